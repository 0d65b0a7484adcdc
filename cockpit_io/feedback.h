// What Phare says on the bus: telltales and speed, in the messages the cockpit file names.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cockpit_io/can_frame.h"
#include "cockpit_io/dbc.h"
#include "cockpit_io/message_check.h"
#include "cockpit_io/switch_logic.h"
#include "config/base/result.h"
#include "config/cockpit.h"

namespace phare {

struct FeedbackValues {
  Telltales telltales;
  LightSwitch light = LightSwitch::kOff;
  std::uint32_t design_index = 0;
  double speed_mps = 0.0;
  double steering_wheel_rad = 0.0;
};

/// What is doubtful about what is sent, "file:line: …" each: signals that do not hold what their source says.
std::vector<std::string> send_doubts(const CockpitConfig& config, const Dbc& dbc);

class Feedback {
 public:
  /// Looks up every signal. Error as of SignalMap::bind().
  static Result<Feedback> bind(const CockpitConfig& config, const Dbc& dbc);

  /// The frames to be sent now: those whose period is over, and those of which a telltale has changed. `now_ns`: any
  /// one clock that does not go back.
  std::vector<CanFrame> due(const FeedbackValues& values, std::int64_t now_ns);

  bool empty() const { return messages_.empty(); }

 private:
  struct BoundSignal {
    DbcSignal signal;
    SendValue value;
  };
  struct BoundMessage {
    DbcMessage message;
    std::vector<BoundSignal> signals;
    std::optional<MessageChecker> signer;
    std::int64_t period_ns = 0;
    std::optional<std::int64_t> sent_ns;
    FeedbackValues sent;
  };
  std::vector<BoundMessage> messages_;
};

}  // namespace phare
