// Unit: pedals to wheel torques, the same at every level: power, gearbox, creep, hill hold, ABS.
#include "vehicle_dynamics/models/powertrain.h"

#include <gtest/gtest.h>

#include "config/base/conventions.h"
#include "full_car.h"

namespace phare {
namespace {

constexpr std::array<Level, 3> kLevels{Level::kKinematic, Level::kSingleTrack, Level::kFull};

RunSetup level_setup(const char* file, Level level) {
  RunSetup setup = test::kinematic_setup(file);
  setup.level = level;
  setup.sprung = *SprungParams::of(setup.vehicle, file);
  return setup;
}

CarState at_speed(double mps) {
  CarState s;
  s.speed_mps = mps;
  return s;
}

// The engine gives its power, whatever the wheels do: spun up on a slippery road they turn as fast as that lets them.
TEST(Powertrain, SpinningWheelsTakeNoMoreThanThePower) {
  const VehicleParams vehicle = test::car("bmw_320i.toml");  // no [engine]
  const full::Params p = *full::params_of(vehicle, "");
  Road wet;
  wet.friction_everywhere = 0.3;
  test::Drive d(p, 0.0, &wet);
  d.input.air_and_rolling = true;
  powertrain::State power;
  double given_j = 0.0, most_w = 0.0;
  d.run(10.0, 0.002, [&](test::Drive& now) {
    const auto torque = powertrain::advance(vehicle, {.accelerator_01 = 1.0}, now.state.u_mps,
                                            full::wheels(p, now.input, now.state), power, 0.002);
    now.input.drive_nm = torque.drive_nm;
    double watts = 0.0;
    for (std::size_t i = 0; i < 4; ++i) watts += torque.drive_nm[i] * now.state.spin_radps[i];
    most_w = std::max(most_w, watts), given_j += 0.002 * watts;
  });
  EXPECT_LE(most_w, vehicle.max_power_w * (1.0 + 1e-9));
  EXPECT_LE(given_j, vehicle.max_power_w * 10.0);
  for (const double spin : d.state.spin_radps) EXPECT_LT(spin * p.radius_m, 150.0);
}

// Every level has the engine of the vehicle file: the same foot gives the same pull, and lifted it drags.
TEST(Powertrain, EveryLevelHasTheSameEngine) {
  for (const double foot : {0.1, 0.3, 0.5})  // more, and the wheels of level full spin
    for (const double speed : {8.0, 15.0, 30.0}) {
      std::array<double, 3> reached{};
      for (std::size_t k = 0; k < 3; ++k) {
        StepLoop loop(level_setup("hatchback.toml", kLevels[k]), at_speed(speed));
        loop.set_controls({.accelerator_01 = foot});
        loop.run_to(test::seconds(2.0));
        reached[k] = loop.state().speed_mps;
      }
      // What slips and squats: 2 % of the speed that is gained, and 1 cm/s.
      const double gained = std::abs(reached[2] - speed);
      EXPECT_NEAR(reached[0], reached[2], 0.02 * gained + 0.01) << foot << ' ' << speed;
      EXPECT_NEAR(reached[1], reached[2], 0.02 * gained + 0.01) << foot << ' ' << speed;
      if (foot == 0.1 && speed == 15.0) {
        EXPECT_LT(reached[0], speed);
      }
    }
}

TEST(Powertrain, ReverseIsRefusedWhileRollingForwards) {
  for (const char* file : {"hatchback.toml", "bmw_320i.toml"})
    for (const Level level : kLevels) {
      StepLoop in_reverse(level_setup(file, level), at_speed(20.0)), coasting(level_setup(file, level), at_speed(20.0));
      in_reverse.set_controls({.accelerator_01 = 1.0, .gear = Gear::kReverse});
      coasting.set_controls({.gear = Gear::kNeutral});
      for (StepLoop* loop : {&in_reverse, &coasting}) loop->run_to(test::seconds(3.0));
      EXPECT_EQ(in_reverse.state().speed_mps, coasting.state().speed_mps) << file << ' ' << name(level);
    }
}

// At a constant foot the level settles: the levels agree on what the car does, so none calls for the other.
TEST(Powertrain, AutoDoesNotHuntAtAConstantFoot) {
  for (const double foot : {0.05, 0.1, 0.2, 0.3, 0.5}) {
    StepLoop loop(level_setup("hatchback.toml", Level::kAuto), at_speed(15.0));
    loop.set_controls({.accelerator_01 = foot});
    loop.run_to(test::seconds(40.0));
    EXPECT_LE(loop.choice().switches(), 6u) << foot;
  }
}

TEST(Powertrain, CreepsInGearAsTheVehicleFileSays) {
  for (const Level level : kLevels)
    for (const Gear gear : {Gear::kDrive, Gear::kReverse, Gear::kNeutral}) {
      RunSetup setup = level_setup("hatchback.toml", level);
      StepLoop without(setup, CarState{});
      setup.vehicle.creep_force_n = 500.0, setup.vehicle.creep_speed_mps = 6.0 / 3.6;
      StepLoop creeps(setup, CarState{}), held(setup, CarState{});
      for (StepLoop* loop : {&without, &creeps}) loop->set_controls({.gear = gear});
      held.set_controls({.brake_01 = 0.2, .gear = gear});
      for (StepLoop* loop : {&without, &creeps, &held}) loop->run_to(test::seconds(20.0));
      // 500 N less what rolls and drags (137 N) is 0.73 of it: at 0.27 of the way to nothing, 0.73 of 6 km/h.
      const double expected = gear == Gear::kDrive ? 1.21 : gear == Gear::kReverse ? -1.21 : 0.0;
      EXPECT_NEAR(creeps.state().speed_mps, expected, 0.03) << name(level) << ' ' << static_cast<int>(gear);
      EXPECT_NEAR(without.state().speed_mps, 0.0, 1e-6) << name(level);
      EXPECT_NEAR(held.state().speed_mps, 0.0, 1e-6) << name(level);
    }
}

TEST(Powertrain, HillHoldKeepsTheBrakeForItsTime) {
  for (const Level level : kLevels) {
    RunSetup setup = level_setup("hatchback.toml", level);
    setup.road = test::tilted_plane(0.15, 0.0);
    setup.vehicle.hill_hold_s = 2.0;
    StepLoop waits(setup, CarState{}), goes(setup, CarState{});
    for (StepLoop* loop : {&waits, &goes}) {
      loop->set_controls({.brake_01 = 0.6});
      loop->run_to(test::seconds(3.0));
      loop->set_controls({});
      loop->run_to(test::seconds(4.8));
      EXPECT_NEAR(loop->state().speed_mps, 0.0, 1e-3) << name(level);
    }
    waits.run_to(test::seconds(7.0));
    EXPECT_LT(waits.state().speed_mps, -0.5) << name(level);  // then it rolls back
    goes.set_controls({.accelerator_01 = 0.8});
    goes.run_to(test::seconds(7.0));
    EXPECT_GT(goes.state().speed_mps, 1.0) << name(level);
  }
}

// ABS uses at least 0.75 of the adhesion (UN R13-H, annex 6, 5.2) on every road and with every step of real time: mean
// deceleration from 45 to 15 km/h over what all wheels at their peak would give.
TEST(Powertrain, AbsUsesTheAdhesionThereIs) {
  for (const char* file : {"bmw_320i.toml", "hatchback.toml", "bmw_m8.toml"})
    for (const double friction : {0.5, 0.3, 0.1, 0.05})
      for (const double dt : {0.001, 0.002, 0.005}) {
        const VehicleParams vehicle = test::car(file);
        const full::Params p = *full::params_of(vehicle, file);
        Road road;
        road.friction_everywhere = friction;
        test::Drive d(p, 16.0, &road);
        powertrain::State power;
        double began_s = 0.0;
        int rises = 0;
        double share_01 = 1.0;
        bool rising = false;
        while (d.state.u_mps > 15.0 / 3.6 && d.time_s < 60.0) {
          const auto torque = powertrain::advance(vehicle, {.brake_01 = 1.0, .gear = Gear::kNeutral}, d.state.u_mps,
                                                  full::wheels(p, d.input, d.state), power, dt);
          d.input.brake_nm = torque.brake_nm;
          d.step(dt);
          if (d.state.u_mps > 45.0 / 3.6) began_s = d.time_s;
          if (power.abs_01[0] != share_01) {
            rises += power.abs_01[0] > share_01 && !rising ? 1 : 0;
            rising = power.abs_01[0] > share_01, share_01 = power.abs_01[0];
          }
        }
        const double mean_mps2 = 30.0 / 3.6 / (d.time_s - began_s);
        EXPECT_GT(mean_mps2, 0.75 * friction * p.tyre.p.long_peak * kGravity_mps2)
            << file << ' ' << friction << ' ' << dt;
        if (dt > 0.002) continue;
        EXPECT_GT(rises / d.time_s, 3.0) << "cycles a second, " << file << ' ' << friction << ' ' << dt;
        EXPECT_LT(rises / d.time_s, 15.0) << file << ' ' << friction << ' ' << dt;
      }
}

}  // namespace
}  // namespace phare
