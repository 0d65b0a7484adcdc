// Level kinematic against closed forms.
#include "vehicle_dynamics/models/kinematic.h"

#include <cmath>
#include <numbers>

#include "config/base/conventions.h"
#include "test_car.h"

namespace phare {
namespace {

using test::kinematic_setup;
using test::seconds;

TEST(Kinematic, YawRateIsSpeedTimesTanSteerOverWheelbase) {
  RunSetup setup = kinematic_setup();
  setup.vehicle.drag_area_m2 = 0.0;
  setup.vehicle.rolling_coefficient = 0.0;
  for (const double speed : {-3.0, 1.4, 8.0}) {
    const double steer = 0.2;
    CarState start;
    start.speed_mps = speed;
    start.steer_rad = steer;
    StepLoop loop(setup, start);
    loop.set_controls({.steering_wheel_rad = steer * setup.vehicle.steering_ratio});
    loop.run_to(seconds(5.0));
    EXPECT_DOUBLE_EQ(loop.state().speed_mps, speed);
    const double expected = speed * std::tan(steer) / setup.vehicle.wheelbase_m;
    EXPECT_NEAR(loop.state().yaw_rate_radps, expected, 1e-12);
    EXPECT_NEAR(loop.state().yaw_rad, 5.0 * expected, 1e-9);
  }
}

TEST(Kinematic, CircleCloses) {
  RunSetup setup = kinematic_setup();
  setup.vehicle.drag_area_m2 = 0.0;
  setup.vehicle.rolling_coefficient = 0.0;
  const double steer = 0.1, speed = 5.0;
  const double radius = setup.vehicle.wheelbase_m / std::tan(steer);
  CarState start;
  start.x_m = 100.0, start.y_m = -50.0, start.yaw_rad = 0.7;
  start.speed_mps = speed;
  start.steer_rad = steer;
  StepLoop loop(setup, start);
  loop.set_controls({.steering_wheel_rad = steer * setup.vehicle.steering_ratio});
  const SimTime lap = seconds(2.0 * std::numbers::pi * radius / speed);
  loop.run_to(lap);
  const VehicleState end = loop.at(lap);
  // Between steps the output is a chord of the arc: (v h)^2 / 8R < 1e-6 m here.
  EXPECT_NEAR(end.x_m, start.x_m, 2e-6);
  EXPECT_NEAR(end.y_m, start.y_m, 2e-6);
  EXPECT_NEAR(std::remainder(end.yaw_rad - start.yaw_rad, 2.0 * std::numbers::pi), 0.0, 1e-8);
}

TEST(Kinematic, DiveOf320iIs5point2693MradPerMps2) {
  // Reference: notes from the CommonRoad tables, tyres in series, no anti-dive; independent of this code.
  const VehicleParams p = test::car("bmw_320i.toml");
  const kinematic::Attitude attitude = kinematic::quasi_static_attitude(p, -1.0, 0.0);
  EXPECT_NEAR(attitude.pitch_rad, 5.2693e-3, 0.005 * 5.2693e-3);
  // Rear lifts 73.1 mm per g.
  EXPECT_NEAR(attitude.heave_m * kGravity_mps2, 0.0731, 0.005 * 0.0731);
  // Roll 8.80 deg per g with the roll centre on the ground.
  EXPECT_NEAR(kinematic::quasi_static_attitude(p, 0.0, kGravity_mps2).roll_rad * 180.0 / std::numbers::pi, 8.80, 0.044);
}

TEST(Kinematic, SteadyBrakingReachesTheDiveAndLowersTheBeam) {
  RunSetup setup = kinematic_setup();
  setup.vehicle.drag_area_m2 = 0.0;
  CarState start;
  start.speed_mps = 40.0;
  StepLoop loop(setup, start);
  loop.set_controls({.brake_01 = 0.3});
  loop.run_to(seconds(6.0));
  const CarState& state = loop.state();
  ASSERT_GT(state.speed_mps, 1.0);
  EXPECT_LT(state.ax_mps2, -2.0);
  EXPECT_NEAR(state.pitch_rad / -state.ax_mps2, 5.2693e-3, 0.005 * 5.2693e-3);
  EXPECT_GT(loop.at(loop.time()).pitch_rad, 0.0);                        // ISO 8855: nose down
  EXPECT_LT(aim_from_pitch_rad(loop.at(loop.time()).pitch_rad), -0.01);  // lamp aim: down
  const glm::dmat3 turned = world_from_car(0.0, loop.at(loop.time()).pitch_rad, 0.0);
  EXPECT_LT(turned[0].z, 0.0);  // the car's x points below the horizon
}

TEST(Kinematic, LeftTurnRollsTheRightSideDown) {
  RunSetup setup = kinematic_setup();
  CarState start;
  start.speed_mps = 15.0;
  StepLoop loop(setup, start);
  loop.set_controls({.steering_wheel_rad = 0.5, .accelerator_01 = 0.1});
  loop.run_to(seconds(4.0));
  const VehicleState out = loop.at(loop.time());
  EXPECT_GT(out.ay_mps2, 0.5);
  EXPECT_GT(out.roll_rad, 0.01);
  EXPECT_GT(world_from_car(out.roll_rad, 0.0, 0.0)[1].z, 0.0);  // the left side is up
}

TEST(Kinematic, BrakeStopsWithoutReversing) {
  RunSetup setup = kinematic_setup();
  for (const double brake : {0.05, 0.5, 1.0}) {
    for (const double speed : {20.0, -4.0}) {
      CarState start;
      start.speed_mps = speed;
      StepLoop loop(setup, start);
      loop.set_controls({.brake_01 = brake});
      for (int i = 1; i <= 30'000; ++i) {
        loop.run_to(SimTime{i * 2'000'000ll});
        ASSERT_GE(loop.state().speed_mps * speed, 0.0);
      }
      EXPECT_EQ(loop.state().speed_mps, 0.0);
    }
  }
}

TEST(Kinematic, StandsStillBitForBitForTenMinutes) {
  for (const bool slope : {false, true}) {
    RunSetup setup = kinematic_setup();
    if (slope) setup.road = test::tilted_plane(0.2, 0.05);
    CarState start;
    start.speed_mps = 5.0;
    StepLoop loop(setup, start);
    loop.set_controls({.steering_wheel_rad = 0.3, .brake_01 = 0.8});
    loop.run_to(seconds(15.0));
    const CarState settled = loop.state();
    EXPECT_EQ(settled.speed_mps, 0.0);
    loop.run_to(seconds(615.0));
    EXPECT_EQ(loop.state(), settled);
    EXPECT_EQ(state_hash(loop.state()), state_hash(settled));
  }
}

TEST(Kinematic, StandingOnTwentyPercentPitchesByGravity) {
  // 20 % uphill, brakes on: suspension 10.14 mrad nose up (dive per m/s2 times g sin 11.31 deg = 1.9232).
  RunSetup setup = kinematic_setup();
  setup.road = test::tilted_plane(0.2, 0.0);
  StepLoop loop(setup, CarState{});
  loop.set_controls({.brake_01 = 1.0});
  loop.run_to(seconds(20.0));
  EXPECT_NEAR(loop.state().pitch_rad, -10.14e-3, 0.005 * 10.14e-3);
  EXPECT_NEAR(loop.state().road_pitch_rad, -std::atan(0.2), 1e-12);
}

TEST(Kinematic, GradeAndBankOnATiltedPlane) {
  // The body's z must be the plane's normal, whatever the heading.
  RunSetup setup = kinematic_setup();
  setup.road = test::tilted_plane(0.12, -0.07);
  const glm::dvec3 normal = setup.road.at(0.0, 0.0)->normal;
  for (double yaw = -3.0; yaw <= 3.0; yaw += 0.5) {
    CarState start;
    start.x_m = 20.0, start.y_m = 10.0, start.yaw_rad = yaw;
    const StepLoop loop(setup, start);
    const CarState& s = loop.state();
    EXPECT_NEAR(s.z_m, 0.12 * 20.0 - 0.07 * 10.0, 1e-12);
    const glm::dvec3 up = world_from_car(s.road_roll_rad, s.road_pitch_rad, s.yaw_rad)[2];
    EXPECT_NEAR(up.x, normal.x, 1e-12);
    EXPECT_NEAR(up.y, normal.y, 1e-12);
    EXPECT_NEAR(up.z, normal.z, 1e-12);
  }
  // Left side up is roll > 0; uphill is pitch < 0.
  CarState north;
  north.yaw_rad = 0.5 * std::numbers::pi;
  EXPECT_LT(StepLoop(setup, north).state().road_roll_rad, 0.0);   // x falls to the left (west)
  EXPECT_GT(StepLoop(setup, north).state().road_pitch_rad, 0.0);  // y falls to the north
}

TEST(Kinematic, CoastsDownAsTheClosedForm) {
  // v = v0 / (1 + k v0 t / m_e), aero only; published for the 320i with CdA 0.65: 29.940, 27.173, 24.874, 19.840 m/s.
  RunSetup setup = kinematic_setup();
  setup.vehicle.rolling_coefficient = 0.0;
  setup.vehicle.drag_area_m2 = 0.65;
  CarState start;
  start.speed_mps = 120.0 / 3.6;
  StepLoop loop(setup, start);
  loop.set_controls({.gear = Gear::kNeutral});
  for (const auto& [time_s, speed] : {std::pair{10.0, 29.940}, {20.0, 27.173}, {30.0, 24.874}, {60.0, 19.840}}) {
    loop.run_to(seconds(time_s));
    EXPECT_NEAR(loop.state().speed_mps, speed, 0.005 * speed);
  }
}

TEST(Kinematic, GearsAndPark) {
  RunSetup setup = kinematic_setup();
  StepLoop loop(setup, CarState{});
  loop.set_controls({.accelerator_01 = 0.5, .gear = Gear::kReverse});
  loop.run_to(seconds(2.0));
  EXPECT_LT(loop.state().speed_mps, -1.0);
  loop.set_controls({.accelerator_01 = 1.0, .gear = Gear::kDrive});
  loop.run_to(seconds(6.0));
  EXPECT_GT(loop.state().speed_mps, 1.0);
  setup.road = test::tilted_plane(0.2, 0.0);
  StepLoop parked(setup, CarState{});
  parked.set_controls({.accelerator_01 = 1.0, .gear = Gear::kPark});
  parked.run_to(seconds(5.0));
  EXPECT_EQ(parked.state().speed_mps, 0.0);
  StepLoop rolling(setup, CarState{});
  rolling.set_controls({.gear = Gear::kNeutral});
  rolling.run_to(seconds(2.0));
  EXPECT_LT(rolling.state().speed_mps, -2.0);  // rolls back down the hill
}

TEST(Kinematic, WildSteeringStaysWithinGripAndFinite) {
  RunSetup setup = kinematic_setup();
  CarState start;
  start.speed_mps = 120.0 / 3.6;
  StepLoop loop(setup, start);
  for (int i = 0; i < 5000; ++i) {
    loop.set_controls({.steering_wheel_rad = (i / 8) % 2 ? 1e6 : -1e6, .accelerator_01 = 0.5});
    loop.run_to(SimTime{(i + 1) * 2'000'000ll});
    const VehicleState out = loop.at(loop.time());
    ASSERT_TRUE(std::isfinite(out.x_m) && std::isfinite(out.roll_rad));
    ASSERT_LE(std::abs(out.ay_mps2), 1.2 * kGravity_mps2);
    ASSERT_LT(std::abs(out.roll_rad), 25.0 * std::numbers::pi / 180.0);
  }
}

}  // namespace
}  // namespace phare
