#include "tests/net/sample.h"

#include "net/channels.h"

namespace phare::test {
namespace {

class Values {
 public:
  explicit Values(std::mt19937_64& random) : random_(random) {}
  double number(double min, double max) { return std::uniform_real_distribution<double>(min, max)(random_); }
  std::uint64_t whole(std::uint64_t max) { return std::uniform_int_distribution<std::uint64_t>(0, max)(random_); }
  std::uint64_t bits() { return random_(); }
  bool flag() { return (random_() & 1) != 0; }
  std::vector<double> numbers(std::size_t count, double min, double max) {
    std::vector<double> values(count);
    for (double& value : values) value = number(min, max);
    return values;
  }

 private:
  std::mt19937_64& random_;
};

VehicleState vehicle(Values& v) {
  VehicleState s;
  s.frame_index = static_cast<std::int64_t>(v.whole(100000)) - 1;
  s.x_m = v.number(-1e8, 1e8);
  s.y_m = v.number(-1e8, 1e8);
  s.z_m = v.number(-1e3, 1e4);
  s.roll_rad = v.number(-1, 1);
  s.pitch_rad = v.number(-1, 1);
  s.yaw_rad = v.number(-7, 7);
  s.vx_mps = v.number(-80, 80);
  s.vy_mps = v.number(-80, 80);
  s.vz_mps = v.number(-5, 5);
  s.roll_rate_radps = v.number(-3, 3);
  s.pitch_rate_radps = v.number(-3, 3);
  s.yaw_rate_radps = v.number(-3, 3);
  s.ax_mps2 = v.number(-12, 12);
  s.ay_mps2 = v.number(-12, 12);
  s.speed_mps = v.number(-10, 80);
  s.steer_rad = v.number(-0.6, 0.6);
  s.suspension_pitch_rad = v.number(-0.1, 0.1);
  s.suspension_roll_rad = v.number(-0.1, 0.1);
  s.suspension_heave_m = v.number(-0.2, 0.2);
  s.level = v.flag() ? "single-track" : "kinematic";
  s.step = v.bits();
  s.state_hash = v.bits();
  s.lag_s = v.number(0, 10);
  s.high_beam_telltale = v.flag();
  s.drive_ended = v.flag();
  s.lamp_tilt_rad = v.number(-0.1, 0.1);
  s.step_hash.resize(v.whole(16));
  for (std::uint64_t& hash : s.step_hash) hash = v.bits();
  return s;
}

Payload payload_of(std::size_t index, std::uint32_t channel, Values& v) {
  switch (index) {
    case kPayloadIndex<CockpitState>: {
      CockpitState s;
      s.frame_index = static_cast<std::int64_t>(v.whole(100000)) - 1;
      s.light_switch = static_cast<LightSwitch>(v.whole(3));
      s.flash = v.flag();
      s.fog_front = v.flag();
      s.design_index = static_cast<std::uint32_t>(v.whole(99));
      s.steering_wheel_rad = v.number(-20, 20);
      s.accelerator_01 = v.number(0, 1);
      s.brake_01 = v.number(0, 1);
      s.gear = static_cast<Gear>(v.whole(3));
      s.fail_safe = v.flag();
      s.light_changes = v.bits();
      s.light_change_wall.ns = static_cast<std::int64_t>(v.whole(2'000'000'000'000'000'000));
      s.light_change_sim.ns = static_cast<std::int64_t>(v.whole(3'600'000'000'000));
      s.drive_ended = v.flag();
      s.source = "can0";
      s.fog_rear = v.flag();
      s.turn = static_cast<TurnSignal>(v.whole(2));
      s.hazard = v.flag();
      s.high_beam_automatic = v.flag();
      s.lamp_aim_rad = v.number(-0.1, 0.1);
      s.clutch_01 = v.number(0, 1);
      s.parking_brake_01 = v.number(0, 1);
      s.ignition_off = v.flag();
      s.source_stamp.ns = static_cast<std::int64_t>(v.whole(2'000'000'000'000'000'000));
      s.source_fault = v.flag() ? "can0: link down" : "";
      return s;
    }
    case kPayloadIndex<VehicleState>:
      return vehicle(v);
    case kPayloadIndex<FrameReport>: {
      FrameReport r;
      r.frame_index = static_cast<std::int64_t>(v.whole(100000)) - 1;
      r.channel = channel;
      r.channels = kMaxChannels;
      r.frame_ms = v.number(0, 100);
      r.gpu_ms = v.number(0, 100);
      r.light_changes_drawn = v.bits();
      r.drawn = vehicle(v);
      r.pose_stale = v.flag();
      r.light_drawn = LightSwitch::kHigh;
      r.flash_drawn = v.flag();
      r.fail_safe_drawn = v.flag();
      r.pictures_not_kept = r.channel;
      r.start = v.whole(1'000'000);
      r.audit_failure = v.flag() ? "frame 3, pixel (5, 7): 1.2 lx, float64 1 lx" : "";
      return r;
    }
    case kPayloadIndex<RigControl>: {
      switch (v.whole(14)) {
        case 0:
          return RigControl{RigControl::Pause{v.flag()}};
        case 1:
          return RigControl{RigControl::Seek{v.number(0, 1000)}};
        case 2:
          return RigControl{RigControl::Design{static_cast<std::uint32_t>(v.whole(9))}};
        case 3:
          return RigControl{RigControl::Aim{v.number(-0.1, 0.1)}};
        case 4:
          return RigControl{RigControl::Dim{"headlamp left", static_cast<std::uint32_t>(v.whole(36)), v.number(0, 1)}};
        case 5:
          return RigControl{RigControl::Swivel{"headlamp right", v.number(-0.3, 0.3), v.number(-0.1, 0.1)}};
        case 6:
          return RigControl{RigControl::Place{"fog left", v.number(-1, 5), v.number(-1, 1), v.number(0, 3)}};
        case 7: {
          RigControl tell{RigControl::Tell{}};
          tell.request_id = 1 + v.whole(1'000'000);
          tell.first_open = 1 + v.whole(tell.request_id - 1);
          return tell;
        }
        case 8:
          return RigControl{RigControl::Set{"isolux_lx", std::string(v.whole(1024), '1')}};
        case 9:
          return RigControl{RigControl::Mount{v.flag() ? "" : "headlamp",
                                              static_cast<rig_command::MountQuantity>(v.whole(6)), v.number(-1.5, 1.5),
                                              v.flag()}};
        case 10:
          return RigControl{RigControl::Undo{1 + static_cast<std::uint32_t>(v.whole(9))}};
        case 11:
          return RigControl{RigControl::Reset{v.flag() ? "" : "fog left"}};
        case 12:
          return RigControl{RigControl::Save{v.flag() ? "" : "/home/jemand/prüfung.toml"}};
        case 13:
          return RigControl{RigControl::Frame{"headlamp left", "/dev/shm/links ü.pgm"}};
        default:
          return RigControl{RigControl::Quit{}};
      }
    }
    case kPayloadIndex<ProbeRequest>: {
      const std::size_t n = v.whole(50);
      ProbeRequest r;
      r.request_id = v.bits();
      r.x_m = v.numbers(n, -1e8, 1e8);
      r.y_m = v.numbers(n, -1e8, 1e8);
      r.z_m = v.numbers(n, -1e3, 1e4);
      r.nx = v.numbers(n, -1, 1);
      r.ny = v.numbers(n, -1, 1);
      r.nz = v.numbers(n, -1, 1);
      return r;
    }
    case kPayloadIndex<KeyInput>: {
      KeyInput k;
      for (std::uint32_t key = 1; k.held.size() < kMostKeys && v.flag();)
        k.held.push_back(key += 1 + static_cast<std::uint32_t>(v.whole(29)));
      for (std::uint64_t n = v.whole(kMostKeys); n > 0; --n) {
        const auto key = static_cast<std::int32_t>(1 + v.whole(0x1fe));
        k.event.push_back(v.flag() ? key : -key);
      }
      k.events = k.event.size() + v.whole(1'000'000);
      return k;
    }
    case kPayloadIndex<ProbeReply>: {
      ProbeReply r;
      r.request_id = v.bits();
      r.illuminance_lx = v.numbers(v.whole(50), 0, 1e4);
      r.error = v.flag() ? "" : "no lamp is lit — prüfen";
      return r;
    }
    case kPayloadIndex<LampState>: {
      const std::size_t n = 1 + v.whole(kMostLampStates - 1);
      LampState s;
      s.design_index = static_cast<std::uint32_t>(v.whole(9));
      s.aim_pitch_rad = v.number(-0.1, 0.1);
      for (auto* array : {&s.x_m, &s.y_m, &s.z_m}) *array = v.numbers(n, -5, 5);
      for (auto* array : {&s.yaw_rad, &s.pitch_rad, &s.roll_rad}) *array = v.numbers(n, -1.5, 1.5);
      return s;
    }
    case kPayloadIndex<FrameStart>: {
      FrameStart s;
      s.number = 1 + v.whole(1'000'000);
      s.controls = std::get<CockpitState>(payload_of(kPayloadIndex<CockpitState>, 0, v));
      s.pose = vehicle(v);
      s.pose_stale = v.flag();
      return s;
    }
    case kPayloadIndex<ClockProbe>: {
      ClockProbe probe;
      probe.asked.ns = 1 + static_cast<std::int64_t>(v.whole(2'000'000'000'000'000'000));
      probe.heard.ns = static_cast<std::int64_t>(v.whole(2'000'000'000'000'000'000));
      return probe;
    }
    case kPayloadIndex<LawAnswer>: {
      LawAnswer a;
      a.frame_index = static_cast<std::int64_t>(v.whole(100000)) - 1;
      a.input.ns = static_cast<std::int64_t>(v.whole(2'000'000'000'000'000'000));
      a.light_switch = static_cast<LightSwitch>(v.whole(3));
      a.levelling_rad = v.number(-0.1, 0.1);
      for (std::uint64_t n = v.whole(4); n > 0; --n)
        a.lamps.push_back(
            {"headlamp left", v.number(-0.3, 0.3), v.number(-0.1, 0.1), v.numbers(v.whole(40), 0.0, 1.0)});
      return a;
    }
    default: {
      ControlReply r;
      r.to_start_id = v.bits();
      r.request_id = 1 + v.whole(1'000'000);
      r.verdict = static_cast<Verdict>(v.whole(3));
      r.reason = v.flag() ? "" : "lamp \"fog\": design \"für den Winter\" has headlamp left";
      r.now = v.flag() ? "" : "headlamp left: source 17 at 0 %";
      return r;
    }
  }
}

}  // namespace

Datagram sample(std::size_t payload_index, std::mt19937_64& random) {
  Values v(random);
  Datagram d;
  d.sender = kChannels[payload_index].sender;
  d.sender_channel = d.sender == Sender::kVisual ? static_cast<std::uint32_t>(v.whole(kMaxChannels - 1)) : 0;
  d.start_id = v.bits() | 1;
  d.sequence = 1 + v.whole(1'000'000);
  d.sim_time.ns = static_cast<std::int64_t>(v.whole(3'600'000'000'000));
  d.sent.ns = static_cast<std::int64_t>(v.whole(2'000'000'000'000'000'000));
  d.payload = payload_of(payload_index, d.sender_channel, v);
  return d;
}

std::vector<Datagram> samples(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Datagram> all;
  for (std::size_t i = 0; i < kChannels.size(); ++i) all.push_back(sample(i, random));
  const RigControl commands[] = {{RigControl::Pause{true}},
                                 {RigControl::Pause{false}},
                                 {RigControl::Seek{0.0}},
                                 {RigControl::Seek{12.5}},
                                 {RigControl::Design{0}},
                                 {RigControl::Design{3}},
                                 {RigControl::Aim{-0.01}},
                                 {RigControl::Quit{}},
                                 {RigControl::Dim{"headlamp left", 0, 0.0}},
                                 {RigControl::Dim{"headlamp right", 36, 0.25}},
                                 {RigControl::Swivel{"headlamp left", 0.1, 0.0}},
                                 {RigControl::Place{"headlamp left", 3.4, 0.7, 0.9}},
                                 {RigControl::Set{"camera", "chase"}},
                                 {RigControl::Set{"help", ""}},
                                 {RigControl::Mount{"headlamp", rig_command::MountQuantity::kSpacing, -0.02, true}},
                                 {RigControl::Mount{"", rig_command::MountQuantity::kPitch, 0.01, false}},
                                 {RigControl::Undo{3}},
                                 {RigControl::Reset{""}},
                                 {RigControl::Save{""}},
                                 {RigControl::Frame{"headlamp left", "/dev/shm/left.pgm"}},
                                 {RigControl::Tell{}, 12, 3}};
  for (const RigControl& command : commands) {
    Datagram d = sample(kPayloadIndex<RigControl>, random);
    d.payload = command;
    all.push_back(d);
  }
  return all;
}

bool equal(const Datagram& a, const Datagram& b) {
  return a.sender == b.sender && a.sender_channel == b.sender_channel && a.start_id == b.start_id &&
         a.sequence == b.sequence && a.sim_time == b.sim_time && a.sent == b.sent && a.payload == b.payload;
}

}  // namespace phare::test
