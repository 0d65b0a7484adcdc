#include "cockpit_io/driver_source.h"

#include <algorithm>
#include <cmath>

#include "config/base/paths.h"
#include "config/cockpit.h"
#include "config/formats/filled_text.h"
#include "config/formats/toml_table.h"
#include "config/rig.h"

namespace phare {

namespace {

constexpr double kKmh = 1.0 / 3.6;

// Chosen so that the car settles on the line without swaying at 80 km/h.
constexpr double kLookAhead_s = 0.9;
constexpr double kLookAheadLeast_m = 6.0;
constexpr double kSpeedGain_1ps = 0.9;
constexpr double kSpeedIntegral_1ps2 = 0.15;
constexpr double kIntegralMost_m = 6.0;
constexpr double kLeastSpeed_mps = 1.0;  // of the profile: a car that stands has no progress to read a speed from

double squared(double value) {
  return value * value;
}

LightEvent read_event(TomlTable table) {
  LightEvent event;
  if (table.has("at_s_m")) event.at_s_m = table.number("at_s_m", 0.0, 1e6);
  if (table.has("at_t_s")) event.at_t_s = table.number("at_t_s", 0.0, 1e6);
  if (event.at_s_m.has_value() == event.at_t_s.has_value())
    table.fail("at_s_m", "an event needs at_s_m or at_t_s, and not both");
  if (table.has("light")) event.light = static_cast<LightSwitch>(table.choice("light", kLightSwitchNames));
  event.flash_s = table.number_or("flash_s", 0.0, 0.0, 60.0);
  if (table.has("fog")) event.fog_front = table.flag_or("fog", false);
  event.design_steps = static_cast<int>(table.integer_or("design_steps", 0, -100, 100));
  return event;
}

SlowStretch read_slow(TomlTable table) {
  SlowStretch slow;
  slow.from_s_m = table.number("from_s_m", 0.0, 1e6);
  slow.to_s_m = table.number("to_s_m", 0.0, 1e6);
  slow.speed_mps = table.number("speed_kmh", 1.0, 300.0) * kKmh;
  if (table.has("brake_mps2")) slow.brake_mps2 = table.number("brake_mps2", 0.1, 12.0);
  if (!(slow.to_s_m > slow.from_s_m)) table.fail("to_s_m", "lies before from_s_m");
  return slow;
}

Result<DriverScript> read_script(TomlTable root) {
  DriverScript script;
  script.file = root.file();
  script.lane_file = resolve_path(filled_text(root, "lane"), root.file());
  script.end_s_m = root.number_or("end_s_m", 1e9, 1.0, 1e9);
  script.end_t_s = root.number_or("end_t_s", 1e9, 0.1, 1e9);
  script.light =
      static_cast<LightSwitch>(root.choice_or("light", static_cast<std::size_t>(LightSwitch::kLow), kLightSwitchNames));

  TomlTable car = root.table("car");
  script.wheelbase_m = car.number("wheelbase_m", 0.5, 10.0);
  script.steering_ratio = car.number("steering_ratio", 1.0, 50.0);
  script.full_throttle_mps2 = car.number("full_throttle_mps2", 0.1, 20.0);
  script.power_wpkg = car.number("power_wpkg", 1.0, 1000.0);
  script.full_brake_mps2 = car.number("full_brake_mps2", 0.1, 20.0);

  TomlTable comfort = root.table("comfort");
  script.max_speed_mps = comfort.number("max_speed_kmh", 1.0, 300.0) * kKmh;
  script.lateral_mps2 = comfort.number("lateral_mps2", 0.1, 12.0);
  script.accelerate_mps2 = comfort.number("accelerate_mps2", 0.1, 12.0);
  script.brake_mps2 = comfort.number("brake_mps2", 0.1, 12.0);

  for (TomlTable& table : root.tables("slow")) script.slow.push_back(read_slow(table));
  for (TomlTable& table : root.tables("event")) script.events.push_back(read_event(table));
  if (const Status status = root.finish(); !status) return status.error();
  return script;
}

}  // namespace

Result<DriverScript> read_driver_script(const std::filesystem::path& file) {
  Result<TomlTable> root = TomlTable::read(file);
  if (!root) return root.error();
  return read_script(*root);
}

Result<DriverScript> parse_driver_script(std::string_view text, const std::string& name) {
  Result<TomlTable> root = TomlTable::parse(text, name);
  if (!root) return root.error();
  return read_script(*root);
}

std::vector<double> speed_profile(const std::vector<LanePoint>& lane, const DriverScript& script) {
  // What curves and slow stretches allow at each point.
  std::vector<double> speed(lane.size());
  for (std::size_t i = 0; i < lane.size(); ++i) {
    speed[i] = std::min(script.max_speed_mps,
                        std::sqrt(script.lateral_mps2 / std::max(std::abs(lane[i].curvature_1pm), 1e-9)));
    for (const SlowStretch& slow : script.slow) {
      if (!slow.brake_mps2 && lane[i].s_m >= slow.from_s_m && lane[i].s_m <= slow.to_s_m) {
        speed[i] = std::min(speed[i], slow.speed_mps);
      }
    }
    speed[i] = std::max(speed[i], kLeastSpeed_mps);
  }
  // Braking in comfort before them.
  for (std::size_t i = lane.size() - 1; i-- > 0;) {
    const double ds_m = lane[i + 1].s_m - lane[i].s_m;
    speed[i] = std::min(speed[i], std::sqrt(squared(speed[i + 1]) + 2.0 * script.brake_mps2 * ds_m));
  }
  // Hard braking from where the script says, and gaining speed no faster than is comfortable.
  std::vector<double> speed_at_begin(script.slow.size(), -1.0);
  for (std::size_t i = 1; i < lane.size(); ++i) {
    const double ds_m = lane[i].s_m - lane[i - 1].s_m;
    speed[i] = std::min(speed[i], std::sqrt(squared(speed[i - 1]) + 2.0 * script.accelerate_mps2 * ds_m));
    for (std::size_t k = 0; k < script.slow.size(); ++k) {
      const SlowStretch& slow = script.slow[k];
      if (!slow.brake_mps2 || lane[i].s_m < slow.from_s_m || lane[i].s_m > slow.to_s_m) continue;
      if (speed_at_begin[k] < 0.0) speed_at_begin[k] = speed[i];
      const double left = squared(speed_at_begin[k]) - 2.0 * *slow.brake_mps2 * (lane[i].s_m - slow.from_s_m);
      speed[i] = std::min(speed[i], std::max(slow.speed_mps, std::sqrt(std::max(left, 0.0))));
    }
  }
  return speed;
}

Result<std::unique_ptr<Source>> DriverSource::open(const std::filesystem::path& script_file) {
  Result<DriverScript> script = read_driver_script(script_file);
  if (!script) return script.error();
  Result<std::vector<LanePoint>> lane = read_lane(script->lane_file);
  if (!lane) return lane.error();
  return std::unique_ptr<Source>(std::make_unique<DriverSource>(std::move(*script), std::move(*lane)));
}

DriverSource::DriverSource(DriverScript script, std::vector<LanePoint> lane)
    : script_(std::move(script)),
      lane_(std::move(lane)),
      speed_mps_(speed_profile(lane_, script_)),
      done_(script_.events.size()) {
  input_.switches.stalk = script_.light;
}

LanePoint DriverSource::at(double s_m) const {
  const auto after =
      std::upper_bound(lane_.begin() + 1, lane_.end() - 1, s_m, [](double s, const LanePoint& p) { return s < p.s_m; });
  const LanePoint& a = *(after - 1);
  const LanePoint& b = *after;
  const double u = (s_m - a.s_m) / (b.s_m - a.s_m);  // beyond the ends: straight on
  LanePoint point = a;
  point.s_m = s_m;
  point.x_m += u * (b.x_m - a.x_m);
  point.y_m += u * (b.y_m - a.y_m);
  return point;
}

double DriverSource::profile_mps(double s_m) const {
  const auto after =
      std::upper_bound(lane_.begin() + 1, lane_.end() - 1, s_m, [](double s, const LanePoint& p) { return s < p.s_m; });
  const auto i = static_cast<std::size_t>(after - lane_.begin());
  const double u = std::clamp((s_m - lane_[i - 1].s_m) / (lane_[i].s_m - lane_[i - 1].s_m), 0.0, 1.0);
  return speed_mps_[i - 1] + u * (speed_mps_[i] - speed_mps_[i - 1]);
}

void DriverSource::locate(const VehicleState& vehicle) {
  const auto distance = [&](std::size_t i) {
    return squared(lane_[i].x_m - vehicle.x_m) + squared(lane_[i].y_m - vehicle.y_m);
  };
  if (!located_) {  // anywhere on the lane: the car may have been driving before this process began
    for (std::size_t i = 0; i < lane_.size(); ++i) {
      if (distance(i) < distance(nearest_)) nearest_ = i;
    }
    located_ = true;
  }
  while (nearest_ + 1 < lane_.size() && distance(nearest_ + 1) <= distance(nearest_)) ++nearest_;
  while (nearest_ > 0 && distance(nearest_ - 1) < distance(nearest_)) --nearest_;
  const LanePoint& point = lane_[nearest_];
  station_m_ = point.s_m + (vehicle.x_m - point.x_m) * std::cos(point.heading_rad) +
               (vehicle.y_m - point.y_m) * std::sin(point.heading_rad);
}

void DriverSource::steer(const VehicleState& vehicle) {
  const double ahead_m = std::max(kLookAheadLeast_m, kLookAhead_s * std::abs(vehicle.speed_mps));
  const LanePoint goal = at(station_m_ + ahead_m);
  // The goal in the car's frame, x forward, y left; the arc through it that leaves along x has curvature 2 y / d².
  const double dx = goal.x_m - vehicle.x_m, dy = goal.y_m - vehicle.y_m;
  const double left_m = -std::sin(vehicle.yaw_rad) * dx + std::cos(vehicle.yaw_rad) * dy;
  const double curvature_1pm = 2.0 * left_m / std::max(squared(dx) + squared(dy), 1.0);
  input_.steering_wheel_rad = std::atan(script_.wheelbase_m * curvature_1pm) * script_.steering_ratio;
}

void DriverSource::pedals(const VehicleState& vehicle, double dt_s) {
  const double speed = std::max(vehicle.speed_mps, 0.0);
  const double target = profile_mps(station_m_);
  const double ahead_m = std::max(0.5, 0.1 * speed);
  const double slope_mps2 = (squared(profile_mps(station_m_ + ahead_m)) - squared(target)) / (2.0 * ahead_m);
  const double error = target - speed;
  // The integral carries grade and resistance; it rests while the pedals are far from steady, or it would wind up.
  if (std::abs(error) < 1.5) {
    speed_error_integral_m_ = std::clamp(speed_error_integral_m_ + error * dt_s, -kIntegralMost_m, kIntegralMost_m);
  }
  double wish_mps2 = slope_mps2 + kSpeedGain_1ps * error + kSpeedIntegral_1ps2 * speed_error_integral_m_;
  wish_mps2 = std::min(wish_mps2, script_.accelerate_mps2);
  const double full_mps2 = std::min(script_.full_throttle_mps2, script_.power_wpkg / std::max(speed, 1.0));
  constexpr double kCoast_mps2 = 0.25;  // up to here the car slows down by itself: no foot on either pedal
  input_.accelerator_01 = std::clamp(wish_mps2 / full_mps2, 0.0, 1.0);
  input_.brake_01 = wish_mps2 < -kCoast_mps2 ? std::clamp(-wish_mps2 / script_.full_brake_mps2, 0.0, 1.0) : 0.0;
}

void DriverSource::lights(Moment now, ControlSink& cockpit) {
  SwitchInput& switches = input_.switches;
  if (now.sim.ns >= flash_until_ns_) switches.flash = false;
  for (std::size_t i = 0; i < done_.size(); ++i) {
    const LightEvent& event = script_.events[i];
    const bool due =
        event.at_s_m ? located_ && station_m_ >= *event.at_s_m : now.sim.seconds() >= event.at_t_s.value_or(0.0);
    if (done_[i] || !due) continue;
    done_[i] = true;
    if (event.light) switches.stalk = *event.light;
    if (event.fog_front) switches.fog_front = *event.fog_front;
    // A process that was restarted comes late to what is past: it sets the switches but does not flash again.
    constexpr double kPast_m = 5.0;
    const bool past = event.at_s_m ? station_m_ > *event.at_s_m + kPast_m : now.sim.seconds() > *event.at_t_s + 0.2;
    if (event.flash_s > 0.0 && !past) {
      switches.flash = true;
      flash_until_ns_ = now.sim.ns + static_cast<std::int64_t>(event.flash_s * 1e9);
    }
    for (int step = 0; step < std::abs(event.design_steps); ++step) {
      (event.design_steps > 0 ? switches.design_next : switches.design_previous) = true;
      cockpit.take(input_, false, now);
      switches.design_next = switches.design_previous = false;
      cockpit.take(input_, false, now);
    }
    cockpit.take(input_, false, now);
  }
}

void DriverSource::advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) {
  const double now_s = now.sim.seconds();
  if (vehicle != nullptr) {
    locate(*vehicle);
    steer(*vehicle);
    pedals(*vehicle, std::clamp(now_s - newest_s_.value_or(now_s), 0.0, 0.1));
    newest_s_ = now_s;
    ended_ = ended_ || station_m_ >= std::min(script_.end_s_m, lane_.back().s_m);
  }
  ended_ = ended_ || now_s >= script_.end_t_s;
  lights(now, cockpit);
  cockpit.take(input_, false, now);
}

}  // namespace phare
