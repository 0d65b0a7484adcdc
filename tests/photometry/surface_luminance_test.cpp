// Reference: luminance of rough surfaces and of a road by its r-table against another program's values; unit: limits,
// files that are wrong.
#include "visual/photometry/table/surface_luminance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "photometry_test_files.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/table/illuminance.h"

namespace phare {
namespace {

using test::Csv;
using test::shared_data;
using test::temporary_file;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

LightAndSight at_angles(double light_deg, double sight_deg, double azimuth_deg) {
  const auto direction = [](double from_normal_deg, double turn_deg) {
    const double t = from_normal_deg * kRadPerDeg, f = turn_deg * kRadPerDeg;
    return glm::dvec3(std::sin(t) * std::cos(f), std::sin(t) * std::sin(f), std::cos(t));
  };
  return {.to_lamp = direction(light_deg, 0.0), .to_eye = direction(sight_deg, azimuth_deg)};
}

TEST(SurfaceLuminance, SmoothIsLambertAndRoughSendsBack) {
  for (const double light : {0.0, 40.0, 88.76}) {
    EXPECT_NEAR(oren_nayar_per_sr(0.3, 0.0, at_angles(light, 30.0, 50.0)), 0.3 / std::numbers::pi, 1e-12);
    EXPECT_NEAR(oren_nayar_simple_per_sr(0.3, 0.0, at_angles(light, 30.0, 50.0)), 0.3 / std::numbers::pi, 1e-12);
  }
  const double rough = 20.0 * kRadPerDeg;
  const double back = oren_nayar_per_sr(0.1, rough, at_angles(88.76, 87.71, 0.0));
  EXPECT_GT(back, 3.0 * oren_nayar_per_sr(0.1, rough, at_angles(88.76, 87.71, 180.0)));
  EXPECT_EQ(oren_nayar_per_sr(0.1, rough, at_angles(91.0, 10.0, 0.0)), 0.0) << "lit from below";
  EXPECT_EQ(oren_nayar_per_sr(0.1, rough, at_angles(10.0, 91.0, 0.0)), 0.0) << "seen from below";
}

TEST(SurfaceLuminance, AnRTableIsReadAndWrongOnesSayWhere) {
  const auto good = read_r_table(temporary_file("r.csv", "# note\nt\\b,0,90,180\n0,100,100,100\n2,300,200,100\n"));
  ASSERT_TRUE(good.ok()) << good.error().text();
  EXPECT_NEAR(good->r_at(45.0, 1.0), 0.5 * (0.01 + 0.025), 1e-15);
  EXPECT_EQ(good->r_at(0.0, 2.1), 0.0);
  EXPECT_NEAR(good->q_per_sr(0.0, 2.0), 0.03 * std::pow(5.0, 1.5), 1e-15);
  // Straight beyond the point: beta 0; the lamp over the eye's side: 180°.
  EXPECT_NEAR(road_luminance_cdm2(*good, 1000.0, {20, 0, 10}, {0, 0, 0}, {-60, 0, 1.5}), 1000.0 * 0.03 / 100.0, 1e-12);
  EXPECT_NEAR(road_luminance_cdm2(*good, 1000.0, {-20, 0, 10}, {0, 0, 0}, {-60, 0, 1.5}), 1000.0 * 0.01 / 100.0, 1e-12);
  EXPECT_EQ(road_luminance_cdm2(*good, 1000.0, {20, 0, -1}, {0, 0, 0}, {-60, 0, 1.5}), 0.0);

  const auto reason = [](const std::string& text) {
    const auto bad = read_r_table(temporary_file("bad.csv", text));
    return bad.ok() ? std::string("none") : bad.error().text().substr(bad.error().text().find("bad.csv"));
  };
  EXPECT_EQ(reason("t,0,180\n0,1,x\n"), "bad.csv:2: expected a number, got \"x\"");
  EXPECT_EQ(reason("t,0,180\n0,1\n"), "bad.csv:2: expected tan gamma and 2 values, got 2 numbers");
  EXPECT_EQ(reason("t,0,180\n1,1,1\n1,1,1\n"), "bad.csv:3: tan gamma has to rise");
  EXPECT_EQ(reason("t,0,90\n"), "bad.csv:1: expected angles from 0 to 180, got 0 to 90");
  EXPECT_EQ(reason("t,0,180\n0,1,1\n1,-1,1\n"), "bad.csv:3: a negative number");
  EXPECT_EQ(reason("t,0,180\n0,655,600\n"), "bad.csv:2: light from straight above has one r, got 600 to 655");
  EXPECT_EQ(reason("t,0,180\n0,0,0\n1,0,0\n"), "bad.csv: the road sends no light back");
  const auto german = read_r_table(temporary_file("s.csv", "t;0;180\n0;1,5;1,5\n2,5;3;2\n"));
  ASSERT_TRUE(german.ok()) << german.error().text();
  EXPECT_EQ(german->tan_gamma, (std::vector<double>{0.0, 2.5}));
  EXPECT_DOUBLE_EQ(german->r_at(0.0, 0.0), 1.5e-4);
  EXPECT_EQ(reason("t,90,0\n"), "bad.csv:1: expected two angles or more that rise");
  EXPECT_EQ(reason(""), "bad.csv: expected two lines of tan gamma or more");
  EXPECT_FALSE(read_r_table("/nowhere/r.csv").ok());
}

class SurfaceReference : public testing::Test {
 protected:
  void SetUp() override {
    PHARE_NEEDS_SHARED_DATA("photometry-reference/manifest.json");
    std::ifstream(folder_ / "manifest.json") >> manifest_;
    const auto key = manifest_["primary_file_per_beam"]["low"].get<std::string>();
    auto read = read_lamp(folder_ / manifest_["files"][key]["file"].get<std::string>(), {});
    ASSERT_TRUE(read.ok());
    low_ = std::move(*read);
    eye_m_ = vec(manifest_["eye_m"]);
  }
  static glm::dvec3 vec(const nlohmann::json& v) { return {v[0], v[1], v[2]}; }
  std::vector<PlacedSource> placed(const nlohmann::json& mountings) const {
    std::vector<PlacedSource> sources;
    for (const auto& m : mountings)
      sources.push_back({&low_, vec(m["position_m"]), {vec(m["forward"]), vec(m["left"]), vec(m["up"])}});
    return sources;
  }

  const std::filesystem::path folder_ = shared_data("photometry-reference");
  nlohmann::json manifest_;
  IntensityTable low_;
  glm::dvec3 eye_m_{0.0};
};

TEST_F(SurfaceReference, RoughRoadsAreThoseOfTheReference) {
  const Csv csv(folder_ / "g_luminance_road.csv");
  const double rho = manifest_["road_reflectance"];
  const glm::dvec3 up(0, 0, 1);
  double worst = 0.0;
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const glm::dvec3 point(csv.number(i, "x"), csv.number(i, "y"), csv.number(i, "z"));
    double simple_20 = 0.0, simple_35 = 0.0, full_20 = 0.0, full_35 = 0.0, lambert = 0.0;
    for (const PlacedSource& lamp : placed(manifest_["mounting"]["low"])) {
      const double lx = illuminance_lx(lamp.position_m, lamp.world_from_lamp, low_, 1.0, point, up);
      const LightAndSight at{up, glm::normalize(lamp.position_m - point), glm::normalize(eye_m_ - point)};
      lambert += lx * rho / std::numbers::pi;
      simple_20 += lx * oren_nayar_simple_per_sr(rho, 20.0 * kRadPerDeg, at);
      simple_35 += lx * oren_nayar_simple_per_sr(rho, 35.0 * kRadPerDeg, at);
      full_20 += lx * oren_nayar_per_sr(rho, 20.0 * kRadPerDeg, at);
      full_35 += lx * oren_nayar_per_sr(rho, 35.0 * kRadPerDeg, at);
    }
    const auto compare = [&](double found, const char* column) {
      const double expected = csv.number(i, column);
      if (expected > 0.0) worst = std::max(worst, std::abs(found / expected - 1.0));
    };
    compare(lambert, "L_lambert");
    compare(simple_20, "L_on_qualitative_20deg");
    compare(simple_35, "L_on_qualitative_35deg");
    compare(full_20, "L_on_full_20deg");
    compare(full_35, "L_on_full_35deg");
  }
  std::printf("rough roads: %zu points of five forms, worst relative difference %.2g\n", csv.rows.size(), worst);
  EXPECT_GT(csv.rows.size(), 100u);
  EXPECT_LE(worst, 1e-9);
}

TEST_F(SurfaceReference, RoadsByR3AreThoseOfTheReference) {
  const auto r3 = read_r_table(folder_ / "cie_r3_table.csv");
  ASSERT_TRUE(r3.ok()) << r3.error().text();
  const Csv look_ups(folder_ / "g_rtable_r3.csv"), oncoming(folder_ / "g_rtable_r3_oncoming.csv");
  double worst = 0.0;
  const auto compare = [&](double found, double expected) {
    worst = std::max(worst, std::abs(found - expected) / (expected > 0.0 ? expected : 1.0));
  };
  for (std::size_t i = 0; i < look_ups.rows.size(); ++i) {
    const double beta = look_ups.number(i, "beta_deg"), tangent = look_ups.number(i, "tan_gamma");
    compare(r3->r_at(beta, tangent), look_ups.number(i, "r_per_sr"));
    compare(r3->q_per_sr(beta, tangent), look_ups.number(i, "q_per_sr"));
    compare(10000.0 * r3->r_at(beta, tangent) / 64.0, look_ups.number(i, "L_for_I_10000cd_H_8m"));
  }
  const std::vector<PlacedSource> lamps = placed(manifest_["oncoming_lamps"]);
  for (std::size_t i = 0; i < oncoming.rows.size(); ++i) {
    const PlacedSource& lamp = lamps[oncoming.text(i, "lamp") == "onc_left" ? 0 : 1];
    const glm::dvec3 point(oncoming.number(i, "x"), oncoming.number(i, "y"), oncoming.number(i, "z"));
    const double cd = low_.intensity_cd((point - lamp.position_m) * lamp.world_from_lamp);
    compare(road_luminance_cdm2(*r3, cd, lamp.position_m, point, eye_m_), oncoming.number(i, "L_r3"));
  }
  std::printf("R3: %zu look-ups, %zu points, worst relative difference %.2g\n", look_ups.rows.size(),
              oncoming.rows.size(), worst);
  EXPECT_LE(worst, 1e-9);
}

}  // namespace
}  // namespace phare
