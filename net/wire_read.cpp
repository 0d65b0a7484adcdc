#include <algorithm>
#include <utility>
#include <variant>

#include "net/wire_payload.h"

namespace phare {
namespace {

void read(CockpitState& to, const wire::CockpitState& from) {
  to.frame_index = from.frame_index();
  to.light_switch = static_cast<LightSwitch>(static_cast<int>(from.light_switch()));
  to.flash = from.flash();
  to.fog_front = from.fog_front();
  to.design_index = from.design_index();
  to.steering_wheel_rad = from.steering_wheel_rad();
  to.accelerator_01 = from.accelerator_01();
  to.brake_01 = from.brake_01();
  to.gear = static_cast<Gear>(static_cast<int>(from.gear()));
  to.fail_safe = from.fail_safe();
  to.light_changes = from.light_changes();
  to.light_change_wall.ns = from.light_change_wall_ns();
  to.light_change_sim.ns = from.light_change_sim_ns();
  to.drive_ended = from.drive_ended();
  to.source = from.source();
  to.fog_rear = from.fog_rear();
  to.turn = static_cast<TurnSignal>(static_cast<int>(from.turn()));
  to.hazard = from.hazard();
  to.high_beam_automatic = from.high_beam_automatic();
  to.lamp_aim_rad = from.lamp_aim_rad();
  to.clutch_01 = from.clutch_01();
  to.parking_brake_01 = from.parking_brake_01();
  to.ignition_off = from.ignition_off();
  to.source_stamp.ns = from.source_stamp_wall_ns();
  to.source_fault = from.source_fault();
}

void read(VehicleState& to, const wire::VehicleState& from) {
  to.frame_index = from.frame_index();
  to.x_m = from.x_m();
  to.y_m = from.y_m();
  to.z_m = from.z_m();
  to.roll_rad = from.roll_rad();
  to.pitch_rad = from.pitch_rad();
  to.yaw_rad = from.yaw_rad();
  to.vx_mps = from.vx_mps();
  to.vy_mps = from.vy_mps();
  to.vz_mps = from.vz_mps();
  to.roll_rate_radps = from.roll_rate_radps();
  to.pitch_rate_radps = from.pitch_rate_radps();
  to.yaw_rate_radps = from.yaw_rate_radps();
  to.ax_mps2 = from.ax_mps2();
  to.ay_mps2 = from.ay_mps2();
  to.speed_mps = from.speed_mps();
  to.steer_rad = from.steer_rad();
  to.suspension_pitch_rad = from.suspension_pitch_rad();
  to.suspension_roll_rad = from.suspension_roll_rad();
  to.suspension_heave_m = from.suspension_heave_m();
  to.level = from.level();
  to.step = from.step();
  to.state_hash = from.state_hash();
  to.lag_s = from.lag_s();
  to.high_beam_telltale = from.high_beam_telltale();
  to.drive_ended = from.drive_ended();
  to.lamp_tilt_rad = from.lamp_tilt_rad();
  to.step_hash.assign(from.step_hash().begin(), from.step_hash().end());
}

void read(FrameReport& to, const wire::FrameReport& from) {
  to.frame_index = from.frame_index();
  to.channel = from.channel();
  to.channels = from.channels();
  to.frame_ms = from.frame_ms();
  to.gpu_ms = from.gpu_ms();
  to.light_changes_drawn = from.light_changes_drawn();
  read(to.drawn, from.drawn());
  to.pose_stale = from.pose_stale();
  to.light_drawn = static_cast<LightSwitch>(static_cast<int>(from.light_drawn()));
  to.flash_drawn = from.flash_drawn();
  to.fail_safe_drawn = from.fail_safe_drawn();
  to.pictures_not_kept = from.pictures_not_kept();
  to.audit_failure = from.audit_failure();
  to.start = from.start();
}

bool read(RigControl& to, const wire::RigControl& from) {
  to.request_id = from.request_id();
  to.first_open = from.first_open();
  switch (from.command_case()) {
    case wire::RigControl::kPause:
      to.command = RigControl::Pause{from.pause()};
      return true;
    case wire::RigControl::kSeekS:
      to.command = RigControl::Seek{from.seek_s()};
      return true;
    case wire::RigControl::kDesignIndex:
      to.command = RigControl::Design{from.design_index()};
      return true;
    case wire::RigControl::kAimPitchRad:
      to.command = RigControl::Aim{from.aim_pitch_rad()};
      return true;
    case wire::RigControl::kQuit:
      to.command = RigControl::Quit{};
      return from.quit();
    case wire::RigControl::kDim:
      to.command = RigControl::Dim{from.dim().lamp(), from.dim().source(), from.dim().dimming_01()};
      return true;
    case wire::RigControl::kSwivel:
      to.command = RigControl::Swivel{from.swivel().lamp(), from.swivel().yaw_rad(), from.swivel().pitch_rad()};
      return true;
    case wire::RigControl::kPlace:
      to.command = RigControl::Place{from.place().lamp(), from.place().x_m(), from.place().y_m(), from.place().z_m()};
      return true;
    case wire::RigControl::kTell:
      to.command = RigControl::Tell{};
      return from.tell();
    case wire::RigControl::kSet:
      to.command = RigControl::Set{from.set().setting(), from.set().value()};
      return true;
    case wire::RigControl::kMount:
      to.command = RigControl::Mount{from.mount().lamp(),
                                     static_cast<rig_command::MountQuantity>(static_cast<int>(from.mount().quantity())),
                                     from.mount().value(), from.mount().by()};
      return true;
    case wire::RigControl::kUndo:
      to.command = RigControl::Undo{from.undo().steps()};
      return true;
    case wire::RigControl::kReset:
      to.command = RigControl::Reset{from.reset().lamp()};
      return true;
    case wire::RigControl::kSave:
      to.command = RigControl::Save{from.save().file()};
      return true;
    case wire::RigControl::kFrame:
      to.command = RigControl::Frame{from.frame().lamp(), from.frame().file()};
      return true;
    case wire::RigControl::COMMAND_NOT_SET:
      break;
  }
  return false;
}

void read(ProbeRequest& to, const wire::ProbeRequest& from) {
  to.request_id = from.request_id();
  to.x_m.assign(from.x_m().begin(), from.x_m().end());
  to.y_m.assign(from.y_m().begin(), from.y_m().end());
  to.z_m.assign(from.z_m().begin(), from.z_m().end());
  to.nx.assign(from.nx().begin(), from.nx().end());
  to.ny.assign(from.ny().begin(), from.ny().end());
  to.nz.assign(from.nz().begin(), from.nz().end());
}

void read(ProbeReply& to, const wire::ProbeReply& from) {
  to.request_id = from.request_id();
  to.illuminance_lx.assign(from.illuminance_lx().begin(), from.illuminance_lx().end());
  to.error = from.error();
}

void read(KeyInput& to, const wire::KeyInput& from) {
  to.held.assign(from.held().begin(), from.held().end());
  to.event.assign(from.event().begin(), from.event().end());
  to.events = from.events();
}

void read(ControlReply& to, const wire::ControlReply& from) {
  to.to_start_id = from.to_start_id();
  to.request_id = from.request_id();
  to.verdict = static_cast<Verdict>(static_cast<int>(from.verdict()));
  to.reason = from.reason();
  to.now = from.now();
}

void read(ClockProbe& to, const wire::ClockProbe& from) {
  to.asked.ns = from.asked_wall_ns();
  to.heard.ns = from.heard_wall_ns();
}

void read(LawAnswer& to, const wire::LawAnswer& from) {
  to.frame_index = from.frame_index();
  to.input.ns = from.input_wall_ns();
  to.light_switch = static_cast<LightSwitch>(static_cast<int>(from.light_switch()));
  to.levelling_rad = from.levelling_rad();
  to.lamps.resize(static_cast<std::size_t>(from.lamps_size()));
  for (std::size_t i = 0; i < to.lamps.size(); ++i) {
    const wire::LampLight& light = from.lamps(static_cast<int>(i));
    LampLight& lamp = to.lamps[i];
    lamp.lamp = light.lamp();
    lamp.yaw_rad = light.yaw_rad();
    lamp.pitch_rad = light.pitch_rad();
    lamp.dimming_01.assign(light.dimming_01().begin(), light.dimming_01().end());
    lamp.frame = light.frame();
  }
}

void read(LampState& to, const wire::LampState& from) {
  to.design_index = from.design_index();
  to.aim_pitch_rad = from.aim_pitch_rad();
  to.x_m.assign(from.x_m().begin(), from.x_m().end());
  to.y_m.assign(from.y_m().begin(), from.y_m().end());
  to.z_m.assign(from.z_m().begin(), from.z_m().end());
  to.yaw_rad.assign(from.yaw_rad().begin(), from.yaw_rad().end());
  to.pitch_rad.assign(from.pitch_rad().begin(), from.pitch_rad().end());
  to.roll_rad.assign(from.roll_rad().begin(), from.roll_rad().end());
}

void read(FrameStart& to, const wire::FrameStart& from) {
  to.number = from.number();
  read(to.controls, from.controls());
  read(to.pose, from.pose());
  to.pose_stale = from.pose_stale();
}

/// The payload to read into: the one of the last datagram where the type fits, so that its memory is used again.
template <typename T>
T& reused(Payload& payload) {
  if (T* held = std::get_if<T>(&payload)) return *held;
  return payload.emplace<T>();
}

bool unknown_in(const google::protobuf::Message& message) {
  return !message.GetReflection()->GetUnknownFields(message).empty();
}

}  // namespace

bool any_unknown(const wire::Datagram& message) {
  if (unknown_in(message)) return true;
  switch (message.payload_case()) {
    case wire::Datagram::kCockpitState:
      return unknown_in(message.cockpit_state());
    case wire::Datagram::kVehicleState:
      return unknown_in(message.vehicle_state());
    case wire::Datagram::kFrameReport:
      return unknown_in(message.frame_report()) || unknown_in(message.frame_report().drawn());
    case wire::Datagram::kRigControl: {
      const wire::RigControl& control = message.rig_control();
      return unknown_in(control) || (control.has_dim() && unknown_in(control.dim())) ||
             (control.has_swivel() && unknown_in(control.swivel())) ||
             (control.has_place() && unknown_in(control.place())) || (control.has_set() && unknown_in(control.set())) ||
             (control.has_mount() && unknown_in(control.mount())) ||
             (control.has_undo() && unknown_in(control.undo())) ||
             (control.has_reset() && unknown_in(control.reset())) || (control.has_save() && unknown_in(control.save()));
    }
    case wire::Datagram::kProbeRequest:
      return unknown_in(message.probe_request());
    case wire::Datagram::kProbeReply:
      return unknown_in(message.probe_reply());
    case wire::Datagram::kKeyInput:
      return unknown_in(message.key_input());
    case wire::Datagram::kControlReply:
      return unknown_in(message.control_reply());
    case wire::Datagram::kClockProbe:
      return unknown_in(message.clock_probe());
    case wire::Datagram::kLawAnswer:
      return unknown_in(message.law_answer()) ||
             std::ranges::any_of(message.law_answer().lamps(), [](const auto& lamp) { return unknown_in(lamp); });
    case wire::Datagram::kLampState:
      return unknown_in(message.lamp_state());
    case wire::Datagram::kFrameStart:
      return unknown_in(message.frame_start()) || unknown_in(message.frame_start().controls()) ||
             unknown_in(message.frame_start().pose());
    case wire::Datagram::PAYLOAD_NOT_SET:
      break;
  }
  return true;
}

bool read_payload(const wire::Datagram& message, Payload& payload) {
  switch (message.payload_case()) {
    case wire::Datagram::kCockpitState:
      read(reused<CockpitState>(payload), message.cockpit_state());
      break;
    case wire::Datagram::kVehicleState:
      read(reused<VehicleState>(payload), message.vehicle_state());
      break;
    case wire::Datagram::kFrameReport:
      if (!message.frame_report().has_drawn()) return false;
      read(reused<FrameReport>(payload), message.frame_report());
      break;
    case wire::Datagram::kRigControl:
      if (!read(reused<RigControl>(payload), message.rig_control())) return false;
      break;
    case wire::Datagram::kProbeRequest:
      read(reused<ProbeRequest>(payload), message.probe_request());
      break;
    case wire::Datagram::kProbeReply:
      read(reused<ProbeReply>(payload), message.probe_reply());
      break;
    case wire::Datagram::kKeyInput:
      read(reused<KeyInput>(payload), message.key_input());
      break;
    case wire::Datagram::kControlReply:
      read(reused<ControlReply>(payload), message.control_reply());
      break;
    case wire::Datagram::kLampState:
      read(reused<LampState>(payload), message.lamp_state());
      break;
    case wire::Datagram::kFrameStart:
      if (!message.frame_start().has_controls() || !message.frame_start().has_pose()) return false;
      read(reused<FrameStart>(payload), message.frame_start());
      break;
    case wire::Datagram::kClockProbe:
      read(reused<ClockProbe>(payload), message.clock_probe());
      break;
    case wire::Datagram::kLawAnswer:
      read(reused<LawAnswer>(payload), message.law_answer());
      break;
    case wire::Datagram::PAYLOAD_NOT_SET:
      return false;
  }
  return true;
}

}  // namespace phare
