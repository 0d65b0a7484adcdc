// Hard cases that need the loop with its driver, levels and controls; PHARE_LONG_TESTS=1 gives them their full length.
#include <gtest/gtest.h>

#include <cfenv>
#include <random>

#include "config/conventions.h"
#include "full_car.h"

namespace phare {
namespace {

using test::long_run;

// 3, again: forwards, braked to walking pace, reverse gear while it still rolls, and drive again while it rolls
// backwards; the car turns round each time and never feels more than its tyres hold.
TEST(HardCase, C03GearChangeWhileRolling) {
  RunSetup setup = test::kinematic_setup("hatchback.toml");
  setup.level = Level::kFull;
  setup.sprung = *SprungCar::of(setup.vehicle, "");
  CarState start;
  start.speed_mps = 3.0;
  StepLoop loop(setup, start);
  double slowest = 0.0, hardest = 0.0, at_change = 0.0;
  for (int i = 1; i <= 4000; ++i) {
    const double t = 0.005 * i;
    const bool reverse = t > 1.0 && t<10.0, braking = t> 1.0 && t < 1.9;
    loop.set_controls({.steering_wheel_rad = 1.0,
                       .accelerator_01 = braking ? 0.0 : 0.3,
                       .brake_01 = braking ? 0.3 : 0.0,
                       .gear = reverse ? Gear::kReverse : Gear::kDrive});
    loop.run_to(SimTime{static_cast<std::int64_t>(i) * 5'000'000});
    const CarState& s = loop.state();
    ASSERT_TRUE(std::isfinite(s.x_m) && std::isfinite(s.pitch_rad));
    if (i == 381) at_change = s.speed_mps;  // the brake has just been let go
    slowest = std::min(slowest, s.speed_mps);
    hardest = std::max(hardest, std::hypot(s.ax_mps2, s.ay_mps2));
    if (std::abs(s.speed_mps) > 1.0) {
      ASSERT_GT(s.yaw_rate_radps * s.speed_mps, 0.0) << t;  // left lock: nose left forwards, right backwards
    }
  }
  EXPECT_GT(at_change, 0.2);
  EXPECT_LT(slowest, -3.0);
  EXPECT_GT(loop.state().speed_mps, 3.0);
  EXPECT_LT(hardest, 1.2 * kGravity_mps2);
}

// 13. The steering wheel thrown from lock to lock, 30 times a second, at 120 km/h.
TEST(HardCase, C13SteeringSquareWave) {
  RunSetup setup = test::kinematic_setup("hatchback.toml");
  setup.level = Level::kFull;
  setup.sprung = *SprungCar::of(setup.vehicle, "");
  CarState start;
  start.speed_mps = 120.0 / 3.6;
  StepLoop loop(setup, start);
  double ay = 0.0, roll = 0.0;
  for (int i = 0; i < 600; ++i) {
    loop.set_controls({.steering_wheel_rad = i % 2 == 0 ? 9.0 : -9.0});
    loop.run_to(SimTime{static_cast<std::int64_t>(i + 1) * 1'000'000'000 / 60});
    ay = std::max(ay, std::abs(loop.state().ay_mps2));
    roll = std::max(roll, std::abs(loop.state().roll_rad));
    ASSERT_TRUE(std::isfinite(loop.state().x_m));
  }
  EXPECT_LE(ay, 1.2 * kGravity_mps2);
  EXPECT_LT(roll * test::kDeg, 25.0);
}

// 16. The level changes every half second through lane changes at 50 km/h.
TEST(HardCase, C16LevelSwitches) {
  RunSetup setup = test::kinematic_setup("hatchback.toml");
  setup.sprung = *SprungCar::of(setup.vehicle, "");
  const auto controls = [](double t) {
    return Controls{.steering_wheel_rad = 0.25 * std::sin(1.2 * t), .gear = Gear::kNeutral};
  };
  setup.level = Level::kFull;
  CarState start;
  start.speed_mps = 50.0 / 3.6;
  StepLoop pure(setup, start);
  constexpr std::array<Level, 4> kOrder{Level::kKinematic, Level::kSingleTrack, Level::kFull, Level::kSingleTrack};
  CarState state = start;
  SimTime time{};
  double jump = 0.0, jump_m = 0.0, beside = 0.0, way = 0.0;
  for (int k = 0; k < 120; ++k) {
    setup.level = kOrder[static_cast<std::size_t>(k) % 4];
    StepLoop part(setup, state, time);
    const VehicleState handed = part.at(time);
    jump = std::max(jump, std::abs(handed.pitch_rad - (state.road_pitch_rad + state.pitch_rad)));
    jump_m = std::max(jump_m, std::abs(handed.z_m - (state.z_m + state.heave_m)));
    for (int i = 0; i < 5; ++i) {
      time.ns += 100'000'000;
      const double x = pure.state().x_m, y = pure.state().y_m;
      for (StepLoop* loop : {&part, &pure}) loop->set_controls(controls(time.seconds())), loop->run_to(time);
      way += std::hypot(pure.state().x_m - x, pure.state().y_m - y);
      if (way > 10.0)
        beside = std::max(beside,
                          std::hypot(part.state().x_m - pure.state().x_m, part.state().y_m - pure.state().y_m) / way);
    }
    const double before = state.pitch_rad;
    state = part.state();
    ASSERT_LT(std::abs(state.pitch_rad - before), 0.05);
  }
  EXPECT_LT(jump, 0.05e-3);
  EXPECT_LT(jump_m, 1e-6);
  EXPECT_GT(way, 300.0);
  EXPECT_LT(beside, 0.01);  // at every tenth of a second, of the way travelled
}

// 17. Random inputs over every level and integrator; nothing may become infinite.
TEST(HardCase, C17RandomInputs) {
  std::mt19937_64 random(17);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::feclearexcept(FE_ALL_EXCEPT);
  const long each = (long_run() ? 1'000'000 : 60'000) / 6;
  for (const Integrator integrator : {Integrator::kSemiImplicitEuler, Integrator::kEtd2, Integrator::kRk4})
    for (const Level level : {Level::kSingleTrack, Level::kFull}) {
      RunSetup setup = test::kinematic_setup("hatchback.toml");
      setup.level = level;
      setup.sprung = *SprungCar::of(setup.vehicle, "");
      setup.sprung->set_integrator(integrator);
      setup.on_top.profiles.push_back(HeightProfile::iso8608(RoughnessClass::kC, 3, 200.0));
      setup.on_top.friction = {{.from_m = 30.0, .to_m = 60.0, .left = 0.1, .right = 0.8}};
      StepLoop loop(setup, CarState{});
      for (long i = 0; i < each; ++i) {
        if (i % 50 == 0)
          loop.set_controls({.steering_wheel_rad = uniform(-12.0, 12.0),
                             .accelerator_01 = uniform(-0.5, 1.5),
                             .brake_01 = std::max(0.0, uniform(-2.0, 1.5)),
                             .gear = static_cast<Gear>(random() % 4)});
        loop.run_to(SimTime{(i + 1) * 2'000'000});
        ASSERT_TRUE(std::isfinite(loop.state().x_m) && std::isfinite(loop.state().pitch_rad) &&
                    std::isfinite(loop.state().yaw_rate_radps))
            << name(level) << " step " << i;
        ASSERT_LT(std::abs(loop.state().speed_mps), 120.0);
      }
    }
  EXPECT_EQ(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW), 0);
}

}  // namespace
}  // namespace phare
