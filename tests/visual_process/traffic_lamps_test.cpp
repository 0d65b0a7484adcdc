// Lamps of other road users: their colours, a bicycle's front lamp, a car's third brake lamp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "config/base/paths.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/process/traffic.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

class TrafficLamps : public testing::Test {
 protected:
  Traffic traffic(const std::string& text) {
    const fs::path path = fs::path(testing::TempDir()) / "traffic_lamps_test.toml";
    std::ofstream(path) << text;
    auto read = Traffic::read(path, {{0, 0, 0, 0, 0, 0}, {1000, 1000, 0, 0, 0, 0}}, movers_);
    EXPECT_TRUE(read) << read.error().text();
    return read ? std::move(*read) : Traffic{};
  }
  static std::vector<Traffic::There> users_of(const Traffic& cars) {
    return cars.at(0.0, RoadLine({{0, 0, 0, 0, 0, 0}, {1000, 1000, 0, 0, 0, 0}}, {}));
  }
  /// Of the same intensity everywhere within ±30° x ±20°, beside the traffic file.
  static void even_beside(const char* name, int cd) {
    std::ofstream out(fs::path(testing::TempDir()) / name);
    out << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n-20 20\n-30 30\n";
    for (int i = 0; i < 4; ++i) out << cd << '\n';
  }
  /// CIE 1931 x, y of linear sRGB.
  static glm::dvec2 xy_of(const glm::dvec3& rgb) {
    const glm::dvec3 xyz{0.4124 * rgb.x + 0.3576 * rgb.y + 0.1805 * rgb.z,
                         0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z,
                         0.0193 * rgb.x + 0.1192 * rgb.y + 0.9505 * rgb.z};
    return glm::dvec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z);
  }
  const glm::dvec3 eye_m_{0.0, 0.0, 1.2};
  Movers movers_ = std::move(*Movers::read());
};

// Places of black bodies in the chart (Kim et al. 2002, as printed); the matrices from and to sRGB have four decimals.
TEST_F(TrafficLamps, HaveTheColourThatIsGiven) {
  std::ofstream even(fs::path(testing::TempDir()) / "traffic_lamps.csv");
  even << "wavelength_nm,power\n";
  for (int nm = 360; nm <= 830; nm += 10) even << nm << ",1\n";
  even.close();
  const struct {
    const char* low_beam;
    glm::dvec2 xy;
  } cases[] = {
      {"", {0.4234, 0.3990}},
      {"low_beam = { colour_temperature_k = 3000 }\n", {0.4369, 0.4041}},
      {"low_beam = { file = \"generated/lamps/led_low_rht.ies\", colour_temperature_k = 6000 }\n", {0.3221, 0.3318}},
      {"low_beam = { chromaticity_xy = [0.38, 0.38] }\n", {0.38, 0.38}},
      {"[road_user.low_beam]\nspectrum = \"traffic_lamps.csv\"\n", {1.0 / 3.0, 1.0 / 3.0}}};
  for (const auto& wanted : cases) {
    SCOPED_TRACE(wanted.low_beam);
    const Traffic cars = traffic(std::string("[[road_user]]\nstart_s_m = 60\n") + wanted.low_beam);
    const auto users = users_of(cars);
    ASSERT_EQ(users.size(), 1u);
    const auto seen = cars.glare_at(users, eye_m_, Scene{}, {});
    ASSERT_EQ(seen.size(), 2u);
    const BeamImage lit = cars.beam(users[0].beam);
    EXPECT_TRUE(lit.tints.empty());
    for (const glm::vec3& colour : {seen[0].colour, lit.colour}) {
      const glm::dvec2 xy = xy_of(glm::dvec3(colour));
      EXPECT_NEAR(xy.x, wanted.xy.x, 1e-3);
      EXPECT_NEAR(xy.y, wanted.xy.y, 1e-3);
    }
  }
}

// Two lights from one place: a tenth of the light red, the rest as blue as daylight, is their mean in the dot that one
// sees, and on the road by the beam's second table. One file in two colours is two beams.
TEST_F(TrafficLamps, OfTwoColoursMixByTheirLight) {
  even_beside("traffic_lamps_low.ies", 300);
  even_beside("traffic_lamps_high.ies", 2700);
  const std::string low = "[[road_user]]\nstart_s_m = 60\nlow_beam = { file = \"traffic_lamps_low.ies\", ";
  const std::string high =
      "colour_temperature_k = 2000 }\nlights = \"high\"\nhigh_beam = { file = \"traffic_lamps_high.ies\", "
      "colour_temperature_k = 6500 }\n";
  const Traffic cars = traffic(low + high + low + "colour_temperature_k = 2500 }\n" + low +
                               "colour_temperature_k = 4500 }\n" + low + "colour_temperature_k = 2500 }\n");
  const auto users = users_of(cars);
  ASSERT_EQ(users.size(), 4u);
  EXPECT_EQ(cars.beams(), 4u) << "the sample car's, the mixed one, and one file in two colours";
  EXPECT_EQ(users[1].beam, users[3].beam);
  EXPECT_NE(users[1].beam, users[2].beam);
  const glm::dvec3 mixed = 0.1 * glm::dvec3(black_body_colour(2000.0)) + 0.9 * glm::dvec3(black_body_colour(6500.0));
  const auto seen = cars.glare_at(std::span(users).first(1), eye_m_, Scene{}, {});
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_LT(glm::distance(glm::dvec3(seen[0].colour), mixed), 1e-5);
  const BeamImage lit = cars.beam(users[0].beam);
  ASSERT_FALSE(lit.tints.empty());
  EXPECT_NEAR(static_cast<double>(lit.tints[0].x / lit.candela[0]), mixed.x, 1e-5);
  EXPECT_NEAR(static_cast<double>(lit.tints[0].y / lit.candela[0]), mixed.z, 1e-5);
}

// What a warm-up draws: one beam of each colour that shines, and one of several, for they take pipelines of their own.
TEST_F(TrafficLamps, AreMetInEachKindOfLight) {
  const auto met = [&](const std::string& text) {
    auto beams = traffic(text).beams_to_meet();
    for (std::size_t& beam : beams) beam -= Traffic::kBeam;
    return beams;
  };
  using Beams = std::vector<std::size_t>;
  const std::string car = "[[road_user]]\n", cold = "low_beam = { colour_temperature_k = 6000 }\n";
  EXPECT_EQ(met(car + "[[road_user]]\nlights = \"high\"\n"), Beams({0})) << "both of 3200 K";
  EXPECT_EQ(met("[[road_user]]\nlights = \"high\"\n"), Beams({0}));
  EXPECT_EQ(met(car + cold + car + cold), Beams({1})) << "nobody shines by the sample car's";
  EXPECT_EQ(met(car + car + cold + "lights = \"high\"\n" + car + cold), Beams({0, 1, 2})) << "high beam of 3200 K";
  EXPECT_EQ(met(car + cold + "lights = false\n[[road_user]]\nclass = \"pedestrian\"\n"), Beams({0}));
}

// Amber tail lamps of 8 cd and brake lamps of 125 cd as they are: in the dots and in spray.
TEST_F(TrafficLamps, AtABackHaveTheirs) {
  const std::string follows = "[[road_user]]\ndirection = \"same\"\nstart_s_m = 30\nspeed_kmh = 72\n";
  const std::string amber = "tail_lamp = { chromaticity_xy = [0.56, 0.42] }\n";
  const Traffic cars = traffic(follows + follows + amber + follows + amber + "brake = true\n");
  const auto users = users_of(cars);
  const glm::dvec3 of_amber(chromaticity_colour({0.56, 0.42}));
  const glm::dvec3 wanted[] = {glm::dvec3(kSignalRed), of_amber,
                               (8.0 * of_amber + 125.0 * glm::dvec3(kSignalRed)) / 133.0};
  const RoadLine road({{0, 0, 0, 0, 0, 0}, {1000, 1000, 0, 0, 0, 0}}, {});
  const auto spray = cars.spraying(users, 0.0, road);
  ASSERT_EQ(users.size(), 3u);
  ASSERT_EQ(spray.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto seen = cars.glare_at(std::span(users).subspan(i, 1), eye_m_, Scene{}, {});
    ASSERT_GE(seen.size(), 2u);
    EXPECT_LT(glm::distance(glm::dvec3(seen[0].colour), wanted[i]), 1e-5) << i;
    EXPECT_LT(glm::distance(glm::dvec3(spray[i].tail_colour), wanted[i]), 1e-5) << i;
  }
}

// 52 cd in the middle, at the roof's rear edge, while the others burn; by its file, and of cars alone.
TEST_F(TrafficLamps, ACarHasAThirdBrakeLamp) {
  even_beside("traffic_lamps_third.ies", 90);
  const std::string follows = "[[road_user]]\ndirection = \"same\"\nstart_s_m = 45\n";
  const Traffic cars = traffic(follows + follows + "brake = true\n" + follows +
                               "brake = true\nthird_brake_lamp = \"traffic_lamps_third.ies\"\n" + follows +
                               "brake = true\nlights = false\n" + follows + "brake = true\nclass = \"lorry\"\n" +
                               follows + "brake = true\nclass = \"motorcycle\"\n");
  const auto users = users_of(cars);
  ASSERT_EQ(users.size(), 6u);
  const glm::dvec3 eye_m(0.0, 0.0, 1.37);  // as high as it
  const auto seen = [&](std::size_t user) {
    return cars.glare_at(std::span(users).subspan(user, 1), eye_m, Scene{}, {});
  };
  EXPECT_EQ(seen(0).size(), 2u) << "does not brake";
  EXPECT_EQ(seen(4).size(), 2u);
  EXPECT_EQ(seen(5).size(), 1u);
  const struct {
    std::size_t user;
    double cd;
  } lit[] = {{1, 52.0}, {2, 90.0}, {3, 52.0}};
  for (const auto& wanted : lit) {
    const auto lamps = seen(wanted.user);
    ASSERT_EQ(lamps.size(), 3u) << wanted.user;
    EXPECT_LT(glm::distance(lamps[2].place_m, glm::dvec3(43.6, 0.0, 1.37)), 1e-9);
    EXPECT_NEAR(lamps[2].eye_lx, wanted.cd / (43.6 * 43.6), 1e-9);
    EXPECT_GT(lamps[2].colour.x, 10.0f * lamps[2].colour.y) << "red";
  }
  EXPECT_EQ(cars.glare_at(std::span(users).subspan(1, 1), {60.0, 0.0, 1.37}, Scene{}, {}).size(), 2u)
      << "from ahead its headlamps alone";
}

// One lamp in the middle, of its own table and white; its peak meets the road 10 m ahead.
TEST_F(TrafficLamps, ABicycleHasAFrontLamp) {
  const Traffic cycles = traffic(
      "[[road_user]]\nclass = \"bicycle\"\nstart_s_m = 40\n[[road_user]]\nclass = \"bicycle\"\nstart_s_m = 40\n"
      "lights = false\n");
  const auto users = users_of(cycles);
  ASSERT_EQ(users.size(), 2u);
  const auto lamps = Traffic::placed_lamps(users, eye_m_, {1.0, 0.0, 0.0});
  ASSERT_EQ(lamps.size(), 1u) << "the other is dark";
  const glm::dvec3 along = lamps[0].world_from_image[0];
  const double to_road = lamps[0].position_m.z / -along.z;
  EXPECT_NEAR(to_road * -along.x, 10.0, 0.05);
  const auto table = read_lamp(generated_dir() / "lamps/bicycle.ies", {});
  ASSERT_TRUE(table);
  const BeamImage lit = cycles.beam(users[0].beam);
  EXPECT_EQ(std::ranges::max(lit.candela), static_cast<float>(table->peak_cd()));
  EXPECT_LT(glm::distance(glm::dvec3(lit.colour), glm::dvec3(black_body_colour(kBicycleLamp_k))), 1e-5);
  const auto seen = cycles.glare_at(users, eye_m_, Scene{}, {});
  ASSERT_EQ(seen.size(), 1u);
  const glm::dvec3 way_m = eye_m_ - lamps[0].position_m;
  EXPECT_NEAR(seen[0].eye_lx * glm::dot(way_m, way_m),
              table->intensity_cd(glm::transpose(lamps[0].world_from_image) * way_m), 1e-6);
}

}  // namespace
}  // namespace phare
