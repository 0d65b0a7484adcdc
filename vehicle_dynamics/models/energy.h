// Where the energy of a drive comes from and goes to, step by step, at every level.
//
// What: what engine and road gave, and what brakes, tyres, dampers and air took, beside what the car has; what is left
//   over is the model's own and the integrator's.
// Source: power of each force at the velocity it acts on, by the trapezoid's rule over a step (its error falls with the
//   square of the step).
// Frame: J, taken and given since the start, > 0 as the names say.
// Leaves out: nothing on purpose. A road that is not even lifts the wheels: its work counts as the road's, as the
// models
//   do not brake the car by the slope of a bump.
// Tests: tests/vehicle_dynamics/energy_test.cpp (over the hard cases, at every level).
#pragma once

#include <cmath>

#include "vehicle_dynamics/models/full.h"
#include "vehicle_dynamics/models/kinematic.h"
#include "vehicle_dynamics/models/single_track.h"

namespace phare::energy {

struct Account {
  double car_j = 0.0;     ///< kinetic, of springs and height; 0 at rest on a level road of height 0
  double engine_j = 0.0;  ///< at the driven wheels, < 0 where it drags
  double brakes_j = 0.0, tyres_j = 0.0, dampers_j = 0.0, air_j = 0.0;  ///< taken; tyres with rolling resistance
  double road_j = 0.0;                                                 ///< by lifting the wheels, beyond its grade
};

/// What is missing of it from `start` to `now`: 0 in a model without error.
inline double missing_j(const Account& start, const Account& now) {
  return (now.engine_j - start.engine_j) + (now.road_j - start.road_j) - (now.car_j - start.car_j) -
         (now.brakes_j - start.brakes_j) - (now.tyres_j - start.tyres_j) - (now.dampers_j - start.dampers_j) -
         (now.air_j - start.air_j);
}

/// Of a car at rest in its springs or in any state; flows are 0.
Account open(const full::Params& params, const chassis::Input& input, const full::State& state);
Account open(const single_track::Params& params, const chassis::Input& input, const single_track::State& state);
Account open(const VehicleParams& vehicle, const CarState& state);

/// Adds one step that was made from `before` to `after` with that input.
void add(const full::Params& params, const chassis::Input& input, const full::State& before, const full::State& after,
         double dt, Account& account);
void add(const single_track::Params& params, const chassis::Input& input, const single_track::State& before,
         const single_track::State& after, double dt, Account& account);
void add(const VehicleParams& vehicle, const kinematic::Push& push, const CarState& before, const CarState& after,
         double dt, Account& account);

}  // namespace phare::energy
