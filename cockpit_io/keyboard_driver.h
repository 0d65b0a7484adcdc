// What the driver does by keys, or with a gamepad: hands that are either on or off, made into a wheel and pedals.
// What: pedals that are pressed and let go in a fraction of a second; a wheel that turns while a key is held and comes
// back when none is. It turns as far as gives a lateral acceleration of 5 m/s² at the speed of now, and always in the
// same time, so that a tap is a small correction at 100 km/h as at 10: a person with keys holds a lane (the test drives
// one with the delay of a person). Frame: wheel left positive. Source: none, chosen by driving; the figures stand in
// the .cpp. Leaves out: the understeer of the car. Tests: tests/cockpit_io/keyboard_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "cockpit_io/cockpit.h"
#include "cockpit_io/memory.h"
#include "config/key_bindings.h"

namespace phare {

/// A gamepad as it is held.
struct PadReading {
  double left_m1_1 = 0.0;  ///< the stick: 1 left, -1 right
  double accelerator_01 = 0.0, brake_01 = 0.0;
  std::array<bool, kKeyActions> pressed{};  ///< what its buttons mean

  friend bool operator==(const PadReading&, const PadReading&) = default;
};

class KeyboardDriver {
 public:
  /// Bytes as a terminal sends them; those of no key are passed over. A terminal tells presses only, so a key counts as
  /// held for a while after the newest press; the repeat of a held key keeps it down.
  void press(std::string_view bytes, Moment now, ControlSink& cockpit);
  /// A key of the window, or of the terminal, goes down; it then counts as held for `held_ns` at least.
  void press(KeyAction action, std::int64_t held_ns, Moment now, ControlSink& cockpit);
  /// What is held in the window now.
  void hold(const std::array<bool, kKeyActions>& held) { window_held_ = held; }
  /// Whoever moved last has wheel and pedals: the pad, or the keys.
  void pad(const PadReading& reading, Moment now, ControlSink& cockpit);
  void no_pad();  ///< it was unplugged, or never there
  /// Of the car, forward or back.
  void set_speed(double speed_mps) { speed_mps_ = speed_mps; }
  /// Time goes by in which somebody else has wheel and pedals: only a flash that was let go ends.
  void pass(Moment now);
  /// Moves wheel and pedals on.
  void advance(Moment now, ControlSink& cockpit);

  void remember(Memory& memory);

  const DriverInput& input() const { return input_; }
  /// Goes on from what somebody else held: the demo driver gives the car back.
  void adopt(const DriverInput& input) { input_ = input; }
  /// What has been pressed since the last call; the pad, when it begins to drive, counts as kAccelerate.
  std::array<bool, kKeyActions> take_pressed();

  /// How long a key counts as held after a terminal sent it, and at least when the window did.
  static std::int64_t terminal_hold_ns(KeyAction action);
  static constexpr std::int64_t kTap_ns = 80'000'000;

 private:
  bool held(KeyAction action, Moment now) const;
  void switch_over(KeyAction action, Moment now, ControlSink& cockpit);

  DriverInput input_{.switches = {.stalk = LightSwitch::kLow}};
  std::array<bool, kKeyActions> window_held_{}, pressed_{};
  std::array<std::int64_t, kKeyActions> until_ns_{};
  PadReading pad_;
  PadReading pad_rest_;  // where it lay when the keys last drove: it drives once it has left that
  bool pad_seen_ = false, pad_drives_ = false;
  double speed_mps_ = 0.0;
  std::int64_t newest_ns_ = 0;
};

/// The angle of the steering wheel that the keys reach at a speed.
double most_wheel_rad(double speed_mps);

}  // namespace phare
