// Level full: at rest, under a constant force, in a steady turn; its symmetry and its integrators. The notes' closed
// forms are in closed_forms_*_test.cpp; tolerance 0.5 % unless said.
#include "vehicle_dynamics/models/full.h"

#include <gtest/gtest.h>

#include "config/base/conventions.h"
#include "full_car.h"

namespace phare {
namespace {

using test::Drive;
using test::full_car;

void expect_close(double value, double expected, double share, const char* what) {
  EXPECT_NEAR(value, expected, share * std::abs(expected)) << what;
}

TEST(Full, StandsAtRestExactly) {
  Drive d(full_car());
  const full::Forces f = d.forces();
  expect_close(f.load_n[0], 2926.07, 0.005, "front load");
  expect_close(f.load_n[2], 2436.54, 0.005, "rear load");
  expect_close(f.load_n[0] / d.params.tyre_rate_npm, 18.49e-3, 0.005, "front tyre");
  expect_close(f.load_n[2] / d.params.tyre_rate_npm, 15.39e-3, 0.005, "rear tyre");
  d.run(10.0, 0.002);
  EXPECT_LT(std::abs(d.state.z_m) + std::abs(d.pitch_rad()) + std::abs(d.state.x_m), 1e-12);
}

// Constant longitudinal force: dive without anti-dive, tyres in series. 5.2693 mrad per m/s2.
TEST(Full, DiveUnderAConstantForce) {
  struct Case {
    const char* file;
    double deg_per_g;
  };
  for (const Case& c :
       {Case{"bmw_320i.toml", 2.9617}, Case{"ford_escort.toml", 3.644}, Case{"vw_vanagon.toml", 3.543}}) {
    Drive d(full_car(c.file), 40.0);
    d.brake(0.1);  // small: the figures are those of a linear car
    d.run(5.0, 0.001);
    const full::Forces f = d.forces();
    expect_close(f.pitch_rad / -f.ax_mps2 * 9.81 * test::kDeg, c.deg_per_g, 0.005, c.file);
    if (c.file[0] != 'b') continue;
    const double front_lower = -(d.state.z_m - d.params.x_m[0] * f.pitch_rad) / -f.ax_mps2 * 9.81;
    const double rear_lift = (d.state.z_m - d.params.x_m[2] * f.pitch_rad) / -f.ax_mps2 * 9.81;
    expect_close(front_lower, 60.3e-3, 0.005, "front lowers per g");
    expect_close(rear_lift, 73.1e-3, 0.005, "rear lifts per g");
    const double transfer =
        0.5 * (f.load_n[0] + f.load_n[1] - f.load_n[2] - f.load_n[3]) - (d.params.load_n[0] - d.params.load_n[2]);
    expect_close(transfer / -f.ax_mps2 * 9.81, 2552.4, 0.005, "load transfer per g");
  }
}

// Steady yaw rate V / (L + K V^2) with K = m/L (b/C_f - a/C_r); stiffness proportional to load, so nearly neutral.
double steady_yaw_rate(const full::Params& p, double speed_mps, double steer_rad) {
  const double c = p.tyre.p.lat_stiffness, a = p.x_m[0], b = -p.x_m[2];
  const double k = p.mass_kg / p.wheelbase_m * (b / (2.0 * c * p.load_n[0]) - a / (2.0 * c * p.load_n[2]));
  return speed_mps * steer_rad / (p.wheelbase_m + k * speed_mps * speed_mps);
}

TEST(Full, SteadyTurn) {
  for (const char* file : {"bmw_320i.toml", "ford_escort.toml", "vw_vanagon.toml"}) {
    Drive d(full_car(file), 80.0 / 3.6);
    d.input.steer_rad = 0.002;
    d.run(4.0, 0.002);
    expect_close(d.state.r_radps, steady_yaw_rate(d.params, d.state.u_mps, 0.002), 0.005, file);
  }
}

TEST(Full, MirrorSymmetryIsExact) {
  Drive left(full_car(), 20.0), right(full_car(), 20.0);
  left.input.steer_rad = 0.05, right.input.steer_rad = -0.05;
  left.run(3.0, 0.002), right.run(3.0, 0.002);
  EXPECT_NEAR(left.state.y_m, -right.state.y_m, 1e-9);
  EXPECT_NEAR(left.roll_rad(), -right.roll_rad(), 1e-11);
  EXPECT_NEAR(left.pitch_rad(), right.pitch_rad(), 1e-11);
}

TEST(Full, IntegratorsAgreeInOrder) {
  // A braked step steer; the error falls with the step as each method's order says.
  const auto end = [](Integrator integrator, double dt) {
    full::Params p = test::hard_car();
    p.integrator = integrator;
    Drive d(p, 20.0);
    d.input.steer_rad = 0.02;
    d.run(1.0, dt);
    return d.state;
  };
  const full::State exact = end(Integrator::kRk4, 1e-4);
  const auto error = [&](Integrator integrator, double dt) {
    const full::State s = end(integrator, dt);
    return std::hypot(s.y_m - exact.y_m, s.r_radps - exact.r_radps);
  };
  EXPECT_LT(error(Integrator::kRk4, 0.004), error(Integrator::kRk4, 0.008) / 10.0);
  EXPECT_LT(error(Integrator::kEtd2, 0.001), error(Integrator::kEtd2, 0.002) / 3.0);
  EXPECT_LT(error(Integrator::kSemiImplicitEuler, 0.001), error(Integrator::kSemiImplicitEuler, 0.002) / 1.7);
  EXPECT_LT(error(Integrator::kRk4, 0.002), 1e-6);
}

TEST(Full, ExponentialStepSurvivesAStiffTyre) {
  // Relaxation 0.01 m at 60 m/s: a decay of 6000 a second, twelve times what a step of 2 ms can take explicitly.
  full::Params p = full_car("bmw_320i.toml", 0.01, 0.01);
  p.integrator = Integrator::kEtd2;
  Drive d(p, 60.0);
  d.input.steer_rad = 0.001;
  d.run(3.0, 0.002);
  ASSERT_TRUE(test::finite(d.state));
  expect_close(d.state.r_radps, steady_yaw_rate(d.params, d.state.u_mps, 0.001), 0.02, "yaw rate");
}

}  // namespace
}  // namespace phare
