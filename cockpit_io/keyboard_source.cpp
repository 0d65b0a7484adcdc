#include "cockpit_io/keyboard_source.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <utility>

#include "net/channels.h"

namespace phare {

namespace {

constexpr std::int64_t kFault_ns = 4'000'000'000;
constexpr std::int64_t kPadEvery_ns = 10'000'000;
constexpr double kDemoReach_m = 15.0;  // the demo driver finds back to a lane as near as that, and that lies ahead
constexpr double kDemoStops_01 = 0.4;

/// What the demo driver says, with the lights of the person once those have been touched.
class DemoSink : public ControlSink {
 public:
  DemoSink(ControlSink& cockpit, const SwitchInput* persons) : cockpit_(cockpit), persons_(persons) {}
  void take(const DriverInput& input, bool silent, Moment now) override {
    newest = input;
    if (persons_ != nullptr) newest.switches = *persons_;
    if (stops) {
      newest.accelerator_01 = 0.0;
      newest.brake_01 = kDemoStops_01;
    }
    cockpit_.take(newest, silent, now);
  }
  void take_recorded(const CockpitState&, Moment) override {}

  DriverInput newest;
  bool stops = false;

 private:
  ControlSink& cockpit_;
  const SwitchInput* persons_;
};

/// The lane is near, and runs where the car looks.
bool within_reach(const std::vector<LanePoint>& lane, const VehicleState& car) {
  const auto distance_m = [&](const LanePoint& p) { return std::hypot(p.x_m - car.x_m, p.y_m - car.y_m); };
  const auto nearest = std::ranges::min_element(lane, {}, distance_m);
  return nearest != lane.end() && distance_m(*nearest) < kDemoReach_m &&
         std::cos(nearest->heading_rad - car.yaw_rad) > 0.0;
}

}  // namespace

KeyboardSource::KeyboardSource(KeyboardCompany company) : company_(std::move(company)) {
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

void KeyboardSource::take_keys(std::uint32_t channel, std::uint64_t start_id, const KeyInput& keys, WallTime received) {
  window_.take(channel, start_id, keys, received);
}

void KeyboardSource::remember(Memory& memory) {
  keys_.remember(memory);
  bool demo = demo_.has_value() && !demo_->ended();
  memory.field(demo);
  memory.field(persons_lights_);
  if (memory.recalls()) demo_goes_on_ = demo;
  for (std::uint32_t channel = 0; channel < kMaxChannels; ++channel) {
    WindowKeys::Handled handled = window_.handled(channel);
    memory.field(handled);
    if (memory.recalls()) window_.go_on(channel, handled);
  }
}

std::string KeyboardSource::driver() const {
  if (!demo_) return {};
  return demo_->ended() ? "demo ended" : "demo";
}

void KeyboardSource::read_terminal(Moment now, ControlSink& cockpit) {
  std::array<char, 256> bytes{};
  pollfd wait{STDIN_FILENO, POLLIN, 0};
  if (terminal_ && tcgetpgrp(STDIN_FILENO) == getpgrp() && poll(&wait, 1, 0) > 0) {
    const ssize_t size = (wait.revents & POLLIN) != 0 ? ::read(STDIN_FILENO, bytes.data(), bytes.size()) : 0;
    if (size > 0) {
      take_terminal({bytes.data(), static_cast<std::size_t>(size)});
    } else if (size == 0 || (errno != EAGAIN && errno != EINTR)) {
      terminal_.reset();  // hung up: no more keys
    }
  }
  if (typed_.empty()) return;
  ++counts_.frames_read;
  ++counts_.decoded;
  if (on_frame) on_frame(now.wall);
  keys_.press(typed_, now, cockpit);
  typed_.clear();
}

void KeyboardSource::read_window(Moment now, ControlSink& cockpit) {
  for (const std::uint32_t code : window_.take_presses()) {
    const KeyBinding* bound = binding_of(code);
    if (bound == nullptr || bound->actor != KeyActor::kCar) continue;
    ++counts_.frames_read;
    ++counts_.decoded;
    if (on_frame) on_frame(now.wall);
    keys_.press(bound->action, KeyboardDriver::kTap_ns, now, cockpit);
  }
  const HeldKeys held = window_.held(now.wall);
  std::array<bool, kKeyActions> actions{};
  for (const KeyBinding& bound : key_bindings()) {
    bool& action = actions[static_cast<std::size_t>(bound.action)];
    action = action || held.test(bound.code);
  }
  keys_.hold(actions);
}

void KeyboardSource::read_pad(Moment now, ControlSink& cockpit) {
  if (!company_.pad || (pad_read_ns_ >= 0 && now.sim.ns < pad_read_ns_ + kPadEvery_ns)) return;
  pad_read_ns_ = now.sim.ns;
  if (const auto reading = company_.pad()) {
    keys_.pad(*reading, now, cockpit);
  } else {
    keys_.no_pad();
  }
}

/// The demo driver takes the wheel at his key; a driving key takes it back, a key of the lights only the lights.
void KeyboardSource::change_hands(Moment now, const VehicleState* vehicle) {
  const auto pressed = keys_.take_pressed();
  if (now.sim.ns >= fault_until_ns_) fault_.clear();
  for (std::size_t i = 0; i < kKeyActions; ++i) {
    const auto action = static_cast<KeyAction>(i);
    if (!pressed[i] || action == KeyAction::kDemo) continue;
    if (is_driving(action)) demo_.reset();
    persons_lights_ = persons_lights_ || !is_driving(action);
  }
  const bool at_once = company_.demo_at_once && vehicle != nullptr;
  if (at_once) company_.demo_at_once = false;
  if (demo_goes_on_ && vehicle != nullptr) {
    const bool persons_lights = persons_lights_;
    demo_goes_on_ = false;
    begin_demo(now, vehicle);
    persons_lights_ = persons_lights;
  }
  if (pressed[static_cast<std::size_t>(KeyAction::kDemo)] || at_once) begin_demo(now, vehicle);
}

void KeyboardSource::begin_demo(Moment now, const VehicleState* vehicle) {
  if (demo_ && !demo_->ended()) return;
  if (company_.demo && vehicle != nullptr && within_reach(company_.demo->lane, *vehicle)) {
    demo_.emplace(company_.demo->script, company_.demo->lane);
    persons_lights_ = false;
    spdlog::info("the demo driver has the wheel; any driving key gives it back");
    return;
  }
  fault_ = company_.demo ? "demo: the road is too far away; Backspace begins again from its start"
                         : "demo: there is no demo driver for this rig";
  fault_until_ns_ = now.sim.ns + kFault_ns;
}

void KeyboardSource::drive_demo(Moment now, const VehicleState* vehicle, ControlSink& cockpit) {
  keys_.pass(now);
  const SwitchInput persons = keys_.input().switches;
  DemoSink sink(cockpit, persons_lights_ ? &persons : nullptr);
  sink.stops = demo_->ended();  // where his road ends he brakes, and waits
  demo_->advance(now, vehicle, sink);
  keys_.adopt(sink.newest);
}

void KeyboardSource::advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) {
  keys_.set_speed(vehicle != nullptr ? vehicle->speed_mps : 0.0);
  read_terminal(now, cockpit);
  read_window(now, cockpit);
  read_pad(now, cockpit);
  change_hands(now, vehicle);
  if (demo_) {
    drive_demo(now, vehicle, cockpit);
  } else {
    keys_.advance(now, cockpit);
  }
}

}  // namespace phare
