// The tyre: force of a slipping contact patch, and how slip builds up.
//
// What: longitudinal and lateral force under combined slip; the transient slip of a single contact point.
// Source: H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed. 2012: Magic Formula ch. 4.3 (PAC2002) with cosine weighting,
//   transient slip ch. 7.2 (eq. 7.20, 7.21 with slip instead of deflection as the state), carcass damping at standstill
//   ch. 8.6; coefficients from the vehicle file.
// Frame: contact patch, x along the wheel's heading in the road plane, y left, ISO 8855. Slip: kappa > 0 drives, tan_alpha
//   > 0 pushes to the left.
// Leaves out: camber, conicity and ply steer, turn slip, self-aligning torque, falling friction with speed, temperature.
// Tests: tests/vehicle_dynamics/tyre_test.cpp (stiffness, peak, friction ellipse, mirror symmetry).
#pragma once

#include <algorithm>
#include <cmath>

#include "config/vehicle.h"

namespace phare::tyre {

/// Steady-state force at a slip, under load_n >= 0 and with road friction mu (1: the file's own peak).
struct Force {
  double x_n = 0.0, y_n = 0.0;
};

/// What does not change while driving, worked out once.
struct Constants {
  TyreParams p;
  double kappa_bend = 0.0, tan_alpha_bend = 0.0;  ///< slip at 1.5 times the peak: relaxation has halved there
  double bx = 0.0, by = 0.0;                      ///< B = K / (C D) at mu 1
};
Constants constants(const TyreParams& params);

Force steady_force(const Constants& tyre, double kappa, double tan_alpha, double load_n, double mu);

/// The same for the four wheels of a car at once: one pass that the compiler can overlap.
void steady_forces(const Constants& tyre, const double kappa[4], const double tan_alpha[4], const double load_n[4],
                   const double mu[4], double fx_n[4], double fy_n[4]);

/// Rate of change of the slips, and the speed they are carried away with over their relaxation lengths: for the
/// exponential integrator. No division by speed: at rest the patch is a spring.
struct SlipRate {
  double kappa_ps = 0.0, tan_alpha_ps = 0.0;
  double kappa_decay_ps = 0.0, tan_alpha_decay_ps = 0.0;
  double kappa_m = 0.0, tan_alpha_m = 0.0;  ///< relaxation lengths used
};

/// `vx`, `vy`: velocity of the wheel's contact point along and across it; `rolling`: spin times radius;
/// `shortest_m`: floor of the relaxation length, half of what the wheel travels in a step, so that explicit steps stay
/// stable.
inline SlipRate slip_rate(const Constants& tyre, double kappa, double tan_alpha, double vx, double vy, double rolling,
                          double shortest_m) {
  // Slip falls with what has passed through the patch. A wheel that slides sideways passes little: a tenth of its slide.
  const double carried = std::max({std::abs(vx), std::abs(rolling), 0.1 * std::abs(vy)});
  const double k = kappa / tyre.kappa_bend, t = tan_alpha / tyre.tan_alpha_bend;
  // Beyond the peak the patch slides and has nothing left to build up (Pacejka 7.2.2: sigma falls with slip stiffness).
  const double along = std::max({tyre.p.long_relaxation_m / (1.0 + k * k), 0.1 * tyre.p.long_relaxation_m, shortest_m});
  const double across = std::max({tyre.p.lat_relaxation_m / (1.0 + t * t), 0.1 * tyre.p.lat_relaxation_m, shortest_m});
  const double inv_along = 1.0 / along, inv_across = 1.0 / across;
  return {.kappa_ps = -((vx - rolling) + carried * kappa) * inv_along,
          .tan_alpha_ps = -(vy + carried * tan_alpha) * inv_across,
          .kappa_decay_ps = carried * inv_along,
          .tan_alpha_decay_ps = carried * inv_across,
          .kappa_m = along,
          .tan_alpha_m = across};
}

}  // namespace phare::tyre
