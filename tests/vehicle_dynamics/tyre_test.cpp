// The tyre: stiffness, peak, friction ellipse, symmetry, and the two ways of working it out.
#include "vehicle_dynamics/models/tyre.h"

#include <gtest/gtest.h>

#include <random>

#include "test_car.h"

namespace phare {
namespace {

tyre::Constants passenger_tyre() {
  return tyre::constants(test::car("bmw_320i.toml").chassis->tyre);
}

TEST(Tyre, SlipStiffnessAndPeak) {
  const tyre::Constants t = passenger_tyre();
  const double load = 3000.0, slip = 1e-6;
  EXPECT_NEAR(tyre::steady_force(t, slip, 0.0, load, 1.0).x_n / slip, 22.303 * load, 1e-3 * 22.303 * load);
  EXPECT_NEAR(tyre::steady_force(t, 0.0, slip, load, 1.0).y_n / slip, 21.92 * load, 1e-3 * 21.92 * load);
  // Friction changes the peak, not the stiffness.
  EXPECT_NEAR(tyre::steady_force(t, 0.0, slip, load, 0.3).y_n / slip, 21.92 * load, 1e-3 * 21.92 * load);
  double most_x = 0.0, most_y = 0.0;
  for (double s = 0.0; s < 1.0; s += 1e-3) {
    most_x = std::max(most_x, tyre::steady_force(t, s, 0.0, load, 0.3).x_n);
    most_y = std::max(most_y, tyre::steady_force(t, 0.0, s, load, 0.3).y_n);
  }
  EXPECT_NEAR(most_x, 0.3 * 1.1739 * load, 1e-3 * load);
  EXPECT_NEAR(most_y, 0.3 * 1.0489 * load, 1e-3 * load);
}

TEST(Tyre, StaysInTheEllipseAndFourAtOnceAgree) {
  const tyre::Constants t = passenger_tyre();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> slip(-2.0, 2.0), load(0.0, 8000.0), mu(0.05, 1.2);
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    double kappa[4], tan_alpha[4], n[4], m[4], x[4], y[4];
    for (int k = 0; k < 4; ++k)
      kappa[k] = slip(random), tan_alpha[k] = slip(random), n[k] = load(random), m[k] = mu(random);
    n[i % 4] = i % 8 == 0 ? 0.0 : n[i % 4];
    tyre::steady_forces(t, kappa, tan_alpha, n, m, x, y);
    for (int k = 0; k < 4; ++k) {
      const tyre::Force one = tyre::steady_force(t, kappa[k], tan_alpha[k], n[k], m[k]);
      worst = std::max({worst, std::abs(one.x_n - x[k]), std::abs(one.y_n - y[k])});
      const double ex = x[k] / (m[k] * 1.1739 * std::max(n[k], 1.0)), ey = y[k] / (m[k] * 1.0489 * std::max(n[k], 1.0));
      ASSERT_LE(ex * ex + ey * ey, 1.0 + 1e-9);
      const tyre::Force mirrored = tyre::steady_force(t, kappa[k], -tan_alpha[k], n[k], m[k]);
      ASSERT_EQ(mirrored.x_n, one.x_n);
      ASSERT_EQ(mirrored.y_n, -one.y_n);
    }
  }
  EXPECT_LT(worst, 1e-8);  // a few units in the last place of 8 kN
}

// A sliding wheel takes energy from the car, never gives it: kappa > 0 pushes ahead, tan alpha > 0 to the left, however
// far it slides. Far out the force lies along the slide.
TEST(Tyre, ForceNeverTurnsItsSign) {
  const tyre::Constants t = passenger_tyre();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(-4.0, 2.0), sign(-1.0, 1.0);
  for (int i = 0; i < 5000; ++i) {
    const double kappa = std::copysign(std::pow(10.0, exponent(random)), sign(random)),
                 tan_alpha = std::copysign(std::pow(10.0, exponent(random)), sign(random));
    const tyre::Force f = tyre::steady_force(t, kappa, tan_alpha, 3000.0, 1.0);
    ASSERT_GT(f.x_n * kappa, 0.0) << kappa << ' ' << tan_alpha;
    ASSERT_GT(f.y_n * tan_alpha, 0.0) << kappa << ' ' << tan_alpha;
  }
  const tyre::Force aside = tyre::steady_force(t, 0.1, 20.0, 3000.0, 1.0);
  EXPECT_LT(std::abs(aside.x_n), 0.02 * aside.y_n);
}

// The table of single-track against the formula: its cubic is off by the fourth derivative (14.8 at most for this
// tyre, over B tan alpha) times h^4 / 384, its rise by that times h^3 sqrt(3) / 216; h is 1/128. Slips from far beyond
// the table's end on one axle alone and on both.
TEST(Tyre, TwoAxlesAtOnceAndTheirRise) {
  const tyre::Constants t = passenger_tyre();
  const double h = 1.0 / 128.0, fourth = 14.8, load = 3000.0, mu = 0.8, peak = mu * t.p.lat_peak;
  const double off = peak * fourth * std::pow(h, 4) / 384.0,
               rise_off = fourth * std::pow(h, 3) * std::sqrt(3.0) / 216.0;
  const double b = t.by / mu, c = t.p.lat_shape, step = 3e-6;
  double worst = 0.0, worst_rise = 0.0;
  for (double slip = -1.0; slip <= 1.0; slip += 0.001) {
    const double other = 0.3 * slip;
    const tyre::SideForce f = tyre::side_force(t, Two{slip, other}, mu);
    const auto exact = [&](double at) { return tyre::steady_force(t, 0.0, at, load, mu).y_n / load; };
    worst = std::max({worst, std::abs(f.share[0] - exact(slip)), std::abs(f.share[1] - exact(other))});
    worst_rise = std::max(worst_rise, std::abs(f.rise[0] - (exact(slip + step) - exact(slip - step)) / (2.0 * step)));
    const tyre::SideForce mirrored = tyre::side_force(t, Two{-slip, -other}, mu);
    ASSERT_EQ(mirrored.share[0], -f.share[0]);
    ASSERT_NEAR(mirrored.rise[0], f.rise[0], 1e-12);
  }
  EXPECT_LT(worst, 1.01 * off + 1e-15);
  EXPECT_GT(worst, 0.5 * off);  // it is a table, and no finer than it says
  // and what the difference quotient itself is off by: third derivative, B^3 D (2 C + C^3) at the origin for a small E,
  // times step^2 / 6, and rounding
  EXPECT_LT(worst_rise,
            peak * b * rise_off + b * b * b * peak * (2.0 * c + c * c * c) * step * step / 6.0 + 2e-16 / step);
}

// A road wet to nothing or a wheel torn aside: the formula beyond the table, and no number where there is none.
TEST(Tyre, SideForceBeyondItsTable) {
  const tyre::Constants t = passenger_tyre();
  for (const double slip : {0.6, 3.0, -50.0, 1e6, -1e300}) {
    const tyre::SideForce f = tyre::side_force(t, Two{slip, 0.01}, 1.0);
    EXPECT_NEAR(f.share[0], tyre::steady_force(t, 0.0, slip, 3000.0, 1.0).y_n / 3000.0, 1e-14) << slip;
    EXPECT_GE(std::abs(f.share[1]), 0.2);
  }
  EXPECT_TRUE(std::isnan(tyre::side_force(t, Two{std::nan(""), 0.0}, 1.0).share[0]));
}

TEST(Tyre, SlipSettlesWithoutDividingBySpeed) {
  const tyre::Constants t = passenger_tyre();
  // Steady: kappa = (R w - v) / |v|; at rest nothing decays, a push stretches the patch like a spring.
  const auto rolling = tyre::slip_rate(t, 0.05, 0.0, 10.0, 0.0, 10.5, 1e6, 1e6);
  EXPECT_NEAR(rolling.kappa_ps, -(10.0 - 10.5 + 10.5 * 0.05) / t.p.long_relaxation_m, 0.1 * std::abs(rolling.kappa_ps));
  const auto resting = tyre::slip_rate(t, 0.01, 0.0, 0.0, 0.0, 0.0, 1e6, 1e6);
  EXPECT_EQ(resting.kappa_ps, 0.0);
  EXPECT_EQ(resting.kappa_decay_ps, 0.0);
}

}  // namespace
}  // namespace phare
