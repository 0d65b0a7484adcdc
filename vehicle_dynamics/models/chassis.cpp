#include "vehicle_dynamics/models/chassis.h"

#include <algorithm>

#include "config/base/conventions.h"

namespace phare::chassis {

Result<Params> params_of(const VehicleParams& vehicle, const std::string& place) {
  if (!vehicle.chassis)
    return Error{place, "levels single-track and full need the tables [body] and [tyre] in the vehicle file"};
  const ChassisParams& c = *vehicle.chassis;
  Params p;
  p.mass_kg = vehicle.sprung_mass_kg + c.front_axle_kg + c.rear_axle_kg;
  p.sprung_kg = vehicle.sprung_mass_kg;
  p.cg_height_m = vehicle.cg_height_m;
  p.radius_m = vehicle.tyre_radius_m;
  p.spin_inertia_kgm2 = vehicle.wheel_inertia_kgm2;
  p.roll_inertia_kgm2 = c.roll_inertia_kgm2;
  p.pitch_inertia_kgm2 = c.pitch_inertia_kgm2;
  p.yaw_inertia_kgm2 = c.yaw_inertia_kgm2;
  p.drag_area_m2 = vehicle.drag_area_m2;
  p.rolling_coefficient = vehicle.rolling_coefficient;
  p.wheelbase_m = vehicle.wheelbase_m;
  p.ackermann_01 = c.ackermann_01;
  p.tyre_rate_npm = vehicle.tyre_rate_npm;
  p.tyre_damping_nspm = c.tyre_damping_nspm;
  p.bump_travel_m = c.bump_travel_m, p.rebound_travel_m = c.rebound_travel_m, p.stop_rate_npm = c.stop_rate_npm;
  const double to_rear = vehicle.wheelbase_m - vehicle.cg_to_front_m;
  for (std::size_t i = 0; i < 4; ++i) {
    const bool front = i < 2, left = i % 2 == 0;
    const double track = front ? c.front_track_m : c.rear_track_m;
    p.x_m[i] = front ? vehicle.cg_to_front_m : -to_rear;
    p.y_m[i] = (left ? 0.5 : -0.5) * track;
    p.unsprung_kg[i] = 0.5 * (front ? c.front_axle_kg : c.rear_axle_kg);
    p.sunk_m[i] = front ? c.front_sunk_m : c.rear_sunk_m;
    p.spring_npm[i] = front ? vehicle.front_rate_npm : vehicle.rear_rate_npm;
    p.damper_nspm[i] = front ? c.front_damping_nspm : c.rear_damping_nspm;
    p.bar_npm[i] = (front ? c.front_anti_roll_nmprad : c.rear_anti_roll_nmprad) / (track * track);
    const double share = (front ? to_rear : vehicle.cg_to_front_m) / vehicle.wheelbase_m;
    p.spring_n[i] = 0.5 * share * p.sprung_kg * kGravity_mps2;
    p.load_n[i] = p.spring_n[i] + p.unsprung_kg[i] * kGravity_mps2;
    p.rest_m[i] = p.spring_n[i] / p.spring_npm[i] + p.load_n[i] / p.tyre_rate_npm;
    // The axle's mass is pushed sideways at wheel height and held on the ground.
    p.unsprung_couple[i] = (left ? 1.0 : -1.0) * 2.0 * p.unsprung_kg[i] / p.mass_kg * p.radius_m / track;
    // Written for the share of the whole load transfer, as anti-dive is quoted; the linkage knows its own wheels'
    // force.
    const double lever = vehicle.cg_height_m / vehicle.wheelbase_m;
    if (front && c.brake_front_01 > 0.0) p.brake_jack[i] = vehicle.anti_dive_01 * lever / c.brake_front_01;
    if (!front && c.drive_front_01 < 1.0) p.drive_jack[i] = c.anti_squat_01 * lever / (1.0 - c.drive_front_01);
  }
  p.tyre = tyre::constants(c.tyre);
  constexpr double kLoaded = 1.5;  // the heaviest wheel over its load at rest when braking or cornering hard
  p.spin_kg = p.spin_inertia_kgm2 / (p.radius_m * p.radius_m);
  p.spin_answer_mps2 = c.tyre.long_stiffness * kLoaded * std::max(p.load_n[0], p.load_n[2]) / p.spin_kg;
  return p;
}

}  // namespace phare::chassis
