#include "config/vehicle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>

#include "config/base/conventions.h"
#include "config/formats/toml_table.h"

namespace phare {
namespace {
constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kRadpsPerRpm = std::numbers::pi / 30.0;

TyreParams read_tyre(TomlTable tyre) {
  TyreParams p;
  p.long_shape = tyre.number("long_shape", 1.0, 2.0);
  p.long_peak = tyre.number("long_peak", 0.05, 3.0);
  p.long_curvature = tyre.number("long_curvature", -10.0, 1.0);
  p.long_stiffness = tyre.number("long_stiffness", 1.0, 100.0);
  p.lat_shape = tyre.number("lat_shape", 1.0, 2.0);
  p.lat_peak = tyre.number("lat_peak", 0.05, 3.0);
  p.lat_curvature = tyre.number("lat_curvature", -10.0, 1.0);
  p.lat_stiffness = tyre.number("lat_stiffness", 1.0, 100.0);
  p.long_weight = tyre.number("long_weight", 0.0, 100.0);
  p.long_weight_fall = tyre.number("long_weight_fall", -100.0, 100.0);
  p.long_weight_shape = tyre.number("long_weight_shape", 0.1, 2.0);
  p.long_weight_curvature = tyre.number("long_weight_curvature", -10.0, 1.0);
  p.lat_weight = tyre.number("lat_weight", 0.0, 100.0);
  p.lat_weight_fall = tyre.number("lat_weight_fall", -100.0, 100.0);
  p.lat_weight_shape = tyre.number("lat_weight_shape", 0.1, 2.0);
  p.lat_weight_curvature = tyre.number("lat_weight_curvature", -10.0, 1.0);
  p.long_relaxation_m = tyre.number("long_relaxation_m", 0.005, 2.0);
  p.lat_relaxation_m = tyre.number("lat_relaxation_m", 0.005, 2.0);
  p.carcass_damping_nspm = tyre.number("carcass_damping_nspm", 0.0, 1e5);
  return p;
}

ChassisParams read_chassis(TomlTable body, TomlTable suspension, TomlTable drive, TomlTable steering, TomlTable tyre) {
  ChassisParams p;
  p.roll_inertia_kgm2 = body.number("roll_inertia_kgm2", 10.0, 1e5);
  p.pitch_inertia_kgm2 = body.number("pitch_inertia_kgm2", 10.0, 1e6);
  p.yaw_inertia_kgm2 = body.number("yaw_inertia_kgm2", 10.0, 1e6);
  p.front_axle_kg = body.number("front_axle_kg", 5.0, 5000.0);
  p.rear_axle_kg = body.number("rear_axle_kg", 5.0, 5000.0);
  p.front_track_m = body.number("front_track_m", 0.5, 3.0);
  p.rear_track_m = body.number("rear_track_m", 0.5, 3.0);
  p.front_damping_nspm = suspension.number("front_damping_nspm", 0.0, 1e6);
  p.rear_damping_nspm = suspension.number("rear_damping_nspm", 0.0, 1e6);
  p.front_anti_roll_nmprad = suspension.number("front_anti_roll_nmprad", 0.0, 1e7);
  p.rear_anti_roll_nmprad = suspension.number("rear_anti_roll_nmprad", 0.0, 1e7);
  p.tyre_damping_nspm = suspension.number_or("tyre_damping_nspm", 0.0, 0.0, 1e5);
  p.anti_squat_01 = suspension.number_or("anti_squat_01", 0.0, 0.0, 1.0);
  p.bump_travel_m = suspension.number("bump_travel_m", 0.01, 1.0);
  p.rebound_travel_m = suspension.number("rebound_travel_m", 0.01, 1.0);
  p.stop_rate_npm = suspension.number("stop_rate_npm", 0.0, 1e7);
  p.brake_front_01 = drive.number("brake_front_01", 0.0, 1.0);
  p.drive_front_01 = drive.number("drive_front_01", 0.0, 1.0);
  p.ackermann_01 = steering.number("ackermann_01", 0.0, 1.0);
  p.tyre = read_tyre(tyre);
  return p;
}

EngineParams read_engine(TomlTable engine) {
  EngineParams p;
  p.speed_radps = engine.numbers("speed_rpm", 0);
  p.torque_nm = engine.numbers("torque_nm", 0);
  for (double& speed : p.speed_radps) speed *= kRadpsPerRpm;
  p.idle_radps = engine.number("idle_rpm", 100.0, 3000.0) * kRadpsPerRpm;
  p.drag_nm = engine.number("drag_nm", 0.0, 1000.0);
  p.gear_ratio = engine.numbers("gear_ratio", 0);
  p.reverse_ratio = engine.number("reverse_ratio", 0.5, 50.0);
  p.final_ratio = engine.number("final_ratio", 0.5, 50.0);
  p.efficiency_01 = engine.number("efficiency_01", 0.1, 1.0);
  p.converter_ratio = engine.number("converter_ratio", 1.0, 5.0);
  p.shift_up_low_radps = engine.number("shift_up_low_rpm", 500.0, 15000.0) * kRadpsPerRpm;
  p.shift_up_full_radps = engine.number("shift_up_full_rpm", 500.0, 15000.0) * kRadpsPerRpm;
  p.shift_down_radps = engine.number("shift_down_rpm", 300.0, 15000.0) * kRadpsPerRpm;
  if (p.speed_radps.size() < 2 || p.speed_radps.size() != p.torque_nm.size())
    engine.fail("torque_nm", "needs as many values as speed_rpm, two at least");
  for (std::size_t i = 0; i < p.speed_radps.size(); ++i) {
    if (!(p.speed_radps[i] >= 0.0 && p.speed_radps[i] < 2500.0) ||
        (i > 0 && !(p.speed_radps[i] > p.speed_radps[i - 1])))
      engine.fail("speed_rpm", "does not rise from 0 towards 20000 at most");
    if (i < p.torque_nm.size() && !(p.torque_nm[i] >= 0.0 && p.torque_nm[i] <= 5000.0))
      engine.fail("torque_nm", "is outside 0 to 5000");
  }
  if (p.gear_ratio.empty()) engine.fail("gear_ratio", "names no gear");
  double last = 50.0, closest = 1.0;
  for (const double ratio : p.gear_ratio) {
    if (!(ratio > 0.1 && ratio < last)) engine.fail("gear_ratio", "does not fall from gear to gear within 50 to 0.1");
    if (last < 50.0) closest = std::min(closest, ratio / last);
    last = ratio;
  }
  // A gearbox that shifts up must not at once want to shift down again.
  if (p.shift_down_radps >= closest * p.shift_up_low_radps || p.shift_up_full_radps < p.shift_up_low_radps)
    engine.fail("shift_down_rpm", "lies above the speed that a shift up leads to: the gearbox would hunt");
  return p;
}

LevellingParams read_levelling(TomlTable levelling) {
  constexpr std::array<std::string_view, 3> kSystems{"wheel", "static", "dynamic"};
  LevellingParams p;
  p.system = static_cast<LevellingSystem>(levelling.choice_or("system", 0, kSystems));
  p.lamp_x_m = levelling.number("lamp_x_m", -5.0, 10.0);
  p.lamp_height_m = levelling.number("lamp_height_m", 0.3, 2.0);
  p.aim_rad = levelling.number("aim_percent", -10.0, 10.0) * 0.01;
  p.manual_step_rad = levelling.number("manual_step_percent", 0.0, 5.0) * 0.01;
  p.range_rad = levelling.number("range_deg", 0.0, 10.0) * kRadPerDeg;
  p.rate_radps = levelling.number("rate_degps", 0.01, 1000.0) * kRadPerDeg;
  p.filter_s = levelling.number("filter_s", 0.0, 60.0);
  return p;
}

// Places are needed with a mass only.
std::vector<LoadParams> read_load(TomlTable load) {
  std::vector<LoadParams> loads;
  const double height_m = load.number_or("height_m", 0.7, 0.1, 3.0);
  for (const auto& [mass, place] : {std::pair{"front_passenger_kg", "front_seat_x_m"},
                                    {"rear_passengers_kg", "rear_seats_x_m"},
                                    {"boot_kg", "boot_x_m"}}) {
    const double kg = load.number_or(mass, 0.0, 0.0, 5000.0);
    if (kg > 0.0)
      loads.push_back({kg, load.number(place, -3.0, 10.0), height_m});
    else
      load.number_or(place, 0.0, -3.0, 10.0);
  }
  return loads;
}

// What follows from several keys together, and lies elsewhere for no vehicle on the road: a wrong unit or a slip of the
// decimal point in any of them shows here.
void check_together(const VehicleParams& p, TomlTable& root, TomlTable& suspension) {
  const auto within = [](TomlTable& table, std::string_view key, double value, double low, double high,
                         const char* what, const char* unit) {
    if (value >= low && value <= high) return;
    char text[200];
    std::snprintf(text, sizeof text, "does not fit the others: %s would be %.3g%s, of vehicles it is %g to %g", what,
                  value, unit, low, high);
    table.fail(key, text);
  };
  const double front_01 = (p.wheelbase_m - p.cg_to_front_m) / p.wheelbase_m;
  within(root, "cg_to_front_m", 100.0 * front_01, 15.0, 85.0, "the front axle's share of the weight", " %");
  if (!p.chassis) return;
  const ChassisParams& c = *p.chassis;
  TomlTable body = root.table("body");
  double roll_nmprad = 0.0;
  for (const bool front : {true, false}) {
    const double rate = front ? p.front_rate_npm : p.rear_rate_npm, track = front ? c.front_track_m : c.rear_track_m;
    const double damping = front ? c.front_damping_nspm : c.rear_damping_nspm;
    const double corner_kg = 0.5 * p.sprung_mass_kg * (front ? front_01 : 1.0 - front_01);
    const double wheel_kg = 0.5 * (front ? c.front_axle_kg : c.rear_axle_kg);
    const auto hertz = [](double stiffness, double kg) { return std::sqrt(stiffness / kg) / (2.0 * std::numbers::pi); };
    within(suspension, front ? "front_rate_npm" : "rear_rate_npm", hertz(rate, corner_kg), 0.5, 8.0,
           "the body's frequency on it", " Hz");
    within(suspension, front ? "front_damping_nspm" : "rear_damping_nspm",
           damping / (2.0 * std::sqrt(rate * corner_kg)), 0.02, 3.0, "the body's damping ratio", "");
    within(suspension, "tyre_rate_npm", hertz(rate + p.tyre_rate_npm, wheel_kg), 4.0, 40.0, "the wheels' hop", " Hz");
    within(root, "wheel_inertia_kgm2", p.wheel_inertia_kgm2 / (wheel_kg * p.tyre_radius_m * p.tyre_radius_m), 0.05, 1.0,
           "its share of axle mass times radius squared", "");
    const double springs = 0.5 * rate * track * track + (front ? c.front_anti_roll_nmprad : c.rear_anti_roll_nmprad);
    const double tyres = 0.5 * p.tyre_rate_npm * track * track;
    roll_nmprad += springs * tyres / (springs + tyres);
  }
  within(root, "track_m", p.track_m / (0.5 * (c.front_track_m + c.rear_track_m)), 0.95, 1.05,
         "its share of the axles' mean track", "");
  within(suspension, "roll_stiffness_nmprad", p.roll_stiffness_nmprad / roll_nmprad, 0.7, 1.4,
         "its share of what springs, bars and tyres give", "");
  within(body, "roll_inertia_kgm2", std::sqrt(c.roll_inertia_kgm2 / p.sprung_mass_kg) / p.track_m, 0.15, 0.8,
         "the radius of gyration over track_m", "");
  within(body, "pitch_inertia_kgm2", std::sqrt(c.pitch_inertia_kgm2 / p.sprung_mass_kg) / p.wheelbase_m, 0.25, 0.8,
         "the radius of gyration over wheelbase_m", "");
  within(body, "yaw_inertia_kgm2", std::sqrt(c.yaw_inertia_kgm2 / p.mass_kg) / p.wheelbase_m, 0.25, 0.8,
         "the radius of gyration over wheelbase_m", "");
}

Result<VehicleParams> vehicle_of(TomlTable root) {
  // Ranges: from a quadricycle to a heavy truck; they catch a wrong unit, not a strange car.
  VehicleParams p;
  p.name = root.text("name");
  p.mass_kg = root.number("mass_kg", 200.0, 40000.0);
  p.sprung_mass_kg = root.number("sprung_mass_kg", 100.0, 40000.0);
  p.wheelbase_m = root.number("wheelbase_m", 1.0, 10.0);
  p.cg_to_front_m = root.number("cg_to_front_m", 0.1, 10.0);
  p.cg_height_m = root.number("cg_height_m", 0.1, 3.0);
  p.track_m = root.number("track_m", 0.5, 3.0);
  p.tyre_radius_m = root.number("tyre_radius_m", 0.15, 0.8);
  p.wheel_inertia_kgm2 = root.number("wheel_inertia_kgm2", 0.0, 50.0);

  TomlTable suspension = root.table("suspension");
  p.front_rate_npm = suspension.number("front_rate_npm", 1e3, 1e7);
  p.rear_rate_npm = suspension.number("rear_rate_npm", 1e3, 1e7);
  p.tyre_rate_npm = suspension.number("tyre_rate_npm", 1e4, 1e8);
  p.anti_dive_01 = suspension.number_or("anti_dive_01", 0.0, 0.0, 1.0);
  p.roll_stiffness_nmprad = suspension.number("roll_stiffness_nmprad", 1e3, 1e8);
  p.ride_frequency_hz = suspension.number("ride_frequency_hz", 0.3, 5.0);
  p.ride_damping = suspension.number("ride_damping", 0.05, 2.0);

  TomlTable steering = root.table("steering");
  p.steering_ratio = steering.number("ratio", 1.0, 40.0);
  p.max_steering_wheel_rad = steering.number("max_wheel_deg", 10.0, 2000.0) * kRadPerDeg;
  p.max_lateral_mps2 = steering.number("max_lateral_mps2", 0.5, 30.0);

  TomlTable drive = root.table("drive");
  p.max_drive_force_n = drive.number("max_force_n", 100.0, 1e5);
  p.max_power_w = drive.number("max_power_kw", 1.0, 2000.0) * 1e3;
  p.max_brake_force_n = drive.number("max_brake_n", 100.0, 1e6);
  p.creep_force_n = drive.number_or("creep_n", 0.0, 0.0, 1e4);
  p.creep_speed_mps = drive.number_or("creep_kmh", 6.0, 0.5, 20.0) / 3.6;
  p.hill_hold_s = drive.number_or("hill_hold_s", 0.0, 0.0, 600.0);
  p.drag_area_m2 = drive.number("drag_area_m2", 0.0, 20.0);
  p.rolling_coefficient = drive.number("rolling_coefficient", 0.0, 0.1);

  const bool has_body = root.has("body"), has_tyre = root.has("tyre");
  if (has_body || has_tyre)
    p.chassis = read_chassis(root.table("body"), suspension, drive, steering, root.table("tyre"));
  if (auto engine = root.table_if("engine")) p.engine = read_engine(*engine);
  if (auto levelling = root.table_if("levelling")) p.levelling = read_levelling(*levelling);

  if (p.chassis) {
    const double axles_kg = p.chassis->front_axle_kg + p.chassis->rear_axle_kg;
    if (std::abs(p.sprung_mass_kg + axles_kg - p.mass_kg) > 0.01 * p.mass_kg)
      root.fail("mass_kg", "is not sprung_mass_kg and both axles together");
  }
  if (p.sprung_mass_kg > p.mass_kg) root.fail("sprung_mass_kg", "is more than mass_kg");
  if (p.cg_to_front_m >= p.wheelbase_m) root.fail("cg_to_front_m", "lies behind the rear axle");
  if (p.roll_stiffness_nmprad <= 1.1 * p.sprung_mass_kg * kGravity_mps2 * p.cg_height_m)
    suspension.fail("roll_stiffness_nmprad", "does not hold the body upright against its weight at cg_height_m");
  check_together(p, root, suspension);
  if (p.steering_ratio > 0.0 && p.max_steering_wheel_rad / p.steering_ratio > 70.0 * kRadPerDeg)
    steering.fail("max_wheel_deg", "turns the road wheels by more than 70 degrees");
  std::vector<LoadParams> loads;
  std::string load_place;
  if (auto load = root.table_if("load")) load_place = load->place(), loads = read_load(*load);
  if (Status done = root.finish(); !done) return done.error();
  Result<VehicleParams> with = loaded(p, loads);
  if (!with) return Error{load_place, with.error().reason};
  return with;
}

}  // namespace

Result<VehicleParams> loaded(const VehicleParams& vehicle, const std::vector<LoadParams>& loads) {
  double kg = 0.0, moment = 0.0, height_moment = 0.0;
  for (const LoadParams& load : loads)
    kg += load.kg, moment += load.kg * load.x_m, height_moment += load.kg * load.height_m;
  if (kg == 0.0) return vehicle;
  VehicleParams p = vehicle;
  const double before_kg = p.sprung_mass_kg, x = p.wheelbase_m - p.cg_to_front_m, height = p.cg_height_m;
  p.mass_kg += kg, p.sprung_mass_kg += kg;
  const double new_x = (before_kg * x + moment) / p.sprung_mass_kg;
  const double new_height = (before_kg * height + height_moment) / p.sprung_mass_kg;
  p.cg_to_front_m = p.wheelbase_m - new_x;
  if (new_x <= 0.0 || new_x >= p.wheelbase_m) return Error{"", "the load tips the car over an axle"};

  // What springs and tyres of an axle give under what it has more to carry.
  const double front_n = kGravity_mps2 * (p.sprung_mass_kg * new_x - before_kg * x) / p.wheelbase_m;
  const double rear_n = kGravity_mps2 * kg - front_n;
  const double front_m = 0.5 * front_n * (1.0 / p.front_rate_npm + 1.0 / p.tyre_rate_npm);
  const double rear_m = 0.5 * rear_n * (1.0 / p.rear_rate_npm + 1.0 / p.tyre_rate_npm);
  p.rest.heave_m -= rear_m, p.rest.pitch_rad += (front_m - rear_m) / p.wheelbase_m;
  p.cg_height_m = new_height - rear_m - (front_m - rear_m) * new_x / p.wheelbase_m;
  // The body is heavier on the same springs and dampers.
  p.ride_frequency_hz *= std::sqrt(before_kg / p.sprung_mass_kg),
      p.ride_damping *= std::sqrt(before_kg / p.sprung_mass_kg);
  if (p.roll_stiffness_nmprad <= 1.1 * p.sprung_mass_kg * kGravity_mps2 * p.cg_height_m)
    return Error{"", "the roll stiffness does not hold the loaded body upright"};

  if (!p.chassis) return p;
  ChassisParams& c = *p.chassis;
  const auto square = [](double value) { return value * value; };
  double along = square(x - new_x), up = square(height - new_height);
  c.pitch_inertia_kgm2 += before_kg * (along + up), c.roll_inertia_kgm2 += before_kg * up;
  c.yaw_inertia_kgm2 += vehicle.mass_kg * along;
  for (const LoadParams& load : loads) {
    along = square(load.x_m - new_x), up = square(load.height_m - new_height);
    c.pitch_inertia_kgm2 += load.kg * (along + up), c.roll_inertia_kgm2 += load.kg * up,
        c.yaw_inertia_kgm2 += load.kg * along;
  }
  c.front_sunk_m += 0.5 * front_n / p.front_rate_npm, c.rear_sunk_m += 0.5 * rear_n / p.rear_rate_npm;
  const double most = std::max(c.front_sunk_m, c.rear_sunk_m);
  if (most >= c.bump_travel_m) {
    char text[120];
    std::snprintf(text, sizeof text, "the load rests on the stops: it takes %.0f mm of %.0f mm of bump travel",
                  1e3 * most, 1e3 * c.bump_travel_m);
    return Error{"", text};
  }
  return p;
}

Result<VehicleParams> read_vehicle(const std::filesystem::path& file) {
  const Result<TomlTable> read = TomlTable::read(file);
  return read ? vehicle_of(*read) : Result<VehicleParams>(read.error());
}

Result<VehicleParams> parse_vehicle(std::string_view text, const std::string& name) {
  const Result<TomlTable> read = TomlTable::parse(text, name);
  return read ? vehicle_of(*read) : Result<VehicleParams>(read.error());
}

}  // namespace phare
