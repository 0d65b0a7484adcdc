// Level `full`: fourteen degrees of freedom.
//
// What: a sprung body (6), four wheels that hop (4) and spin (4), eight transient slips; load transfer, lift-off,
//   locking, standing still, kerbs, split friction.
// Source: R. Rajamani, Vehicle Dynamics and Control, 2nd ed. 2012, ch. 8; T. Shim, C. Ghike, "Understanding the
//   limitations of different vehicle models for roll dynamics studies", Vehicle System Dynamics 45(3), 2007;
//   Newton-Euler in the body's own axes with a quaternion instead of small angles. Tyres: models/tyre.h.
// Frame: state at the centre of gravity of the body, velocities in the body's axes (ISO 8855), position in the
//   world; z_m is the height of that centre less its height at rest.
// Leaves out: linkage kinematics beyond anti-dive and anti-squat (wheels move along the body's z axis: no bump steer,
//   no camber), roll centres above the ground, the sideways inertia of a body that rolls about the ground, the
//   pitching moment of gravity on the pitched body (2 to 5 % of dive) as the textbook does, products of inertia,
//   frame flexibility, side wind. Two tracks of unlike height roll the body and do not push it aside.
// Tests: tests/vehicle_dynamics/full_test.cpp (closed forms), reference_test.cpp (two other programs),
//   hard_cases_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include "vehicle_dynamics/models/chassis.h"
#include "vehicle_dynamics/models/fixed_step.h"

namespace phare::full {

/// The car, and how it is moved on.
struct Params : chassis::Params {
  Integrator integrator = Integrator::kRk4;
};

/// From a vehicle file that has [body] and [tyre]. Error names the table that is missing.
Result<Params> params_of(const VehicleParams& vehicle, const std::string& place);

using chassis::Forces;
using chassis::Input;

/// Plain numbers only; all zero with w = 1 is a car at rest on a level road of height 0.
struct State {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double qw = 1.0, qx = 0.0, qy = 0.0, qz = 0.0;  ///< world from body, unit
  double path_m = 0.0;                            ///< travelled ahead, on the map
  double u_mps = 0.0, v_mps = 0.0, w_mps = 0.0;
  double p_radps = 0.0, q_radps = 0.0, r_radps = 0.0;
  std::array<double, 4> travel_m{};            ///< of the wheel towards the body, 0 at rest
  std::array<double, 4> rise_mps{};            ///< of the wheel along the body's z, absolute
  std::array<double, 4> spin_radps{};          ///< > 0 forwards
  std::array<double, 4> kappa{}, tan_alpha{};  ///< transient slips

  friend bool operator==(const State&, const State&) = default;
};
inline constexpr std::size_t kStateSize = 34;
static_assert(sizeof(State) == kStateSize * sizeof(double));

/// Car at rest in its springs on the plane through four contacts, rolling at `speed_mps`, its centre of gravity over
/// (x, y).
State at_rest(const Params& params, double x_m, double y_m, double yaw_rad, double speed_mps,
              const std::array<double, 4>& height_m);

/// Lets a car that stands, at_rest(), settle where `input` holds it: body, springs and carcasses carry the weight on
/// whatever the road is, and nothing moves. Without brakes all but the car's own rolling off. The steering, brakes and
/// road are input's. False, and the state as it was: there is no such place (the brakes or the road do not hold it).
bool stand(const Params& params, const Input& input, State& state);

/// Front wheels turned by a mean angle, each by its share of the Ackermann angle.
struct Steer {
  std::array<double, 4> cosine{}, sine{};
};

/// What is decided once for a step: wheels held by their brakes, steering, the floor of the relaxation lengths.
struct Held {
  Steer steer;
  std::array<bool, 4> locked{};
  std::array<double, 4> brake_nm{};  ///< signed, of the turning wheels, for the whole step
  // One over the floors of the relaxation lengths, and how much of the carcass' damping along the wheel the step bears.
  double most_along_pm = std::numeric_limits<double>::infinity(),
         most_across_pm = std::numeric_limits<double>::infinity();
  double most_damping_nspm = std::numeric_limits<double>::infinity();
};

/// d state/dt at `t_s` into the step.
void derivative(const Params& params, const Input& input, const Held& held, const State& state, double t_s, State& rate,
                std::array<double, 8>* slip_decay_ps = nullptr);

/// Which wheels stick in their brakes over the coming step.
Held held(const Params& params, const Input& input, const State& state, double dt);

/// After any integrator's step: wheels whose brakes stopped them stand, the quaternion is unit again.
void finish_step(const Held& held, const State& before, State& state);

/// One step of dt seconds.
void advance(const Params& params, const Input& input, State& state, double dt);

/// How the wheels turn, for pedals and ABS.
powertrain::Wheels wheels(const Params& params, const Input& input, const State& state);

/// At the state, for output.
Forces forces(const Params& params, const Input& input, const State& state, double t_s = 0.0);

/// Kinetic energy, of springs, tyres and height, J: 0 at rest on a level road at height 0.
double energy_j(const Params& params, const State& state, const Forces& forces);

}  // namespace phare::full
