// Parts of level `single-track` that its integrators put together: what acts on the car at a state.
#pragma once

#include <array>

#include "vehicle_dynamics/models/single_track.h"

namespace phare::single_track {

/// Side force over load of the axles (front, rear), and its rise with slip.
struct Grip {
  Two share{}, rise{};
  Two slip{};         ///< where it was worked out
  double most = 0.0;  ///< share that no slip exceeds

  /// The share at a slip nearby, by the tangent.
  Two near(Two other) const { return least(largest(share + rise * (other - slip), both(-most)), both(most)); }
};
Grip grip(const Params& params, const Held& held, const State& state);

/// Everything that tyres, springs and road do at a state.
struct Acting {
  Two front_load_n{}, rear_load_n{};  ///< left, right
  Two ahead_n{}, limit_n{};           ///< torque at the tread, cut off by friction; and where that cuts: front, rear
  double front_x_n = 0.0, rear_x_n = 0.0, front_y_n = 0.0, rear_y_n = 0.0;  ///< in the wheels' heading
  double fx_n = 0.0, fy_n = 0.0;                                            ///< of the tyres, along the car's axes
  double ax_mps2 = 0.0, ay_mps2 = 0.0;             ///< along the car's axes, less gravity's part
  double u_mps2 = 0.0, v_mps2 = 0.0, r_ps2 = 0.0;  ///< rates of the velocities
  Two slip_rate_ps{}, slip_decay_ps{};             ///< front, rear
  ride::Push ride;                                 ///< of the body, beside its springs' answer to its own place
};
/// `share`: of the side force, see Grip.
Acting acting(const Params& params, const Held& held, Two share, const State& state, double t_s);

}  // namespace phare::single_track
