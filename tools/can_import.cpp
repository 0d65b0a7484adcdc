#include "tools/can_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "cockpit_io/can_log.h"
#include "cockpit_io/dbc.h"
#include "config/base/conventions.h"
#include "tools/import_cockpit.h"
#include "tools/import_signals.h"
#include "tools/import_track.h"
#include "tools/local_fit.h"
#include "vehicle_dynamics/models/kinematic.h"
#include "vehicle_dynamics/state.h"

namespace phare {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr std::int64_t kPeriod_ns = 10'000'000;  // 100 Hz, both messages
constexpr double kSpeedWindow_s =
    0.4;  // wheel speeds jump by 0.3 m/s in 20 ms over a bump: no acceleration of the body
constexpr double kPoseWindow_s = 0.25;  // pose comes at 20 Hz: ten points
constexpr double kSteerWindow_s = 0.05;
constexpr double kCoasting_mps2 = 0.5;  // a car in gear slows that much by itself; more is braking

double held_at(const Samples& samples, double t_s, double before_first) {
  const auto after = std::upper_bound(samples.t_s.begin(), samples.t_s.end(), t_s);
  if (after == samples.t_s.begin()) return before_first;
  return samples.value[static_cast<std::size_t>(after - samples.t_s.begin()) - 1];
}

/// Heights under the wheels from the scene's road; where it has none, the plane through the lane's point.
void stand_on_road(const ImportOptions& options, double z_m, double grade, CarState& car, double dt) {
  const auto contacts = kinematic::contact_points(options.vehicle, car);
  std::array<double, 4> height{};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto road = options.road.at(contacts[i].x, contacts[i].y);
    height[i] = road ? road->z_m : z_m + (i < 2 ? grade * options.vehicle.wheelbase_m : 0.0);
  }
  kinematic::stand_on(options.vehicle, height, car, dt);
}

LightSwitch light_switch(ImportLight light, bool parking, bool low, bool high) {
  if (light == ImportLight::kLow) return LightSwitch::kLow;
  if (light == ImportLight::kHigh) return LightSwitch::kHigh;
  if (high) return LightSwitch::kHigh;
  if (low) return LightSwitch::kLow;
  return parking ? LightSwitch::kPosition : LightSwitch::kOff;
}

/// The messages that a cockpit file maps; none without one.
std::vector<CanId> ids_of(const std::optional<CockpitConfig>& cockpit, const Dbc& dbc) {
  std::vector<CanId> ids;
  if (!cockpit) return ids;
  for (const ControlMapping& control : cockpit->controls) {
    if (const DbcMessage* message = dbc.find(control.message)) ids.push_back({message->id, message->extended});
  }
  return ids;
}

/// All that the stalk did besides the light switch, which is put where `light` says.
void take_recorded_switches(const CockpitState& was, ImportLight light, CockpitState& to) {
  if (light == ImportLight::kAsRecorded) {
    const bool moved = was.flash != to.flash || was.fog_front != to.fog_front;
    to.flash = was.flash;
    to.fog_front = was.fog_front;
    to.fail_safe = was.fail_safe;
    if (moved && was.light_switch == to.light_switch) {
      ++to.light_changes;
      to.light_change_sim = was.light_change_sim;
      to.light_change_wall = was.light_change_wall;
    }
  }
  to.fog_rear = was.fog_rear;
  to.turn = was.turn;
  to.hazard = was.hazard;
  to.high_beam_automatic = was.high_beam_automatic;
  to.gear = was.gear;
  to.clutch_01 = was.clutch_01;
  to.parking_brake_01 = was.parking_brake_01;
  to.lamp_aim_rad = was.lamp_aim_rad;
}

}  // namespace

Result<ImportedDrive> import_can_drive(const ImportOptions& options) {
  auto read_log = read_can_log(options.can_log);
  if (!read_log) return read_log.error();
  const bool asked = !options.interface.empty();
  const auto chosen = choose_interface(
      read_log->log, asked ? options.interface : options.cockpit ? options.cockpit->interface : "", asked);
  if (!chosen) return chosen.error();
  const CandumpLog* const log = &read_log->log;
  auto dbc = read_dbc(options.dbc);
  if (!dbc) return dbc.error();
  std::optional<ImportPose> pose;
  if (!options.pose.empty()) {
    auto read = read_import_pose(options.pose);
    if (!read) return read.error();
    pose = std::move(*read);
  }
  std::optional<RecordedControls> recorded;
  if (options.cockpit) {
    auto read = recorded_controls(*options.cockpit, *dbc, *log);
    if (!read) return read.error();
    recorded = std::move(*read);
  }
  std::optional<ImportLane> lane;
  if (options.lane) {
    auto read = import_lane(*options.lane);
    if (!read) return read.error();
    lane = std::move(*read);
  }

  // Which signals: steering and speed must be there, the others may.
  enum { kSteering, kSpeed, kAccelerator, kBrake, kParking, kLow, kHigh, kControls };
  struct Wanted {
    const char* what;
    const std::string& path;
    ControlUnits units;
    std::string unit{};
    bool must = false;  ///< else the drive goes without
  };
  const std::array<Wanted, kControls> wanted{
      {{"steering", options.signals.steering, ControlUnits::kAngle, options.signals.steering_unit, true},
       {"speed", options.signals.speed, ControlUnits::kSpeed, options.signals.speed_unit, true},
       {"accelerator", options.signals.accelerator, ControlUnits::kShare, {}, options.signals.accelerator_must},
       {"brake", options.signals.brake, ControlUnits::kShare, {}, options.signals.brake_must},
       {"parking light", options.signals.parking_light, ControlUnits::kNone},
       {"low beam", options.signals.low_beam, ControlUnits::kNone},
       {"high beam", options.signals.high_beam, ControlUnits::kNone}}};
  ImportedDrive drive;
  std::vector<ImportControl> controls;
  if (!chosen->empty()) drive.notes.push_back(*chosen);
  for (const std::string& doubt : doubts(*log)) drive.notes.push_back(doubt);
  if (!read_log->read_with.empty()) drive.notes.push_back("log: read with " + read_log->read_with);
  for (const auto& [what, path, units, unit, must] : wanted) {
    if (recorded && controls.size() != kSpeed) {  // the cockpit file names it
      controls.push_back({what, {}, nullptr, 1.0, {}});
      continue;
    }
    auto control = find_control(*dbc, what, path, units, unit);
    if (!control && must) return control.error();
    if (!control) drive.notes.push_back(std::string(what) + ": " + control.error().text());
    controls.push_back(control ? std::move(*control) : ImportControl{what, {}, nullptr, 1.0, {}});
  }

  // Decode every frame within the time that log and pose share.
  ImportCounts& counts = drive.counts;
  if (const Status one = one_recording(*log); !one) return one.error();
  const double log_begin_s = static_cast<double>(log->entries.front().stamp_ns) * 1e-9;
  const double log_end_s = static_cast<double>(log->entries.back().stamp_ns) * 1e-9;
  const double begin_s = pose ? std::max(log_begin_s, pose->t_s.front()) : log_begin_s;
  const double end_s = pose ? std::min(log_end_s, pose->t_s.back()) : log_end_s;
  if (!(end_s > begin_s) && !pose) return Error{options.can_log.string(), "all its frames have one stamp"};
  if (!(end_s > begin_s)) return Error{options.pose.string(), "shares no time with " + options.can_log.string()};
  counts.broken_lines = log->broken_lines;
  if (log->broken_lines > 0)
    drive.notes.push_back(options.can_log.string() + ":" + std::to_string(log->problems.front().line) + ": " +
                          log->problems.front().reason + "; " + std::to_string(log->broken_lines) +
                          (log->broken_lines == 1 ? " broken line is" : " broken lines are") + " left out");
  counts.backward_stamps = log->backward_stamps;
  counts.pose_rows = pose ? pose->t_s.size() : 0;
  const std::vector<CanId> by_cockpit = ids_of(options.cockpit, *dbc);
  for (const CandumpEntry& entry : log->entries) {
    ++counts.frames;
    const double t_s = static_cast<double>(entry.stamp_ns) * 1e-9;
    if (t_s < begin_s || t_s > end_s) {
      ++counts.outside;
      continue;
    }
    const CanId id{entry.frame.id, entry.frame.extended};
    bool ours =
        std::ranges::any_of(by_cockpit, [&](const CanId& of) { return of.id == id.id && of.extended == id.extended; });
    bool decoded = ours, repeated = false;
    for (ImportControl& control : controls) {
      if (control.message == nullptr || control.message->id != entry.frame.id ||
          control.message->extended != entry.frame.extended) {
        continue;
      }
      ours = true;
      Samples& samples = control.samples;
      if (!samples.t_s.empty() && t_s <= samples.t_s.back()) {
        repeated = true;  // stamped backwards, or twice: order is the log's, not time's
        continue;
      }
      if (const auto value = decode_control(control, entry.frame)) {
        decoded = true;
        samples.t_s.push_back(t_s);
        samples.value.push_back(*value);
      }
    }
    ++(decoded ? counts.used : repeated ? counts.repeated : ours ? counts.undecodable : counts.other_ids);
  }
  if (recorded) {
    controls[kSteering].samples = {recorded->steering_t_s, recorded->steering_rad};
    counts.refused = recorded->refused;
    drive.notes.push_back("controls: by " + options.cockpit->file.filename().string() + ", " +
                          std::to_string(recorded->states.size()) + " frames, " + std::to_string(recorded->refused) +
                          " of them refused by their checks");
  }
  const auto sample_count = [&](std::size_t i) { return static_cast<std::uint64_t>(controls[i].samples.t_s.size()); };
  counts.steering_samples = sample_count(kSteering);
  counts.speed_samples = sample_count(kSpeed);
  counts.accelerator_samples = sample_count(kAccelerator);
  counts.brake_samples = sample_count(kBrake);
  counts.light_samples = sample_count(kLow);
  for (const std::size_t i : {std::size_t{kSteering}, std::size_t{kSpeed}}) {
    if (sample_count(i) < 4) {
      const std::string of = controls[i].message != nullptr ? " of " + controls[i].message->name : std::string();
      return Error{options.can_log.string(), "fewer than four frames" + of + " for the " + controls[i].what};
    }
  }
  for (const std::size_t i : {std::size_t{kSteering}, std::size_t{kSpeed}})
    if (const std::string gap = widest_gap(controls[i].what, controls[i].samples.t_s, begin_s); !gap.empty())
      drive.notes.push_back(gap);
  if (pose)
    if (const std::string gap = widest_gap("pose", pose->t_s, begin_s); !gap.empty()) drive.notes.push_back(gap);
  const bool has_accelerator = recorded ? recorded->has_accelerator : counts.accelerator_samples > 0;
  const bool has_brake = recorded ? recorded->has_brake : counts.brake_samples > 0;
  if (!has_accelerator) drive.notes.push_back("accelerator: not in the log, 0");
  if (!has_brake) {
    drive.notes.push_back("brake: not in the log; taken from the deceleration while the accelerator is released");
  }
  if (options.light != ImportLight::kAsRecorded) {
    const bool dark = !recorded && std::none_of(controls[kLow].samples.value.begin(),
                                                controls[kLow].samples.value.end(), [](double on) { return on > 0.5; });
    drive.notes.push_back(std::string("light switch: ") + (options.light == ImportLight::kLow ? "low" : "high") +
                          " throughout, " +
                          (dark ? "because the recorded stalk is off" : "instead of the recorded one"));
  }
  if (lane) {
    drive.notes.push_back("path: put onto " + options.lane->filename().string() +
                          " by path length; speed and acceleration are the recorded ones, the turns are the lane's");
  }

  if (!lane && !pose) {
    drive.notes.push_back("path: driven by CAN speed and steering at level kinematic, with a steering ratio of " +
                          std::to_string(options.vehicle.steering_ratio).substr(0, 5) +
                          "; it drifts from where the car was");
  }

  // Every 10 ms: controls, motion, attitude.
  const auto frames = static_cast<std::int64_t>(std::floor((end_s - begin_s) * 1e9 / static_cast<double>(kPeriod_ns)));
  const auto begin_ns = static_cast<std::int64_t>(std::llround(begin_s * 1e9));
  const double dt = static_cast<double>(kPeriod_ns) * 1e-9;
  double path_m = lane ? options.lane_start_m : 0.0, speed_before = 0.0;
  CockpitState cockpit;
  cockpit.source = ("import " + options.can_log.filename().string()).substr(0, 64);  // longest text on the wire
  CarState car;
  std::optional<DrivenCar> driven;
  const auto speed_at = [&](double t_s) {
    return local_fit(controls[kSpeed].samples.t_s, controls[kSpeed].samples.value, t_s, kSpeedWindow_s);
  };
  const auto steering_at = [&](double t_s) {
    return local_fit(controls[kSteering].samples.t_s, controls[kSteering].samples.value, t_s, kSteerWindow_s);
  };
  for (std::int64_t k = 0; k <= frames; ++k) {
    const SimTime sim_time{k * kPeriod_ns};
    const double t_s = begin_s + sim_time.seconds();
    const bool last = k == frames;
    const FittedValue speed = speed_at(t_s), steering = steering_at(t_s);
    const CockpitState* was = recorded ? &recorded->at(t_s) : nullptr;
    const double accelerator =
        was != nullptr ? was->accelerator_01 : std::clamp(held_at(controls[kAccelerator].samples, t_s, 0.0), 0.0, 1.0);

    const LightSwitch light = was != nullptr && options.light == ImportLight::kAsRecorded
                                  ? was->light_switch
                                  : light_switch(options.light, held_at(controls[kParking].samples, t_s, 0.0) > 0.5,
                                                 held_at(controls[kLow].samples, t_s, 0.0) > 0.5,
                                                 held_at(controls[kHigh].samples, t_s, 0.0) > 0.5);
    if (was != nullptr) take_recorded_switches(*was, options.light, cockpit);
    if (light != cockpit.light_switch) {
      cockpit.light_switch = light;
      ++cockpit.light_changes;
      cockpit.light_change_sim = sim_time;
      cockpit.light_change_wall = WallTime{begin_ns + sim_time.ns};
    }
    cockpit.steering_wheel_rad = steering.value;
    cockpit.accelerator_01 = accelerator;
    const double braking_mps2 = accelerator < 0.01 ? std::max(0.0, -speed.slope - kCoasting_mps2) : 0.0;
    cockpit.brake_01 =
        has_brake ? (was != nullptr ? was->brake_01 : std::clamp(held_at(controls[kBrake].samples, t_s, 0.0), 0.0, 1.0))
                  : std::clamp(braking_mps2 * options.vehicle.mass_kg / options.vehicle.max_brake_force_n, 0.0, 1.0);
    cockpit.drive_ended = last;

    car.speed_mps = speed.value;
    car.ax_mps2 = speed.slope;
    if (k > 0) path_m += 0.5 * (speed_before + speed.value) * dt;
    speed_before = speed.value;
    if (lane) {
      if (path_m + options.vehicle.wheelbase_m > lane->s_m.back()) {
        return Error{options.lane->string(), "the lane ends after " + std::to_string(lane->s_m.back()) +
                                                 " m, the drive goes on; choose a smaller --start"};
      }
      const ImportLane::Point at = lane->at(path_m);
      car.x_m = at.x_m;
      car.y_m = at.y_m;
      car.yaw_rad = at.heading_rad;
      car.yaw_rate_radps = at.curvature_1pm * speed.value;
      car.steer_rad = std::atan(options.vehicle.wheelbase_m * at.curvature_1pm);
      stand_on_road(options, at.z_m, at.grade, car, k == 0 ? 0.0 : dt);
    } else if (!pose) {
      if (!driven) {
        CarState start = options.start;
        start.speed_mps = speed.value;
        start.steer_rad = steering.value / options.vehicle.steering_ratio;
        driven.emplace(options.vehicle, options.road, start);
      } else {
        driven->advance(steering.value, speed.value, dt);
      }
      const CarState before = car;
      car = driven->state();
      car.ax_mps2 = speed.slope;
      car.pitch_rad = before.pitch_rad, car.roll_rad = before.roll_rad, car.heave_m = before.heave_m;
    } else {
      const FittedValue yaw = local_fit(pose->t_s, pose->yaw_rad, t_s, kPoseWindow_s);
      const FittedValue pitch = local_fit(pose->t_s, pose->pitch_rad, t_s, kPoseWindow_s);
      car.x_m = local_fit(pose->t_s, pose->east_m, t_s, kPoseWindow_s).value;
      car.y_m = local_fit(pose->t_s, pose->north_m, t_s, kPoseWindow_s).value;
      car.z_m = local_fit(pose->t_s, pose->up_m, t_s, kPoseWindow_s).value;
      car.yaw_rad = yaw.value;
      car.yaw_rate_radps = yaw.slope;
      car.road_pitch_rad = pitch.value;
      car.road_pitch_rate_radps = pitch.slope;
      car.steer_rad = steering.value / options.vehicle.steering_ratio;
    }
    car.ay_mps2 = car.yaw_rate_radps * speed.value;
    const kinematic::Attitude attitude = kinematic::quasi_static_attitude(
        options.vehicle, car.ax_mps2 - kGravity_mps2 * std::sin(car.road_pitch_rad),
        car.ay_mps2 + kGravity_mps2 * std::cos(car.road_pitch_rad) * std::sin(car.road_roll_rad));
    car.pitch_rate_radps = k == 0 ? 0.0 : (attitude.pitch_rad - car.pitch_rad) / dt;
    car.roll_rate_radps = k == 0 ? 0.0 : (attitude.roll_rad - car.roll_rad) / dt;
    car.heave_rate_mps = k == 0 ? 0.0 : (attitude.heave_m - car.heave_m) / dt;
    car.pitch_rad = attitude.pitch_rad;
    car.roll_rad = attitude.roll_rad;
    car.heave_m = attitude.heave_m;

    VehicleState vehicle = to_message(car, options.vehicle.rest);
    vehicle.level = "import";
    vehicle.step = static_cast<std::uint64_t>(k);
    vehicle.state_hash = state_hash(car);
    vehicle.high_beam_telltale = light == LightSwitch::kHigh;
    vehicle.drive_ended = last;
    Datagram datagram;
    datagram.start_id = 1;  // fixed, so the same input gives the same file
    datagram.sequence = static_cast<std::uint64_t>(k) + 1;
    datagram.sim_time = sim_time;
    datagram.sent = WallTime{begin_ns + sim_time.ns};
    datagram.sender = Sender::kCockpit;
    datagram.payload = cockpit;
    drive.datagrams.push_back(datagram);
    datagram.sender = Sender::kDynamics;
    datagram.payload = vehicle;
    drive.datagrams.push_back(std::move(datagram));
    ++counts.cockpit_messages;
    ++counts.vehicle_messages;
  }
  drive.duration_s = static_cast<double>(frames * kPeriod_ns) * 1e-9;
  drive.distance_m = path_m - (lane ? options.lane_start_m : 0.0);
  if (!pose) return drive;
  const auto time_of = [&](std::int64_t k) { return begin_s + static_cast<double>(k * kPeriod_ns) * 1e-9; };
  drive.drift = drift_of(
      options.vehicle, frames, dt, [&](std::int64_t k) { return steering_at(time_of(k)).value; },
      [&](std::int64_t k) { return speed_at(time_of(k)).value; },
      [&](std::int64_t k) {
        const double t_s = time_of(k);
        return PlanePose{local_fit(pose->t_s, pose->east_m, t_s, kPoseWindow_s).value,
                         local_fit(pose->t_s, pose->north_m, t_s, kPoseWindow_s).value,
                         local_fit(pose->t_s, pose->yaw_rad, t_s, kPoseWindow_s).value};
      });
  drive.notes.push_back("steering: " + drive.drift->text());
  for (std::size_t i = 1; i < pose->t_s.size(); ++i) {
    if (pose->t_s[i - 1] < begin_s || pose->t_s[i] > end_s) continue;
    drive.pose_path_m += std::hypot(pose->east_m[i] - pose->east_m[i - 1], pose->north_m[i] - pose->north_m[i - 1],
                                    pose->up_m[i] - pose->up_m[i - 1]);
  }
  if (drive.pose_path_m > 0.0) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "speed: the CAN signal adds up to %.1f m, the recorded positions to %.1f m (%+.1f %%); kept as it is",
                  drive.distance_m, drive.pose_path_m, 100.0 * (drive.distance_m / drive.pose_path_m - 1.0));
    drive.notes.push_back(text);
  }
  return drive;
}

nlohmann::json to_json(const ImportedDrive& drive) {
  const ImportCounts& c = drive.counts;
  nlohmann::json drift;
  if (drive.drift)
    drift = {{"distance_m", drive.drift->distance_m},
             {"heading_deg", drive.drift->heading_rad / kRadPerDeg},
             {"path_m", drive.drift->path_m}};
  return {{"duration_s", drive.duration_s},
          {"drift", drift},
          {"distance_m", drive.distance_m},
          {"pose_path_m", drive.pose_path_m},
          {"frames",
           {{"read", c.frames},
            {"used", c.used},
            {"other_ids", c.other_ids},
            {"undecodable", c.undecodable},
            {"outside", c.outside},
            {"refused", c.refused},
            {"broken_lines", c.broken_lines},
            {"backward_stamps", c.backward_stamps}}},
          {"samples",
           {{"steering", c.steering_samples},
            {"speed", c.speed_samples},
            {"accelerator", c.accelerator_samples},
            {"brake", c.brake_samples},
            {"light", c.light_samples},
            {"pose", c.pose_rows}}},
          {"messages", {{"cockpit_state", c.cockpit_messages}, {"vehicle_state", c.vehicle_messages}}},
          {"notes", drive.notes}};
}

}  // namespace phare
