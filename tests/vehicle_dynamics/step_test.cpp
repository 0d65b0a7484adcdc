// The loop: repeatability, catch-up, overload, bad input.
#include "vehicle_dynamics/step.h"

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "test_car.h"

namespace phare {
namespace {

using test::kinematic_setup;
using test::seconds;

Controls controls_at(double t) {
  return {.steering_wheel_rad = 0.8 * std::sin(0.7 * t),
          .accelerator_01 = std::max(0.0, std::sin(0.31 * t)),
          .brake_01 = std::max(0.0, -std::sin(0.31 * t)),
          .gear = Gear::kDrive};
}

TEST(StepLoop, SixtySecondsGiveTheSameHashTwice) {
  std::uint64_t hash[2]{};
  for (std::uint64_t& run : hash) {
    RunSetup setup = kinematic_setup("hatchback.toml");
    setup.road = test::tilted_plane(0.03, -0.02, 3000.0);
    StepLoop loop(setup, CarState{});
    for (std::int64_t frame = 0; frame <= 3600; ++frame) {
      const SimTime time = frame_time(frame, 60);
      loop.set_controls(controls_at(time.seconds()));
      loop.run_to(time);
      run = run * 31 + loop.at(time).state_hash;
    }
    EXPECT_EQ(loop.steps(), 30'000u);
    EXPECT_GT(std::hypot(loop.state().x_m, loop.state().y_m), 10.0);
  }
  EXPECT_EQ(hash[0], hash[1]);
}

// What a killed process left is whole: its successor goes on bit for bit, at every level, wherever the kill fell.
TEST(StepLoop, GoesOnBitForBitFromWhatAnotherLeft) {
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull, Level::kAuto}) {
    RunSetup setup = kinematic_setup();
    setup.level = level;
    setup.levelling = levelling::Kind::kDynamic;
    setup.road = test::tilted_plane(0.02, -0.01, 3000.0);
    Result<SprungParams> sprung = SprungParams::of(setup.vehicle, "test");
    ASSERT_TRUE(sprung) << sprung.error().text();
    setup.sprung = *sprung;
    StepLoop loop(setup, CarState{});
    std::optional<StepLoop> successor;
    std::mt19937 random(11);
    for (std::int64_t frame = 1; frame <= 900; ++frame) {
      const SimTime time = frame_time(frame, 60);
      for (StepLoop* each : {&loop, successor ? &*successor : nullptr}) {
        if (each == nullptr) continue;
        each->set_controls(controls_at(time.seconds()));
        each->run_to(time);
      }
      if (successor) {
        ASSERT_EQ(successor->at(time), loop.at(time)) << name(level) << ", frame " << frame;
        ASSERT_EQ(successor->hashes_after(loop.steps() - 8), loop.hashes_after(loop.steps() - 8));
      }
      if (random() % 50 != 0) continue;
      const StepLoop::Memory memory = loop.memory();
      successor.emplace(RunSetup(setup), CarState{});
      successor->recall(memory);
      ASSERT_EQ(successor->at(time), loop.at(time));
    }
    ASSERT_TRUE(successor);
    EXPECT_GT(std::hypot(loop.state().x_m, loop.state().y_m), 10.0);
  }
}

TEST(StepLoop, TheClockOfASuccessorGoesOnFromTheTimeThatWasLeft) {
  StepLoop loop(kinematic_setup(), CarState{}), successor(kinematic_setup(), CarState{});
  loop.catch_up(SimTime{40'000'000});
  loop.catch_up(SimTime{400'000'000});  // of which some is dropped
  ASSERT_GT(loop.dropped().ns, 0);
  successor.recall(loop.memory());
  successor.begin_clock();
  EXPECT_EQ(successor.catch_up(SimTime{}), 0);
  EXPECT_EQ(successor.time(), loop.time());
  EXPECT_EQ(successor.catch_up(SimTime{20'000'000}), 10);
  EXPECT_EQ(successor.dropped(), loop.dropped());
}

TEST(StepLoop, JitterOfTheClockChangesNothing) {
  const RunSetup setup = kinematic_setup();
  StepLoop even(setup, CarState{}), jittery(setup, CarState{});
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int64_t> wake_ns(1'000'000, 33'000'000);
  std::int64_t elapsed_ns = 0;
  for (int i = 0; i < 600; ++i) {
    elapsed_ns += wake_ns(random);
    jittery.set_controls({.steering_wheel_rad = 0.4, .accelerator_01 = 0.6});
    jittery.catch_up(SimTime{elapsed_ns});
  }
  even.set_controls({.steering_wheel_rad = 0.4, .accelerator_01 = 0.6});
  even.run_to(jittery.time());
  EXPECT_EQ(even.steps(), jittery.steps());
  EXPECT_EQ(even.state(), jittery.state());
  EXPECT_EQ(jittery.dropped().ns, 0);
}

TEST(StepLoop, StallIsCappedAndDropped) {
  StepLoop loop(kinematic_setup(), CarState{});
  EXPECT_EQ(loop.max_catch_up(), 25);
  EXPECT_EQ(loop.catch_up(seconds(0.020)), 10);
  EXPECT_EQ(loop.catch_up(seconds(0.520)), 25);  // 250 due after 500 ms of stall
  EXPECT_EQ(loop.dropped().ns, 450'000'000);
  EXPECT_EQ(loop.drops(), 1u);
  EXPECT_EQ(loop.catch_up(seconds(0.524)), 2);  // and goes on from there
  EXPECT_DOUBLE_EQ(loop.at(loop.time()).lag_s, 0.45);
}

TEST(StepLoop, SustainedOverloadSettles) {
  // A step takes three times its share of wall time: the work of a wake-up must not grow.
  StepLoop loop(kinematic_setup(), CarState{});
  std::int64_t wall_ns = 0, most = 0;
  for (int wake = 0; wake < 1000; ++wake) {
    const int steps = loop.catch_up(SimTime{wall_ns});
    most = std::max<std::int64_t>(most, steps);
    wall_ns += std::max(1, steps) * 6'000'000ll;
  }
  EXPECT_LE(most, 25);
  EXPECT_GT(loop.dropped().ns, 0);
  const std::int64_t behind_ns = wall_ns - loop.dropped().ns - loop.time().ns;
  EXPECT_LE(behind_ns, 25 * 6'000'000ll);  // all the rest of the lag is accounted for as dropped
}

TEST(StepLoop, PauseHoldsTheCar) {
  StepLoop loop(kinematic_setup(), CarState{});
  loop.catch_up(seconds(0.040));
  loop.skip(seconds(10.0));
  EXPECT_EQ(loop.catch_up(seconds(10.040)), 0);
  EXPECT_EQ(loop.catch_up(seconds(10.044)), 2);
  EXPECT_EQ(loop.dropped().ns, 0);
}

TEST(StepLoop, BadInputIsRefused) {
  StepLoop loop(kinematic_setup(), CarState{});
  loop.set_controls({.steering_wheel_rad = 0.1, .accelerator_01 = 0.5});
  loop.run_to(seconds(1.0));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  loop.set_controls({.steering_wheel_rad = kNan});
  loop.set_controls({.accelerator_01 = kInf});
  loop.set_controls({.brake_01 = -kInf});
  loop.set_controls({.gear = static_cast<Gear>(9)});
  EXPECT_EQ(loop.controls_refused(), 4u);
  StepLoop same(kinematic_setup(), CarState{});
  same.set_controls({.steering_wheel_rad = 0.1, .accelerator_01 = 0.5});
  same.run_to(seconds(2.0));
  loop.run_to(seconds(2.0));
  EXPECT_EQ(loop.state(), same.state());  // the last good controls were held
  loop.set_controls({.steering_wheel_rad = 1e308, .accelerator_01 = 1e308, .brake_01 = -1e308});
  loop.run_to(seconds(4.0));
  EXPECT_TRUE(std::isfinite(loop.state().x_m) && std::isfinite(loop.state().roll_rad));
}

TEST(StepLoop, OutputLiesBetweenTheLastTwoSteps) {
  CarState start;
  start.speed_mps = 30.0;
  StepLoop loop(kinematic_setup(), start);
  loop.set_controls({.accelerator_01 = 1.0});
  loop.run_to(SimTime{1'000'000});  // half a step: one step is done
  EXPECT_EQ(loop.steps(), 1u);
  EXPECT_NEAR(loop.at(SimTime{1'000'000}).x_m, 0.5 * loop.state().x_m, 1e-12);
  EXPECT_EQ(loop.at(loop.time()).x_m, loop.state().x_m);
}

TEST(StepLoop, GoesOnAfterARestart) {
  RunSetup setup = kinematic_setup();
  setup.road = test::tilted_plane(0.05, 0.02);
  CarState start;
  start.speed_mps = 12.0;
  StepLoop whole(setup, start);
  whole.set_controls({.steering_wheel_rad = 0.3, .accelerator_01 = 0.4});
  const SimTime cut = frame_time(61, 60), end = frame_time(120, 60);
  whole.run_to(cut);
  const VehicleState drawn = whole.at(cut);
  StepLoop successor(setup, from_message(drawn, setup.vehicle.wheelbase_m, setup.vehicle.track_m), cut, drawn.step);
  const VehicleState first = successor.at(cut);
  EXPECT_NEAR(first.x_m, drawn.x_m, 1e-9);
  EXPECT_NEAR(first.z_m, drawn.z_m, 1e-9);
  EXPECT_NEAR(first.pitch_rad, drawn.pitch_rad, 1e-9);
  EXPECT_EQ(first.step, drawn.step);
  successor.set_controls({.steering_wheel_rad = 0.3, .accelerator_01 = 0.4});
  whole.run_to(end);
  successor.run_to(end);
  EXPECT_NEAR(successor.at(end).x_m, whole.at(end).x_m, 1e-3);
  EXPECT_NEAR(successor.at(end).pitch_rad, whole.at(end).pitch_rad, 1e-5);
}

TEST(StepLoop, BesideTheRoadTheHeightIsHeld) {
  RunSetup setup = kinematic_setup();
  setup.road = test::tilted_plane(0.1, 0.0, 20.0);
  CarState start;
  start.speed_mps = 15.0;
  StepLoop loop(setup, start);
  loop.run_to(seconds(1.0));
  EXPECT_FALSE(loop.off_road());
  loop.run_to(seconds(6.0));
  EXPECT_TRUE(loop.off_road());
  EXPECT_GT(loop.state().x_m, 25.0);
  EXPECT_LT(loop.state().z_m, 2.1);
  EXPECT_GT(loop.state().z_m, 1.5);
}

// What lies on a road ends with it: a wheel beside it stands as high as it last did, and does not take the roughness on
// top of its last height again in every step.
TEST(StepLoop, BesideARoughRoadTheHeightIsHeld) {
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
    SCOPED_TRACE(static_cast<int>(level));
    RunSetup setup = kinematic_setup();
    setup.level = level;
    setup.road = test::tilted_plane(0.0, 0.0, 20.0);
    setup.on_top.profiles.push_back(HeightProfile::iso8608(RoughnessClass::kC, 7));
    Result<SprungParams> sprung = SprungParams::of(setup.vehicle, "test");
    ASSERT_TRUE(sprung) << sprung.error().text();
    setup.sprung = *sprung;
    CarState start;
    start.speed_mps = 15.0;
    StepLoop loop(setup, start);
    loop.run_to(seconds(4.0));
    ASSERT_TRUE(loop.off_road());
    ASSERT_GT(loop.state().x_m, 40.0);
    // Class C is 6 mm rms over all its waves, and its highest point of 1 km below 3 cm.
    for (const double z : loop.state().contact_z_m) EXPECT_LT(std::abs(z), 0.03);
  }
}

// The lever of the parking brake alone, in neutral on 12 %: half of the brakes, at the rear wheels, holds every level;
// let go, every level rolls.
TEST(StepLoop, ParkingBrakeHoldsOnAGrade) {
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull, Level::kAuto}) {
    RunSetup setup = kinematic_setup("hatchback.toml");
    setup.level = level;
    setup.road = test::tilted_plane(0.12, 0.0);
    setup.sprung = *SprungParams::of(setup.vehicle, "");
    StepLoop loop(std::move(setup), CarState{});
    loop.set_controls({.gear = Gear::kNeutral, .parking_brake_01 = 1.0});
    loop.run_to(seconds(5.0));
    const double x = loop.state().x_m;
    loop.run_to(seconds(20.0));
    EXPECT_NEAR(loop.state().x_m, x, 1e-6) << name(level);
    EXPECT_NEAR(x, 0.0, 0.02) << name(level);
    loop.set_controls({.gear = Gear::kNeutral});
    loop.run_to(seconds(24.0));
    EXPECT_LT(loop.state().speed_mps, -1.0) << name(level);
  }
}

// A wall across the road, a road a mile high, a kerb that turns the car over: whatever the models make of it, no state
// that is not a number leaves the loop, and the reason is told once and for all.
TEST(StepLoop, LostCarStaysWhereItWas) {
  for (const Level level : {Level::kSingleTrack, Level::kFull, Level::kAuto})
    for (const double height_m : {3.0, 1e3, 1e9}) {
      RunSetup setup = kinematic_setup("vw_vanagon.toml");
      setup.level = level;
      setup.sprung = *SprungParams::of(setup.vehicle, "");
      setup.on_top.profiles.push_back(
          HeightProfile::bumps({{.shape = Bump::Shape::kStep, .start_m = 20.0, .height_m = height_m, .right = false}}));
      CarState start;
      start.speed_mps = 25.0;
      StepLoop loop(std::move(setup), start);
      const auto ends = [&loop] {
        const auto fields = fields_of(loop.state());
        return std::all_of(fields.begin(), fields.end(), [](double v) { return std::isfinite(v); });
      };
      for (int i = 0; i < 400; ++i) {
        loop.run_to(seconds(0.01 * (i + 1)));
        ASSERT_TRUE(ends()) << name(level) << ' ' << height_m << ' ' << i;
        const VehicleState sent = loop.at(loop.time());
        ASSERT_TRUE(std::isfinite(sent.x_m + sent.y_m + sent.z_m + sent.roll_rad + sent.vx_mps + sent.vy_mps));
      }
      if (level == Level::kSingleTrack && !loop.out_of_play()) continue;  // its linear springs follow any road
      ASSERT_NE(loop.out_of_play(), nullptr) << name(level) << ' ' << height_m;
      const CarState before = loop.state();
      loop.set_controls({.accelerator_01 = 1.0});
      loop.run_to(seconds(6.0));
      EXPECT_EQ(loop.state(), before);
    }
}

TEST(StepLoop, TenThousandKilometresFromTheOriginNothingChanges) {
  const RunSetup setup = kinematic_setup();
  CarState near, far;
  far.x_m = 1e7;
  near.speed_mps = far.speed_mps = 20.0;
  StepLoop a(setup, near), b(setup, far);
  for (int frame = 0; frame < 600; ++frame) {
    for (StepLoop* loop : {&a, &b}) {
      loop->set_controls(controls_at(frame / 60.0));
      loop->run_to(frame_time(frame, 60));
    }
  }
  EXPECT_NEAR(b.state().x_m - 1e7, a.state().x_m, 1e-5);  // 5000 sums at an ulp of 1.9e-9 m
  EXPECT_EQ(a.state().yaw_rad, b.state().yaw_rad);
}

TEST(StepLoop, StepTimesAreReported) {
  StepLoop loop(kinematic_setup(), CarState{});
  loop.run_to(seconds(20.0));
  EXPECT_EQ(loop.times().count(), 10'000u);
  std::printf("kinematic step: p50 %.0f ns, p99 %.0f ns, p99.9 %.0f ns\n", loop.times().quantile_ns(0.5),
              loop.times().quantile_ns(0.99), loop.times().quantile_ns(0.999));
  EXPECT_LE(loop.times().quantile_ns(0.5), loop.times().quantile_ns(0.99));
}

TEST(Level, NamesThoseThereAre) {
  EXPECT_TRUE(parse_level("pose", "--level").ok());
  for (const char* level : {"kinematic", "single-track", "full", "auto"}) {
    const Result<Level> read = parse_level(level, "--level");
    ASSERT_TRUE(read.ok());
    EXPECT_STREQ(name(*read), level);
  }
  const Result<Level> unknown = parse_level("best", "--level");
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().text(),
            "--level: level \"best\" is unknown; there are pose, kinematic, single-track, full, auto");
}

TEST(StepTimes, QuantilesWithinABucket) {
  StepTimes times;
  for (int i = 1; i <= 10'000; ++i) times.add(std::chrono::nanoseconds(i));
  EXPECT_NEAR(times.quantile_ns(0.5), 5000.0, 0.13 * 5000.0);
  EXPECT_NEAR(times.quantile_ns(0.99), 9900.0, 0.13 * 9900.0);
  EXPECT_EQ(times.max_ns(), 10'000u);
}

}  // namespace
}  // namespace phare
