#include "cockpit_io/keyboard_source.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>

namespace phare {

namespace {

// Chosen: longer than a terminal's first repeat (usually 250 to 500 ms), so that a held key counts as held.
constexpr std::int64_t kHeld_ns = 600'000'000;
constexpr double kAccelerator_01 = 0.5;
constexpr double kBrake_01 = 0.35;
constexpr double kSteeringStep_rad = 0.09;   // 5 degrees of the wheel a press
constexpr double kSteeringMost_rad = 4.7;    // three quarters of a turn
constexpr double kSteeringReturn_1ps = 3.0;  // the wheel runs back when no key is held

}  // namespace

void KeyboardDriver::press(std::string_view bytes, Moment now, ControlSink& cockpit) {
  while (!bytes.empty()) {
    const char first = bytes.front();
    bytes.remove_prefix(1);
    if (first != '\x1b') {
      key(first, now, cockpit);
      continue;
    }
    if (bytes.size() < 2 || (bytes[0] != '[' && bytes[0] != 'O')) continue;
    // An escape sequence: parameters, then one final byte.
    std::size_t end = 1;
    while (end < bytes.size() && (bytes[end] < '@' || bytes[end] > '~')) ++end;
    if (end == bytes.size()) return;
    if (end == 1) arrow(bytes[end], now);
    bytes.remove_prefix(end + 1);
  }
}

void KeyboardDriver::key(char key, Moment now, ControlSink& cockpit) {
  SwitchInput& switches = input_.switches;
  const int level = static_cast<int>(switches.stalk);
  switch (key) {
    case 'l':
      switches.stalk = static_cast<LightSwitch>(std::min(level + 1, static_cast<int>(LightSwitch::kHigh)));
      break;
    case 'L':
      switches.stalk = static_cast<LightSwitch>(std::max(level - 1, static_cast<int>(LightSwitch::kOff)));
      break;
    case 'f':
      switches.flash = true;
      flash_until_ns_ = now.sim.ns + kHeld_ns;
      break;
    case 'g':
      switches.fog_front = !switches.fog_front;
      break;
    case 'b':
      switches.fog_rear = !switches.fog_rear;
      break;
    case 'h':
      switches.hazard = !switches.hazard;
      break;
    case 'a':
      switches.automatic = !switches.automatic;
      break;
    case ',':
    case '.': {  // the lever latches; the other way, or the same once more, puts it back
      const TurnSignal wanted = key == ',' ? TurnSignal::kLeft : TurnSignal::kRight;
      switches.turn = switches.turn == TurnSignal::kNone ? wanted : TurnSignal::kNone;
      break;
    }
    case 'r':
      input_.gear = input_.gear == Gear::kReverse ? Gear::kDrive : Gear::kReverse;
      break;
    case 'k':
      input_.parking_brake_01 = input_.parking_brake_01 == 0.0 ? 1.0 : 0.0;
      break;
    case 'n':
    case 'p':  // pressed here, let go below: one step a press
      (key == 'n' ? switches.design_next : switches.design_previous) = true;
      cockpit.take(input_, false, now);
      switches.design_next = switches.design_previous = false;
      break;
    case ' ':
      input_.steering_wheel_rad = input_.accelerator_01 = input_.brake_01 = 0.0;
      break;
    default:
      return;
  }
  cockpit.take(input_, false, now);
}

void KeyboardDriver::arrow(char direction, Moment now) {
  const std::int64_t until_ns = now.sim.ns + kHeld_ns;
  switch (direction) {
    case 'A':
      input_.accelerator_01 = kAccelerator_01;
      input_.brake_01 = 0.0;
      accelerator_until_ns_ = until_ns;
      break;
    case 'B':
      input_.brake_01 = kBrake_01;
      input_.accelerator_01 = 0.0;
      brake_until_ns_ = until_ns;
      break;
    case 'C':
    case 'D': {
      const double step_rad = direction == 'D' ? kSteeringStep_rad : -kSteeringStep_rad;
      input_.steering_wheel_rad =
          std::clamp(input_.steering_wheel_rad + step_rad, -kSteeringMost_rad, kSteeringMost_rad);
      steering_until_ns_ = until_ns;
      break;
    }
    default:
      break;
  }
}

void KeyboardDriver::advance(Moment now, ControlSink& cockpit) {
  const double dt_s = static_cast<double>(std::max<std::int64_t>(now.sim.ns - newest_ns_, 0)) * 1e-9;
  newest_ns_ = std::max(newest_ns_, now.sim.ns);
  if (now.sim.ns >= flash_until_ns_) input_.switches.flash = false;
  if (now.sim.ns >= accelerator_until_ns_) input_.accelerator_01 = 0.0;
  if (now.sim.ns >= brake_until_ns_) input_.brake_01 = 0.0;
  if (now.sim.ns >= steering_until_ns_) input_.steering_wheel_rad *= std::exp(-kSteeringReturn_1ps * dt_s);
  cockpit.take(input_, false, now);
}

KeyboardSource::KeyboardSource() {
  termios now{};
  // In the background reading the terminal would stop the process.
  if (isatty(STDIN_FILENO) == 0 || tcgetpgrp(STDIN_FILENO) != getpgrp() || tcgetattr(STDIN_FILENO, &now) != 0) return;
  terminal_ = now;
  termios raw = now;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // Ctrl-C stays a signal
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  if (tcsetattr(STDIN_FILENO, TCSANOW, &raw) != 0) terminal_.reset();
}

KeyboardSource::~KeyboardSource() {
  if (terminal_ && tcgetpgrp(STDIN_FILENO) == getpgrp()) tcsetattr(STDIN_FILENO, TCSANOW, &*terminal_);
}

std::vector<int> KeyboardSource::wait_fds() const {
  // In the background the keys are not ours to read, and would wake us for ever.
  if (!terminal_ || tcgetpgrp(STDIN_FILENO) != getpgrp()) return {};
  return {STDIN_FILENO};
}

void KeyboardSource::advance(Moment now, const VehicleState*, ControlSink& cockpit) {
  std::array<char, 256> bytes{};
  pollfd wait{STDIN_FILENO, POLLIN, 0};
  if (terminal_ && tcgetpgrp(STDIN_FILENO) == getpgrp() && poll(&wait, 1, 0) > 0) {
    const ssize_t size = (wait.revents & POLLIN) != 0 ? ::read(STDIN_FILENO, bytes.data(), bytes.size()) : 0;
    if (size > 0) {
      ++counts_.frames_read;
      ++counts_.decoded;
      if (on_frame) on_frame(now.wall);
      driver_.press({bytes.data(), static_cast<std::size_t>(size)}, now, cockpit);
    } else if (size == 0 || (errno != EAGAIN && errno != EINTR)) {
      terminal_.reset();  // hung up: no more keys
    }
  }
  driver_.advance(now, cockpit);
}

}  // namespace phare
