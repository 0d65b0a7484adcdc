// Bits of a frame and the values they mean. The reader of the files is dbc_reader.cpp.
#include "cockpit_io/dbc.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>

namespace phare {

namespace {

constexpr int kDeepestMultiplex = 8;  // a chain of multiplexors in a file that goes in a circle ends here

/// The position of the bit that is one less significant (Motorola, from the top) or one more (Intel, from the bottom).
/// Motorola numbering: 7 6 5 4 3 2 1 0 | 15 14 … 8 | 23 …, so below bit 0 of a byte comes bit 7 of the next.
std::uint32_t next_bit(bool motorola, std::uint32_t bit) {
  if (!motorola) return bit + 1;
  return bit % 8 == 0 ? bit + 15 : bit - 1;
}

bool is_integer(const DbcSignal& s) {
  return s.type == DbcSignal::Type::kUnsigned || s.type == DbcSignal::Type::kSigned;
}

std::int64_t sign_extended(std::uint64_t raw, std::uint32_t bits) {
  const std::uint64_t sign = std::uint64_t{1} << (bits - 1);
  return static_cast<std::int64_t>((raw ^ sign) - sign);
}

void write_bits(const DbcSignal& s, std::uint64_t raw, CanFrame& frame) {
  std::uint32_t bit = s.start_bit;
  for (std::uint32_t i = 0; i < s.length_bits; ++i, bit = next_bit(s.motorola, bit)) {
    const std::uint32_t rank = s.motorola ? s.length_bits - 1 - i : i;
    const auto at = static_cast<std::uint8_t>(1u << (bit % 8));
    std::uint8_t& byte = frame.data[bit / 8];
    byte = static_cast<std::uint8_t>(((raw >> rank) & 1u) != 0 ? byte | at : byte & ~at);
  }
}

bool has_value(const DbcSignal& s, std::uint64_t raw) {
  return std::any_of(s.multiplex_values.begin(), s.multiplex_values.end(),
                     [raw](const MultiplexRange& range) { return raw >= range.first && raw <= range.last; });
}

bool present(const DbcMessage& message, const DbcSignal& s, std::span<const std::uint8_t> data, int depth) {
  if (bytes_needed(s) > data.size()) return false;
  if (s.multiplexor.empty()) return true;
  const DbcSignal* above = message.find(s.multiplexor);
  if (above == nullptr || depth == 0 || !present(message, *above, data, depth - 1)) return false;
  return has_value(s, *raw_bits(*above, data));
}

/// Turns the multiplexors above `s` to it.
bool switch_to(const DbcMessage& message, const DbcSignal& s, CanFrame& frame, int depth) {
  if (s.multiplexor.empty()) return true;
  const DbcSignal* above = message.find(s.multiplexor);
  if (above == nullptr || depth == 0 || s.multiplex_values.empty() || bytes_needed(*above) > frame.length) return false;
  if (!has_value(s, *raw_bits(*above, frame.bytes()))) {
    const std::uint64_t wanted = s.multiplex_values.front().first;
    if (above->length_bits < 64 && (wanted >> above->length_bits) != 0) return false;
    write_bits(*above, wanted, frame);
  }
  return switch_to(message, *above, frame, depth - 1);
}

}  // namespace

const DbcSignal* DbcMessage::find(std::string_view signal) const {
  const auto found = std::find_if(signals.begin(), signals.end(), [&](const DbcSignal& s) { return s.name == signal; });
  return found == signals.end() ? nullptr : &*found;
}

const DbcMessage* Dbc::find(std::string_view message) const {
  const auto found =
      std::find_if(messages.begin(), messages.end(), [&](const DbcMessage& m) { return m.name == message; });
  return found == messages.end() ? nullptr : &*found;
}

const DbcMessage* Dbc::find(std::uint32_t id, bool extended) const {
  const auto found = std::find_if(messages.begin(), messages.end(),
                                  [&](const DbcMessage& m) { return m.id == id && m.extended == extended; });
  return found == messages.end() ? nullptr : &*found;
}

std::size_t Dbc::signal_count() const {
  std::size_t count = 0;
  for (const DbcMessage& message : messages) count += message.signals.size();
  return count;
}

std::uint32_t bytes_needed(const DbcSignal& s) {
  const std::uint32_t first_byte = s.start_bit / 8;
  const std::uint32_t bits_in_first = s.motorola ? s.start_bit % 8 + 1 : 8 - s.start_bit % 8;
  if (s.length_bits <= bits_in_first) return first_byte + 1;
  return first_byte + 1 + (s.length_bits - bits_in_first + 7) / 8;
}

bool is_present(const DbcMessage& message, const DbcSignal& s, std::span<const std::uint8_t> data) {
  return present(message, s, data, kDeepestMultiplex);
}

std::optional<std::uint64_t> raw_bits(const DbcSignal& s, std::span<const std::uint8_t> data) {
  if (bytes_needed(s) > data.size()) return std::nullopt;
  std::uint64_t raw = 0;
  std::uint32_t bit = s.start_bit;
  for (std::uint32_t i = 0; i < s.length_bits; ++i, bit = next_bit(s.motorola, bit)) {
    const std::uint32_t rank = s.motorola ? s.length_bits - 1 - i : i;
    raw |= static_cast<std::uint64_t>((data[bit / 8] >> (bit % 8)) & 1u) << rank;
  }
  return raw;
}

std::optional<std::int64_t> raw_value(const DbcSignal& s, std::span<const std::uint8_t> data) {
  const auto raw = raw_bits(s, data);
  if (!raw) return std::nullopt;
  return s.type == DbcSignal::Type::kSigned ? sign_extended(*raw, s.length_bits) : static_cast<std::int64_t>(*raw);
}

std::optional<double> decode(const DbcMessage& message, const DbcSignal& s, const CanFrame& frame) {
  if (!frame.carries_data() || !is_present(message, s, frame.bytes())) return std::nullopt;
  const std::uint64_t raw = *raw_bits(s, frame.bytes());
  double value = 0.0;
  switch (s.type) {
    case DbcSignal::Type::kUnsigned:
      value = static_cast<double>(raw);
      break;
    case DbcSignal::Type::kSigned:
      value = static_cast<double>(sign_extended(raw, s.length_bits));
      break;
    case DbcSignal::Type::kFloat:
      value = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(raw)));
      break;
    case DbcSignal::Type::kDouble:
      value = std::bit_cast<double>(raw);
      break;
  }
  const double physical = value * s.factor + s.offset;
  return std::isfinite(physical) ? std::optional(physical) : std::nullopt;
}

bool encode_raw(const DbcMessage& message, const DbcSignal& s, std::uint64_t raw, CanFrame& frame) {
  if (frame.length > CanFrame::kMaxLength || bytes_needed(s) > frame.length) return false;
  const CanFrame before = frame;
  if (!switch_to(message, s, frame, kDeepestMultiplex)) {
    frame = before;
    return false;
  }
  write_bits(s, raw, frame);
  return true;
}

bool encode(const DbcMessage& message, const DbcSignal& s, double value, CanFrame& frame) {
  const double scaled = (value - s.offset) / s.factor;
  if (!std::isfinite(scaled)) return false;
  std::uint64_t raw = 0;
  if (is_integer(s)) {
    const double rounded = std::round(scaled);
    const bool is_signed = s.type == DbcSignal::Type::kSigned;
    const double end =
        std::ldexp(1.0, static_cast<int>(s.length_bits) - (is_signed ? 1 : 0));  // first that does not fit
    if (rounded >= end || rounded < (is_signed ? -end : 0.0)) return false;
    raw = is_signed ? static_cast<std::uint64_t>(static_cast<std::int64_t>(rounded))
                    : static_cast<std::uint64_t>(rounded);
  } else if (s.type == DbcSignal::Type::kFloat) {
    const auto narrow = static_cast<float>(scaled);
    if (!std::isfinite(narrow)) return false;
    raw = std::bit_cast<std::uint32_t>(narrow);
  } else {
    raw = std::bit_cast<std::uint64_t>(scaled);
  }
  return encode_raw(message, s, raw, frame);
}

namespace {

/// A signal in a frame of its own, which no multiplexor takes away.
struct Alone {
  explicit Alone(const DbcSignal& of) : signal(of) {
    signal.multiplexor.clear();
    frame.length = CanFrame::kMaxLength;
  }
  DbcMessage message{};
  DbcSignal signal;
  CanFrame frame{};
};

}  // namespace

std::optional<double> physical_value(const DbcSignal& signal, std::uint64_t raw) {
  Alone alone(signal);
  encode_raw(alone.message, alone.signal, raw, alone.frame);
  return decode(alone.message, alone.signal, alone.frame);
}

std::optional<double> nearest_value(const DbcSignal& signal, double value) {
  Alone alone(signal);
  if (!encode(alone.message, alone.signal, value, alone.frame)) return std::nullopt;
  return decode(alone.message, alone.signal, alone.frame);
}

std::string physical_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::uint32_t fd_length(std::uint32_t bytes) {
  constexpr std::array<std::uint32_t, 7> kLong{12, 16, 20, 24, 32, 48, 64};
  if (bytes <= 8) return bytes;
  const auto found = std::lower_bound(kLong.begin(), kLong.end(), bytes);
  return found == kLong.end() ? kLong.back() : *found;
}

CanFrame empty_frame(const DbcMessage& message) {
  CanFrame frame;
  frame.id = message.id;
  frame.extended = message.extended;
  frame.fd = message.fd;
  frame.length = static_cast<std::uint8_t>(message.fd ? fd_length(message.length_bytes) : message.length_bytes);
  return frame;
}

}  // namespace phare
