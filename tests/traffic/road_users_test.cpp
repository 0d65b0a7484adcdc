// unit: road users read from their file and followed along a lane. reference: poses.csv, which the Python package wrote
// and is held to as well.
#include "config/traffic/road_users.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <string>
#include <string_view>

#include "tests/csv_table.h"
#include "tests/paths.h"

namespace phare {
namespace {

constexpr double kRadius_m = 150.0;  // of tests/traffic/bend_lane.csv, to the left, from the origin along x

LaneLine bend() {
  auto points = read_lane(tests_dir("traffic/bend_lane.csv"));
  EXPECT_TRUE(points.ok()) << (points ? "" : points.error().text());
  return LaneLine(*points);
}

std::string users_written(const std::string& lines) {
  const std::string file = testing::TempDir() + "road_users.toml";
  std::ofstream(file) << lines;
  return file;
}

TEST(RoadUsers, AreWhereThePythonPackageHasThem) {
  const auto users = read_road_users(tests_dir("traffic/users.toml"));
  ASSERT_TRUE(users.ok()) << users.error().text();
  const LaneLine lane = bend();
  const test::CsvTable wanted = test::read_csv_table(tests_dir("traffic/poses.csv"));
  ASSERT_GT(wanted.rows.size(), 0u);
  std::set<std::size_t> seen;
  int there = 0, away = 0;
  for (std::size_t row = 0; row < wanted.rows.size(); ++row) {
    SCOPED_TRACE("row " + std::to_string(row + 2));
    const auto number = static_cast<std::size_t>(wanted.number(row, "user"));
    seen.insert(number);
    const RoadUser& user = users->at(number - 1);
    const auto pose = pose_of(user, lane, wanted.number(row, "time_s"));
    ASSERT_EQ(pose.has_value(), wanted.number(row, "there") != 0.0);
    ++(pose ? there : away);
    if (!pose) continue;
    // A few roundings of 2^-53 of some 300 m, and of some 2π over 80 points of an unwrapped heading (times 150 m).
    EXPECT_NEAR(pose->x_m, wanted.number(row, "x_m"), 1e-10);
    EXPECT_NEAR(pose->y_m, wanted.number(row, "y_m"), 1e-10);
    EXPECT_NEAR(pose->z_m, wanted.number(row, "z_m"), 1e-10);
    if (user.across_mps != 0.0) continue;  // LookAlongTheirWayAcross
    const double turned = user.direction == RoadUserDirection::oncoming ? std::numbers::pi : 0.0;
    EXPECT_NEAR(pose->heading_rad - turned, wanted.number(row, "lane_heading_rad"), 1e-13);
  }
  EXPECT_EQ(seen.size(), users->size());
  EXPECT_GT(there, 0);
  EXPECT_GT(away, 0);
}

TEST(RoadUsers, FollowTheCircleThatTheLaneIs) {
  const LaneLine lane = bend();
  const RoadUser user{.start_s_m = 700.0, .speed_mps = 20.0, .offset_m = 3.5};
  for (const double time_s : {0.0, 3.3, 11.0, 29.9}) {
    const auto pose = pose_of(user, lane, time_s);
    ASSERT_TRUE(pose.has_value());
    const double turn = (700.0 - 20.0 * time_s) / kRadius_m;
    // A chord of 10 m stands 10²/(8·150) = 0.083 m inside its arc, and nowhere farther.
    EXPECT_NEAR(pose->x_m, (kRadius_m - 3.5) * std::sin(turn), 0.084);
    EXPECT_NEAR(pose->y_m, kRadius_m - (kRadius_m - 3.5) * std::cos(turn), 0.084);
    EXPECT_NEAR(pose->heading_rad, turn + std::numbers::pi, 1e-10);  // twelve decimals in the file, past a whole turn
    EXPECT_EQ(pose->speed_mps, 20.0);
  }
}

TEST(RoadUsers, AreThereFromAndUntilAndOnTheLaneOnly) {
  const LaneLine lane = bend();
  RoadUser user{.direction = RoadUserDirection::same, .start_s_m = 0.0, .speed_mps = 10.0, .from_s = 2.0, .to_s = 4.0};
  EXPECT_FALSE(pose_of(user, lane, std::nextafter(2.0, 0.0)));
  ASSERT_TRUE(pose_of(user, lane, 2.0));
  EXPECT_TRUE(pose_of(user, lane, 4.0));
  EXPECT_FALSE(pose_of(user, lane, std::nextafter(4.0, 5.0)));
  EXPECT_EQ(pose_of(user, lane, 2.0)->s_m, 20.0);  // start_s_m is its place at time 0, not at from_s
  user.from_s = -1.0, user.to_s = 1e9;
  EXPECT_FALSE(pose_of(user, lane, -0.1));  // before the lane's first point
  EXPECT_TRUE(pose_of(user, lane, 80.0));   // on its last
  EXPECT_FALSE(pose_of(user, lane, 80.1));
}

TEST(RoadUsers, LookAlongTheirWayAcross) {
  const LaneLine lane({{0, 0, 0, 0, 0, 0}, {100, 100, 0, 0, 0, 0}});  // along x
  RoadUser user{.kind = RoadUserClass::pedestrian,
                .direction = RoadUserDirection::standing,
                .start_s_m = 50.0,
                .offset_m = -4.0,
                .across_mps = 1.5,
                .across_from_s = 2.0,
                .across_to_s = 6.0};
  const struct {
    double time_s, y_m, speed_mps;
  } wanted[] = {{0.0, -4.0, 0.0}, {2.0, -4.0, 1.5}, {4.0, -1.0, 1.5}, {6.0, 2.0, 0.0}, {9.0, 2.0, 0.0}};
  for (const auto& then : wanted) {
    const auto pose = pose_of(user, lane, then.time_s);
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->y_m, then.y_m);
    EXPECT_EQ(pose->speed_mps, then.speed_mps) << then.time_s;
    EXPECT_NEAR(pose->heading_rad, 0.5 * std::numbers::pi, 1e-15);
  }
  // On wheels only while it moves over: 3 m/s against the lane and 4 m/s to its left.
  user = {.direction = RoadUserDirection::oncoming,
          .start_s_m = 80.0,
          .speed_mps = 3.0,
          .across_mps = 4.0,
          .across_from_s = 1.0,
          .across_to_s = 2.0};
  EXPECT_NEAR(pose_of(user, lane, 0.5)->heading_rad, std::numbers::pi, 1e-15);
  EXPECT_NEAR(pose_of(user, lane, 1.5)->heading_rad, std::atan2(4.0, -3.0), 1e-15);
  EXPECT_NEAR(pose_of(user, lane, 1.5)->speed_mps, 5.0, 1e-15);
  EXPECT_NEAR(pose_of(user, lane, 2.5)->heading_rad, std::numbers::pi, 1e-15);
}

TEST(RoadUsers, HaveTheSizeOfTheirClassUnlessSaid) {
  const auto users =
      read_road_users(users_written("[[road_user]]\n[[road_user]]\nclass = \"lorry\"\nheight_m = 4\nspeed_kmh = "
                                    "72\n[[road_user]]\nclass = \"pedestrian\"\n"));
  ASSERT_TRUE(users.ok()) << users.error().text();
  ASSERT_EQ(users->size(), 3u);
  EXPECT_EQ((*users)[0].width_m, 1.8);
  EXPECT_EQ((*users)[0].lights, RoadUserLights::low);
  EXPECT_EQ((*users)[1].height_m, 4.0);
  EXPECT_EQ((*users)[1].length_m, 10.0);
  EXPECT_EQ((*users)[1].speed_mps, 20.0);
  EXPECT_EQ((*users)[2].lights, RoadUserLights::off);  // a pedestrian has none
}

// Lamp files are named beside the file that names them; what burns is a flag or a word.
TEST(RoadUsers, NameTheirLampsAndWhatOfThemBurns) {
  const std::filesystem::path here = std::filesystem::path(testing::TempDir()).lexically_normal();
  for (const char* name : {"road_user_low.ies", "road_user_high.ies"}) std::ofstream(here / name) << "not read here";
  const auto users = read_road_users(users_written(R"([[road_user]]
low_beam = "road_user_low.ies"
high_beam = "road_user_high.ies"
lights = "high"
[[road_user]]
lights = "low"
[[road_user]]
lights = "off"
[[road_user]]
lights = false
[[road_user]]
class = "bicycle"
lights = "low"
)"));
  ASSERT_TRUE(users.ok()) << users.error().text();
  EXPECT_EQ((*users)[0].low_beam.file, here / "road_user_low.ies");
  EXPECT_EQ((*users)[0].high_beam.file, here / "road_user_high.ies");
  EXPECT_TRUE((*users)[1].low_beam.file.empty());
  const RoadUserLights wanted[] = {RoadUserLights::high, RoadUserLights::low, RoadUserLights::off, RoadUserLights::off,
                                   RoadUserLights::low};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ((*users)[i].lights, wanted[i]) << i;
}

// A lamp is a file, or a table of a file and a colour with the keys of a rig's source; both may be left out.
TEST(RoadUsers, NameTheColoursOfTheirLamps) {
  const std::filesystem::path here = std::filesystem::path(testing::TempDir()).lexically_normal();
  std::ofstream(here / "road_user_low.ies") << "not read here";
  std::ofstream(here / "road_user_led.csv") << "wavelength_nm,power\n450,1\n455,2\n460,1\n";
  const auto users = read_road_users(users_written(R"([[road_user]]
low_beam = { file = "road_user_low.ies", colour_temperature_k = 3000 }
high_beam = { colour_temperature_k = 6000.0 }
brake_lamp = { chromaticity_xy = [0.68, 0.32] }
third_brake_lamp = "road_user_low.ies"
[road_user.tail_lamp]
spectrum = "road_user_led.csv"
[[road_user]]
class = "bicycle"
low_beam = { file = "road_user_low.ies" }
)"));
  ASSERT_TRUE(users.ok()) << users.error().text();
  const RoadUser& car = (*users)[0];
  EXPECT_EQ(car.low_beam.file, here / "road_user_low.ies");
  EXPECT_EQ(car.low_beam.colour.colour_temperature_k, 3000.0);
  EXPECT_TRUE(car.high_beam.file.empty());
  EXPECT_EQ(car.high_beam.colour.colour_temperature_k, 6000.0);
  EXPECT_EQ(car.brake_lamp.colour.chromaticity_xy, glm::dvec2(0.68, 0.32));
  EXPECT_EQ(car.third_brake_lamp.file, here / "road_user_low.ies");
  EXPECT_EQ(car.tail_lamp.colour.spectrum, here / "road_user_led.csv");
  ASSERT_TRUE(car.tail_lamp.colour.chromaticity_xy);
  EXPECT_LT(car.tail_lamp.colour.chromaticity_xy->y, 0.05) << "blue";
  EXPECT_EQ((*users)[1].low_beam.file, here / "road_user_low.ies");
  EXPECT_FALSE((*users)[1].low_beam.colour.said());
}

TEST(RoadUsers, OfTheShippedExampleAreRead) {
  const auto users = read_road_users(source_dir() + "/config/examples/traffic.toml");
  ASSERT_TRUE(users.ok()) << users.error().text();
  EXPECT_EQ(users->size(), 3u);
  const auto braking = read_road_users(source_dir() + "/config/examples/braking.toml");
  ASSERT_TRUE(braking.ok()) << braking.error().text();
  EXPECT_EQ(braking->at(0).speeds.size(), 5u);
  EXPECT_TRUE(braking->at(1).path);
}

TEST(RoadUsers, WhatIsWrongIsSaidWithItsLine) {
  const struct {
    const char *line, *why;
  } cases[] = {{"speeed_kmh = 3", "speed_kmh"},
               {"class = \"tram\"", "tram"},
               {"start_s_m = '3'", "start_s_m"},
               {"speed_kmh = -3", "speed_kmh"},
               {"width_m = 0", "width_m"},
               {"direction = \"up\"", "up"},
               {"start_s_m = nan", "start_s_m"},
               {"to_s = inf", "to_s"},
               {"lights = 1", "lights"},
               {"across_to_s = -1", "across_to_s"},
               {"lights = \"full\"", "none of off, low, high"},
               {"direction = \"standing\"\nspeed_kmh = 50", "who is standing has none"},
               {"from_s = 10\nto_s = 5", "to_s"},
               {"across_from_s = 3", "there is no across_kmh"},
               {"class = \"deer\"\nlights = true", "a deer has no lights"},
               {"low_beam = \"nowhere.ies\"", "nowhere.ies: no such file"},
               {"high_beam = 3", "high_beam"},
               {"low_beam = \"\"", "name of a file"},
               {"class = \"bicycle\"\nlights = \"high\"", "a bicycle has no high beam"},
               {"class = \"bicycle\"\nhigh_beam = \"users.toml\"", "a bicycle has no high beam"},
               {"class = \"lorry\"\nthird_brake_lamp = \"users.toml\"", "a lorry has no third brake lamp"},
               {"low_beam = { colour_temperature_k = 800 }", "colour_temperature_k"},
               {"low_beam = { colour_k = 3000 }", "colour_temperature_k"},
               {"low_beam = { file = \"nowhere.ies\" }", "nowhere.ies: no such file"},
               {"low_beam = { spectrum = \"nowhere.csv\" }", "nowhere.csv"},
               {"tail_lamp = { colour_temperature_k = 3000, chromaticity_xy = [0.3, 0.3] }", "not both"},
               {"brake_lamp = { chromaticity_xy = [0.9, 0.3] }", "x + y <= 1"},
               {"class = \"deer\"\nlow_beam = \"users.toml\"", "a deer has no headlamps"}};
  for (const auto& wrong : cases) {
    SCOPED_TRACE(wrong.line);
    const auto users = read_road_users(users_written(std::string("[[road_user]]\n") + wrong.line + "\n"));
    ASSERT_FALSE(users.ok());
    const int line = std::string_view(wrong.line).find('\n') == std::string_view::npos ? 2 : 3;
    EXPECT_NE(users.error().text().find("road_users.toml:" + std::to_string(line) + ":"), std::string::npos)
        << users.error().text();
    EXPECT_NE(users.error().reason.find(wrong.why), std::string::npos) << users.error().text();
  }
  EXPECT_FALSE(read_road_users(users_written("")).ok());
  EXPECT_FALSE(read_road_users(users_written("road_user = 3\n")).ok());
  EXPECT_FALSE(read_road_users(users_written("[road_user]\n")).ok());
  EXPECT_FALSE(read_road_users(testing::TempDir() + "nowhere.toml").ok());
}

}  // namespace
}  // namespace phare
