#include "cockpit_io/cockpit.h"

#include <algorithm>

namespace phare {

namespace {
constexpr double kPedalFade_s = 1.0;  // chosen: a foot leaving the pedal, not a jerk
}

Cockpit::Cockpit(SwitchParams params, std::string source) : params_(params), source_(std::move(source)) {}

void Cockpit::take(const DriverInput& input, bool silent, Moment now) {
  newest_ = now.sim = std::max(now.sim, newest_);
  if (silent && !switches_.fail_safe) silent_since_ = now.sim;
  advance_switches(params_, input.switches, silent, now, switches_, speed_mps_);
  input_ = input;
  if (silent) {
    const double share = std::clamp(1.0 - (now.sim.seconds() - silent_since_.seconds()) / kPedalFade_s, 0.0, 1.0);
    input_.accelerator_01 *= share;
    input_.brake_01 *= share;
    input_.clutch_01 *= share;
  }
}

void Cockpit::take_recorded(const CockpitState& recorded, Moment now) {
  newest_ = now.sim = std::max(now.sim, newest_);
  input_.steering_wheel_rad = recorded.steering_wheel_rad;
  input_.accelerator_01 = recorded.accelerator_01;
  input_.brake_01 = recorded.brake_01;
  input_.gear = recorded.gear;
  input_.clutch_01 = recorded.clutch_01;
  input_.parking_brake_01 = recorded.parking_brake_01;
  input_.lamp_aim_rad = recorded.lamp_aim_rad;
  switches_.signals = {recorded.fog_rear, recorded.turn, recorded.hazard, recorded.high_beam_automatic};
  switches_.contacts[static_cast<std::size_t>(Contact::kIgnition)].value = !recorded.ignition_off;
  switches_.fail_safe = recorded.fail_safe;
  // Every frame is recorded with its design; what a hand chooses stays until the recorded one changes.
  std::uint32_t design_index = switches_.lights.design_index;
  if (recorded_design_ != recorded.design_index) {
    recorded_design_ = recorded.design_index;
    if (recorded.design_index < std::max(params_.design_count, 1u))
      design_index = recorded.design_index;
    else
      unknown_design_ = recorded.design_index;
  }
  Lights lights{recorded.light_switch, recorded.flash, recorded.fog_front, design_index};
  if (lights == switches_.lights) return;
  switches_.lights = lights;
  ++switches_.light_changes;
  switches_.light_change = now;
}

void Cockpit::choose_design(std::uint32_t design_index, Moment now) {
  now.sim = std::max(now.sim, newest_);
  phare::choose_design(params_, design_index, now, switches_);
}

void Cockpit::remember(Memory& memory) {
  memory.field(switches_);
  memory.field(input_);
  memory.field(speed_mps_);
  memory.field(newest_);
  memory.field(silent_since_);
}

void Cockpit::count_on_from(std::uint64_t light_changes) {
  switches_.light_changes = std::max(switches_.light_changes, light_changes);
}

CockpitState Cockpit::state(std::int64_t frame_index, bool drive_ended) const {
  CockpitState state;
  state.frame_index = frame_index;
  state.light_switch = switches_.lights.light_switch;
  state.flash = switches_.lights.flash;
  state.fog_front = switches_.lights.fog_front;
  state.design_index = switches_.lights.design_index;
  state.steering_wheel_rad = input_.steering_wheel_rad;
  state.accelerator_01 = input_.accelerator_01;
  state.brake_01 = input_.brake_01;
  state.gear = input_.gear;
  state.fail_safe = switches_.fail_safe;
  state.light_changes = switches_.light_changes;
  state.light_change_wall = switches_.light_change.wall;
  state.light_change_sim = switches_.light_change.sim;
  state.drive_ended = drive_ended;
  state.source = source_;
  state.fog_rear = switches_.signals.fog_rear;
  state.turn = switches_.signals.turn;
  state.hazard = switches_.signals.hazard;
  state.high_beam_automatic = switches_.signals.automatic_armed;
  state.lamp_aim_rad = input_.lamp_aim_rad;
  state.clutch_01 = input_.clutch_01;
  state.parking_brake_01 = input_.parking_brake_01;
  state.ignition_off = switches_.contacts[static_cast<std::size_t>(Contact::kIgnition)].value == 0;
  return state;
}

}  // namespace phare
