#include <variant>

#include "net/wire_payload.h"

namespace phare {
namespace {

void fill(wire::CockpitState& to, const CockpitState& from) {
  to.set_frame_index(from.frame_index);
  to.set_light_switch(to_wire_enum<wire::LightSwitch>(static_cast<int>(from.light_switch)));
  to.set_flash(from.flash);
  to.set_fog_front(from.fog_front);
  to.set_design_index(from.design_index);
  to.set_steering_wheel_rad(from.steering_wheel_rad);
  to.set_accelerator_01(from.accelerator_01);
  to.set_brake_01(from.brake_01);
  to.set_gear(to_wire_enum<wire::Gear>(static_cast<int>(from.gear)));
  to.set_fail_safe(from.fail_safe);
  to.set_light_changes(from.light_changes);
  to.set_light_change_wall_ns(from.light_change_wall.ns);
  to.set_light_change_sim_ns(from.light_change_sim.ns);
  to.set_drive_ended(from.drive_ended);
  to.set_source(from.source);
  to.set_fog_rear(from.fog_rear);
  to.set_turn(to_wire_enum<wire::TurnSignal>(static_cast<int>(from.turn)));
  to.set_hazard(from.hazard);
  to.set_high_beam_automatic(from.high_beam_automatic);
  to.set_lamp_aim_rad(from.lamp_aim_rad);
  to.set_clutch_01(from.clutch_01);
  to.set_parking_brake_01(from.parking_brake_01);
  to.set_ignition_off(from.ignition_off);
  to.set_source_stamp_wall_ns(from.source_stamp.ns);
  to.set_source_fault(from.source_fault);
}

void fill(wire::VehicleState& to, const VehicleState& from) {
  to.set_frame_index(from.frame_index);
  to.set_x_m(from.x_m);
  to.set_y_m(from.y_m);
  to.set_z_m(from.z_m);
  to.set_roll_rad(from.roll_rad);
  to.set_pitch_rad(from.pitch_rad);
  to.set_yaw_rad(from.yaw_rad);
  to.set_vx_mps(from.vx_mps);
  to.set_vy_mps(from.vy_mps);
  to.set_vz_mps(from.vz_mps);
  to.set_roll_rate_radps(from.roll_rate_radps);
  to.set_pitch_rate_radps(from.pitch_rate_radps);
  to.set_yaw_rate_radps(from.yaw_rate_radps);
  to.set_ax_mps2(from.ax_mps2);
  to.set_ay_mps2(from.ay_mps2);
  to.set_speed_mps(from.speed_mps);
  to.set_steer_rad(from.steer_rad);
  to.set_suspension_pitch_rad(from.suspension_pitch_rad);
  to.set_suspension_roll_rad(from.suspension_roll_rad);
  to.set_suspension_heave_m(from.suspension_heave_m);
  to.set_level(from.level);
  to.set_step(from.step);
  to.set_state_hash(from.state_hash);
  to.set_lag_s(from.lag_s);
  to.set_high_beam_telltale(from.high_beam_telltale);
  to.set_drive_ended(from.drive_ended);
  to.set_lamp_tilt_rad(from.lamp_tilt_rad);
  to.mutable_step_hash()->Add(from.step_hash.begin(), from.step_hash.end());
}

void fill(wire::FrameReport& to, const FrameReport& from) {
  to.set_frame_index(from.frame_index);
  to.set_channel(from.channel);
  to.set_channels(from.channels);
  to.set_frame_ms(from.frame_ms);
  to.set_gpu_ms(from.gpu_ms);
  to.set_light_changes_drawn(from.light_changes_drawn);
  fill(*to.mutable_drawn(), from.drawn);
  to.set_pose_stale(from.pose_stale);
  to.set_light_drawn(to_wire_enum<wire::LightSwitch>(static_cast<int>(from.light_drawn)));
  to.set_flash_drawn(from.flash_drawn);
  to.set_fail_safe_drawn(from.fail_safe_drawn);
  to.set_pictures_not_kept(from.pictures_not_kept);
  if (!from.audit_failure.empty()) to.set_audit_failure(from.audit_failure);
  to.set_start(from.start);
}

struct CommandFiller {
  wire::RigControl& to;
  void operator()(const RigControl::Pause& pause) const { to.set_pause(pause.on); }
  void operator()(const RigControl::Seek& seek) const { to.set_seek_s(seek.to_s); }
  void operator()(const RigControl::Design& design) const { to.set_design_index(design.index); }
  void operator()(const RigControl::Aim& aim) const { to.set_aim_pitch_rad(aim.pitch_rad); }
  void operator()(const RigControl::Quit&) const { to.set_quit(true); }
  void operator()(const RigControl::Dim& dim) const {
    to.mutable_dim()->set_lamp(dim.lamp);
    to.mutable_dim()->set_source(dim.source);
    to.mutable_dim()->set_dimming_01(dim.dimming_01);
  }
  void operator()(const RigControl::Swivel& swivel) const {
    to.mutable_swivel()->set_lamp(swivel.lamp);
    to.mutable_swivel()->set_yaw_rad(swivel.yaw_rad);
    to.mutable_swivel()->set_pitch_rad(swivel.pitch_rad);
  }
  void operator()(const RigControl::Place& place) const {
    to.mutable_place()->set_lamp(place.lamp);
    to.mutable_place()->set_x_m(place.x_m);
    to.mutable_place()->set_y_m(place.y_m);
    to.mutable_place()->set_z_m(place.z_m);
  }
  void operator()(const RigControl::Tell&) const { to.set_tell(true); }
  void operator()(const RigControl::Set& set) const {
    to.mutable_set()->set_setting(set.setting);
    to.mutable_set()->set_value(set.value);
  }
  void operator()(const RigControl::Mount& mount) const {
    to.mutable_mount()->set_lamp(mount.lamp);
    to.mutable_mount()->set_quantity(to_wire_enum<wire::MountQuantity>(static_cast<int>(mount.quantity)));
    to.mutable_mount()->set_value(mount.value);
    to.mutable_mount()->set_by(mount.by);
  }
  void operator()(const RigControl::Undo& undo) const { to.mutable_undo()->set_steps(undo.steps); }
  void operator()(const RigControl::Reset& reset) const { to.mutable_reset()->set_lamp(reset.lamp); }
  void operator()(const RigControl::Save& save) const { to.mutable_save()->set_file(save.file); }
  void operator()(const RigControl::Frame& frame) const {
    to.mutable_frame()->set_lamp(frame.lamp);
    to.mutable_frame()->set_file(frame.file);
  }
};

void fill(wire::RigControl& to, const RigControl& from) {
  std::visit(CommandFiller{to}, from.command);
  to.set_request_id(from.request_id);
  to.set_first_open(from.first_open);
}

void fill(wire::ProbeRequest& to, const ProbeRequest& from) {
  to.set_request_id(from.request_id);
  to.mutable_x_m()->Add(from.x_m.begin(), from.x_m.end());
  to.mutable_y_m()->Add(from.y_m.begin(), from.y_m.end());
  to.mutable_z_m()->Add(from.z_m.begin(), from.z_m.end());
  to.mutable_nx()->Add(from.nx.begin(), from.nx.end());
  to.mutable_ny()->Add(from.ny.begin(), from.ny.end());
  to.mutable_nz()->Add(from.nz.begin(), from.nz.end());
}

void fill(wire::ProbeReply& to, const ProbeReply& from) {
  to.set_request_id(from.request_id);
  to.mutable_illuminance_lx()->Add(from.illuminance_lx.begin(), from.illuminance_lx.end());
  to.set_error(from.error);
}

void fill(wire::KeyInput& to, const KeyInput& from) {
  to.mutable_held()->Add(from.held.begin(), from.held.end());
  to.mutable_event()->Add(from.event.begin(), from.event.end());
  to.set_events(from.events);
}

void fill(wire::ControlReply& to, const ControlReply& from) {
  to.set_to_start_id(from.to_start_id);
  to.set_request_id(from.request_id);
  to.set_verdict(to_wire_enum<wire::ControlVerdict>(static_cast<int>(from.verdict)));
  to.set_reason(from.reason);
  to.set_now(from.now);
}

void fill(wire::ClockProbe& to, const ClockProbe& from) {
  to.set_asked_wall_ns(from.asked.ns);
  to.set_heard_wall_ns(from.heard.ns);
}

void fill(wire::LawAnswer& to, const LawAnswer& from) {
  to.set_frame_index(from.frame_index);
  to.set_input_wall_ns(from.input.ns);
  to.set_light_switch(to_wire_enum<wire::LightSwitch>(static_cast<int>(from.light_switch)));
  to.set_levelling_rad(from.levelling_rad);
  for (const LampLight& light : from.lamps) {
    wire::LampLight& lamp = *to.add_lamps();
    lamp.set_lamp(light.lamp);
    lamp.set_yaw_rad(light.yaw_rad);
    lamp.set_pitch_rad(light.pitch_rad);
    lamp.mutable_dimming_01()->Add(light.dimming_01.begin(), light.dimming_01.end());
    if (!light.frame.empty()) lamp.set_frame(light.frame);
  }
}

void fill(wire::LampState& to, const LampState& from) {
  to.set_design_index(from.design_index);
  to.set_aim_pitch_rad(from.aim_pitch_rad);
  to.mutable_x_m()->Add(from.x_m.begin(), from.x_m.end());
  to.mutable_y_m()->Add(from.y_m.begin(), from.y_m.end());
  to.mutable_z_m()->Add(from.z_m.begin(), from.z_m.end());
  to.mutable_yaw_rad()->Add(from.yaw_rad.begin(), from.yaw_rad.end());
  to.mutable_pitch_rad()->Add(from.pitch_rad.begin(), from.pitch_rad.end());
  to.mutable_roll_rad()->Add(from.roll_rad.begin(), from.roll_rad.end());
}

void fill(wire::FrameStart& to, const FrameStart& from) {
  to.set_number(from.number);
  fill(*to.mutable_controls(), from.controls);
  fill(*to.mutable_pose(), from.pose);
  to.set_pose_stale(from.pose_stale);
}

struct PayloadFiller {
  wire::Datagram& to;
  void operator()(const CockpitState& from) const { fill(*to.mutable_cockpit_state(), from); }
  void operator()(const VehicleState& from) const { fill(*to.mutable_vehicle_state(), from); }
  void operator()(const FrameReport& from) const { fill(*to.mutable_frame_report(), from); }
  void operator()(const RigControl& from) const { fill(*to.mutable_rig_control(), from); }
  void operator()(const ProbeRequest& from) const { fill(*to.mutable_probe_request(), from); }
  void operator()(const ProbeReply& from) const { fill(*to.mutable_probe_reply(), from); }
  void operator()(const KeyInput& from) const { fill(*to.mutable_key_input(), from); }
  void operator()(const ControlReply& from) const { fill(*to.mutable_control_reply(), from); }
  void operator()(const ClockProbe& from) const { fill(*to.mutable_clock_probe(), from); }
  void operator()(const LawAnswer& from) const { fill(*to.mutable_law_answer(), from); }
  void operator()(const LampState& from) const { fill(*to.mutable_lamp_state(), from); }
  void operator()(const FrameStart& from) const { fill(*to.mutable_frame_start(), from); }
};

}  // namespace

void fill_payload(wire::Datagram& message, const Payload& payload) {
  std::visit(PayloadFiller{message}, payload);
}

}  // namespace phare
