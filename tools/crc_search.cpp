#include "tools/crc_search.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "cockpit_io/crc.h"
#include "cockpit_io/dbc.h"
#include "cockpit_io/message_check.h"
#include "config/cockpit.h"

namespace phare {
namespace {

constexpr std::size_t kMostFrames = 400;  // of a message: many times more than a wrong check fits by chance

/// The frames of one message, all of one length.
struct OfOneId {
  CanId id;
  std::vector<CanFrame> different;
  std::vector<CanFrame> in_order;  // the first ones, also those that are like others
};

std::vector<OfOneId> frames_by_id(const CandumpLog& log) {
  std::map<std::pair<std::uint32_t, bool>, OfOneId> all;
  for (const CandumpEntry& entry : log.entries) {
    const CanFrame& frame = entry.frame;
    if (!frame.carries_data() || frame.length < 2) continue;
    OfOneId& of = all[{frame.id, frame.extended}];
    of.id = {frame.id, frame.extended};
    if (!of.in_order.empty() && of.in_order[0].length != frame.length) continue;
    if (of.in_order.size() < kMostFrames) of.in_order.push_back(frame);
    if (of.different.size() < kMostFrames && std::ranges::find(of.different, frame) == of.different.end())
      of.different.push_back(frame);
  }
  std::vector<OfOneId> list;
  for (auto& [id, of] : all) list.push_back(std::move(of));
  return list;
}

// ---- places

struct Bits {
  std::uint32_t start = 0, length = 8;
  bool motorola = false;
};

DbcSignal signal_of(const std::string& name, const Bits& bits) {
  DbcSignal signal;
  signal.name = name;
  signal.start_bit = bits.start;
  signal.length_bits = bits.length;
  signal.motorola = bits.motorola;
  return signal;
}

std::string line_of(const std::string& name, const Bits& bits) {
  return "SG_ " + name + " : " + std::to_string(bits.start) + "|" + std::to_string(bits.length) + "@" +
         (bits.motorola ? "0" : "1") + "+ (1,0) [0|" + std::to_string((std::uint64_t{1} << bits.length) - 1) +
         "] \"\" PHARE";
}

/// Half a byte, where counters are.
struct Nibble {
  std::size_t byte = 0;
  bool high = false;

  unsigned of(const CanFrame& frame) const { return (frame.data[byte] >> (high ? 4 : 0)) & 15u; }
  Bits bits() const { return {static_cast<std::uint32_t>(8 * byte + (high ? 4 : 0)), 4, false}; }
  std::string text() const {
    return "counter in the " + std::string(high ? "upper" : "lower") + " half of byte " + std::to_string(byte);
  }
};

/// All but those of the check's byte.
std::vector<Nibble> nibbles(std::size_t length, std::size_t check_byte) {
  std::vector<Nibble> all;
  for (std::size_t byte = 0; byte < length; ++byte)
    for (const bool high : {false, true})
      if (byte != check_byte) all.push_back({byte, high});
  return all;
}

/// How many values a nibble counts through, 15 or 16; 0: it does not count. One step in ten may lack frames.
int counts_through(const std::vector<CanFrame>& in_order, const Nibble& nibble) {
  unsigned most = 0;
  for (const CanFrame& frame : in_order) most = std::max(most, nibble.of(frame));
  const unsigned values = most == 15 ? 16 : 15;
  std::size_t steps = 0;
  for (std::size_t i = 1; i < in_order.size(); ++i)
    steps += (nibble.of(in_order[i - 1]) + 1) % values == nibble.of(in_order[i]) ? 1u : 0u;
  return 10 * steps >= 9 * (in_order.size() - 1) ? static_cast<int>(values) : 0;
}

// ---- kinds

struct Kind {
  CrcKind kind;
  CrcParams params;
};
constexpr Kind kByteCrcs[]{
    {CrcKind::kCrc8, kCrc8}, {CrcKind::kCrc8SaeJ1850, kCrc8SaeJ1850}, {CrcKind::kCrc8H2f, kCrc8H2f}};
constexpr Kind kLongCrcs[]{{CrcKind::kCrc16CcittFalse, kCrc16CcittFalse},
                           {CrcKind::kCrc16Arc, kCrc16Arc},
                           {CrcKind::kCrc32, kCrc32},
                           {CrcKind::kCrc32P4, kCrc32P4}};

std::string kind_key(CrcKind kind) {
  return "crc_kind = \"" + std::string(kCrcNames[static_cast<std::size_t>(kind)]) + "\"";
}

std::string bytes_text(std::size_t first, std::size_t count) {
  if (count == 1) return "byte " + std::to_string(first);
  return "bytes " + std::to_string(first) + (count == 2 ? " and " : " to ") + std::to_string(first + count - 1);
}

/// The register after the frame's bytes but `count` from `first` on.
Crc over_others(const CrcParams& params, const CanFrame& frame, std::size_t first, std::size_t count) {
  Crc crc(params);
  for (std::size_t i = 0; i < frame.length; ++i)
    if (i < first || i >= first + count) crc.add(frame.data[i]);
  return crc;
}

/// Whether a cockpit file's check of a message with nothing but the check takes all frames.
bool all_fit(CrcKind kind, const Bits& bits, const std::vector<std::int64_t>& data_ids,
             const std::vector<CanFrame>& frames) {
  Dbc dbc;
  DbcMessage message;
  message.name = "M";
  message.length_bytes = frames[0].length;
  message.signals.push_back(signal_of("CRC", bits));
  MessageCheck check;
  check.message = "M";
  check.crc = "CRC";
  check.crc_kind = kind;
  check.data_ids = data_ids;
  auto checker = MessageChecker::bind(check, dbc, message);
  return checker && std::ranges::all_of(frames, [&](const CanFrame& frame) {
           return checker->take(frame) == MessageChecker::Verdict::kGood;
         });
}

/// The byte behind all others that gives the frame's check; nullopt: none does.
std::optional<std::int64_t> id_behind(const CrcParams& params, const CanFrame& frame, const Bits& bits,
                                      std::size_t first, std::size_t count) {
  const Crc before = over_others(params, frame, first, count);
  const auto wanted = raw_bits(signal_of("CRC", bits), frame.bytes());
  for (std::int64_t id = 0; id < 256; ++id) {
    Crc with = before;
    with.add(static_cast<std::uint8_t>(id));
    if (with.value() == wanted) return id;
  }
  return std::nullopt;
}

// ---- AUTOSAR E2E

/// CRC-8/AUTOSAR with a data id for each value of a counter (profile 2): the ids, by the counter; empty: it is not.
std::vector<std::int64_t> profile_2_ids(const std::vector<CanFrame>& frames, std::size_t crc_byte,
                                        const Nibble& counter) {
  std::array<std::optional<std::int64_t>, 16> ids{};
  std::array<int, 16> seen{};
  for (const CanFrame& frame : frames) {
    const auto fits = id_behind(kCrc8H2f, frame, {static_cast<std::uint32_t>(8 * crc_byte), 8, false}, crc_byte, 1);
    const unsigned value = counter.of(frame);
    if (ids[value] && ids[value] != fits) return {};
    ids[value] = fits;
    ++seen[value];
  }
  std::vector<std::int64_t> all;
  std::set<std::int64_t> different;
  for (std::size_t value = 0; value < 16; ++value) {
    if (!ids[value] || seen[value] < 2) return {};
    all.push_back(*ids[value]);
    different.insert(*ids[value]);
  }
  return different.size() > 1 ? all : std::vector<std::int64_t>{};
}

/// Profile 1 begins with the data id: for each frame the register before its first byte that gives its check.
std::vector<std::uint8_t> profile_1_begins(const std::vector<CanFrame>& frames, std::size_t crc_byte) {
  CrcParams params = kCrc8E2eProfile1;
  std::array<std::uint8_t, 256> begin_of{};  // by what it is after as many zeros
  for (unsigned begin = 0; begin < 256; ++begin) {
    params.init = begin;
    Crc crc(params);
    for (std::size_t i = 1; i < frames[0].length; ++i) crc.add(std::uint8_t{0});
    begin_of[crc.value()] = static_cast<std::uint8_t>(begin);
  }
  std::vector<std::uint8_t> begins;  // a CRC of a sum is the sum of the CRCs
  for (const CanFrame& frame : frames)
    begins.push_back(begin_of[over_others(kCrc8E2eProfile1, frame, crc_byte, 1).value() ^ frame.data[crc_byte]]);
  return begins;
}

/// The byte that takes the register from 0 there.
std::int64_t byte_before(std::uint8_t begin) {
  std::int64_t byte = 0;
  for (; byte < 255; ++byte) {
    Crc crc(kCrc8E2eProfile1);
    crc.add(static_cast<std::uint8_t>(byte));
    if (crc.value() == begin) break;
  }
  return byte;
}

/// The data id below 256 with which both its bytes take the register there.
std::int64_t id_before(std::uint8_t begin) {
  std::int64_t id = 0;
  for (; id < 255; ++id) {
    Crc crc(kCrc8E2eProfile1);
    crc.add(static_cast<std::uint8_t>(id));
    crc.add(std::uint8_t{0});
    if (crc.value() == begin) break;
  }
  return id;
}

// ---- one message

class Search {
 public:
  Search(const OfOneId& of, std::vector<CrcFound>& found) : of_(of), frames_(of.different), found_(found) {}

  void run() {
    const std::uint32_t length = frames_[0].length;
    const Bits last{8 * (length - 1), 4, false};
    if (all_fit(CrcKind::kHonda, last, {}, frames_)) add(last, "the last nibble", {kind_key(CrcKind::kHonda)});
    exclusive_or();
    for (std::uint32_t byte = 0; byte < length; ++byte)
      if (changes(byte)) one_byte(byte);
    for (const Kind& kind : kLongCrcs) {
      const auto count = static_cast<std::uint32_t>(kind.params.width / 8);
      for (std::uint32_t byte = 0; byte + count <= length; ++byte)
        for (const bool motorola : {false, true})
          crc(kind, {motorola ? 8 * byte + 7 : 8 * byte, 8 * count, motorola}, byte, count);
    }
  }

 private:
  /// A byte that never changes is no check.
  bool changes(std::size_t byte) const {
    return std::ranges::any_of(frames_,
                               [&](const CanFrame& frame) { return frame.data[byte] != frames_[0].data[byte]; });
  }

  void add(const Bits& crc, const std::string& where, std::vector<std::string> keys, std::string note = {},
           const std::optional<Nibble>& counter = std::nullopt) {
    CrcFound one{of_.id, frames_.size(), {}, where, std::move(note), {line_of("CRC", crc)}, {"crc = \"CRC\""}};
    for (const std::string& key : keys) one.scheme += (one.scheme.empty() ? "" : ", ") + key;
    if (counter) {
      one.where += ", " + counter->text();
      one.signals.push_back(line_of("COUNTER", counter->bits()));
      one.table.push_back("counter = \"COUNTER\"");
    }
    one.table.insert(one.table.end(), keys.begin(), keys.end());
    found_.push_back(std::move(one));
  }

  /// Where all bytes together give 0, each of them is the check of the others.
  void exclusive_or() {
    std::vector<std::uint32_t> bytes;
    for (std::uint32_t byte = 0; byte < frames_[0].length; ++byte)
      if (changes(byte)) bytes.push_back(byte);
    if (bytes.empty() || !all_fit(CrcKind::kXor8, {8 * bytes.back(), 8, false}, {}, frames_)) return;
    add({8 * bytes.back(), 8, false}, bytes_text(bytes.back(), 1), {kind_key(CrcKind::kXor8)},
        "each byte is the exclusive or of the others: which of them is the check cannot be told, and each checks the "
        "same");
  }

  /// A named polynomial, alone or with an id behind the bytes.
  bool crc(const Kind& kind, const Bits& bits, std::size_t first, std::size_t count) {
    std::string where = bytes_text(first, count);
    if (count > 1) where += bits.motorola ? ", the highest first" : ", the lowest first";
    if (all_fit(kind.kind, bits, {}, frames_)) {
      add(bits, where, {kind_key(kind.kind)});
      return true;
    }
    const auto id = id_behind(kind.params, frames_[0], bits, first, count);
    if (!id || !all_fit(kind.kind, bits, {*id}, frames_)) return false;
    add(bits, where, {kind_key(kind.kind), "data_id = " + std::to_string(*id)});
    return true;
  }

  void one_byte(std::uint32_t byte) {
    const Bits bits{8 * byte, 8, false};
    for (const CrcKind kind : {CrcKind::kSum8, CrcKind::kToyota})
      if (all_fit(kind, bits, {}, frames_)) add(bits, bytes_text(byte, 1), {kind_key(kind)});
    bool known = false;
    for (const Kind& kind : kByteCrcs) known = crc(kind, bits, byte, 1) || known;
    // With frames of one length profile 1 and SAE J1850 without an id differ by nothing but where they begin.
    if (!known) known = profile_2(byte) || profile_1(byte);
  }

  bool profile_2(std::uint32_t byte) {
    for (const Nibble& counter : nibbles(frames_[0].length, byte)) {
      const auto ids = profile_2_ids(frames_, byte, counter);
      if (ids.empty()) continue;
      std::string text;
      for (const std::int64_t id : ids) text += (text.empty() ? "" : ", ") + std::to_string(id);
      add({8 * byte, 8, false}, bytes_text(byte, 1), {kind_key(CrcKind::kE2eProfile2), "data_ids = [" + text + "]"}, {},
          counter);
      return true;
    }
    return false;
  }

  bool profile_1(std::uint32_t byte) {
    const Bits bits{8 * byte, 8, false};
    const std::vector<std::uint8_t> begins = profile_1_begins(frames_, byte);
    const bool one = std::ranges::all_of(begins, [&](std::uint8_t begin) { return begin == begins[0]; });
    for (const Nibble& counter : nibbles(frames_[0].length, byte)) {
      std::array<std::optional<std::uint8_t>, 2> of_parity{};
      bool fits = true;
      for (std::size_t i = 0; i < frames_.size() && fits; ++i) {
        auto& begin = of_parity[counter.of(frames_[i]) % 2];
        if (!begin) begin = begins[i];
        fits = begin == begins[i];
      }
      const int values = fits ? counts_through(of_.in_order, counter) : 0;
      if (values == 0 || !of_parity[0] || !of_parity[1]) continue;
      std::vector<std::string> keys{kind_key(CrcKind::kE2eProfile1)};
      if (one) {
        keys.push_back("data_id = " + std::to_string(id_before(begins[0])));
      } else {
        keys.push_back("data_id = " + std::to_string(byte_before(*of_parity[1]) << 8 | byte_before(*of_parity[0])));
        keys.push_back("data_id_mode = \"alternating\"");
      }
      if (values != 15) keys.push_back("counter_values = " + std::to_string(values));
      add(bits, bytes_text(byte, 1), std::move(keys),
          one ? "255 other data_ids, and one with data_id_mode = \"low\", give the same: which is meant cannot be told"
              : "",
          counter);
      return true;
    }
    if (!one) return false;
    // Nothing counts: the same by its parameters, since a profile has a counter.
    add(bits, bytes_text(byte, 1),
        {kind_key(CrcKind::kPolynomial), "width = 8", "poly = " + std::to_string(kCrc8E2eProfile1.polynomial),
         "init = " + std::to_string(begins[0])});
    return true;
  }

  const OfOneId& of_;
  const std::vector<CanFrame>& frames_;
  std::vector<CrcFound>& found_;
};

}  // namespace

std::vector<CrcFound> find_crcs(const CandumpLog& log, std::size_t least) {
  std::vector<CrcFound> found;
  for (const OfOneId& of : frames_by_id(log))
    if (of.different.size() >= least) Search(of, found).run();
  return found;
}

}  // namespace phare
