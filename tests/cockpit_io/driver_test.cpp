// The scripted driver: files, speed profile, and a drive over a bend with a car of the simplest kind.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "cockpit_io/driver_source.h"

namespace phare {
namespace {

constexpr const char* kScript =
    "lane = \"lane.csv\"\nend_s_m = 700\n"
    "[car]\nwheelbase_m = 2.6\nsteering_ratio = 15\nfull_throttle_mps2 = 4\npower_wpkg = 60\nfull_brake_mps2 = 9\n"
    "[comfort]\nmax_speed_kmh = 90\nlateral_mps2 = 2.5\naccelerate_mps2 = 2\nbrake_mps2 = 2\n"
    "[[slow]]\nfrom_s_m = 500\nto_s_m = 560\nspeed_kmh = 36\nbrake_mps2 = 6\n"
    "[[event]]\nat_s_m = 100\nlight = \"high\"\n[[event]]\nat_s_m = 200\nlight = \"low\"\n"
    "[[event]]\nat_t_s = 2\nfog = true\n[[event]]\nat_s_m = 300\nflash_s = 0.5\n[[event]]\nat_s_m = 350\ndesign_steps "
    "= 1\n";

/// 200 m straight, a quarter of a circle of 150 m radius to the left, straight on.
std::vector<LanePoint> lane() {
  std::vector<LanePoint> points;
  double x = 0, y = 0, heading = 0;
  for (int s = 0; s <= 800; ++s) {
    const double curvature = s >= 200 && s < 200 + 235 ? 1.0 / 150.0 : 0.0;
    points.push_back({static_cast<double>(s), x, y, 0, heading, curvature});
    x += std::cos(heading + 0.5 * curvature);
    y += std::sin(heading + 0.5 * curvature);
    heading += curvature;
  }
  return points;
}

TEST(DriverScript, ErrorsHavePlaces) {
  EXPECT_TRUE(parse_driver_script(kScript, "s.toml").ok()) << parse_driver_script(kScript, "s.toml").error().text();
  const std::string text = kScript;
  EXPECT_EQ(parse_driver_script(text + "[[event]]\nlight = \"low\"\n", "s.toml").error().place.substr(0, 7), "s.toml:");
  EXPECT_FALSE(parse_driver_script(text + "[[event]]\nat_s_m = 1\nlight = \"laser\"\n", "s.toml").ok());
  EXPECT_FALSE(parse_driver_script("lane = 3\n", "s.toml").ok());
}

TEST(Lane, ErrorsHavePlaces) {
  const auto file = std::filesystem::path(testing::TempDir()) / "phare_lane_test.csv";
  const auto read = [&](const std::string& text) {
    std::ofstream(file) << text;
    return read_lane(file);
  };
  const std::string header = "s_m,x_m,y_m,z_m,heading_rad,curvature_1pm\n";
  EXPECT_TRUE(read(header + "0,1,2,3,4,5\n1.5,1,2,3,-4e-3,5\r\n").ok());
  EXPECT_EQ(read(header + "0,1,2,3,4,5\n0,1,2,3,4,5\n").error().place, file.string() + ":3");
  EXPECT_EQ(read(header + "0,1,2,nan,4,5\n").error().place, file.string() + ":2");
  EXPECT_FALSE(read(header + "0,1,2,3,4,5\n").ok());
  EXPECT_FALSE(read("a,b\n").ok());
  EXPECT_FALSE(read("").ok());
  std::filesystem::remove(file);
  EXPECT_FALSE(read_lane(file).ok());
}

// What a scene has beside it: no file, a start alone, a lane, or a mistake with its place.
TEST(Lane, OfASceneIsALaneNoneOrAnError) {
  const auto scene = std::filesystem::path(testing::TempDir()) / "phare_scene.glb";
  const auto beside = [&](const std::string& text) {
    std::ofstream(lane_file_of(scene)) << text;
    return lane_beside(scene);
  };
  std::filesystem::remove(lane_file_of(scene));
  EXPECT_TRUE(lane_beside(scene)->empty());
  EXPECT_TRUE(beside("x_m,y_m,z_m,heading_rad\n1,2,3,0\n")->empty());
  const std::string header = "s_m,x_m,y_m,z_m,heading_rad,curvature_1pm\n";
  EXPECT_EQ(beside(header + "0,1,2,3,0,0\n10,11,2,3,0,0\n")->size(), 2u);
  EXPECT_EQ(beside(header + "0,1,2,3,0,0\n10,nan,2,3,0,0\n").error().place, lane_file_of(scene).string() + ":3");
  EXPECT_EQ(beside(header + "5,1,2,3,0,0\n0,11,2,3,0,0\n").error().text(),
            lane_file_of(scene).string() + ":3: s_m does not rise");
  EXPECT_FALSE(beside("").ok());
  EXPECT_FALSE(beside("a,b\n1,2\n").ok());
  std::filesystem::remove(lane_file_of(scene));
}

TEST(Driver, SpeedKeepsTheLimits) {
  const DriverScript script = *parse_driver_script(kScript, "s.toml");
  const auto points = lane();
  const auto speed = speed_profile(points, script);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LE(speed[i], 25.0 + 1e-9);
    EXPECT_LE(speed[i] * speed[i] * points[i].curvature_1pm, 2.5 + 1e-9);
    const double a = (speed[i] * speed[i] - speed[i - 1] * speed[i - 1]) / 2.0;
    EXPECT_LE(a, 2.0 + 1e-9);
    EXPECT_GE(a, points[i].s_m >= 500 && points[i].s_m <= 561 ? -6.0 - 1e-9 : -2.0 - 1e-9) << i;
  }
  EXPECT_NEAR(speed[550], 10.0, 1e-9);
}

TEST(Driver, FollowsTheLaneAndItsScript) {
  DriverSource driver(*parse_driver_script(kScript, "s.toml"), lane());
  Cockpit cockpit({0, 2}, "driver");
  const auto points = lane();
  VehicleState car;
  double furthest_m = 0.0, flash_s = 0.0;
  CockpitState controls;
  std::vector<LightSwitch> lights;
  const double dt = 1.0 / 60.0;
  int step = 0;
  for (; step < 60 * 90 && !driver.ended(); ++step) {
    driver.advance({SimTime{static_cast<std::int64_t>(step * dt * 1e9)}, {}}, &car, cockpit);
    controls = cockpit.state(step, driver.ended());
    if (lights.empty() || lights.back() != controls.light_switch) lights.push_back(controls.light_switch);
    if (controls.flash) flash_s += dt;
    // a car without mass: kinematic single track, pedals give acceleration
    const double a =
        controls.accelerator_01 * std::min(4.0, 60.0 / std::max(car.speed_mps, 1.0)) - controls.brake_01 * 9.0 - 0.15;
    car.speed_mps = std::max(0.0, car.speed_mps + a * dt);
    car.yaw_rad += car.speed_mps / 2.6 * std::tan(controls.steering_wheel_rad / 15.0) * dt;
    car.x_m += car.speed_mps * std::cos(car.yaw_rad) * dt;
    car.y_m += car.speed_mps * std::sin(car.yaw_rad) * dt;
    double nearest = 1e9;
    for (const LanePoint& p : points) nearest = std::min(nearest, std::hypot(p.x_m - car.x_m, p.y_m - car.y_m));
    furthest_m = std::max(furthest_m, nearest);
  }
  EXPECT_TRUE(driver.ended());
  EXPECT_LT(furthest_m, 0.8);  // half a metre of it is the distance between lane points
  EXPECT_EQ(lights, (std::vector<LightSwitch>{LightSwitch::kLow, LightSwitch::kHigh, LightSwitch::kLow}));
  EXPECT_NEAR(flash_s, 0.5, 0.04);
  EXPECT_TRUE(controls.fog_front);
  EXPECT_EQ(controls.design_index, 1u);
  EXPECT_EQ(controls.light_changes, 7u);  // low, fog, high, low, flash on and off, design
  EXPECT_GT(car.speed_mps, 10.0);
  EXPECT_LT(step * dt, 60.0);
}

TEST(Driver, ARestartedDriverSetsTheSwitchesOfThePast) {
  DriverSource driver(*parse_driver_script(kScript, "s.toml"), lane());
  Cockpit cockpit({0, 2}, "driver");
  const auto points = lane();
  VehicleState car;
  car.x_m = points[400].x_m;
  car.y_m = points[400].y_m;
  car.yaw_rad = points[400].heading_rad;
  car.speed_mps = 19.0;
  driver.advance({SimTime{30'000'000'000}, {}}, &car, cockpit);
  const CockpitState state = cockpit.state(1, false);
  EXPECT_EQ(state.light_switch, LightSwitch::kLow);
  EXPECT_FALSE(state.flash);
  EXPECT_TRUE(state.fog_front);
  EXPECT_EQ(state.design_index, 1u);
  EXPECT_NEAR(driver.station_m(), 400.0, 0.1);
}

}  // namespace
}  // namespace phare
