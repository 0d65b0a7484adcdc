// Other road users in the picture: where they are, their lamps, and what these throw into the driver's eye.
#include "visual/process/traffic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/trigonometric.hpp>

#include "config/base/paths.h"
#include "visual/air_of_desk.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

class TrafficTest : public testing::Test {
 protected:
  fs::path file(const std::string& text) {
    const fs::path path = fs::path(testing::TempDir()) / "traffic_test.toml";
    std::ofstream(path) << text;
    return path;
  }
  Traffic traffic(const std::string& text) {
    auto read = Traffic::read(file(text), straight_lane(), movers_);
    EXPECT_TRUE(read) << read.error().text();
    return read ? std::move(*read) : Traffic{};
  }
  /// Straight along x on the plane z = 0, 1 km.
  static std::vector<LanePoint> straight_lane() { return {{0, 0, 0, 0, 0, 0}, {1000, 1000, 0, 0, 0, 0}}; }
  static RoadLine straight() { return RoadLine(straight_lane(), {}); }
  Movers movers_ = std::move(*Movers::read());
};

TEST_F(TrafficTest, IsWhereTheFileSaysAndNowhereElse) {
  const Traffic cars = traffic(R"([[road_user]]
class = "car"
direction = "oncoming"
start_s_m = 480
speed_kmh = 72
offset_m = 3.5
from_s = 2
to_s = 20
[[road_user]]
class = "lorry"
direction = "same"
start_s_m = 990
speed_kmh = 36
)");
  const RoadLine road = straight();
  EXPECT_TRUE(cars.at(1.99, road).empty()) << "the car is not there yet, the lorry past the end";
  const auto lorry = cars.at(0.5, road);
  ASSERT_EQ(lorry.size(), 1u);
  EXPECT_NEAR(lorry[0].position_m.x, 995.0, 1e-9);
  const auto then = cars.at(10.0, road);
  ASSERT_EQ(then.size(), 1u) << "the lorry is past the lane's end";
  EXPECT_NEAR(glm::distance(then[0].position_m, glm::dvec3(280.0, 3.5, 0.0)), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(then[0].world_from_user[0], glm::dvec3(-1.0, 0.0, 0.0)), 0.0, 1e-9) << "toward us";
  EXPECT_NEAR(glm::distance(then[0].world_from_user[1], glm::dvec3(0.0, -1.0, 0.0)), 0.0, 1e-9);
  EXPECT_TRUE(cars.at(20.1, road).empty());
}

// Two lamps light the scene. In the mirror of wet ground and in fog those show most that shine toward the eye.
TEST_F(TrafficTest, WhoShinesTowardTheEyeComesFirstInFogAsOnWetGround) {
  const Traffic cars =
      traffic("[[road_user]]\nstart_s_m = 20\ndirection = \"same\"\n[[road_user]]\nstart_s_m = 60\noffset_m = 3.5\n");
  const auto users = cars.at(0.0, straight());
  const auto first_x_m = [&](std::optional<double> visibility_m, double rain_mmph, std::optional<std::size_t> ground) {
    Desk desk;
    desk.visibility_m = visibility_m, desk.rain_mmph = rain_mmph, desk.ground = ground;
    return Traffic::placed_lamps(users, {0.0, 0.3, 1.2}, {1.0, 0.0, 0.0}, lamps_toward_first(desk)).at(0).position_m.x;
  };
  EXPECT_LT(first_x_m({}, 0.0, {}), 30.0) << "the nearest";
  EXPECT_GT(first_x_m({}, 0.0, 1), 50.0) << "wet";
  EXPECT_GT(first_x_m(300.0, 0.0, {}), 50.0) << "fog";
  EXPECT_GT(first_x_m({}, 5.0, 0), 50.0) << "rain, over dry ground";
}

// Two low beams look along its way; each throws into an eye what its table has in that direction over the distance
// squared, and a car that leads shows its tail lamps alone.
TEST_F(TrafficTest, ItsLampsGlareAsTheirTablesHaveIt) {
  const Traffic cars = traffic("[[road_user]]\nstart_s_m = 50\noffset_m = 3.5\n");
  const auto users = cars.at(0.0, straight());
  const auto lamps = Traffic::placed_lamps(users, {0.0, 0.3, 1.2}, {1.0, 0.0, 0.0});
  ASSERT_EQ(lamps.size(), 2u);
  const glm::dvec3 eye_m(0.0, 0.3, 1.2);
  const auto glare = cars.glare_at(users, eye_m, Scene{}, {});
  ASSERT_EQ(glare.size(), 2u) << "tail lamps shine the other way";
  const auto table = read_lamp(generated_dir() / "lamps/low_rht.ies", {});
  ASSERT_TRUE(table);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(glare[i].place_m, lamps[i].position_m);
    const glm::dvec3 way_m = eye_m - lamps[i].position_m;
    const double cd = table->intensity_cd(glm::transpose(lamps[i].world_from_image) * way_m);
    EXPECT_GT(cd, 0.0);
    EXPECT_NEAR(glare[i].eye_lx, cd / glm::dot(way_m, way_m), 1e-12);
  }
  const auto in_fog = cars.glare_at(users, eye_m, Scene{}, {.visibility_m = 50.0});
  EXPECT_NEAR(in_fog[0].eye_lx / glare[0].eye_lx, std::pow(0.05, glm::distance(eye_m, glare[0].place_m) / 50.0), 1e-6);

  const Traffic leading = traffic("[[road_user]]\nstart_s_m = 30\ndirection = \"same\"\n");
  const auto ahead = leading.at(0.0, straight());
  const auto tail = leading.glare_at(ahead, eye_m, Scene{}, {});
  ASSERT_EQ(tail.size(), 2u);
  const glm::dvec3 way_m = eye_m - tail[0].place_m;
  EXPECT_NEAR(tail[0].eye_lx, kTailLamp_cd * std::abs(way_m.x) / std::pow(glm::length(way_m), 3), 1e-12);
  EXPECT_GT(tail[0].colour.x, 10.0f * tail[0].colour.y) << "red";

  const Traffic dark =
      traffic("[[road_user]]\nstart_s_m = 50\nlights = false\n[[road_user]]\nclass = \"pedestrian\"\n");
  EXPECT_TRUE(Traffic::placed_lamps(dark.at(0.0, straight()), eye_m, {1.0, 0.0, 0.0}).empty());
  EXPECT_TRUE(dark.glare_at(dark.at(0.0, straight()), eye_m, Scene{}, {}).empty());
}

/// Of the same intensity everywhere within ±30° x ±20°, beside the traffic file.
void even_beside(const char* name, int cd) {
  std::ofstream out(fs::path(testing::TempDir()) / name);
  out << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n-20 20\n-30 30\n";
  for (int i = 0; i < 4; ++i) out << cd << '\n';
}

// 900 cd of low beam and 2100 of high beam are 3000 cd toward an eye, where high beam is on; the picture's beams are
// the same lamps, each light once.
TEST_F(TrafficTest, ItsLampsAreThoseThatItNames) {
  even_beside("traffic_low.ies", 900);
  even_beside("traffic_high.ies", 2100);
  const std::string named = "[[road_user]]\nstart_s_m = 60\nlow_beam = \"traffic_low.ies\"\n";
  const std::string high = "high_beam = \"traffic_high.ies\"\nlights = ";
  const Traffic cars = traffic(named + named + high + "\"low\"\n" + named + high + "\"high\"\n" + named + high +
                               "\"off\"\n" + "[[road_user]]\nstart_s_m = 60\nlights = \"high\"\n");
  const auto users = cars.at(0.0, straight());
  ASSERT_EQ(users.size(), 5u);
  ASSERT_EQ(cars.beams(), 4u) << "the sample car's, low, low and high, the sample car's with high";
  const glm::dvec3 eye_m(0.0, 0.0, 1.2), ahead(1.0, 0.0, 0.0);
  // 57.82 m ahead of the eye, 0.6 m beside it, 0.59 m below: 3343.86 m².
  const auto lx_of = [&](std::size_t user) {
    const auto seen = cars.glare_at(std::span(users).subspan(user, 1), eye_m, Scene{}, {});
    return seen.empty() ? 0.0 : seen[0].eye_lx;
  };
  EXPECT_NEAR(lx_of(0), 900.0 / 3343.8605, 1e-9);
  EXPECT_NEAR(lx_of(1), 900.0 / 3343.8605, 1e-9);
  EXPECT_NEAR(lx_of(2), 3000.0 / 3343.8605, 1e-9);
  EXPECT_EQ(lx_of(3), 0.0);
  const auto lit_by = [&](std::size_t user) {
    return Traffic::placed_lamps(std::span(users).subspan(user, 1), eye_m, ahead).at(0).beam - Traffic::kBeam;
  };
  EXPECT_EQ(lit_by(0), lit_by(1));
  EXPECT_EQ(std::ranges::max(cars.beam(lit_by(1)).candela), 900.0f);
  EXPECT_EQ(std::ranges::max(cars.beam(lit_by(2)).candela), 3000.0f);
  EXPECT_GT(std::ranges::max(cars.beam(lit_by(4)).candela), 1.2f * std::ranges::max(cars.beam(0).candela));

  // What is no lamp is told by the lamp's own line.
  std::ofstream(fs::path(testing::TempDir()) / "traffic_low.ies") << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1\n";
  const auto broken = Traffic::read(file(named), straight_lane(), movers_);
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().text().find("traffic_low.ies:"), std::string::npos) << broken.error().text();
}

// 20 m/s until 1 s, then 5 m/s² down to 10 m/s at 3 s: a car 45 m ahead then shows 125 cd besides its 8, in the place
// of its tail lamps, also where these are off; before and after it does not, and nothing else is seen for it.
TEST_F(TrafficTest, WhoSlowsDownShowsBrakeLamps) {
  const std::string slows = "[[road_user]]\ndirection = \"same\"\nstart_s_m = 45\nspeeds = [[1, 72], [3, 36]]\n";
  const auto seen_at = [&](const Traffic& cars, double time_s) {
    const auto users = cars.at(time_s, straight());
    EXPECT_EQ(users.size(), 1u);
    const glm::dvec3 eye_m(users.at(0).position_m.x - 45.0, 0.0, 0.8);  // at the height of the lamps, behind the middle
    return cars.glare_at(users, eye_m, Scene{}, {});
  };
  // Each 0.6 m aside and 42.8 m ahead.
  const double square_m2 = 42.8 * 42.8 + 0.6 * 0.6, cosine = 42.8 / std::sqrt(square_m2);
  const Traffic cars = traffic(slows);
  for (const auto& [time_s, cd] : {std::pair{0.5, 8.0}, {2.0, 133.0}, {5.0, 8.0}}) {
    const auto seen = seen_at(cars, time_s);
    ASSERT_EQ(seen.size(), cd > 100.0 ? 3u : 2u) << time_s << ": the third brake lamp last, traffic_lamps_test.cpp";
    for (const GlaringLamp& lamp : std::span(seen).first(2)) {
      EXPECT_NEAR(lamp.eye_lx, cd * cosine / square_m2, 1e-12) << time_s;
      EXPECT_GT(lamp.colour.x, 10.0f * lamp.colour.y) << "red";
    }
  }
  EXPECT_NEAR(cars.at(2.0, straight())[0].position_m.x, 45.0 + 20.0 + 17.5, 1e-9);
  EXPECT_EQ(cars.at(2.0, straight())[0].speed_mps, 15.0);

  const Traffic dark = traffic(slows + "lights = false\n");
  EXPECT_TRUE(seen_at(dark, 0.5).empty());
  ASSERT_EQ(seen_at(dark, 2.0).size(), 3u);
  EXPECT_NEAR(seen_at(dark, 2.0)[0].eye_lx, 125.0 * cosine / square_m2, 1e-12);
  EXPECT_TRUE(Traffic::placed_lamps(dark.at(2.0, straight()), {}, {1.0, 0.0, 0.0}).empty()) << "they light nothing";
  // What one sees in its spray, too.
  const RoadLine road = straight();
  EXPECT_EQ(cars.spraying(cars.at(2.0, road), 2.0, road).at(0).tail_cd, kTailLamp_cd + kBrakeLamp_cd);
  EXPECT_EQ(dark.spraying(dark.at(2.0, road), 2.0, road).at(0).tail_cd, kBrakeLamp_cd);
  EXPECT_EQ(cars.spraying(cars.at(0.5, road), 0.5, road).at(0).tail_cd, kTailLamp_cd);
}

// Files of the lamps at a back, whose axes point backward; one file of two users is read once and stays where it is.
TEST_F(TrafficTest, ItsRearLampsAreThoseThatItNames) {
  even_beside("traffic_tail.ies", 12);
  even_beside("traffic_brake.ies", 240);
  const std::string one =
      "[[road_user]]\ndirection = \"same\"\nstart_s_m = 30\ntail_lamp = \"traffic_tail.ies\"\nbrake_lamp = "
      "\"traffic_brake.ies\"\n";
  Traffic read = traffic(one + one + "brake = true\n");
  const Traffic cars = std::move(read);
  const auto users = cars.at(0.0, straight());
  ASSERT_EQ(users.size(), 2u);
  // 27.8 m behind, 0.6 m beside and 0.4 m above: 773.36 m².
  const auto lx_of = [&](std::size_t user) {
    const auto seen = cars.glare_at(std::span(users).subspan(user, 1), {0.0, 0.0, 1.2}, Scene{}, {});
    EXPECT_EQ(seen.size(), user == 0 ? 2u : 3u);
    return seen.empty() ? 0.0 : seen[0].eye_lx;
  };
  EXPECT_NEAR(lx_of(0), 12.0 / 773.36, 1e-9);
  EXPECT_NEAR(lx_of(1), 252.0 / 773.36, 1e-9);
  EXPECT_TRUE(cars.glare_at(std::span(users).first(1), {60.0, 0.0, 1.2}, Scene{}, {}).size() == 2u)
      << "from ahead its headlamps alone";

  // A lamp that shines to its own left shines to the right of the car that it ends.
  const auto table = read_lamp(generated_dir() / "lamps/low_rht.ies", {});
  ASSERT_TRUE(table);
  const RearLight light{.tail = {.table = &*table}};
  const glm::dvec3 to_its_left = glm::normalize(glm::dvec3(1.0, 0.1, -0.02));
  const double cd = table->intensity_cd(to_its_left);
  EXPECT_NEAR(light.toward({-to_its_left.x, -to_its_left.y, to_its_left.z}).cd, cd, 1e-9 * cd);
  EXPECT_GT(std::abs(light.toward({-to_its_left.x, to_its_left.y, to_its_left.z}).cd - cd), 0.01 * cd);

  std::ofstream(fs::path(testing::TempDir()) / "traffic_brake.ies") << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1\n";
  const auto broken = Traffic::read(file(one), straight_lane(), movers_);
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().text().find("traffic_brake.ies:"), std::string::npos) << broken.error().text();
}

// The body, its lamps and its spray are where its recording has it.
TEST_F(TrafficTest, FollowsARecordedPath) {
  std::ofstream(fs::path(testing::TempDir()) / "traffic_path.csv")
      << "time_s,x_m,y_m,heading_rad\n0,100,3.5,3.141592653589793\n2,60,3.5,3.141592653589793\n";
  const Traffic cars = traffic("[[road_user]]\npath = \"traffic_path.csv\"\n");
  const RoadLine road = straight();
  const auto users = cars.at(1.5, road);
  ASSERT_EQ(users.size(), 1u);
  EXPECT_NEAR(users[0].position_m.x, 70.0, 1e-9);
  EXPECT_NEAR(users[0].speed_mps, 20.0, 1e-9);
  EXPECT_NEAR(users[0].world_from_user[0].x, -1.0, 1e-12);
  EXPECT_NEAR(cars.placed_meshes(users)[0].position_m.x, 70.0, 1e-9);
  const auto lamps = Traffic::placed_lamps(users, {0.0, 0.0, 1.2}, {1.0, 0.0, 0.0});
  ASSERT_EQ(lamps.size(), 2u);
  EXPECT_NEAR(lamps[0].position_m.x, 70.0 - 2.18, 1e-9);
  EXPECT_NEAR(cars.spraying(users, 1.5, road).at(0).wheels_m[1].x, 70.0 + 10.0 * kSprayAge_s + 1.5, 1e-9);
  EXPECT_TRUE(cars.at(2.01, road).empty());
}

// Fast ones with motors throw up water, from where their rear wheels were; who has just come, came straight.
TEST_F(TrafficTest, FastVehiclesThrowUpWater) {
  const Traffic cars = traffic(R"([[road_user]]
class = "bicycle"
direction = "same"
start_s_m = 20
speed_kmh = 36
[[road_user]]
direction = "same"
start_s_m = 30
speed_kmh = 90
[[road_user]]
start_s_m = 600
speed_kmh = 72
from_s = 4.0
[[road_user]]
direction = "same"
start_s_m = 40
speed_kmh = 29
[[road_user]]
direction = "same"
class = "lorry"
start_s_m = 60
speed_kmh = 90
lights = false
)");
  const RoadLine road = straight();
  const auto spraying = cars.spraying(cars.at(4.5, road), 4.5, road);
  ASSERT_EQ(spraying.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const double ago_s = 0.5 * static_cast<double>(i) * kSprayAge_s;
    EXPECT_NEAR(spraying[0].wheels_m[i].x, 30.0 + 25.0 * (4.5 - ago_s) - 1.5, 1e-9);
    EXPECT_NEAR(spraying[1].wheels_m[i].x, 600.0 - 20.0 * (4.5 - ago_s) + 1.5, 1e-9);
  }
  EXPECT_NEAR(spraying[0].tail_m[0].x, 30.0 + 25.0 * 4.5 - 2.2, 1e-9);
  EXPECT_EQ(spraying[0].tail_cd, kTailLamp_cd);
  EXPECT_EQ(spraying[2].tail_cd, 0.0);
  EXPECT_GT(spraying[2].tyres_m, spraying[0].tyres_m);
  EXPECT_NE(spraying[0].number, spraying[2].number);
}

// The figures are those of the equations by hand: one lamp 10° beside the line of sight; and eyes that come toward us.
TEST_F(TrafficTest, GlareFiguresAreThoseOfTheEquations) {
  const glm::dvec3 eye_m(1.0, 2.0, 1.2), ahead(1.0, 0.0, 0.0);
  const double angle = glm::radians(10.0);
  const std::vector<GlaringLamp> lamps{{eye_m + 40.0 * glm::dvec3(std::cos(angle), std::sin(angle), 0.0), 0.5},
                                       {eye_m - 10.0 * ahead, 100.0}};
  const Viewer viewer{40.0, 0.5};
  const Glare glare = glare_figures(lamps, eye_m, ahead, viewer);
  const double lx = 0.5 * std::cos(angle);
  EXPECT_NEAR(glare.illuminance_lx, lx, 1e-12) << "the lamp behind does not count";
  EXPECT_NEAR(glare.veil_cdm2, lx * veil_general_per_sr(viewer, 10.0), 1e-12);
  EXPECT_NEAR(glare.threshold_increment_percent, 65.0 * glare.veil_cdm2, 1e-12) << "adapted to 1 cd/m²";

  const Traffic both = traffic(
      "[[road_user]]\nstart_s_m = 50\noffset_m = 3.5\n[[road_user]]\nstart_s_m = 30\n"
      "direction = \"same\"\n[[road_user]]\nclass = \"pedestrian\"\nstart_s_m = 20\n");
  const auto eyes = Traffic::oncoming_eyes(both.at(0.0, straight()), ahead);
  ASSERT_EQ(eyes.size(), 1u) << "who drives ahead looks away, who walks does not drive";
  EXPECT_NEAR(glm::distance(eyes[0].at.position_m, glm::dvec3(50.0 - 0.35, 3.5 - 0.37, 1.2)), 0.0, 1e-9);
  EXPECT_NEAR(eyes[0].at.normal.x, -1.0, 1e-9);
}

// One lamp of 900 cd to all sides, and an eye 80 m ahead of it and 4 m to its left. By hand: 80.1 m, 2.8624° from the
// line of sight, 900/6416 lx times the cosine; the veil at 40 years and pigment 0.5 is 1.16067 cd/m² a lux; de Boer's
// 5 − 2·log10(E/(0.003·6·171.74^0.46)).
TEST_F(TrafficTest, WhatOurLampsDoToWhoComesTowardUs) {
  const fs::path even = fs::path(testing::TempDir()) / "traffic_test_even.ies";
  std::ofstream(even) << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n"
                         "-20 20\n-30 30\n900 900\n900 900\n";
  LampConfig lamp;
  lamp.position_m = {0.0, 0.0, 1.2};
  lamp.sources.push_back({.function = LampFunction::kLow, .file = even});
  Rig rig;
  rig.designs.emplace_back().lamps = {lamp};
  auto lamps = Lamps::load(rig);
  ASSERT_TRUE(lamps) << lamps.error().text();
  CockpitState controls;
  controls.light_switch = LightSwitch::kLow;
  (void)lamps->set_controls(controls);

  const Traffic both = traffic(
      "[[road_user]]\nstart_s_m = 160\noffset_m = 4.37\n"
      "[[road_user]]\nstart_s_m = 80.35\noffset_m = 4.37\n"
      "[[road_user]]\nstart_s_m = 20\noffset_m = 8\nclass = \"pedestrian\"\n");
  const auto users = both.at(0.0, straight());
  const auto eyes = Traffic::oncoming_eyes(users, {1.0, 0.0, 0.0});
  ASSERT_EQ(eyes.size(), 2u);
  const Scene nothing;
  World world(nothing, movers_.meshes());
  world.move(both.placed_meshes(users));
  const Viewer viewer{40.0, 0.5};
  // Six digits above, four of de Boer's: half of the last.
  const Glare clear = glare_at_oncoming_eyes(*lamps, {}, eyes, world, {}, viewer);
  EXPECT_NEAR(clear.illuminance_lx, 0.140099, 5e-7) << "the nearer one, out of a body as if of glass";
  EXPECT_NEAR(clear.veil_cdm2, 0.162609, 5e-7);
  EXPECT_NEAR(clear.threshold_increment_percent, 10.5696, 5e-5);
  EXPECT_NEAR(clear.de_boer.value(), 5.2738, 5e-5);
  // In fog a twentieth is left after 80 m: exp(-2.9957·80.1/80).
  const Glare fog = glare_at_oncoming_eyes(*lamps, {}, eyes, world, {.visibility_m = 80.0}, viewer);
  EXPECT_NEAR(fog.illuminance_lx / clear.illuminance_lx, 0.0498132, 5e-7);
  EXPECT_NEAR(fog.veil_cdm2 / clear.veil_cdm2, 0.0498132, 5e-7);
  EXPECT_NEAR(fog.threshold_increment_percent / clear.threshold_increment_percent, 0.0498132, 5e-7);
  EXPECT_NEAR(fog.de_boer.value(), 7.8791, 5e-5);

  controls.light_switch = LightSwitch::kOff;
  (void)lamps->set_controls(controls);
  const Glare dark = glare_at_oncoming_eyes(*lamps, {}, eyes, world, {}, viewer);
  EXPECT_EQ(dark.illuminance_lx, 0.0);
  EXPECT_FALSE(dark.de_boer);
}

// In the mirror of wet ground those show who shine toward the eye.
TEST_F(TrafficTest, OnWetGroundWhoComesTowardUsLightsTheScene) {
  const Traffic both = traffic("[[road_user]]\nstart_s_m = 50\n[[road_user]]\nstart_s_m = 30\ndirection = \"same\"\n");
  const auto users = both.at(0.0, straight());
  const glm::dvec3 eye_m(0.0, 0.0, 1.2), ahead(1.0, 0.0, 0.0);
  for (const PlacedLamp& lamp : Traffic::placed_lamps(users, eye_m, ahead)) EXPECT_LT(lamp.position_m.x, 40.0);
  const auto mirrored = Traffic::placed_lamps(users, eye_m, ahead, true);
  ASSERT_EQ(mirrored.size(), Traffic::kMostLamps);
  for (const PlacedLamp& lamp : mirrored) EXPECT_GT(lamp.position_m.x, 40.0);
}

// The nearest that has not passed lights the scene; all glare.
TEST_F(TrafficTest, TheNearestLightsTheScene) {
  const Traffic column = traffic(
      "[[road_user]]\nstart_s_m = 100\n[[road_user]]\nstart_s_m = 60\n[[road_user]]\n"
      "start_s_m = 10\n[[road_user]]\nclass = \"motorcycle\"\nstart_s_m = 40\n");
  const auto users = column.at(0.0, straight());
  const glm::dvec3 eye_m(20.0, 0.0, 1.2), ahead(1.0, 0.0, 0.0);
  const auto lamps = Traffic::placed_lamps(users, eye_m, ahead);
  ASSERT_EQ(lamps.size(), Traffic::kMostLamps);
  EXPECT_NEAR(lamps[0].position_m.x, 40.0 - 0.6, 1e-9) << "the motorcycle, with one";
  EXPECT_NEAR(lamps[1].position_m.x, 60.0 - 2.18, 1e-9) << "then the car behind it";
  EXPECT_EQ(column.glare_at(users, eye_m, Scene{}, {}).size(), 5u + 2u) << "tail lamps of who has passed, too";
}

TEST_F(TrafficTest, WhatIsWrongInTheFileIsNamed) {
  const auto reason = [&](const std::string& text) {
    const auto read = Traffic::read(file(text), straight_lane(), movers_);
    return read ? std::string() : read.error().text();
  };
  EXPECT_NE(reason("[[road_user]]\nclass = \"tank\"\n").find("traffic_test.toml:2"), std::string::npos);
  EXPECT_NE(reason("[[road_user]]\nspeed_kmh = -3\n").find("speed_kmh"), std::string::npos);
  EXPECT_NE(reason("[[road_user]]\nspead_kmh = 3\n").find("spead_kmh"), std::string::npos);
  EXPECT_NE(reason("\n").find("expected [[road_user]]"), std::string::npos);
  EXPECT_FALSE(Traffic::read(file("[[road_user]]\n"), {}, movers_)) << "there is no lane to drive along";
  EXPECT_FALSE(Traffic::read("no_such_file.toml", straight_lane(), movers_));
  const auto none = Traffic::read({}, {}, movers_);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
}

// A lorry between the eye and an oncoming car hides its lamps, and not its own; it hides the road behind it from ours.
TEST_F(TrafficTest, BodiesHideLampsButNotThoseThatTheyCarry) {
  const Traffic both = traffic(
      "[[road_user]]\nclass = \"lorry\"\ndirection = \"same\"\nstart_s_m = 40\n"
      "[[road_user]]\nstart_s_m = 90\n");
  const auto users = both.at(0.0, straight());
  ASSERT_EQ(users.size(), 2u);
  const glm::dvec3 eye_m{0.0, 0.0, 1.2};
  const Scene nothing;
  World world(nothing, movers_.meshes());
  EXPECT_EQ(both.glare_at(users, eye_m, world, {}).size(), 4u) << "two headlamps, two tail lamps";
  world.move(both.placed_meshes(users));
  const auto seen = both.glare_at(users, eye_m, world, {});
  ASSERT_EQ(seen.size(), 2u) << "the lorry's own tail lamps";
  EXPECT_LT(seen[0].place_m.x, 40.0);
  const SceneChunk* by = occluder(world, {3.4, 0.6, 0.65}, {60.0, 0.0, 3.0});
  ASSERT_TRUE(by);
  EXPECT_EQ(name_of(*by), "lorry");
  // Who carries the lamps that light the scene is told to the picture, which leaves him out of their shadows.
  const auto lamps = Traffic::placed_lamps(users, eye_m, {1.0, 0.0, 0.0});
  for (const PlacedLamp& lamp : lamps) EXPECT_EQ(lamp.carried_by, lamp.position_m.x < 60.0 ? 0u : 1u);
}

}  // namespace
}  // namespace phare
