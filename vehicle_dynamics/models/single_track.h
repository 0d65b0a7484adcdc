// Level `single-track`: one wheel per axle in the plane, a body on springs above it.
//
// What: yaw and side slip with linear or Magic Formula tyres and their relaxation; dive, roll and heave, as a dynamic
//   second-order body over four contacts or quasi-static; load transfer onto four wheels.
// Source: M. Mitschke, H. Wallentowitz, Dynamik der Kraftfahrzeuge, 5th ed. 2014, ch. 19 (single track); D. L.
// Milliken,
//   W. F. Milliken, Race Car Vehicle Dynamics, 1995, ch. 5 and 18; body on springs in series with the tyres.
// Frame: position and velocity of the centre of gravity, ISO 8855; attitude as slopes against the horizontal, small
// angles. Leaves out: wheel hop and lift-off, wheel spin and locking (tyre force follows torque up to the friction
// limit),
//   differences between left and right tyres, damping of the tyres.
// Tests: tests/vehicle_dynamics/single_track_test.cpp (closed forms), reference_test.cpp (two other programs).
#pragma once

#include <array>

#include "vehicle_dynamics/models/full.h"

namespace phare::single_track {

struct Options {
  bool magic_formula = true;     ///< false: linear in slip, no limit
  bool dynamic_attitude = true;  ///< false: body at once where the forces hold it
};

struct Params {
  full::Params car;
  Options options;
  Integrator integrator = Integrator::kSemiImplicitEuler;
  std::array<double, 4> spring_npm{}, damper_nspm{};  ///< in series with the tyre
  double front_bar_nmprad = 0.0, rear_bar_nmprad = 0.0;
  double effective_kg = 0.0;  ///< mass with the wheels' spin inertia
  double front_brake_jack = 0.0, rear_drive_jack = 0.0;
};

Result<Params> params_of(const VehicleParams& vehicle, const Options& options, const std::string& place);

/// All zero: at rest on a level road of height 0.
struct State {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0, path_m = 0.0;
  double u_mps = 0.0, v_mps = 0.0, r_radps = 0.0;
  double z_m = 0.0, pitch = 0.0, roll = 0.0;  ///< height over rest; slopes
  double z_rate_mps = 0.0, pitch_rate_ps = 0.0, roll_rate_ps = 0.0;
  double front_slip = 0.0, rear_slip = 0.0;  ///< tan alpha, transient

  friend bool operator==(const State&, const State&) = default;
};
inline constexpr std::size_t kStateSize = 15;
static_assert(sizeof(State) == kStateSize * sizeof(double));

State at_rest(const Params& params, double x_m, double y_m, double yaw_rad, double speed_mps,
              const std::array<double, 4>& height_m);

/// Road under the wheels during one step, held or linear: asked for once, at its start and its end.
struct Under {
  std::array<double, 4> height_m{}, rate_mps{};
  double friction = 1.0;  ///< mean of the wheels
  bool off_road = false;
};
Under under(const Params& params, const full::Input& input, const State& state, double dt);

/// What is decided once for a step.
struct Held {
  Under road;
  double steer_rad = 0.0, cosine = 1.0, sine = 0.0;
  double brake_sign = 0.0;  ///< of the motion that the brakes oppose
  bool stopped = false;     ///< brakes hold the car along its x
  double most_slip_pm = std::numeric_limits<double>::infinity();
};
Held held(const Params& params, const full::Input& input, const State& state, double dt);
void finish_step(const full::Input& input, const Held& held, const State& before, State& state);

void derivative(const Params& params, const full::Input& input, const Held& held, const State& state, double t_s,
                State& rate, std::array<double, 2>* slip_decay_ps = nullptr);

/// One step of dt seconds.
void advance(const Params& params, const full::Input& input, State& state, double dt);

full::Forces forces(const Params& params, const full::Input& input, const State& state);

}  // namespace phare::single_track
