// Level `kinematic`.
//
// What: path, speed, stops, grade and bank of a car whose wheels do not slip, and the attitude its springs take
//   under the forces of driving: dive, squat, roll, heave.
// Source: R. Rajamani, Vehicle Dynamics and Control, 2nd ed. 2012, ch. 2 (kinematic bicycle model, front steering),
//   written for the rear axle; attitude quasi-static, theta = -m a_x h / K_th with axle springs and tyres in series
//   (Milliken & Milliken, Race Car Vehicle Dynamics, 1995, ch. 18), approached through a second-order filter with
//   the ride frequency and damping of the car, exact for a step, so that it neither jumps nor stops dead.
// Frame: ISO 8855, origin on the ground under the middle of the rear axle; pitch > 0 nose down.
// Leaves out: tyre slip (a turn beyond the car's grip is widened), wheel hop and bumps (the body follows the plane
//   of its four contacts), engine inertia, locked wheels.
// Tests: tests/vehicle_dynamics/kinematic_test.cpp (closed forms), step_test.cpp (repeatability, standing still).
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <numbers>

#include "config/vehicle.h"
#include "vehicle_dynamics/models/powertrain.h"
#include "vehicle_dynamics/state.h"

namespace phare::kinematic {

/// A driver turns the wheel at 1000 degrees a second at most; faster input is a fault or a joystick.
inline constexpr double kMaxSteeringWheelRate_radps = 1000.0 * std::numbers::pi / 180.0;

/// Body attitude under constant forces. `fx`, `fy`: acceleration felt in the car (without gravity's part: standing
/// uphill is felt as forward acceleration), car frame.
struct Attitude {
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
  double heave_m = 0.0;  ///< over the rear axle
};
Attitude quasi_static_attitude(const VehicleParams& params, double fx_mps2, double fy_mps2);

/// At the treads of all wheels together.
struct Push {
  double drive_n = 0.0;  ///< > 0 forwards
  double brake_n = 0.0;  ///< >= 0, against the motion
};
Push push_of(const VehicleParams& params, const std::array<double, 4>& drive_nm, const std::array<double, 4>& brake_nm);
inline Push push_of(const VehicleParams& params, const powertrain::Torques& torques) {
  return push_of(params, torques.drive_nm, torques.brake_nm);
}

/// What pushes a car that moves as the state says, N, > 0 forwards: drive less brakes.
double pushed_n(const VehicleParams& params, const CarState& state);

/// One step of dt seconds, dt > 0. `steering_wheel_rad` must be finite. Moves the car over the plane it stands on; the
/// road under its new place is put there by stand_on().
void advance(const VehicleParams& params, double steering_wheel_rad, const Push& push, CarState& state, double dt);

/// Lets a car that stands take at once the attitude that its springs take under `push` on the road it stands on.
void stand(const VehicleParams& params, const Push& push, CarState& state);

/// World x, y of the wheel contacts: front left, front right, rear left, rear right.
std::array<glm::dvec2, 4> contact_points(const VehicleParams& params, const CarState& state);

/// Puts the car on the road whose heights under its contacts are given: height, grade, bank, and their rates over `dt`
/// (0: a first placing, rates 0).
void stand_on(const VehicleParams& params, const std::array<double, 4>& height_m, CarState& state, double dt);

}  // namespace phare::kinematic
