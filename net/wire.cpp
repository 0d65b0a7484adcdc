#include "net/wire.h"

#include <google/protobuf/arena.h>
#include <google/protobuf/message.h>
#include <google/protobuf/stubs/logging.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "net/udp.h"
#include "phare.pb.h"

namespace phare {
namespace {

// Tag of field 16, fixed32, as a varint; then four bytes, little-endian.
constexpr std::size_t kCheckBytes = 6;
constexpr unsigned char kCheckTag[2] = {0x85, 0x01};
// version, sender, start id, sequence, payload of length 0, check
constexpr std::size_t kMinDatagramBytes = 2 + 2 + 9 + 2 + 2 + kCheckBytes;

std::uint32_t crc_of(const void* bytes, std::size_t size) {
  return static_cast<std::uint32_t>(crc32(0, static_cast<const Bytef*>(bytes), static_cast<uInt>(size)));
}

/// One protobuf message on an arena whose first block is kept, so that small datagrams need no heap at all.
class Scratch {
 public:
  Scratch() : arena_(options(block_)) {
    // Otherwise protobuf writes a line to stderr for every string that is not UTF-8.
    google::protobuf::SetLogHandler(nullptr);
  }

  wire::Datagram& fresh() {
    arena_.Reset();
    return *google::protobuf::Arena::CreateMessage<wire::Datagram>(&arena_);
  }

 private:
  using Block = std::array<char, 16384>;
  static google::protobuf::ArenaOptions options(Block& block) {
    google::protobuf::ArenaOptions options;
    options.initial_block = block.data();
    options.initial_block_size = block.size();
    return options;
  }

  alignas(16) Block block_;
  google::protobuf::Arena arena_;
};

wire::Datagram& fresh_message() {
  thread_local Scratch scratch;
  return scratch.fresh();
}

// ---- struct to protobuf

template <typename Enum>
Enum to_wire_enum(int value) {
  return static_cast<Enum>(value);
}

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
};

// ---- protobuf to struct

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

/// The payload to read into: the one of the last datagram where the type fits, so that its memory is used again.
template <typename T>
T& reused(Payload& payload) {
  if (T* held = std::get_if<T>(&payload)) return *held;
  return payload.emplace<T>();
}

// ---- unknown fields, at any depth

bool unknown_in(const google::protobuf::Message& message) {
  return !message.GetReflection()->GetUnknownFields(message).empty();
}

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
    case wire::Datagram::PAYLOAD_NOT_SET:
      break;
  }
  return true;
}

/// Every message has one encoding. What parses but encodes otherwise repeats fields, pads numbers or changes their
/// order.
bool is_the_encoding_of(const wire::Datagram& message, const std::uint8_t* bytes, std::size_t size) {
  if (message.ByteSizeLong() != size) return false;
  thread_local std::vector<std::uint8_t> canonical(kMaxDatagramBytes);
  message.SerializeWithCachedSizesToArray(canonical.data());
  return std::memcmp(canonical.data(), bytes, size) == 0;
}

}  // namespace

void encode_into(const Datagram& datagram, std::string& bytes) {
  wire::Datagram& message = fresh_message();
  message.set_protocol_version(kProtocolVersion);
  message.set_sender(to_wire_enum<wire::Sender>(static_cast<int>(datagram.sender)));
  message.set_sender_channel(datagram.sender_channel);
  message.set_start_id(datagram.start_id);
  message.set_sequence(datagram.sequence);
  message.set_sim_time_ns(datagram.sim_time.ns);
  message.set_sent_wall_ns(datagram.sent.ns);
  std::visit(PayloadFiller{message}, datagram.payload);

  // There are no maps and no unknown fields: protobuf's encoding of equal messages is equal.
  const std::size_t size = message.ByteSizeLong();
  bytes.resize(size + kCheckBytes);
  auto* const begin = reinterpret_cast<std::uint8_t*>(bytes.data());
  std::uint8_t* end = message.SerializeWithCachedSizesToArray(begin);
  const std::uint32_t crc = crc_of(begin, size);
  *end++ = kCheckTag[0];
  *end++ = kCheckTag[1];
  for (int shift = 0; shift < 32; shift += 8) *end++ = static_cast<std::uint8_t>(crc >> shift);
}

std::string encode(const Datagram& datagram) {
  std::string bytes;
  encode_into(datagram, bytes);
  return bytes;
}

Refusal decode_into(std::span<const std::byte> bytes, Datagram& datagram) {
  // Cheap checks first, so that a flood of garbage costs little: size, first bytes, check tag, CRC.
  if (bytes.size() < kMinDatagramBytes || bytes.size() > kMaxDatagramBytes) return Refusal::kSize;
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  if (data[0] != 0x08 || data[1] != kProtocolVersion || data[2] != 0x10 || data[3] < 1 || data[3] > 5) {
    return Refusal::kHeader;
  }
  const std::size_t size = bytes.size() - kCheckBytes;
  const std::uint8_t* const tail = data + size;
  if (tail[0] != kCheckTag[0] || tail[1] != kCheckTag[1]) return Refusal::kChecksum;
  std::uint32_t crc = 0;
  for (unsigned i = 0; i < 4; ++i) crc |= static_cast<std::uint32_t>(tail[2 + i]) << (8 * i);
  if (crc != crc_of(data, size)) return Refusal::kChecksum;

  wire::Datagram& message = fresh_message();
  if (!message.ParseFromArray(data, static_cast<int>(size))) return Refusal::kMalformed;
  if (any_unknown(message) || message.check() != 0 || !is_the_encoding_of(message, data, size))
    return Refusal::kMalformed;

  datagram.sender = static_cast<Sender>(static_cast<int>(message.sender()));
  datagram.sender_channel = message.sender_channel();
  datagram.start_id = message.start_id();
  datagram.sequence = message.sequence();
  datagram.sim_time.ns = message.sim_time_ns();
  datagram.sent.ns = message.sent_wall_ns();
  switch (message.payload_case()) {
    case wire::Datagram::kCockpitState:
      read(reused<CockpitState>(datagram.payload), message.cockpit_state());
      break;
    case wire::Datagram::kVehicleState:
      read(reused<VehicleState>(datagram.payload), message.vehicle_state());
      break;
    case wire::Datagram::kFrameReport:
      if (!message.frame_report().has_drawn()) return Refusal::kMalformed;
      read(reused<FrameReport>(datagram.payload), message.frame_report());
      break;
    case wire::Datagram::kRigControl:
      if (!read(reused<RigControl>(datagram.payload), message.rig_control())) return Refusal::kMalformed;
      break;
    case wire::Datagram::kProbeRequest:
      read(reused<ProbeRequest>(datagram.payload), message.probe_request());
      break;
    case wire::Datagram::kProbeReply:
      read(reused<ProbeReply>(datagram.payload), message.probe_reply());
      break;
    case wire::Datagram::kKeyInput:
      read(reused<KeyInput>(datagram.payload), message.key_input());
      break;
    case wire::Datagram::kControlReply:
      read(reused<ControlReply>(datagram.payload), message.control_reply());
      break;
    case wire::Datagram::kLampState:
      read(reused<LampState>(datagram.payload), message.lamp_state());
      break;
    case wire::Datagram::kClockProbe:
      read(reused<ClockProbe>(datagram.payload), message.clock_probe());
      break;
    case wire::Datagram::kLawAnswer:
      read(reused<LawAnswer>(datagram.payload), message.law_answer());
      break;
    case wire::Datagram::PAYLOAD_NOT_SET:
      return Refusal::kMalformed;
  }
  return check(datagram);
}

Result<Datagram> decode(std::span<const std::byte> bytes) {
  Datagram datagram;
  const Refusal refusal = decode_into(bytes, datagram);
  if (refusal != Refusal::kNone) return Error{"datagram", refusal_text(refusal)};
  return datagram;
}

}  // namespace phare
