// unit: where a road ends, and what its driver is told there.
#include "visual/process/road_end.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/visual_process/ground_square.h"
#include "visual/process/screens.h"

namespace phare {
namespace {

/// Along x from -80 m to 80 m.
std::vector<LanePoint> straight_lane() {
  std::vector<LanePoint> lane;
  for (int i = 0; i <= 160; ++i) lane.push_back({.s_m = 1.0 * i, .x_m = i - 80.0, .z_m = 2.0});
  return lane;
}

VehicleState car_at(double x_m, double y_m) {
  VehicleState car;
  car.x_m = x_m;
  car.y_m = y_m;
  car.z_m = 2.0;
  return car;
}

TEST(RoadEnd, IsPastTheLaneAndThenPastTheGround) {
  const Scene scene = ground_square(0.0, "ground");
  const RoadEnd road(scene, straight_lane());
  EXPECT_EQ(road.of(car_at(-80.0, 0.0)), RoadPlace::kThere) << "where the drive starts";
  EXPECT_EQ(road.of(car_at(0.0, 60.0)), RoadPlace::kThere) << "far beside the road is another matter";
  EXPECT_EQ(road.of(car_at(79.0, 3.0)), RoadPlace::kThere);
  EXPECT_EQ(road.of(car_at(85.0, 3.0)), RoadPlace::kPastEnd);
  EXPECT_EQ(road.of(car_at(-85.0, 0.0)), RoadPlace::kPastEnd) << "backwards too";
  EXPECT_EQ(road.of(car_at(101.0, 0.0)), RoadPlace::kNoGround);
  EXPECT_EQ(road.of(car_at(0.0, -101.0)), RoadPlace::kNoGround) << "beside it too";
}

TEST(RoadEnd, ALaneThatGoesRoundHasNone) {
  const Scene scene = ground_square(0.0, "road");
  std::vector<LanePoint> ring;
  for (int i = 0; i < 360; ++i) {
    const double turn = i * M_PI / 180.0;
    ring.push_back(
        {.s_m = 50.0 * turn, .x_m = 50.0 * std::sin(turn), .y_m = -50.0 * std::cos(turn), .heading_rad = turn});
  }
  const RoadEnd road(scene, ring);
  for (const double x_m : {-3.0, 0.0, 3.0}) EXPECT_EQ(road.of(car_at(x_m, -50.0)), RoadPlace::kThere);
}

TEST(RoadEnd, WithoutALaneOrAGroundNothingIsInvented) {
  const Scene scene = ground_square(0.0, "ground");
  EXPECT_EQ(RoadEnd(scene, {}).of(car_at(99.0, 0.0)), RoadPlace::kThere);
  EXPECT_EQ(RoadEnd(scene, {}).of(car_at(101.0, 0.0)), RoadPlace::kNoGround);
  const Scene trees = ground_square(0.0, "tree");  // the car drives on a plane
  EXPECT_EQ(RoadEnd(trees, {}).of(car_at(1000.0, 0.0)), RoadPlace::kThere);
}

TEST(RoadEnd, IsSaidToTheDriver) {
  EXPECT_EQ(road_end_line(RoadPlace::kThere), "");
  EXPECT_NE(road_end_line(RoadPlace::kPastEnd).find("ROAD ENDS"), std::string::npos);
  Screens screens({.kind = ScreensSetup::Kind::kLive});
  const KeyAction up[] = {KeyAction::kAccelerate};
  Desk desk;
  screens.press(up, true, desk, {});
  EXPECT_TRUE(screens.panel({}, 60.0, false).empty());
  screens.set_road(RoadPlace::kPastEnd);
  EXPECT_TRUE(screens.panel({}, 60.0, false).empty()) << "there is road to be seen yet";
  screens.set_road(RoadPlace::kNoGround);
  const OverlayPanel panel = screens.panel({}, 60.0, false);
  EXPECT_EQ(panel.title, "The road has ended");
  ASSERT_FALSE(panel.rows.empty());
  EXPECT_EQ(panel.rows.front().key, binding_of(KeyAction::kBeginAgain)->name);
  screens.set_road(RoadPlace::kThere);
  EXPECT_TRUE(screens.panel({}, 60.0, false).empty());
  // Who looks on at a drive cannot turn round in it.
  Screens replay({.kind = ScreensSetup::Kind::kReplay});
  replay.set_road(RoadPlace::kNoGround);
  EXPECT_TRUE(replay.panel({}, 60.0, false).empty());
}

}  // namespace
}  // namespace phare
