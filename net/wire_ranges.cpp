// What a datagram may say: sane ranges of every field, of whoever sent it.
#include <cmath>
#include <variant>
#include <vector>

#include "net/channels.h"
#include "net/wire.h"

namespace phare {
namespace {

// Wide enough for every hard case of a drive, narrow enough that sums and squares stay finite.

constexpr double kMaxCoordinate_m = 1e8;  // beyond the earth's radius
constexpr double kMaxAngle_rad = 1e6;     // yaw need not be wrapped
constexpr double kMaxSpeed_mps = 1e5;
constexpr double kMaxRate_radps = 1e5;
constexpr double kMaxAcceleration_mps2 = 1e6;
constexpr double kMaxSteeringWheel_rad = 20.0;  // three turns to a side
constexpr double kMaxRoadWheel_rad = 1.6;
constexpr double kMaxTime_s = 1e9;  // thirty years; fits the 32 bits of a pcap stamp
constexpr std::int64_t kMaxTime_ns = 1'000'000'000'000'000'000;
constexpr double kMaxFrame_ms = 1e9;
// A hundred and twenty years after 1970: differences of two fit 64 bits.
constexpr std::int64_t kMaxWall_ns = 4'000'000'000'000'000'000;
constexpr double kMaxAim_rad = 1.6;
constexpr double kMaxNormal = 1.001;
constexpr double kLeastNormal = 1e-6;  ///< in length: less has no direction
constexpr double kMaxIlluminance_lx = 1e15;
constexpr std::int64_t kMaxFrameIndex = 1'000'000'000'000;
constexpr std::uint64_t kMaxSequence = std::uint64_t{1} << 62;
constexpr std::uint32_t kMaxDesigns = 10000;
constexpr std::size_t kMaxNameBytes = 64;
constexpr std::size_t kMaxValueBytes = 1024;  // of a setting
constexpr std::uint32_t kMaxSources = 10000;  // of a lamp
constexpr double kMaxMounting_m = 50.0;       // of a lamp from the car's origin: long lorries too
constexpr std::uint32_t kMaxUndoSteps = 1000;
constexpr std::size_t kMaxErrorBytes = 4096;
constexpr std::uint32_t kMaxKey = 0x1ff;  // characters of Latin-1, then GLFW's numbers

/// Collects the first thing wrong.
class Checker {
 public:
  Refusal first() const { return first_; }

  void number(double value, double min, double max) {
    if (!std::isfinite(value)) return refuse(Refusal::kNotFinite);
    if (value < min || value > max) refuse(Refusal::kRange);
  }
  void within(double value, double limit) { number(value, -limit, limit); }
  void numbers(const std::vector<double>& values, double min, double max) {
    for (const double value : values) number(value, min, max);
  }
  void require(bool fine, Refusal otherwise = Refusal::kRange) {
    if (!fine) refuse(otherwise);
  }
  void frame_index(std::int64_t index) { require(index >= -1 && index <= kMaxFrameIndex); }

 private:
  void refuse(Refusal refusal) {
    if (first_ == Refusal::kNone) first_ = refusal;
  }
  Refusal first_ = Refusal::kNone;
};

template <typename Enum>
bool enum_within(Enum value, Enum last) {
  return static_cast<int>(value) >= 0 && static_cast<int>(value) <= static_cast<int>(last);
}

void check(Checker& c, const CockpitState& s) {
  c.frame_index(s.frame_index);
  c.require(enum_within(s.light_switch, LightSwitch::kHigh));
  c.require(enum_within(s.gear, Gear::kPark));
  c.require(s.design_index < kMaxDesigns);
  c.within(s.steering_wheel_rad, kMaxSteeringWheel_rad);
  c.number(s.accelerator_01, 0.0, 1.0);
  c.number(s.brake_01, 0.0, 1.0);
  c.require(s.light_change_sim.ns >= -kMaxTime_ns && s.light_change_sim.ns <= kMaxTime_ns);
  c.require(s.source.size() <= kMaxNameBytes);
  c.require(enum_within(s.turn, TurnSignal::kRight));
  c.within(s.lamp_aim_rad, kMaxAim_rad);
  c.number(s.clutch_01, 0.0, 1.0);
  c.number(s.parking_brake_01, 0.0, 1.0);
  c.require(s.source_fault.size() <= kMaxErrorBytes);
}

void check(Checker& c, const VehicleState& s) {
  c.frame_index(s.frame_index);
  for (const double coordinate_m : {s.x_m, s.y_m, s.z_m}) c.within(coordinate_m, kMaxCoordinate_m);
  for (const double angle_rad : {s.roll_rad, s.pitch_rad, s.yaw_rad, s.suspension_pitch_rad, s.suspension_roll_rad}) {
    c.within(angle_rad, kMaxAngle_rad);
  }
  for (const double speed_mps : {s.vx_mps, s.vy_mps, s.vz_mps, s.speed_mps}) c.within(speed_mps, kMaxSpeed_mps);
  for (const double rate_radps : {s.roll_rate_radps, s.pitch_rate_radps, s.yaw_rate_radps}) {
    c.within(rate_radps, kMaxRate_radps);
  }
  for (const double acceleration_mps2 : {s.ax_mps2, s.ay_mps2}) c.within(acceleration_mps2, kMaxAcceleration_mps2);
  c.within(s.steer_rad, kMaxRoadWheel_rad);
  c.within(s.suspension_heave_m, kMaxCoordinate_m);
  c.number(s.lag_s, 0.0, kMaxTime_s);
  c.require(s.level.size() <= kMaxNameBytes);
  c.within(s.lamp_tilt_rad, kMaxAim_rad);
  c.require(s.step_hash.size() <= kMaxStepHashes, Refusal::kArrays);
}

void check(Checker& c, const FrameReport& r) {
  c.frame_index(r.frame_index);
  c.require(r.channels >= 1 && r.channels <= kMaxChannels && r.channel < r.channels);
  c.number(r.frame_ms, 0.0, kMaxFrame_ms);
  c.number(r.gpu_ms, 0.0, kMaxFrame_ms);
  c.require(r.audit_failure.size() <= kMaxErrorBytes);
  c.require(enum_within(r.light_drawn, LightSwitch::kHigh));
  check(c, r.drawn);
}

struct CommandChecker {
  Checker& c;
  void operator()(const RigControl::Pause&) const {}
  void operator()(const RigControl::Seek& seek) const { c.number(seek.to_s, 0.0, kMaxTime_s); }
  void operator()(const RigControl::Design& design) const { c.require(design.index < kMaxDesigns); }
  void operator()(const RigControl::Aim& aim) const { c.within(aim.pitch_rad, kMaxAim_rad); }
  void operator()(const RigControl::Quit&) const {}
  void operator()(const RigControl::Dim& dim) const {
    c.require(!dim.lamp.empty() && dim.lamp.size() <= kMaxNameBytes && dim.source <= kMaxSources);
    c.number(dim.dimming_01, 0.0, 1.0);
  }
  void operator()(const RigControl::Swivel& swivel) const {
    c.require(!swivel.lamp.empty() && swivel.lamp.size() <= kMaxNameBytes);
    for (const double angle_rad : {swivel.yaw_rad, swivel.pitch_rad}) c.within(angle_rad, kMaxAim_rad);
  }
  void operator()(const RigControl::Place& place) const {
    c.require(!place.lamp.empty() && place.lamp.size() <= kMaxNameBytes);
    for (const double at_m : {place.x_m, place.y_m, place.z_m}) c.within(at_m, kMaxMounting_m);
  }
  void operator()(const RigControl::Tell&) const {}
  void operator()(const RigControl::Set& set) const {
    c.require(!set.setting.empty() && set.setting.size() <= kMaxNameBytes && set.value.size() <= kMaxValueBytes);
  }
  void operator()(const RigControl::Mount& mount) const {
    c.require(mount.lamp.size() <= kMaxNameBytes);
    c.require(enum_within(mount.quantity, rig_command::MountQuantity::kRoll));
    c.within(mount.value, mount.quantity <= rig_command::MountQuantity::kSpacing ? 2.0 * kMaxMounting_m : kMaxAim_rad);
  }
  void operator()(const RigControl::Undo& undo) const { c.require(undo.steps >= 1 && undo.steps <= kMaxUndoSteps); }
  void operator()(const RigControl::Reset& reset) const { c.require(reset.lamp.size() <= kMaxNameBytes); }
  void operator()(const RigControl::Save& save) const { c.require(save.file.size() <= kMaxErrorBytes); }
  void operator()(const RigControl::Frame& frame) const {
    c.require(!frame.lamp.empty() && frame.lamp.size() <= kMaxNameBytes && !frame.file.empty() &&
              frame.file.size() <= kMaxErrorBytes);
  }
};

void check(Checker& c, const RigControl& control) {
  std::visit(CommandChecker{c}, control.command);
  c.require(control.request_id <= kMaxSequence && control.first_open <= control.request_id);
  c.require((control.request_id == 0) == (control.first_open == 0));
}

void check(Checker& c, const ProbeRequest& r) {
  const std::size_t count = r.x_m.size();
  c.require(count <= kMaxProbePoints, Refusal::kArrays);
  for (const auto* array : {&r.y_m, &r.z_m, &r.nx, &r.ny, &r.nz}) c.require(array->size() == count, Refusal::kArrays);
  for (const auto* array : {&r.x_m, &r.y_m, &r.z_m}) c.numbers(*array, -kMaxCoordinate_m, kMaxCoordinate_m);
  for (const auto* array : {&r.nx, &r.ny, &r.nz}) c.numbers(*array, -kMaxNormal, kMaxNormal);
  for (std::size_t i = 0; i < count && i < r.nz.size() && i < r.ny.size() && i < r.nx.size(); ++i)
    c.require(std::hypot(r.nx[i], r.ny[i], r.nz[i]) >= kLeastNormal);
}

void check(Checker& c, const ProbeReply& r) {
  c.require(r.illuminance_lx.size() <= kMaxProbePoints, Refusal::kArrays);
  c.numbers(r.illuminance_lx, 0.0, kMaxIlluminance_lx);
  c.require(r.error.size() <= kMaxErrorBytes);
}

void check(Checker& c, const KeyInput& keys) {
  c.require(keys.held.size() <= kMostKeys && keys.event.size() <= kMostKeys, Refusal::kArrays);
  std::uint32_t before = 0;
  for (const std::uint32_t key : keys.held) {
    c.require(key > before && key <= kMaxKey);
    before = key;
  }
  constexpr auto kMost = static_cast<std::int32_t>(kMaxKey);
  for (const std::int32_t event : keys.event) c.require(event != 0 && event >= -kMost && event <= kMost);
  c.require(keys.events >= keys.event.size() && keys.events <= kMaxSequence);
}

void check(Checker& c, const ControlReply& r) {
  c.require(r.request_id >= 1 && r.request_id <= kMaxSequence);
  c.require(enum_within(r.verdict, Verdict::kNotMine));
  c.require(r.reason.size() <= kMaxErrorBytes && r.now.size() <= kMaxErrorBytes);
}

void check(Checker& c, const LampState& s) {
  const std::size_t lamps = s.x_m.size();
  c.require(s.design_index < kMaxDesigns);
  c.require(lamps >= 1 && lamps <= kMostLampStates, Refusal::kArrays);
  for (const auto* array : {&s.y_m, &s.z_m, &s.yaw_rad, &s.pitch_rad, &s.roll_rad})
    c.require(array->size() == lamps, Refusal::kArrays);
  for (const auto* array : {&s.x_m, &s.y_m, &s.z_m}) c.numbers(*array, -kMaxMounting_m, kMaxMounting_m);
  for (const auto* array : {&s.yaw_rad, &s.pitch_rad, &s.roll_rad}) c.numbers(*array, -kMaxAim_rad, kMaxAim_rad);
  c.within(s.aim_pitch_rad, kMaxAim_rad);
}

void check(Checker& c, const FrameStart& s) {
  c.require(s.number >= 1 && s.number <= kMaxSequence);
  check(c, s.controls);
  check(c, s.pose);
}

void check(Checker& c, const ClockProbe& probe) {
  c.require(probe.asked.ns >= 1 && probe.asked.ns <= kMaxWall_ns);
  c.require(probe.heard.ns >= 0 && probe.heard.ns <= kMaxWall_ns);
}

void check(Checker& c, const LawAnswer& a) {
  c.frame_index(a.frame_index);
  c.require(a.input.ns >= 0 && a.input.ns <= kMaxWall_ns);
  c.require(enum_within(a.light_switch, LightSwitch::kHigh));
  c.within(a.levelling_rad, kMaxAim_rad);
  c.require(a.lamps.size() <= kMostLawLamps, Refusal::kArrays);
  for (const LampLight& light : a.lamps) {
    c.require(!light.lamp.empty() && light.lamp.size() <= kMaxNameBytes);
    for (const double angle_rad : {light.yaw_rad, light.pitch_rad}) c.within(angle_rad, kMaxAim_rad);
    c.require(light.dimming_01.size() <= kMaxSources, Refusal::kArrays);
    c.numbers(light.dimming_01, 0.0, 1.0);
    c.require(light.frame.size() <= kMaxErrorBytes);
  }
}

}  // namespace

Refusal check(const Datagram& datagram) {
  Checker c;
  c.require(datagram.start_id != 0 && datagram.sequence >= 1 && datagram.sequence <= kMaxSequence, Refusal::kEnvelope);
  c.require(datagram.sim_time.ns >= 0 && datagram.sim_time.ns <= kMaxTime_ns, Refusal::kEnvelope);
  c.require(datagram.sent.ns >= 0 && datagram.sent.ns <= kMaxWall_ns, Refusal::kEnvelope);
  const bool visual = datagram.sender == Sender::kVisual;
  c.require(datagram.sender_channel < (visual ? kMaxChannels : 1), Refusal::kEnvelope);
  c.require(kChannels[datagram.payload.index()].may_send(datagram.sender), Refusal::kSender);
  if (const auto* report = std::get_if<FrameReport>(&datagram.payload)) {
    c.require(report->channel == datagram.sender_channel, Refusal::kEnvelope);
  }
  std::visit([&c](const auto& payload) { check(c, payload); }, datagram.payload);
  return c.first();
}

const char* refusal_text(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "accepted";
    case Refusal::kSize:
      return "shorter or longer than any datagram";
    case Refusal::kHeader:
      return "no datagram of this protocol version";
    case Refusal::kChecksum:
      return "checksum does not fit: cut short or changed on the way";
    case Refusal::kMalformed:
      return "not the encoding of a datagram";
    case Refusal::kEnvelope:
      return "start id, sequence, channel or time out of range";
    case Refusal::kSender:
      return "sender may not send this payload";
    case Refusal::kNotFinite:
      return "a number is not finite";
    case Refusal::kRange:
      return "a value is out of range";
    case Refusal::kArrays:
      return "arrays differ in length, or are longer than any of ours";
    case Refusal::kNotForUs:
      return "not meant for this process";
    case Refusal::kKey:
      return "not sealed with the key of this bus";
    case Refusal::kReplay:
      return "sent earlier and played again, or the clocks of two machines are far apart";
    case Refusal::kSecond:
      return "another sender of this message is heard";
  }
  return "unknown";
}

}  // namespace phare
