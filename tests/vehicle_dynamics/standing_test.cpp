// unit: a drive begins where a car that has stood there stands: nothing moves in the first seconds, at any level, on
// any slope and bank that its brakes hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "full_car.h"
#include "vehicle_dynamics/batch.h"

namespace phare {
namespace {

constexpr Level kLevelsThatStand[] = {Level::kKinematic, Level::kSingleTrack, Level::kFull, Level::kAuto};

struct Standpoint {
  const char* what;
  double up, aside;
};
constexpr Standpoint kStandpoints[] = {{"level", 0.0, 0.0},
                                       {"20 % up", 0.2, 0.0},
                                       {"15 % down", -0.15, 0.0},
                                       {"bank of 10 %", 0.0, 0.1},
                                       {"both", 0.12, -0.08}};

// Rounding: a slope of 0.2 over 500 m of mesh has its heights to 1e-14 m, of which the springs make some 1e-12 m/s2,
// and two seconds of that are 1e-11 m and less. Brakes are dry friction, so they add nothing.
constexpr double kStill_m = 2e-9, kStill_rad = 2e-9;

TEST(Standing, NothingMovesLive) {
  for (const char* file : {"hatchback.toml", "bmw_320i.toml"})
    for (const Standpoint& ground : kStandpoints)
      for (const Level level : kLevelsThatStand) {
        RunSetup setup;
        setup.level = level;
        setup.vehicle = test::car(file);
        setup.sprung = *SprungParams::of(setup.vehicle, file);
        setup.road = test::tilted_plane(ground.up, ground.aside);
        CarState start;
        start.yaw_rad = 0.3;
        StepLoop loop(std::move(setup), start);
        Controls held;
        held.brake_01 = 1.0;
        loop.set_controls(held);
        loop.run_to(SimTime{});
        const VehicleState first = loop.at(loop.time());
        double moved_m = 0.0, turned_rad = 0.0;
        for (int k = 1; k <= 100; ++k) {
          loop.run_to(test::seconds(0.02 * k));
          const VehicleState now = loop.at(loop.time());
          moved_m =
              std::max({moved_m, std::hypot(now.x_m - first.x_m, now.y_m - first.y_m), std::abs(now.z_m - first.z_m)});
          turned_rad = std::max({turned_rad, std::abs(now.pitch_rad - first.pitch_rad),
                                 std::abs(now.roll_rad - first.roll_rad), std::abs(now.yaw_rad - first.yaw_rad)});
        }
        EXPECT_LT(moved_m, kStill_m) << file << ", " << ground.what << ", " << name(level);
        EXPECT_LT(turned_rad, kStill_rad) << file << ", " << ground.what << ", " << name(level);
      }
}

TEST(Standing, NothingMovesInBatch) {
  for (const Standpoint& ground : kStandpoints)
    for (const Level level : kLevelsThatStand)
      for (const bool parked : {false, true}) {
        Road road;
        road.slope_x = ground.up, road.slope_y = ground.aside;
        batch::Inputs in;
        in.time_s = {0.0, 2.0}, in.steer_rad = {0.0, 0.0}, in.accelerator_01 = {0.0, 0.0};
        in.brake_01 = parked ? std::vector{0.0, 0.0} : std::vector{0.8, 0.8};
        in.parking_01 = parked ? std::vector{1.0, 1.0} : std::vector<double>{};
        batch::Options o;
        o.vehicle = test::car("bmw_320i.toml"), o.vehicle_place = "320i";
        o.level = level, o.integrator = batch::integrator_of(level), o.road = &road;
        std::optional<batch::Row> first;
        double moved_m = 0.0, turned_rad = 0.0, rate = 0.0;
        ASSERT_TRUE(batch::run(o, in, [&](const batch::Row& row) {
                      if (!first) first = row;
                      moved_m = std::max({moved_m, std::hypot(row.x_m - first->x_m, row.y_m - first->y_m),
                                          std::abs(row.z_m - first->z_m)});
                      turned_rad = std::max({turned_rad, std::abs(row.pitch_rad - first->pitch_rad),
                                             std::abs(row.roll_rad - first->roll_rad)});
                      rate = std::max({rate, std::abs(row.vx_mps), std::abs(row.pitch_rate_radps)});
                    }).ok());
        const std::string which = std::string(ground.what) + ", " + name(level) + (parked ? ", parked" : "");
        EXPECT_LT(moved_m, kStill_m) << which;
        EXPECT_LT(turned_rad, kStill_rad) << which;
        EXPECT_LT(rate, 1e-8) << which;
      }
}

// What it stands on without brakes it leaves, and it leaves it without a jolt: the grade is the first acceleration.
TEST(Standing, WithoutBrakesItRollsOffEvenly) {
  for (const Level level : {Level::kKinematic, Level::kSingleTrack, Level::kFull}) {
    Road road;
    road.slope_x = 0.1;
    batch::Inputs in;
    in.time_s = {0.0, 1.0}, in.steer_rad = in.accelerator_01 = in.brake_01 = {0.0, 0.0};
    batch::Options o;
    o.vehicle = test::car("bmw_320i.toml"), o.vehicle_place = "320i";
    o.level = level, o.integrator = batch::integrator_of(level), o.road = &road;
    double least = 1e9, most = -1e9, end_mps = 0.0;
    ASSERT_TRUE(batch::run(o, in, [&](const batch::Row& row) {
                  least = std::min(least, row.pitch_rad), most = std::max(most, row.pitch_rad), end_mps = row.vx_mps;
                }).ok());
    EXPECT_NEAR(end_mps, -0.8, 0.1) << name(level);  // 9.81 sin(5.7 deg) less rolling and the wheels' inertia
    // Pitch follows what comes up meanwhile, rolling resistance and the wheels' own inertia, 0.25 m/s2 at 5.27 mrad
    // each (dive of this car); put on the road as on level ground it would swing by the grade's own 5.2 mrad.
    EXPECT_LT(most - least, 0.25 * 5.27e-3) << name(level);
  }
}

}  // namespace
}  // namespace phare
