// The tyre: force of a slipping contact patch, and how slip builds up.
//
// What: longitudinal and lateral force under combined slip; the transient slip of a single contact point.
// Source: H. B. Pacejka, Tire and Vehicle Dynamics, 3rd ed. 2012: Magic Formula ch. 4.3 (PAC2002) with cosine
//   weighting, for a wheel that slides far its direction instead; transient slip ch. 7.2 (eq. 7.20, 7.21 with slip
//   instead of deflection as the state), carcass damping at standstill ch. 8.6; coefficients from the vehicle file.
// Frame: contact patch, x along the wheel's heading in the road plane, y left, ISO 8855. Slip: kappa > 0 drives,
//   tan_alpha > 0 pushes to the left.
// Leaves out: camber, conicity and ply steer, turn slip, self-aligning torque, falling friction with speed,
//   temperature.
// Tests: tests/vehicle_dynamics/tyre_test.cpp (stiffness, peak, friction ellipse, mirror symmetry, sign).
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "config/base/two.h"
#include "config/vehicle.h"

namespace phare::tyre {

/// Steady-state force at a slip, under load_n >= 0 and with road friction mu (1: the file's own peak).
struct Force {
  double x_n = 0.0, y_n = 0.0;
};

/// What does not change while driving, worked out once.
struct Constants {
  TyreParams p;
  double per_kappa_bend = 0.0,
         per_tan_alpha_bend = 0.0;           ///< one over 1.5 times the slip at the peak: relaxation halves
  double peak_kappa = 0.0;                   ///< longitudinal slip at the highest force, friction 1; falls with it
  double per_long_m = 0.0, per_lat_m = 0.0;  ///< one over the relaxation lengths
  double bx = 0.0, by = 0.0;                 ///< B = K / (C D) at mu 1
  std::vector<Two> side_curve;  ///< side force over peak at B tan_alpha, see side_force(): value, rise per node
};
Constants constants(const TyreParams& params);

Force steady_force(const Constants& tyre, double kappa, double tan_alpha, double load_n, double mu);

/// The same for the four wheels of a car at once: one pass that the compiler can overlap.
void steady_forces(const Constants& tyre, const double kappa[4], const double tan_alpha[4], const double load_n[4],
                   const double mu[4], double fx_n[4], double fy_n[4]);

/// Side force over load of the two axles of a single track, without longitudinal slip, and its rise with tan_alpha.
/// From a table of the formula, by the cubic through values and rises of two nodes: 1.4e-10 of the peak for a passenger
/// car (h^4 / 384 times the fourth derivative); beyond the table the formula itself.
struct SideForce {
  Two share{}, rise{};
};
SideForce side_force(const Constants& tyre, Two tan_alpha, double mu);

/// Share of its slide at which a patch that slides aside carries its slip away: one that rolls little passes little.
/// The slip of such a patch is ten at most, and its force lies along the slide.
inline constexpr double kSlideCarries = 0.1;

/// Rate of change of the slips. No division by speed: at rest the patch is a spring.
struct SlipRate {
  double kappa_ps = 0.0, tan_alpha_ps = 0.0;
  double kappa_decay_ps = 0.0, tan_alpha_decay_ps = 0.0;        ///< for the exponential integrator
  double carried_mps = 0.0;                                     ///< speed at which the patch carries its slip away
  double kappa_stretch_mps = 0.0, tan_alpha_stretch_mps = 0.0;  ///< rate of the carcass' deflection
};

/// `vx`, `vy`: velocity of the wheel's contact point along and across it; `rolling`: spin times radius;
/// `most_along_pm`, `most_across_pm`: one over the floors of the relaxation lengths that keep a step stable; infinite
/// for none.
inline SlipRate slip_rate(const Constants& tyre, double kappa, double tan_alpha, double vx, double vy, double rolling,
                          double most_along_pm, double most_across_pm) {
  // Slip falls with what has passed through the patch.
  const double carried = std::max(std::max(std::abs(vx), std::abs(rolling)), kSlideCarries * std::abs(vy));
  const double k = kappa * tyre.per_kappa_bend, t = tan_alpha * tyre.per_tan_alpha_bend;
  // Beyond the peak the patch slides and has nothing left to build up: sigma falls with slip (Pacejka 7.2.2), to a
  // tenth.
  const double along_pm = std::min(std::min(tyre.per_long_m * (1.0 + k * k), 10.0 * tyre.per_long_m), most_along_pm);
  const double across_pm = std::min(std::min(tyre.per_lat_m * (1.0 + t * t), 10.0 * tyre.per_lat_m), most_across_pm);
  const double along = rolling - vx - carried * kappa, across = -vy - carried * tan_alpha;
  return {.kappa_ps = along * along_pm,
          .tan_alpha_ps = across * across_pm,
          .kappa_decay_ps = carried * along_pm,
          .tan_alpha_decay_ps = carried * across_pm,
          .carried_mps = carried,
          .kappa_stretch_mps = along,
          .tan_alpha_stretch_mps = across};
}

/// The lateral part of it alone, for wheels that roll without longitudinal slip: the axles of a single track.
struct SideSlipRate {
  Two tan_alpha_ps{}, decay_ps{}, stretch_mps{};
};
inline SideSlipRate side_slip_rate(const Constants& tyre, Two tan_alpha, Two vx, Two vy, double most_pm) {
  const Two carried = largest(magnitude(vx), kSlideCarries * magnitude(vy)), t = tan_alpha * tyre.per_tan_alpha_bend;
  const Two per_m = least(least(tyre.per_lat_m * (1.0 + t * t), both(10.0 * tyre.per_lat_m)), both(most_pm));
  const Two stretch = -vy - carried * tan_alpha;
  return {stretch * per_m, carried * per_m, stretch};
}

}  // namespace phare::tyre
