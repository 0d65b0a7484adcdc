#include "cockpit_io/keyboard_driver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace phare {

namespace {

// Chosen: longer than a terminal's first repeat (usually 250 to 500 ms), so that a held key counts as held. Steering
// would go too far in that time; it pauses once before the repeat begins.
constexpr std::int64_t kTerminalHold_ns = 600'000'000;
constexpr std::int64_t kTerminalSteer_ns = 150'000'000;

// Chosen by eye, driving the country road with the keys of a window.
constexpr double kAccelerator_01 = 0.6;                       // 2.4 m/s² with the hatchback
constexpr double kBrake_01 = 0.4;                             // 3.7 m/s²: as one brakes for a bend
constexpr double kPressAccelerator_1ps = 1.5;                 // 0.4 s until the pedal is down
constexpr double kPressBrake_1ps = 3.0;                       // 0.13 s
constexpr double kPressBrakeHard_1ps = 8.0;                   // full in 0.13 s
constexpr double kLetGo_1ps = 6.0;                            // 0.1 s
constexpr double kLateral_mps2 = 5.0;                         // a brisk bend; tyres hold nearly twice as much
constexpr double kWheelbase_m = 2.65, kSteeringRatio = 15.5;  // of a middling car: the wheel need not know which
constexpr double kMostWheel_rad = 4.7;                        // three quarters of a turn, below 22 km/h
constexpr double kOut_s = 0.6;                                // from straight to the most
constexpr double kBack_s = 0.35;                              // and back
constexpr double kPadOut_s = 0.2;                             // a stick is turned as fast as a thumb; the wheel is not
constexpr double kPadMoved = 0.15;                            // a stick that rests lies within

void toward(double& value, double goal, double step) {
  value = value < goal ? std::min(value + step, goal) : std::max(value - step, goal);
}

std::size_t index(KeyAction action) {
  return static_cast<std::size_t>(action);
}

}  // namespace

double most_wheel_rad(double speed_mps) {
  const double v2 = std::max(speed_mps * speed_mps, 1.0);
  return std::min(kMostWheel_rad, kSteeringRatio * std::atan(kWheelbase_m * kLateral_mps2 / v2));
}

std::int64_t KeyboardDriver::terminal_hold_ns(KeyAction action) {
  return action == KeyAction::kSteerLeft || action == KeyAction::kSteerRight ? kTerminalSteer_ns : kTerminalHold_ns;
}

void KeyboardDriver::press(std::string_view bytes, Moment now, ControlSink& cockpit) {
  while (!bytes.empty()) {
    const auto code = take_terminal_key(bytes);
    if (!code) continue;
    const KeyAction action = binding_of(*code)->action;
    press(action, terminal_hold_ns(action), now, cockpit);
  }
}

void KeyboardDriver::press(KeyAction action, std::int64_t held_ns, Moment now, ControlSink& cockpit) {
  until_ns_[index(action)] = std::max(until_ns_[index(action)], now.sim.ns + held_ns);
  pressed_[index(action)] = true;
  if (is_driving(action)) {
    pad_drives_ = false;
    pad_rest_ = pad_;
  }
  switch_over(action, now, cockpit);
}

/// What a press changes; what holds as long as the key does is in advance().
void KeyboardDriver::switch_over(KeyAction action, Moment now, ControlSink& cockpit) {
  SwitchInput& switches = input_.switches;
  const int level = static_cast<int>(switches.stalk);
  switch (action) {
    case KeyAction::kReverse:
      input_.gear = input_.gear == Gear::kReverse ? Gear::kDrive : Gear::kReverse;
      break;
    case KeyAction::kParkingBrake:
      input_.parking_brake_01 = input_.parking_brake_01 == 0.0 ? 1.0 : 0.0;
      break;
    case KeyAction::kLightUp:
      switches.stalk = static_cast<LightSwitch>(std::min(level + 1, static_cast<int>(LightSwitch::kHigh)));
      break;
    case KeyAction::kLightDown:
      switches.stalk = static_cast<LightSwitch>(std::max(level - 1, static_cast<int>(LightSwitch::kOff)));
      break;
    case KeyAction::kHighBeam:
      switches.stalk = switches.stalk == LightSwitch::kHigh ? LightSwitch::kLow : LightSwitch::kHigh;
      break;
    case KeyAction::kFlash:
      switches.flash = true;
      break;
    case KeyAction::kFogFront:
      switches.fog_front = !switches.fog_front;
      break;
    case KeyAction::kFogRear:
      switches.fog_rear = !switches.fog_rear;
      break;
    case KeyAction::kHazard:
      switches.hazard = !switches.hazard;
      break;
    case KeyAction::kAutomaticHigh:
      switches.automatic = !switches.automatic;
      break;
    case KeyAction::kTurnLeft:
    case KeyAction::kTurnRight: {  // the lever latches; the other way, or the same once more, puts it back
      const TurnSignal wanted = action == KeyAction::kTurnLeft ? TurnSignal::kLeft : TurnSignal::kRight;
      switches.turn = switches.turn == TurnSignal::kNone ? wanted : TurnSignal::kNone;
      break;
    }
    case KeyAction::kDesignNext:
    case KeyAction::kDesignPrevious:  // pressed here, let go below: one step a press
      (action == KeyAction::kDesignNext ? switches.design_next : switches.design_previous) = true;
      cockpit.take(input_, false, now);
      switches.design_next = switches.design_previous = false;
      break;
    default:
      return;
  }
  cockpit.take(input_, false, now);
}

void KeyboardDriver::pad(const PadReading& reading, Moment now, ControlSink& cockpit) {
  if (!pad_seen_) pad_rest_ = reading;
  pad_seen_ = true;
  for (std::size_t i = 0; i < kKeyActions; ++i) {
    if (reading.pressed[i] && !pad_.pressed[i]) press(static_cast<KeyAction>(i), 0, now, cockpit);
  }
  pad_ = reading;
  const auto left_rest = [](double value, double rest) { return std::abs(value - rest) > kPadMoved; };
  if (!pad_drives_ &&
      (left_rest(pad_.left_m1_1, pad_rest_.left_m1_1) || left_rest(pad_.accelerator_01, pad_rest_.accelerator_01) ||
       left_rest(pad_.brake_01, pad_rest_.brake_01))) {
    pad_drives_ = pressed_[index(KeyAction::kAccelerate)] = true;
  }
}

void KeyboardDriver::no_pad() {
  pad_ = pad_rest_ = {};
  pad_seen_ = pad_drives_ = false;
}

bool KeyboardDriver::held(KeyAction action, Moment now) const {
  return window_held_[index(action)] || pad_.pressed[index(action)] || now.sim.ns < until_ns_[index(action)];
}

void KeyboardDriver::remember(Memory& memory) {
  memory.field(input_);
  memory.field(until_ns_);
  memory.field(pad_rest_);
  memory.field(pad_seen_);
  memory.field(pad_drives_);
  memory.field(newest_ns_);
}

void KeyboardDriver::pass(Moment now) {
  newest_ns_ = std::max(newest_ns_, now.sim.ns);
  input_.switches.flash = held(KeyAction::kFlash, now);
}

void KeyboardDriver::advance(Moment now, ControlSink& cockpit) {
  const double dt_s = static_cast<double>(std::max<std::int64_t>(now.sim.ns - newest_ns_, 0)) * 1e-9;
  newest_ns_ = std::max(newest_ns_, now.sim.ns);
  input_.switches.flash = held(KeyAction::kFlash, now);
  const double most_rad = most_wheel_rad(speed_mps_);
  double& wheel_rad = input_.steering_wheel_rad;
  if (pad_drives_) {
    const double share = std::abs(pad_.left_m1_1) < kPadMoved ? 0.0 : pad_.left_m1_1;
    toward(wheel_rad, share * std::abs(share) * most_rad,
           most_rad / kPadOut_s * dt_s);  // square: fine about the middle
    input_.accelerator_01 = std::clamp(pad_.accelerator_01, 0.0, 1.0);
    input_.brake_01 = std::clamp(pad_.brake_01, 0.0, 1.0);
    return cockpit.take(input_, false, now);
  }

  const int side = (held(KeyAction::kSteerLeft, now) ? 1 : 0) - (held(KeyAction::kSteerRight, now) ? 1 : 0);
  const double goal_rad = side * most_rad;
  const bool out = side != 0 && wheel_rad * side >= 0.0;
  toward(wheel_rad, goal_rad, most_rad / (out ? kOut_s : kBack_s) * dt_s);

  const bool hard = held(KeyAction::kBrakeHard, now), brake = held(KeyAction::kBrake, now);
  const double brake_01 = hard ? 1.0 : brake ? kBrake_01 : 0.0;
  const double accelerator_01 = held(KeyAction::kAccelerate, now) && !hard && !brake ? kAccelerator_01 : 0.0;
  toward(input_.brake_01, brake_01,
         dt_s * (brake_01 < input_.brake_01 ? kLetGo_1ps
                 : hard                     ? kPressBrakeHard_1ps
                                            : kPressBrake_1ps));
  toward(input_.accelerator_01, accelerator_01,
         dt_s * (accelerator_01 < input_.accelerator_01 ? kLetGo_1ps : kPressAccelerator_1ps));
  cockpit.take(input_, false, now);
}

std::array<bool, kKeyActions> KeyboardDriver::take_pressed() {
  return std::exchange(pressed_, {});
}

}  // namespace phare
