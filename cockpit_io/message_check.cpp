#include "cockpit_io/message_check.h"

#include <string>
#include <vector>

#include "cockpit_io/crc.h"
#include "config/formats/toml_table.h"

namespace phare {

namespace {

/// Bits that a kind of check gives.
std::uint32_t bits_of(const MessageCheck& check) {
  switch (check.crc_kind) {
    case CrcKind::kPolynomial:
      return static_cast<std::uint32_t>(check.polynomial.width);
    case CrcKind::kCrc16CcittFalse:
    case CrcKind::kCrc16Arc:
      return 16;
    case CrcKind::kCrc32:
    case CrcKind::kCrc32P4:
      return 32;
    case CrcKind::kHonda:
      return 4;
    default:
      return 8;
  }
}

CrcParams params_of(const MessageCheck& check) {
  const CrcPolynomial& p = check.polynomial;
  switch (check.crc_kind) {
    case CrcKind::kPolynomial:
      return {p.width, p.poly, p.init, p.reflect, p.xor_out};
    case CrcKind::kE2eProfile1:
      return kCrc8E2eProfile1;
    case CrcKind::kE2eProfile2:
    case CrcKind::kCrc8H2f:
      return kCrc8H2f;
    case CrcKind::kCrc8SaeJ1850:
      return kCrc8SaeJ1850;
    case CrcKind::kCrc16CcittFalse:
      return kCrc16CcittFalse;
    case CrcKind::kCrc16Arc:
      return kCrc16Arc;
    case CrcKind::kCrc32:
      return kCrc32;
    case CrcKind::kCrc32P4:
      return kCrc32P4;
    default:
      return kCrc8;
  }
}

/// The frame's bytes without those the check lies in.
std::vector<std::uint8_t> checked_bytes(const MessageCheck& check, const DbcSignal& crc, const CanFrame& frame) {
  const bool some = check.crc_kind == CrcKind::kPolynomial;
  const std::size_t first = some ? static_cast<std::size_t>(check.polynomial.first_byte) : 0;
  const std::size_t last = some ? static_cast<std::size_t>(check.polynomial.last_byte) : CanFrame::kMaxLength;
  CanFrame where;  // ones where the check lies
  where.length = frame.length;
  DbcMessage alone;
  encode_raw(alone, crc, ~std::uint64_t{0}, where);
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = first; i < frame.length && i <= last; ++i) {
    if (where.data[i] == 0) bytes.push_back(frame.data[i]);
  }
  return bytes;
}

std::uint64_t nibble_sum(std::uint32_t number) {
  std::uint64_t sum = 0;
  for (; number != 0; number >>= 4) sum += number & 0xFu;
  return sum;
}

}  // namespace

Result<std::size_t> find_signal(const Dbc& dbc, const DbcMessage& message, const std::string& name,
                                const std::string& place) {
  if (const DbcSignal* found = message.find(name)) return static_cast<std::size_t>(found - message.signals.data());
  for (const DbcProblem& problem : dbc.problems) {
    if (problem.message == message.name && problem.signal == name) {
      return Error{place, "signal \"" + name + "\" cannot be used: " + dbc.file.string() + ":" +
                              std::to_string(problem.line) + ": " + problem.reason};
    }
  }
  std::vector<std::string> names;
  for (const DbcSignal& signal : message.signals) names.push_back(signal.name);
  return Error{place, unknown_name_reason("signal", name, names) + " (in message " + message.name + " of " +
                          dbc.file.filename().string() + ")"};
}

Result<std::size_t> find_message(const Dbc& dbc, const std::string& name, const std::string& place) {
  if (const DbcMessage* found = dbc.find(name)) return static_cast<std::size_t>(found - dbc.messages.data());
  for (const DbcProblem& problem : dbc.problems) {
    if (problem.message == name && problem.signal.empty()) {
      return Error{place, "message \"" + name + "\" cannot be used: " + dbc.file.string() + ":" +
                              std::to_string(problem.line) + ": " + problem.reason};
    }
  }
  std::vector<std::string> names;
  for (const DbcMessage& message : dbc.messages) names.push_back(message.name);
  std::string reason = "no message \"" + name + "\" in " + dbc.file.filename().string();
  if (const std::string nearest = nearest_name(name, names); !nearest.empty())
    reason += "; did you mean \"" + nearest + "\"?";
  return Error{place, reason};
}

Result<MessageChecker> MessageChecker::bind(const MessageCheck& check, const Dbc& dbc, const DbcMessage& message) {
  MessageChecker checker;
  checker.check_ = check;
  checker.data_bytes_ = message.length_bytes;
  if (!check.counter.empty()) {
    const auto found = find_signal(dbc, message, check.counter, check.counter_place);
    if (!found) return found.error();
    const DbcSignal& s = message.signals[*found];
    const std::uint64_t most = s.length_bits >= 31 ? 0 : std::uint64_t{1} << s.length_bits;
    checker.counter_values_ = check.counter_values ? static_cast<std::uint64_t>(*check.counter_values) : most;
    if (most < 2 || checker.counter_values_ > most) {
      return Error{check.counter_place, "\"" + s.name + "\" has " + std::to_string(s.length_bits) +
                                            " bits: no counter, or too few for counter_values"};
    }
    if (check.crc_kind == CrcKind::kE2eProfile2 && most != 16)
      return Error{check.counter_place,
                   "profile 2 of E2E counts in 4 bits, \"" + s.name + "\" has " + std::to_string(s.length_bits)};
    checker.counter_ = s;
  }
  if (!check.crc.empty()) {
    const auto found = find_signal(dbc, message, check.crc, check.crc_place);
    if (!found) return found.error();
    const DbcSignal& s = message.signals[*found];
    if (s.length_bits != bits_of(check)) {
      return Error{check.crc_place, "\"" + s.name + "\" has " + std::to_string(s.length_bits) + " bits, " +
                                        std::string(kCrcNames[static_cast<std::size_t>(check.crc_kind)]) + " gives " +
                                        std::to_string(bits_of(check))};
    }
    checker.crc_ = s;
    checker.crc_->multiplexor.clear();
  }
  if (checker.counter_) checker.counter_->multiplexor.clear();
  return checker;
}

std::uint64_t MessageChecker::counter_of(const CanFrame& frame) const {
  return counter_ ? raw_bits(*counter_, frame.bytes()).value_or(0) : 0;
}

std::uint64_t MessageChecker::crc_of(const CanFrame& frame) const {
  const std::vector<std::uint8_t> bytes = checked_bytes(check_, *crc_, frame);
  std::uint64_t sum = 0;
  switch (check_.crc_kind) {
    case CrcKind::kXor8:
      for (const std::uint8_t byte : bytes) sum ^= byte;
      return sum;
    case CrcKind::kSum8:
      for (const std::uint8_t byte : bytes) sum += byte;
      return sum & 0xFFu;
    case CrcKind::kToyota:  // the id's bytes, the length and the data
      sum = (frame.id >> 24) + (frame.id >> 16 & 0xFFu) + (frame.id >> 8 & 0xFFu) + (frame.id & 0xFFu) + frame.length;
      for (const std::uint8_t byte : bytes) sum += byte;
      return sum & 0xFFu;
    case CrcKind::kHonda: {  // minus the sum of all hexadecimal digits but the check's own, which is the last
      sum = nibble_sum(frame.id);
      for (std::size_t i = 0; i < frame.length; ++i) {
        const bool last = i + 1u == frame.length;
        sum += static_cast<std::uint64_t>(frame.data[i] >> 4) + (last ? 0u : frame.data[i] & 0xFu);
      }
      return ((frame.extended ? 11u : 8u) - sum) & 0xFu;
    }
    default:
      break;
  }
  Crc crc(params_of(check_));
  const auto id = check_.data_ids.empty() ? std::int64_t{0} : check_.data_ids.front();
  if (check_.crc_kind == CrcKind::kE2eProfile1) {
    const bool low = check_.data_id_mode != DataIdMode::kAlternating || counter_of(frame) % 2 == 0;
    if (low) crc.add(static_cast<std::uint8_t>(id & 0xFF));
    if (!low || check_.data_id_mode == DataIdMode::kBoth) crc.add(static_cast<std::uint8_t>(id >> 8 & 0xFF));
    crc.add(bytes);
    return crc.value();
  }
  if (check_.crc_kind == CrcKind::kPolynomial) {
    const auto add_id = [&] {
      if (!check_.data_ids.empty())
        crc.add(static_cast<std::uint8_t>(check_.data_ids[counter_of(frame) % check_.data_ids.size()]));
    };
    if (check_.polynomial.data_id_first) add_id();
    crc.add(bytes);
    if (!check_.polynomial.data_id_first) add_id();
    return crc.value();
  }
  crc.add(bytes);
  if (check_.crc_kind == CrcKind::kE2eProfile2) {
    crc.add(static_cast<std::uint8_t>(check_.data_ids[counter_of(frame) % check_.data_ids.size()]));
  } else if (!check_.data_ids.empty()) {
    crc.add(static_cast<std::uint8_t>(id));
  }
  return crc.value();
}

MessageChecker::Verdict MessageChecker::take(const CanFrame& frame) {
  if (crc_ && (frame.length < data_bytes_ || raw_bits(*crc_, frame.bytes()) != crc_of(frame))) return Verdict::kBadCrc;
  if (!counter_) return Verdict::kGood;
  if (bytes_needed(*counter_) > frame.length) return Verdict::kBadCounter;
  const std::uint64_t counter = counter_of(frame);
  const std::optional<std::uint64_t> last = std::exchange(last_, counter);
  if (counter >= counter_values_) return Verdict::kBadCounter;
  if (!last || *last >= counter_values_) return Verdict::kGood;
  const auto step = static_cast<std::uint64_t>(check_.counter_step);
  // How many frames later this counter comes round; a step that does not divide the range passes every value.
  std::uint64_t frames = 1;
  std::uint64_t expected = *last;
  for (; frames <= static_cast<std::uint64_t>(check_.counter_most_lost) + 1; ++frames) {
    expected = (expected + step) % counter_values_;
    if (expected == counter) break;
    if (expected == *last) return Verdict::kBadCounter;  // round once without meeting it
  }
  if (expected != counter || counter == *last) return Verdict::kBadCounter;
  lost_ += frames - 1;
  return Verdict::kGood;
}

void MessageChecker::sign(CanFrame& frame) {
  const DbcMessage alone;
  if (counter_) {
    last_ = last_ ? (*last_ + static_cast<std::uint64_t>(check_.counter_step)) % counter_values_ : 0;
    encode_raw(alone, *counter_, *last_, frame);
  }
  if (crc_) encode_raw(alone, *crc_, crc_of(frame), frame);
}

}  // namespace phare
