// The vehicle file: mass, springs, drive and steering of a car. Reader of config/vehicles/*.toml.
// Angles in the file are degrees and power kilowatts where the key says so; here everything is SI.
#pragma once

#include <filesystem>
#include <string>

#include "config/result.h"

namespace phare {

struct VehicleParams {
  std::string name;
  double mass_kg = 0.0;         ///< whole car with driver
  double sprung_mass_kg = 0.0;  ///< body without wheels and axles
  double wheelbase_m = 0.0;
  double cg_to_front_m = 0.0;       ///< centre of gravity to front axle, horizontal
  double cg_height_m = 0.0;         ///< above the ground at rest
  double track_m = 0.0;             ///< mean of front and rear
  double tyre_radius_m = 0.0;       ///< loaded
  double wheel_inertia_kgm2 = 0.0;  ///< spin inertia of one wheel

  double front_rate_npm = 0.0;  ///< spring rate at one front wheel, without the tyre
  double rear_rate_npm = 0.0;
  double tyre_rate_npm = 0.0;  ///< vertical rate of one tyre, in series with the spring
  double anti_dive_01 = 0.0;   ///< share of the front load transfer of braking the linkage carries past the spring
  double roll_stiffness_nmprad = 0.0;  ///< whole car, springs and anti-roll bars in series with the tyres
  double ride_frequency_hz = 0.0;      ///< undamped, of the body on its springs
  double ride_damping = 0.0;           ///< ratio to critical

  double steering_ratio = 0.0;  ///< steering wheel angle over mean road-wheel angle
  double max_steering_wheel_rad = 0.0;
  double max_lateral_mps2 = 0.0;  ///< grip: sharper turns are widened to this

  double max_drive_force_n = 0.0;    ///< at the wheels, accelerator 1, low speed
  double max_power_w = 0.0;          ///< at the wheels
  double max_brake_force_n = 0.0;    ///< brake 1
  double drag_area_m2 = 0.0;         ///< drag coefficient times frontal area
  double rolling_coefficient = 0.0;  ///< rolling resistance over weight
};

/// Reads and checks a vehicle file: all keys, their ranges, and that the centre of gravity lies between the axles and
/// the car does not fall over its roll stiffness.
Result<VehicleParams> read_vehicle(const std::filesystem::path& file);

}  // namespace phare
