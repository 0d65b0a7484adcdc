// The exact step of the body on its springs, against closed forms.
#include "vehicle_dynamics/models/ride.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace phare {
namespace {

// An oscillator from rest, x'' = a0 + a1 t - w2 x - c x', by variation of constants: a particular solution p + q t and
// the damped oscillation that brings it to rest at the start. They nearly cancel: hence the rounding to allow.
struct Answer {
  double value, rounding;
};
Answer closed_form(double w2, double c, double a0, double a1, double t) {
  const double q = a1 / w2, p = (a0 - c * q) / w2, decay = 0.5 * c, w = std::sqrt(w2 - decay * decay);
  const double value = p + q * t - std::exp(-decay * t) * (p * std::cos(w * t) + (q + decay * p) / w * std::sin(w * t));
  return {value, 16.0 * std::numeric_limits<double>::epsilon() * (std::abs(p) + std::abs(q) * t)};
}

TEST(Ride, AnyStepIsExactForAPushThatGrowsEvenly) {
  ride::Springs springs;
  springs.roll_stiffness_ps2 = 120.0, springs.roll_damping_ps = 7.0;
  // Heave and pitch as two oscillators of their own: the coupled form must contain them.
  springs.stiffness_ps2 = {{{81.0, 0.0}, {0.0, 95.0}}};
  springs.damping_ps = {{{6.0, 0.0}, {0.0, 5.0}}};
  for (const double dt : {1e-3, 0.005, 0.1, 2.0}) {
    const ride::Step step = ride::step_of(springs, dt);
    const ride::Body b = ride::add(step, ride::after(step, {}, {.heave = 0.7, .pitch = -0.4, .roll = 1.3}),
                                   {.heave = -0.2, .pitch = 0.9, .roll = 0.5});
    const Answer roll = closed_form(120.0, 7.0, 1.3, 0.5 / dt, dt), heave = closed_form(81.0, 6.0, 0.7, -0.2 / dt, dt),
                 pitch = closed_form(95.0, 5.0, -0.4, 0.9 / dt, dt);
    EXPECT_NEAR(b.roll, roll.value, roll.rounding) << dt;
    EXPECT_NEAR(b.z_m, heave.value, heave.rounding) << dt;
    EXPECT_NEAR(b.pitch, pitch.value, pitch.rounding) << dt;
  }
}

TEST(Ride, CoupledHeaveAndPitchKeepTheirEnergyWithoutDamping) {
  // The 320i's figures: stiffness per mass and per inertia, so that m z'' z' + I p'' p' is a perfect differential.
  const double m = 965.71, i = 1565.8, k11 = 78e3, k12 = 9e3, k22 = 130e3;
  ride::Springs springs;
  springs.stiffness_ps2 = {{{k11 / m, k12 / m}, {k12 / i, k22 / i}}};
  const auto energy = [&](const ride::Body& b) {
    return m * b.z_rate_mps * b.z_rate_mps + i * b.pitch_rate_ps * b.pitch_rate_ps + k11 * b.z_m * b.z_m +
           2.0 * k12 * b.z_m * b.pitch + k22 * b.pitch * b.pitch;
  };
  const ride::Step step = ride::step_of(springs, 0.005);
  ride::Body b{.z_m = 0.03, .pitch = 0.01};
  const double start = energy(b);
  for (int n = 0; n < 120'000; ++n) b = ride::after(step, b, {});  // ten minutes
  EXPECT_NEAR(energy(b) / start, 1.0, 1e-9);  // 120 000 roundings of 2e-16, on one side at worst: 5e-11
}

}  // namespace
}  // namespace phare
