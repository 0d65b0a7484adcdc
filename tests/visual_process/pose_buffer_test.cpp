#include "visual/process/pose_buffer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace phare {
namespace {

constexpr double kRadius_m = 80.0, kSpeed_mps = 25.0;

/// A car on a circle to the left at constant speed.
VehicleState on_circle(double t_s) {
  const double rate = kSpeed_mps / kRadius_m, a = rate * t_s;
  VehicleState state;
  state.x_m = kRadius_m * std::sin(a);
  state.y_m = kRadius_m * (1.0 - std::cos(a));
  state.yaw_rad = std::remainder(a, 2.0 * M_PI);
  state.vx_mps = kSpeed_mps * std::cos(a);
  state.vy_mps = kSpeed_mps * std::sin(a);
  state.yaw_rate_radps = rate;
  state.ay_mps2 = kSpeed_mps * rate;
  state.speed_mps = kSpeed_mps;
  return state;
}

SimTime at_s(double seconds) {
  return SimTime{static_cast<std::int64_t>(std::llround(seconds * 1e9))};
}

double distance_m(const VehicleState& a, const VehicleState& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

TEST(PoseBuffer, InterpolatesAndExtrapolatesWithinMicrometres) {
  PoseBuffer poses;
  for (int i = 0; i <= 40; ++i) poses.push(at_s(i * 0.004), on_circle(i * 0.004));
  for (double t_s = 0.11; t_s < 0.164; t_s += 0.00037) {
    const auto drawn = poses.at(at_s(t_s));
    ASSERT_TRUE(drawn.has_value());
    EXPECT_FALSE(drawn->stale);
    EXPECT_LT(distance_m(drawn->pose, on_circle(t_s)), 1e-6) << t_s;
    EXPECT_NEAR(drawn->pose.yaw_rad, on_circle(t_s).yaw_rad, 1e-9);
  }
}

TEST(PoseBuffer, TurnsTheShortWayRound) {
  PoseBuffer poses;
  VehicleState state;
  state.yaw_rad = M_PI - 0.01;
  poses.push(at_s(0.0), state);
  state.yaw_rad = -M_PI + 0.01;
  poses.push(at_s(0.01), state);
  const double yaw_rad = poses.at(at_s(0.005))->pose.yaw_rad;
  EXPECT_NEAR(std::cos(yaw_rad), -1.0, 1e-12);
}

TEST(PoseBuffer, CoastsFor200MillisecondsThenHoldsAndSaysSo) {
  PoseBuffer poses;
  EXPECT_FALSE(poses.at(at_s(0.0)).has_value());
  poses.push(at_s(1.0), on_circle(1.0));
  const auto coasting = poses.at(at_s(1.19));
  EXPECT_FALSE(coasting->stale);
  EXPECT_LT(distance_m(coasting->pose, on_circle(1.19)), 0.02);
  const auto held = poses.at(at_s(1.5)), later = poses.at(at_s(9.0));
  EXPECT_TRUE(held->stale);
  EXPECT_NEAR(held->age_s, 0.5, 1e-9);
  EXPECT_EQ(held->pose.x_m, later->pose.x_m);
  EXPECT_NEAR(distance_m(held->pose, on_circle(1.0)), 5.0, 0.1);  // 200 ms at 25 m/s
}

// The time of the picture stands with a car that is silent for longer than the coast, and does not go back when the car
// comes back where it was left.
TEST(PoseBuffer, TimeToShowStandsWithTheCarAndDoesNotGoBack) {
  const auto at_ms = [](std::int64_t ms) { return SimTime{ms * 1'000'000}; };
  PoseBuffer poses;
  EXPECT_EQ(poses.time_to_show(at_ms(70), std::nullopt), at_ms(70));
  poses.push(at_ms(1000), VehicleState{});
  EXPECT_EQ(poses.time_to_show(at_ms(1150), at_ms(1140)), at_ms(1150));
  EXPECT_EQ(poses.time_to_show(at_ms(9000), at_ms(1190)), at_ms(1200));
  poses.push(at_ms(1004), VehicleState{});  // it goes on where it was
  EXPECT_EQ(poses.time_to_show(at_ms(1004), at_ms(1200)), at_ms(1200));
  EXPECT_EQ(poses.time_to_show(at_ms(1210), at_ms(1200)), at_ms(1204));
  poses.push(at_ms(300), VehicleState{});  // a seek
  EXPECT_EQ(poses.time_to_show(at_ms(300), at_ms(1204)), at_ms(300));
  for (int i = 0; i < 9; ++i) poses.push(at_ms(300), VehicleState{});  // it stands, and is heard of late
  poses.push(at_ms(304), VehicleState{});
  for (int i = 0; i < 9; ++i) poses.push(at_ms(304), VehicleState{});
  EXPECT_EQ(poses.time_to_show(at_ms(304), at_ms(390)), at_ms(390));
  poses.push(at_ms(200), VehicleState{});  // begun anew a little behind, and told twice
  poses.push(at_ms(200), VehicleState{});
  EXPECT_EQ(poses.time_to_show(at_ms(200), at_ms(300)), at_ms(300));
  for (int i = 0; i < 2; ++i) poses.push(at_ms(200), VehicleState{});  // in a pause it comes again and again: a seek
  EXPECT_EQ(poses.time_to_show(at_ms(200), at_ms(300)), at_ms(200));
}

TEST(PoseBuffer, ASeekBackBeginsAnew) {
  PoseBuffer poses;
  poses.push(at_s(5.0), on_circle(5.0));
  poses.push(at_s(1.0), on_circle(1.0));
  EXPECT_LT(distance_m(poses.at(at_s(1.0))->pose, on_circle(1.0)), 1e-9);
  EXPECT_LT(distance_m(poses.at(at_s(0.5))->pose, on_circle(1.0)), 1e-9);  // before the oldest: the oldest
  poses.push(at_s(1.0), on_circle(2.0));  // the same moment again: the newer word counts
  EXPECT_LT(distance_m(poses.at(at_s(1.0))->pose, on_circle(2.0)), 1e-9);
}

TEST(DisplayClock, FollowsTheLeastDelayedMessage) {
  DisplayClock clock;
  EXPECT_FALSE(clock.at(WallTime{0}).has_value());
  constexpr std::int64_t kStart = 1'000'000'000'000;
  for (int i = 0; i < 500; ++i) {
    const std::int64_t sim_ns = i * 4'000'000, late_ns = i % 7 * 300'000;
    clock.observe(SimTime{sim_ns}, WallTime{kStart + sim_ns + late_ns});
  }
  const double error_s = clock.at(WallTime{kStart + 2'000'000'000})->seconds() - 2.0;
  EXPECT_LT(std::abs(error_s), 1e-5);
}

TEST(DisplayClock, StandsWhilePaused) {
  DisplayClock clock;
  for (int i = 0; i < 100; ++i) clock.observe(SimTime{0}, WallTime{(i - 100) * 4'000'000});
  EXPECT_FALSE(clock.stands()) << "the drive has not begun";
  for (int i = 0; i < 100; ++i) clock.observe(SimTime{i * 4'000'000}, WallTime{i * 4'000'000});
  EXPECT_FALSE(clock.stands());
  for (int i = 100; i < 200; ++i) {
    clock.observe(SimTime{99 * 4'000'000}, WallTime{i * 4'000'000});
    EXPECT_NEAR(clock.at(WallTime{i * 4'000'000})->seconds(), 0.396, 1e-9);
    EXPECT_EQ(clock.stands(), i > 99 + 50) << "steps may take 50 ms: told after 200";
  }
  clock.observe(SimTime{100 * 4'000'000}, WallTime{200 * 4'000'000});
  EXPECT_FALSE(clock.stands());
}

}  // namespace
}  // namespace phare
