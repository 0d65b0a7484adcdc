// Level single-track against closed forms.
#include "vehicle_dynamics/models/single_track.h"

#include <gtest/gtest.h>

#include "config/conventions.h"
#include "full_car.h"

namespace phare {
namespace {

using single_track::Options;

struct Track {
  single_track::Params params;
  full::Input input;
  single_track::State state;
  explicit Track(const single_track::Params& p, double speed)
      : params(p), state(single_track::at_rest(p, 0.0, 0.0, 0.0, speed, {})) {
    input.air_and_rolling = false;
  }
  void run(double seconds, double dt) {
    for (long i = 0; i < std::lround(seconds / dt); ++i) single_track::advance(params, input, state, dt);
  }
  void brake(double mps2) {
    const double torque = params.car.mass_kg * mps2 * params.car.radius_m;
    input.brake_nm = {0.33 * torque, 0.33 * torque, 0.17 * torque, 0.17 * torque};
  }
};

TEST(SingleTrack, DiveAndRollOfBothAttitudes) {
  for (const bool dynamic : {true, false}) {
    Track brake(test::single_car({.dynamic_attitude = dynamic}), 30.0);
    brake.brake(1.0);
    brake.run(5.0, 0.005);
    const full::Forces f = single_track::forces(brake.params, brake.input, brake.state);
    EXPECT_NEAR(f.pitch_rad / -f.ax_mps2, 5.2693e-3, 0.005 * 5.2693e-3) << dynamic;
    Track turn(test::single_car({.dynamic_attitude = dynamic}), 20.0);
    turn.input.steer_rad = 0.004;
    turn.run(6.0, 0.005);
    const full::Forces g = single_track::forces(turn.params, turn.input, turn.state);
    EXPECT_NEAR(g.roll_rad / g.ay_mps2 * 9.81 * test::kDeg, 8.80, 0.005 * 8.80) << dynamic;
  }
}

TEST(SingleTrack, SteadyYawGainOfAnUndersteeringCar) {
  // Notes' variant Cf 80 000, Cr 110 000 N/rad: here by the load share that gives this ratio with equal tyres.
  Track turn(test::single_car({.magic_formula = false}), 80.0 / 3.6);
  auto& car = turn.params.car;
  const double c = car.tyre.p.lat_stiffness;
  car.load_n = {40'000.0 / c, 40'000.0 / c, 55'000.0 / c, 55'000.0 / c};
  turn.input.steer_rad = 0.01;
  turn.run(5.0, 0.001);
  EXPECT_NEAR(turn.state.r_radps / 0.01 / turn.state.u_mps * (80.0 / 3.6), 5.4180, 0.01 * 5.4180);
}

TEST(SingleTrack, YawStepResponse) {
  Track turn(test::single_car({.magic_formula = false}), 80.0 / 3.6);
  auto& car = turn.params.car;
  car.tyre.per_lat_m = 1e3;  // no relaxation
  const double c = car.tyre.p.lat_stiffness;
  car.load_n = {40'000.0 / c, 40'000.0 / c, 55'000.0 / c, 55'000.0 / c};
  turn.params.integrator = Integrator::kEtd2;
  turn.input.steer_rad = 1e-4;
  double peak = 0.0, peak_at = 0.0;
  for (int i = 1; i <= 6000; ++i) {
    single_track::advance(turn.params, turn.input, turn.state, 0.0005);
    if (i < 2000 && turn.state.r_radps > peak) peak = turn.state.r_radps, peak_at = i * 0.0005;
  }
  EXPECT_NEAR(peak / turn.state.r_radps, 1.0375, 0.005 * 1.0375);
  EXPECT_NEAR(peak_at, 0.343, 0.01);
}

TEST(SingleTrack, StandsOnASlope) {
  Road slope;
  slope.slope_x = 0.2;
  for (const Integrator integrator : {Integrator::kSemiImplicitEuler, Integrator::kEtd2, Integrator::kRk4}) {
    Track parked(test::single_car(), 0.0);
    parked.params.integrator = integrator;
    parked.input.road = &slope;
    const double b = parked.params.car.x_m[2], a = parked.params.car.x_m[0];
    parked.state = single_track::at_rest(parked.params, 0.0, 0.0, 0.0, 0.0, {0.2 * a, 0.2 * a, 0.2 * b, 0.2 * b});
    parked.brake(10.0);
    parked.run(10.0, 0.005);
    const double x = parked.state.x_m;
    parked.run(60.0, 0.005);
    EXPECT_EQ(parked.state.x_m, x);
    EXPECT_EQ(parked.state.u_mps, 0.0);
    const full::Forces f = single_track::forces(parked.params, parked.input, parked.state);
    EXPECT_NEAR((f.pitch_rad - f.road_pitch_rad) * test::kDeg, -0.581, 0.01 * 0.581);
  }
}

TEST(SingleTrack, StopsAndReverses) {
  Track stop(test::single_car(), 50.0 / 3.6);
  stop.brake(6.0);
  stop.run(6.0, 0.005);
  EXPECT_EQ(stop.state.u_mps, 0.0);
  Track back(test::single_car(), -3.0);
  back.input.steer_rad = 0.25;
  back.run(10.0, 0.005);
  EXPECT_NEAR(back.state.r_radps, back.state.u_mps * std::tan(0.25) / back.params.car.wheelbase_m, 0.02 * 0.3);
}

}  // namespace
}  // namespace phare
