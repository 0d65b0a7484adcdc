// The cockpit file's mapping bound to a DBC: CAN frames in, the driver's controls out, and a clock for each mapped
// message.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cockpit_io/can_frame.h"
#include "cockpit_io/control_reader.h"
#include "cockpit_io/dbc.h"
#include "cockpit_io/driver_input.h"
#include "cockpit_io/message_check.h"
#include "config/base/result.h"
#include "config/cockpit.h"

namespace phare {

/// A control's signal as the control reads it: where the cockpit file says that the car has it ("16|4@1+"), else as the
/// DBC file has it. Error: bits that are none, or do not fit the message.
Result<DbcSignal> laid_out(const ControlMapping& mapping, const DbcMessage& message, const DbcSignal& signal);

class SignalMap {
 public:
  enum class Taken {
    kNotMapped,   ///< no control comes from this id
    kDecoded,     ///< every control of it was read
    kIncomplete,  ///< too short, or a multiplexed signal was not in it, or a value fits no level: those controls stay
    kBadCrc,      ///< refused: nothing was read
    kBadCounter,  ///< refused: nothing was read
  };

  /// Looks up every signal. Error at the cockpit file's line for a message or signal the DBC has not (naming the
  /// nearest), or one that the DBC reader had to drop (naming the DBC's line). `start_ns`: when listening begins, see
  /// take().
  static Result<SignalMap> bind(const CockpitConfig& config, Dbc dbc, std::int64_t start_ns);

  /// Reads a frame into the controls. `at_ns`: when it was on the bus, on any one clock that does not go back.
  Taken take(const CanFrame& frame, std::int64_t at_ns, DriverInput& input);

  /// When the source will have been silent for its timeout if no more frames come: the first of the mapped messages.
  std::int64_t silent_at_ns() const;
  /// The name of that message.
  const std::string& most_silent() const;

  /// Latches, and when each message was heard.
  void remember(Memory& memory);

  bool knows(const CanFrame& frame) const;
  std::vector<CanId> ids() const;
  const Dbc& dbc() const { return dbc_; }
  const CockpitConfig& config() const { return config_; }
  /// Frames missing between those that came, by the alive counters that are checked.
  std::uint64_t lost() const;

 private:
  struct BoundControl {
    ControlReader reader;
    DbcSignal signal{};  ///< as this control reads it: `bits` of another leave it alone
    std::optional<std::size_t> fine_signal, sign_signal;
    std::vector<double> unknown;  ///< values without a meaning that have been told
    /// A value without a meaning leaves the beam open: as if it had not come.
    bool decides_beam() const;
  };
  struct BoundMessage {
    std::size_t message = 0;  ///< index in the DBC
    std::vector<BoundControl> controls;
    std::optional<MessageChecker> checker;
    std::int64_t timeout_ns = 0;
    std::int64_t last_ns = 0;
  };
  enum class Read { kRead, kAbsent, kUnknown, kUnfit };

  static Read read(BoundControl& control, const DbcMessage& message, const CanFrame& frame, std::int64_t at_ns,
                   BeamBits& bits, DriverInput& input);
  const BoundMessage* first_silent() const;

  CockpitConfig config_;
  Dbc dbc_;
  std::vector<BoundMessage> messages_;
  BeamBits bits_;
};

}  // namespace phare
