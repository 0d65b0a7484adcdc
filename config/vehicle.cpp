#include "config/vehicle.h"

#include <numbers>

#include "config/conventions.h"
#include "config/toml_table.h"

namespace phare {
namespace {
constexpr double kRadPerDeg = std::numbers::pi / 180.0;
}  // namespace

Result<VehicleParams> read_vehicle(const std::filesystem::path& file) {
  Result<TomlTable> read = TomlTable::read(file);
  if (!read) return read.error();
  TomlTable& root = *read;

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
  p.drag_area_m2 = drive.number("drag_area_m2", 0.0, 20.0);
  p.rolling_coefficient = drive.number("rolling_coefficient", 0.0, 0.1);

  if (p.sprung_mass_kg > p.mass_kg) root.fail("sprung_mass_kg", "is more than mass_kg");
  if (p.cg_to_front_m >= p.wheelbase_m) root.fail("cg_to_front_m", "lies behind the rear axle");
  if (p.roll_stiffness_nmprad <= 1.1 * p.sprung_mass_kg * kGravity_mps2 * p.cg_height_m)
    suspension.fail("roll_stiffness_nmprad", "does not hold the body upright against its weight at cg_height_m");
  if (p.steering_ratio > 0.0 && p.max_steering_wheel_rad / p.steering_ratio > 70.0 * kRadPerDeg)
    steering.fail("max_wheel_deg", "turns the road wheels by more than 70 degrees");
  if (Status done = root.finish(); !done) return done.error();
  return p;
}

}  // namespace phare
