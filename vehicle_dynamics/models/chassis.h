// What the levels with tyres share: the car's masses, springs and tyres, what acts on it during a step, what it shows.
#pragma once

#include <array>
#include <string>

#include "vehicle_dynamics/models/powertrain.h"
#include "vehicle_dynamics/models/tyre.h"
#include "vehicle_dynamics/road.h"

namespace phare::chassis {

/// A car, worked out once from its file. Wheels: front left, front right, rear left, rear right.
struct Params {
  double mass_kg = 0.0, sprung_kg = 0.0, cg_height_m = 0.0, radius_m = 0.0, spin_inertia_kgm2 = 0.0;
  double roll_inertia_kgm2 = 0.0, pitch_inertia_kgm2 = 0.0, yaw_inertia_kgm2 = 0.0;
  double drag_area_m2 = 0.0, rolling_coefficient = 0.0;
  double wheelbase_m = 0.0, ackermann_01 = 0.0;
  double tyre_rate_npm = 0.0, tyre_damping_nspm = 0.0;
  double bump_travel_m = 0.0, rebound_travel_m = 0.0, stop_rate_npm = 0.0;
  std::array<double, 4> sunk_m{};      ///< travel that the load has taken at rest
  std::array<double, 4> x_m{}, y_m{};  ///< from the centre of gravity
  std::array<double, 4> unsprung_kg{}, spring_npm{}, damper_nspm{}, bar_npm{};  ///< bar: per difference of travel
  std::array<double, 4> load_n{}, spring_n{};                                   ///< at rest: of the tyre, of the spring
  std::array<double, 4> unsprung_couple{};  ///< vertical force per N of lateral force, from the axle's own height
  std::array<double, 4> brake_jack{}, drive_jack{};  ///< anti-dive, anti-squat: vertical over longitudinal force
  std::array<double, 4> rest_m{};                    ///< what spring and tyre give under the weight at rest
  double spin_answer_mps2 = 0.0;                     ///< of a loaded wheel's tread to a slip of one: k Fz R^2 / I
  double spin_kg = 0.0;                              ///< a wheel's inertia at its tread: I / R^2
  tyre::Constants tyre;
};

/// From a vehicle file that has [body] and [tyre]. Error: one of them is missing.
Result<Params> params_of(const VehicleParams& vehicle, const std::string& place);

/// What acts on the car during one step.
struct Input {
  double steer_rad = 0.0;                        ///< mean of the front wheels
  std::array<double, 4> drive_nm{}, brake_nm{};  ///< brake: dry friction, >= 0, never turns a wheel
  bool air_and_rolling = true;                   ///< drag and rolling resistance
  const Road* road = nullptr;                    ///< nullptr: level, friction 1
  bool heights_given = false;                    ///< road heights under the wheels come as numbers, over the step
  std::array<double, 4> height_m{}, height_rate_mps{};  ///< given: at the step's start, and their slope over it
  double steering_wheel_rad = 0.0;  ///< level kinematic: instead of steer_rad, as it limits the wheel's rate itself
};

/// What a step shows besides the state.
struct Forces {
  std::array<double, 4> load_n{}, fx_n{}, fy_n{};  ///< in the wheel's heading
  std::array<double, 4> ground_m{};
  double ax_mps2 = 0.0, ay_mps2 = 0.0;  ///< of the centre of gravity along the body's axes, without gravity
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rad = 0.0;  ///< R = Rz Ry Rx
  double roll_rate_radps = 0.0, pitch_rate_radps = 0.0, yaw_rate_radps = 0.0;
  double road_pitch_rad = 0.0, road_roll_rad = 0.0;  ///< of the plane through the contacts
  bool off_road = false;
};

}  // namespace phare::chassis
