// The alive counter and the checksum of a message: whether a received frame is good, and filling in a sent one.
// Source: AUTOSAR R22-11, "E2E Protocol Specification" (PRS_E2EProtocol), profiles 1 and 2; named polynomials: crc.h;
// Toyota and Honda: as their public DBC files are used. Tests: tests/cockpit_io/message_check_test.cpp.
#pragma once

#include <cstdint>
#include <optional>

#include "cockpit_io/can_frame.h"
#include "cockpit_io/dbc.h"
#include "config/base/result.h"
#include "config/cockpit.h"

namespace phare {

/// One [check.…] of the cockpit file bound to its message, with the counter's memory.
class MessageChecker {
 public:
  enum class Verdict {
    kGood,
    kBadCrc,
    kBadCounter,  ///< it stands still, or jumped further than frames may be missing (the next frame counts from there)
  };

  /// Error where the DBC has no such signal (the nearest is named), or one that cannot be a counter or this CRC.
  static Result<MessageChecker> bind(const MessageCheck& check, const Dbc& dbc, const DbcMessage& message);

  /// Judges a frame of the message, which must be as long as the DBC says.
  Verdict take(const CanFrame& frame);

  /// Fills in the counter (the next value) and then the CRC.
  void sign(CanFrame& frame);

  /// Frames that the counter says are missing between those that came.
  std::uint64_t lost() const { return lost_; }

 private:
  std::uint64_t crc_of(const CanFrame& frame) const;
  std::uint64_t counter_of(const CanFrame& frame) const;

  MessageCheck check_;
  std::optional<DbcSignal> counter_, crc_;
  std::uint64_t counter_values_ = 0;
  std::uint64_t data_bytes_ = 0;  ///< of the message
  std::optional<std::uint64_t> last_;
  std::uint64_t lost_ = 0;
};

/// Looks up a signal: its index in the message, or the Error that says why there is none.
Result<std::size_t> find_signal(const Dbc& dbc, const DbcMessage& message, const std::string& name,
                                const std::string& place);
Result<std::size_t> find_message(const Dbc& dbc, const std::string& name, const std::string& place);

}  // namespace phare
