// The driver's controls from the keys of a terminal.
//   l L  light switch up, down        f  flash        g  fog        n p  design next, previous
//   b  rear fog      , .  turn left, right      h  hazard      a  automatic high beam      r  reverse and back
//   k  parking brake
//   arrows  accelerate, brake, steer  space  wheel straight, pedals released
#pragma once

#include <termios.h>

#include <optional>
#include <string_view>

#include "cockpit_io/source.h"

namespace phare {

/// What keys mean, apart from the terminal. A terminal tells presses only, so a pedal or the flash counts as held for a
/// while after the newest press; the repeat of a held key keeps it down.
class KeyboardDriver {
 public:
  /// Bytes as the terminal sends them; unknown ones and unknown escape sequences are passed over.
  void press(std::string_view bytes, Moment now, ControlSink& cockpit);
  /// Lets go of what has been held long enough.
  void advance(Moment now, ControlSink& cockpit);

  const DriverInput& input() const { return input_; }

 private:
  void key(char key, Moment now, ControlSink& cockpit);
  void arrow(char direction, Moment now);

  DriverInput input_{.switches = {.stalk = LightSwitch::kLow}};
  std::int64_t flash_until_ns_ = 0, accelerator_until_ns_ = 0, brake_until_ns_ = 0, steering_until_ns_ = 0;
  std::int64_t newest_ns_ = 0;
};

class KeyboardSource : public Source {
 public:
  /// Puts standard input into raw mode if it is a terminal in the foreground; else there are no keys and low beam is
  /// on.
  KeyboardSource();
  ~KeyboardSource() override;  ///< gives the terminal back as it was

  void advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) override;
  std::vector<int> wait_fds() const override;
  std::string status() const override { return terminal_ ? "up" : "no terminal"; }

 private:
  std::optional<termios> terminal_;  // as it was; nullopt: no terminal
  KeyboardDriver driver_;
};

}  // namespace phare
