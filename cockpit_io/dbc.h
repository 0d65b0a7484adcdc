// DBC files: which signals lie where in which CAN frame. Format: Vector's DBC, as real cars' files write it.
//
// Read: BO_, SG_ (Intel and Motorola order, signed; multiplexing M, m0 … and m0M), SG_MUL_VAL_ (extended multiplexing:
// which signal switches, and by which ranges of values), VAL_ and VAL_TABLE_, SIG_VALTYPE_ (float, double), CM_ of
// messages and signals, 29-bit ids (bit 31 of the number), the attributes VFrameFormat (CAN FD) and
// System…LongSymbol (names beyond 32 letters). Passed over: all other attributes, nodes, environment variables, and the
// signals that no message holds (VECTOR__INDEPENDENT_SIG_MSG).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cockpit_io/can_frame.h"
#include "config/base/result.h"

namespace phare {

/// Raw values first … last of a multiplexor, both included.
struct MultiplexRange {
  std::uint64_t first = 0, last = 0;

  friend bool operator==(const MultiplexRange&, const MultiplexRange&) = default;
};

struct DbcSignal {
  enum class Type { kUnsigned, kSigned, kFloat, kDouble };

  std::string name;
  std::uint32_t start_bit =
      0;  ///< as the file numbers it: Intel: least significant bit; Motorola: most significant bit
  std::uint32_t length_bits = 1;  ///< 1 … 64
  bool motorola = false;          ///< bits run from the start bit down, bytes upwards
  Type type = Type::kUnsigned;
  double factor = 1.0;  ///< physical = raw * factor + offset
  double offset = 0.0;
  double minimum = 0.0, maximum = 0.0;  ///< as the file says; both 0: not given
  std::string unit;
  std::string comment;
  bool is_multiplexor = false;
  std::string multiplexor;                       ///< the signal that switches this one; empty: always present
  std::vector<MultiplexRange> multiplex_values;  ///< present only while the multiplexor has one of these
  std::map<std::int64_t, std::string> value_names;
  int line = 0;
};

struct DbcMessage {
  std::uint32_t id = 0;
  bool extended = false;
  bool fd = false;  ///< longer than 8 bytes, or said to be CAN FD by the attribute VFrameFormat
  std::string name;
  std::uint32_t length_bytes = 0;
  std::string comment;
  std::vector<DbcSignal> signals;
  int line = 0;

  const DbcSignal* find(std::string_view signal) const;
};

/// A line that breaks the grammar or cannot be used, and why; the rest of the file was kept.
struct DbcProblem {
  int line = 0;
  std::string message;  ///< in whose block it stands; may be empty
  std::string signal;   ///< the signal of that line; may be empty
  std::string reason;
};

struct Dbc {
  std::filesystem::path file;
  std::vector<DbcMessage> messages;
  std::vector<DbcProblem> problems;

  const DbcMessage* find(std::string_view message) const;
  const DbcMessage* find(std::uint32_t id, bool extended) const;
  std::size_t signal_count() const;
};

/// Reads a DBC file. Error when it cannot be read or holds not one message.
Result<Dbc> read_dbc(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
Result<Dbc> parse_dbc(std::string_view text, const std::string& name);

/// Bytes a frame needs to hold the signal.
std::uint32_t bytes_needed(const DbcSignal& signal);

/// Whether the frame holds the signal: it is long enough, and every multiplexor above the signal has a value of its
/// range.
bool is_present(const DbcMessage& message, const DbcSignal& signal, std::span<const std::uint8_t> data);

/// Raw bits of a signal, not sign-extended; nullopt when the frame is too short to hold it.
std::optional<std::uint64_t> raw_bits(const DbcSignal& signal, std::span<const std::uint8_t> data);

/// Raw value of an integer signal as the file's VAL_ tables count it, sign-extended.
std::optional<std::int64_t> raw_value(const DbcSignal& signal, std::span<const std::uint8_t> data);

/// Physical value in the signal's unit. nullopt when the frame is no data frame, is too short, has another signal in
/// this place (multiplexing), or holds a float that is not finite.
std::optional<double> decode(const DbcMessage& message, const DbcSignal& signal, const CanFrame& frame);

/// Writes raw bits (those above the signal's length are dropped) and, for a multiplexed signal, the multiplexors above
/// it where they do not have a fitting value yet. False (frame unchanged) when the frame is too short.
bool encode_raw(const DbcMessage& message, const DbcSignal& signal, std::uint64_t raw, CanFrame& frame);

/// Writes a physical value into the frame's bits, rounded to the nearest raw value; false (frame unchanged) when the
/// value is not finite, does not fit the bits, or the frame is too short. Sets multiplexors as encode_raw() does.
bool encode(const DbcMessage& message, const DbcSignal& signal, double value, CanFrame& frame);

/// The physical value of raw bits, wherever they stand; nullopt: a float that is not finite.
std::optional<double> physical_value(const DbcSignal& signal, std::uint64_t raw);

/// The value of the signal that is nearest to this one; nullopt: it is not finite or does not fit the bits.
std::optional<double> nearest_value(const DbcSignal& signal, double value);

/// Physical values as messages show them, to ten digits.
std::string physical_text(double value);

/// The shortest length of a CAN FD frame that holds so many bytes: 0 … 8, 12, 16, 20, 24, 32, 48, 64 (ISO 11898-1).
std::uint32_t fd_length(std::uint32_t bytes);

/// A frame of this message, all bits 0.
CanFrame empty_frame(const DbcMessage& message);

}  // namespace phare
