#include "cockpit_io/combined_source.h"

#include <algorithm>
#include <utility>

namespace phare {

namespace {

struct Event {
  std::size_t child = 0;
  DriverInput input;
  bool silent = false;
  Moment at;
};

/// Keeps what one child says until all have spoken.
class Recorder : public ControlSink {
 public:
  Recorder(std::size_t child, std::vector<Event>& events) : child_(child), events_(events) {}
  void take(const DriverInput& input, bool silent, Moment now) override {
    events_.push_back({child_, input, silent, now});
  }
  void take_recorded(const CockpitState&, Moment) override {}  // drives do not combine

 private:
  std::size_t child_;
  std::vector<Event>& events_;
};

ControlGroup group_of(Control control) {
  switch (control) {
    case Control::kLightSwitch:
    case Control::kPosition:
    case Control::kLow:
    case Control::kHigh:
    case Control::kBeamLever:
      return ControlGroup::kLights;
    case Control::kFlash:
      return ControlGroup::kFlash;
    case Control::kFogFront:
      return ControlGroup::kFogFront;
    case Control::kFogRear:
      return ControlGroup::kFogRear;
    case Control::kTurn:
    case Control::kTurnLeft:
    case Control::kTurnRight:
      return ControlGroup::kTurn;
    case Control::kHazard:
      return ControlGroup::kHazard;
    case Control::kDesignNext:
    case Control::kDesignPrevious:
      return ControlGroup::kDesign;
    case Control::kLampAim:
      return ControlGroup::kLampAim;
    case Control::kAutomaticHigh:
      return ControlGroup::kAutomatic;
    case Control::kVehicleAhead:
      return ControlGroup::kAhead;
    case Control::kIgnition:
      return ControlGroup::kIgnition;
    case Control::kSteering:
      return ControlGroup::kSteering;
    case Control::kAccelerator:
      return ControlGroup::kAccelerator;
    case Control::kBrake:
      return ControlGroup::kBrake;
    case Control::kClutch:
      return ControlGroup::kClutch;
    case Control::kGear:
      return ControlGroup::kGear;
    case Control::kParkingBrake:
      return ControlGroup::kParkingBrake;
  }
  return ControlGroup::kLights;
}

std::array<bool, kControlGroups> groups_of(const CockpitConfig& config) {
  std::array<bool, kControlGroups> has{};
  if (config.source == SourceKind::kKeyboard) {  // keys for all but what no key stands for
    has.fill(true);
    for (const ControlGroup none : {ControlGroup::kIgnition, ControlGroup::kAhead, ControlGroup::kClutch}) {
      has[static_cast<std::size_t>(none)] = false;
    }
  }
  for (const ControlMapping& mapping : config.controls) has[static_cast<std::size_t>(group_of(mapping.control))] = true;
  // Recorded changes of design are left out; those of a hand beside the log are not.
  if (config.keep_design && config.source == SourceKind::kLog)
    has[static_cast<std::size_t>(ControlGroup::kDesign)] = false;
  return has;
}

}  // namespace

CombinedSource::CombinedSource(std::vector<Part> parts) {
  for (Part& part : parts) {
    Child child{std::move(part.source), groups_of(part.config), {}, false};
    child.source->on_frame = [this](WallTime stamp) {
      if (on_frame) on_frame(stamp);
    };
    children_.push_back(std::move(child));
  }
}

const CombinedSource::Child* CombinedSource::holder(ControlGroup group) const {
  const Child* silent = nullptr;
  for (const Child& child : children_) {
    if (!child.has[static_cast<std::size_t>(group)]) continue;
    if (!child.silent) return &child;
    if (silent == nullptr) silent = &child;
  }
  return silent;
}

DriverInput CombinedSource::merged() const {
  DriverInput all = children_.front().input;
  SwitchInput& s = all.switches;
  const auto from = [&](ControlGroup group, const auto& copy) {
    if (const Child* child = holder(group)) copy(child->input);
  };
  from(ControlGroup::kLights, [&](const DriverInput& in) {
    s.stalk = in.switches.stalk;
    s.high = in.switches.high;
    s.lever = in.switches.lever;
  });
  from(ControlGroup::kFlash, [&](const DriverInput& in) { s.flash = in.switches.flash; });
  from(ControlGroup::kFogFront, [&](const DriverInput& in) { s.fog_front = in.switches.fog_front; });
  from(ControlGroup::kFogRear, [&](const DriverInput& in) { s.fog_rear = in.switches.fog_rear; });
  from(ControlGroup::kTurn, [&](const DriverInput& in) { s.turn = in.switches.turn; });
  from(ControlGroup::kHazard, [&](const DriverInput& in) { s.hazard = in.switches.hazard; });
  from(ControlGroup::kLampAim, [&](const DriverInput& in) { all.lamp_aim_rad = in.lamp_aim_rad; });
  from(ControlGroup::kAutomatic, [&](const DriverInput& in) { s.automatic = in.switches.automatic; });
  from(ControlGroup::kAhead, [&](const DriverInput& in) { s.ahead = in.switches.ahead; });
  from(ControlGroup::kIgnition, [&](const DriverInput& in) { s.ignition = in.switches.ignition; });
  from(ControlGroup::kSteering, [&](const DriverInput& in) { all.steering_wheel_rad = in.steering_wheel_rad; });
  from(ControlGroup::kAccelerator, [&](const DriverInput& in) { all.accelerator_01 = in.accelerator_01; });
  from(ControlGroup::kBrake, [&](const DriverInput& in) { all.brake_01 = in.brake_01; });
  from(ControlGroup::kClutch, [&](const DriverInput& in) { all.clutch_01 = in.clutch_01; });
  from(ControlGroup::kGear, [&](const DriverInput& in) { all.gear = in.gear; });
  from(ControlGroup::kParkingBrake, [&](const DriverInput& in) { all.parking_brake_01 = in.parking_brake_01; });
  s.design_next = s.design_previous = false;
  for (const Child& child : children_) {
    if (!child.has[static_cast<std::size_t>(ControlGroup::kDesign)]) continue;
    s.design_next |= child.input.switches.design_next;
    s.design_previous |= child.input.switches.design_previous;
  }
  return all;
}

/// Fail-safe is for the lights: on when nobody who has them speaks.
bool CombinedSource::merged_silent() const {
  const Child* lights = holder(ControlGroup::kLights);
  return lights != nullptr ? lights->silent : children_.front().silent;
}

void CombinedSource::advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) {
  std::vector<Event> events;
  for (std::size_t i = 0; i < children_.size(); ++i) {
    Recorder recorder(i, events);
    children_[i].source->advance(now, vehicle, recorder);
  }
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.at.sim < b.at.sim; });
  for (const Event& event : events) {
    children_[event.child].input = event.input;
    children_[event.child].silent = event.silent;
    cockpit.take(merged(), merged_silent(), event.at);
  }
  counts_ = {};
  for (const Child& child : children_) counts_ += child.source->counts();
}

/// What one of them plays again moves the switch logic again.
bool CombinedSource::plays_again() const {
  return std::any_of(children_.begin(), children_.end(),
                     [](const Child& child) { return child.source->plays_again(); });
}

void CombinedSource::remember(Memory& memory) {
  for (Child& child : children_) {
    if (child.source->plays_again()) continue;
    memory.field(child.input);
    memory.field(child.silent);
    child.source->remember(memory);
  }
}

std::string CombinedSource::fault() const {
  for (const Child& child : children_) {
    if (std::string fault = child.source->fault(); !fault.empty()) return fault;
  }
  return {};
}

bool CombinedSource::sends_back() const {
  return std::any_of(children_.begin(), children_.end(), [](const Child& child) { return child.source->sends_back(); });
}

void CombinedSource::send_back(const FeedbackValues& values, WallTime now) {
  for (Child& child : children_) child.source->send_back(values, now);
}

void CombinedSource::take_keys(std::uint32_t channel, std::uint64_t start_id, const KeyInput& keys, WallTime received) {
  for (Child& child : children_) child.source->take_keys(channel, start_id, keys, received);
}

std::vector<int> CombinedSource::wait_fds() const {
  std::vector<int> all;
  for (const Child& child : children_) {
    const std::vector<int> fds = child.source->wait_fds();
    all.insert(all.end(), fds.begin(), fds.end());
  }
  return all;
}

}  // namespace phare
