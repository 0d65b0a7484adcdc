// unit: speed profiles and recorded ways of road users, and when brake lamps burn. reference: path_poses.csv, which the
// Python package wrote and is held to as well.
#include "config/traffic/recorded_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>

#include "config/traffic/road_users.h"
#include "tests/csv_table.h"
#include "tests/paths.h"

namespace phare {
namespace {

std::string written(const std::string& name, const std::string& text) {
  const std::string file = testing::TempDir() + name;
  std::ofstream(file) << text;
  return file;
}

RecordedPath path_of(const std::string& text) {
  auto path = RecordedPath::read(written("recorded_path.csv", text));
  EXPECT_TRUE(path) << (path ? "" : path.error().text());
  return *path;
}

LaneLine straight() {
  return LaneLine({{0, 0, 0, 0, 0, 0}, {1000, 1000, 0, 0, 0, 0}});
}

RoadUser user_of(const std::string& lines) {
  const auto users = read_road_users(written("recorded_path.toml", "[[road_user]]\n" + lines));
  EXPECT_TRUE(users) << (users ? "" : users.error().text());
  return users->at(0);
}

TEST(RecordedPaths, AreWhereThePythonPackageHasThem) {
  const auto users = read_road_users(tests_dir("traffic/paths.toml"));
  ASSERT_TRUE(users) << users.error().text();
  const auto points = read_lane(tests_dir("traffic/bend_lane.csv"));
  ASSERT_TRUE(points) << points.error().text();
  const LaneLine lane(*points);
  const test::CsvTable wanted = test::read_csv_table(tests_dir("traffic/path_poses.csv"));
  std::size_t there = 0, braking = 0;
  for (std::size_t row = 0; row < wanted.rows.size(); ++row) {
    SCOPED_TRACE("row " + std::to_string(row + 2));
    const RoadUser& user = users->at(static_cast<std::size_t>(wanted.number(row, "user")) - 1);
    const auto pose = pose_of(user, lane, wanted.number(row, "time_s"));
    ASSERT_EQ(pose.has_value(), wanted.number(row, "there") != 0.0);
    if (!pose) continue;
    ++there;
    braking += pose->brakes ? 1 : 0;
    // A few roundings of 2^-53 of some 400 m, as in RoadUsers.AreWhereThePythonPackageHasThem.
    EXPECT_NEAR(pose->x_m, wanted.number(row, "x_m"), 1e-10);
    EXPECT_NEAR(pose->y_m, wanted.number(row, "y_m"), 1e-10);
    EXPECT_NEAR(pose->z_m, wanted.number(row, "z_m"), 1e-10);
    EXPECT_NEAR(pose->s_m, wanted.number(row, "s_m"), 1e-10);
    EXPECT_NEAR(pose->heading_rad, wanted.number(row, "heading_rad"), 1e-12);
    EXPECT_NEAR(pose->speed_mps, wanted.number(row, "speed_mps"), 1e-12);
    EXPECT_EQ(pose->brakes, wanted.number(row, "brakes") != 0.0);
  }
  EXPECT_GT(there, 100u);
  EXPECT_GT(braking, 30u);
}

// Through every row; between them the speed does not jump, and who has stopped stays where he is.
TEST(RecordedPaths, AreSmoothAndDoNotOvershoot) {
  const RecordedPath path = path_of("time_s,s_m,offset_m\n0,0,0\n1,20,0\n2,38,0\n3,45,0\n4,45,0\n6,45,0\n");
  for (const auto& [time_s, s_m] : {std::pair{0.0, 0.0}, {1.0, 20.0}, {2.0, 38.0}, {3.0, 45.0}, {6.0, 45.0}})
    EXPECT_NEAR(path.at(time_s).first_m, s_m, 1e-12) << time_s;
  double before_m = 0.0, before_mps = path.at(0.0).speed_mps;
  constexpr double kStep_s = 1e-3;
  for (int i = 1; i <= 6000; ++i) {
    const RecordedPath::Place place = path.at(i * kStep_s);
    EXPECT_GE(place.first_m, before_m - 1e-12) << i;
    EXPECT_LE(place.first_m, 45.0 + 1e-12) << i;
    // The speed is the slope of the way: what one step adds, within half a step times the most acceleration.
    constexpr double kMost_mps2 = 60.0;  // of these cubics: the secants fall from 18 to 7 m/s, and to 0 within a second
    EXPECT_NEAR((place.first_m - before_m) / kStep_s, 0.5 * (place.speed_mps + before_mps), kMost_mps2 * kStep_s);
    EXPECT_NEAR(place.speed_mps, before_mps, kMost_mps2 * kStep_s) << i;
    before_m = place.first_m, before_mps = place.speed_mps;
  }
  EXPECT_EQ(path.at(4.5).speed_mps, 0.0);
  EXPECT_EQ(path.at(99.0).first_m, 45.0);
}

// The inner slope of uneven steps by hand: steps 1 and 2, secants 10 and 4: weights 5 and 4, 9/(5/10 + 4/4) = 6.
TEST(RecordedPaths, HaveTheSlopesOfFritschAndButland) {
  EXPECT_NEAR(path_of("time_s,s_m,offset_m\n0,0,0\n1,10,0\n3,18,0\n").at(1.0).speed_mps, 6.0, 1e-12);
  EXPECT_NEAR(path_of("time_s,s_m,offset_m\n0,0,0\n1,10,0\n").at(0.3).speed_mps, 10.0, 1e-12);
  // An end is that of the parabola: x = 20 t - t² has 20 m/s at 0 and 12 at 4 s.
  const RecordedPath parabola = path_of("time_s,x_m,y_m\n0,0,0\n2,36,0\n4,64,0\n");
  EXPECT_NEAR(parabola.at(0.0).speed_mps, 20.0, 1e-12);
  EXPECT_NEAR(parabola.at(4.0).speed_mps, 12.0, 1e-12);
}

TEST(RecordedPaths, LookAlongTheirWayUnlessTheFileSaysHow) {
  // Diagonally, then it stands, then back: before and in its stop as it came.
  const RecordedPath path = path_of("time_s,x_m,y_m\n0,0,0\n1,3,3\n2,6,6\n3,6,6\n4,6,6\n5,4,6\n6,2,6\n");
  EXPECT_NEAR(path.at(0.5).heading_rad, 0.25 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(path.at(3.0).heading_rad, 0.25 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(path.at(6.0).heading_rad, std::numbers::pi, 1e-12);
  // 3.1 and -3.1 rad are 0.083 apart, by π.
  const RecordedPath told = path_of("time_s,x_m,y_m,heading_rad\n0,0,0,3.1\n1,-3,0,-3.1\n");
  EXPECT_NEAR(told.at(0.5).heading_rad, std::numbers::pi, 1e-12);
  EXPECT_EQ(path_of("time_s,s_m,offset_m\n0,5,1\n1,5,1\n").at(0.5).heading_rad, 0.0);
}

TEST(RecordedPaths, AreThereFromTheirFirstRowToTheirLast) {
  written("recorded_path.csv", "# of a test track\ntime_s,s_m,offset_m,spare\n2,100,3.5,0\n4,60,3.5,0\n");
  const RoadUser user = user_of("path = \"recorded_path.csv\"\n");
  const LaneLine lane = straight();
  EXPECT_FALSE(pose_of(user, lane, std::nextafter(2.0, 0.0)));
  ASSERT_TRUE(pose_of(user, lane, 2.0));
  const auto pose = pose_of(user, lane, 3.0);
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->x_m, 80.0, 1e-12);
  EXPECT_NEAR(pose->y_m, 3.5, 1e-12);
  EXPECT_NEAR(std::abs(pose->heading_rad), std::numbers::pi, 1e-12) << "against the lane";
  EXPECT_NEAR(pose->speed_mps, 20.0, 1e-12);
  EXPECT_TRUE(pose_of(user, lane, 4.0));
  EXPECT_FALSE(pose_of(user, lane, std::nextafter(4.0, 5.0)));
  // In the world: the height of the lane where it comes nearest.
  written("recorded_path.csv", "time_s,x_m,y_m\n0,3,6\n1,3,8\n");
  const auto in_world =
      pose_of(user_of("path = \"recorded_path.csv\"\n"), LaneLine({{0, 0, 0, 1, 0, 0}, {10, 10, 0, 2, 0, 0}}), 0.5);
  ASSERT_TRUE(in_world);
  EXPECT_NEAR(in_world->s_m, 3.0, 1e-12);
  EXPECT_NEAR(in_world->z_m, 1.3, 1e-12);
  EXPECT_NEAR(in_world->y_m, 7.0, 1e-12);
}

// 72 km/h until 1 s, then 5 m/s² down to 36 km/h at 3 s: 20, then 17.5 and 12.5 m, then 10 a second.
TEST(SpeedProfiles, AreIntegratedExactly) {
  const RoadUser user =
      user_of("direction = \"same\"\nstart_s_m = 100\nspeeds = [[1, 72], [3, 36.0]]\noffset_m = -1\n");
  const LaneLine lane = straight();
  const struct {
    double time_s, s_m, speed_mps;
  } wanted[] = {{0.0, 100.0, 20.0}, {0.5, 110.0, 20.0}, {1.0, 120.0, 20.0},
                {2.0, 137.5, 15.0}, {3.0, 150.0, 10.0}, {5.0, 170.0, 10.0}};
  for (const auto& then : wanted) {
    const auto pose = pose_of(user, lane, then.time_s);
    ASSERT_TRUE(pose);
    EXPECT_NEAR(pose->s_m, then.s_m, 1e-12) << then.time_s;
    EXPECT_NEAR(pose->speed_mps, then.speed_mps, 1e-12) << then.time_s;
  }
  // start_s_m is the place at time 0 also where the profile begins before it.
  const RoadUser oncoming = user_of("start_s_m = 100\nspeeds = [[-2, 36], [2, 72]]\n");
  EXPECT_EQ(pose_of(oncoming, lane, 0.0)->s_m, 100.0);
  EXPECT_NEAR(pose_of(oncoming, lane, 1.0)->s_m, 100.0 - 16.25, 1e-12);  // 15 m/s at 0, 2.5 m/s²
}

// From a quarter of a second before it slows down: the mean of 5 m/s² over what part of half a second it does exceeds
// 0.7 m/s² from 0.07 s of it on.
TEST(BrakeLamps, BurnWhileItSlowsDownUnlessTheFileSaysSo) {
  const std::string slows = "direction = \"same\"\nspeeds = [[1, 72], [3, 36]]\n";
  const LaneLine lane = straight();
  const auto burn = [&](const std::string& lines, double time_s) {
    const auto pose = pose_of(user_of(lines), lane, time_s);
    EXPECT_TRUE(pose);
    return pose && pose->brakes;
  };
  EXPECT_FALSE(burn(slows, 0.0));
  EXPECT_FALSE(burn(slows, 0.81));
  EXPECT_TRUE(burn(slows, 0.83));
  EXPECT_TRUE(burn(slows, 2.0));
  EXPECT_TRUE(burn(slows, 3.17));
  EXPECT_FALSE(burn(slows, 3.19));
  EXPECT_FALSE(burn(slows + "brake = false\n", 2.0));
  EXPECT_TRUE(burn("speed_kmh = 50\nstart_s_m = 90\nbrake = true\n", 1.0));
  EXPECT_FALSE(burn("speed_kmh = 50\nstart_s_m = 90\n", 1.0));
  EXPECT_FALSE(burn("class = \"bicycle\"\n" + slows, 2.0));
  // 0.69 and 0.71 m/s²: 2.5 km/h a second is 0.694.
  EXPECT_FALSE(burn("direction = \"same\"\nspeeds = [[0, 80], [10, 55.16]]\n", 5.0));
  EXPECT_TRUE(burn("direction = \"same\"\nspeeds = [[0, 80], [10, 54.44]]\n", 5.0));
  EXPECT_FALSE(burn("direction = \"same\"\nspeeds = [[0, 40], [5, 80]]\n", 2.0)) << "goes faster";
  // A recording that ends or begins does not brake there.
  written("recorded_path.csv", "time_s,s_m,offset_m\n0,10,0\n1,30,0\n2,50,0\n3,61,0\n4,61,0\n");
  const std::string recorded = "path = \"recorded_path.csv\"\n";
  EXPECT_FALSE(burn(recorded, 0.0));
  EXPECT_TRUE(burn(recorded, 2.3));
  EXPECT_FALSE(burn(recorded, 4.0)) << "stands";
  written("recorded_path.csv", "time_s,s_m,offset_m\n0,10,0\n1,30,0\n2,50,0\n");
  EXPECT_FALSE(burn(recorded, 2.0)) << "ends at full speed";
}

TEST(RecordedPaths, WhatIsWrongIsSaidWithFileAndLine) {
  const struct {
    const char *text, *why;
  } wrongs[] = {
      {"time_s,s_m,offset_m\n0,1,0\n1,2,0\n1,3,0\n", "recorded_path.csv:4: time_s does not rise"},
      {"time_s,s_m,offset_m\n0,1,0\n1,nan,0\n", "recorded_path.csv:3: column s_m: \"nan\" is not a finite number"},
      {"time_s,s_m\n0,1\n1,2\n", "recorded_path.csv:1: has no column offset_m"},
      {"time_s,x_m\n0,1\n1,2\n", "recorded_path.csv:1: has no column y_m"},
      {"s_m,offset_m\n0,1\n1,2\n", "recorded_path.csv:1: has no column time_s"},
      {"time_s,v\n0,1\n1,2\n", "has neither columns s_m and offset_m nor x_m and y_m"},
      {"time_s,s_m,offset_m,x_m,y_m\n0,1,0,1,0\n1,2,0,2,0\n", "one of both"},
      {"time_s,s_m,offset_m,heading_rad\n0,1,0,1\n1,2,0,2\n", "one of both"},
      {"time_s,s_m,offset_m\n0,1,0\n", "a path has at least two rows"},
      {"", "has no header line"},
      {"time_s,s_m,offset_m\n0,0,0\n1,278,0\n", "recorded_path.csv:3: goes faster than 1000 km/h"},
      {"time_s,s_m,offset_m\n0,2e6,0\n1,2e6,0\n", "recorded_path.csv:2: a place is outside"},
  };
  for (const auto& wrong : wrongs) {
    SCOPED_TRACE(wrong.text);
    written("recorded_path.csv", wrong.text);
    const auto users = read_road_users(written("recorded_path.toml", "[[road_user]]\npath = \"recorded_path.csv\"\n"));
    ASSERT_FALSE(users);
    EXPECT_NE(users.error().text().find(wrong.why), std::string::npos) << users.error().text();
    EXPECT_NE(users.error().text().find("recorded_path.toml:2"), std::string::npos) << users.error().text();
  }
}

TEST(SpeedProfiles, WhatIsWrongIsSaidWithItsLine) {
  written("recorded_path.csv", "time_s,s_m,offset_m\n0,1,0\n1,2,0\n");
  const struct {
    const char *line, *why;
  } wrongs[] = {
      {"speeds = [[0, 80], [0, 70]]", "times do not rise"},
      {"speeds = [[0, 80, 3]]", "expected an array of arrays of 2 finite numbers"},
      {"speeds = [[0, nan]]", "expected an array of arrays of 2 finite numbers"},
      {"speeds = [0, 80]", "expected an array of arrays of 2 finite numbers"},
      {"speeds = []", "expected an array of arrays of 2 finite numbers"},
      {"speeds = [[0, -1]]", "a speed is outside"},
      {"speeds = [[0, 50]] # both\nspeed_kmh = 50", "there is speed_kmh, too"},
      {"speeds = [[0, 50]]\ndirection = \"standing\"", "who is standing has none"},
      {"start_s_m = 3\npath = \"recorded_path.csv\"", "there is a path, too"},
      {"speeds = [[0, 50]]\npath = \"recorded_path.csv\"", "there is a path, too"},
      {"path = \"nowhere.csv\"", "nowhere.csv: cannot be read"},
      {"path = \"\"", "expected the name of a file"},
      {"brake = \"yes\"", "expected true or false"},
      {"brake = true\nclass = \"bicycle\"", "a bicycle has no brake lamps"},
      {"brake_lamp = \"recorded_path.csv\"\nclass = \"bicycle\"", "a bicycle has no brake lamps"},
      {"tail_lamp = \"recorded_path.csv\"\nclass = \"deer\"", "a deer has no tail lamps"},
      {"tail_lamp = \"nowhere.ies\"", "nowhere.ies: no such file"},
      {"tail_lmp = \"nowhere.ies\"", "did you mean \"tail_lamp\"?"},
  };
  for (const auto& wrong : wrongs) {
    SCOPED_TRACE(wrong.line);
    const auto users =
        read_road_users(written("recorded_path.toml", std::string("[[road_user]]\n") + wrong.line + "\n"));
    ASSERT_FALSE(users);
    EXPECT_NE(users.error().text().find(wrong.why), std::string::npos) << users.error().text();
    EXPECT_NE(users.error().text().find("recorded_path.toml:2"), std::string::npos) << users.error().text();
  }
}

}  // namespace
}  // namespace phare
