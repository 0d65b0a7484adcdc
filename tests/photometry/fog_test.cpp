// Reference: light in fog in float64 against the quadratures of another program; unit: its phase functions and limits.
#include "visual/photometry/table/fog.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "photometry_test_files.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

using test::Csv;
using test::shared_data;

IntensityTable even_table(double cd) {
  IntensityTable table;
  table.first_deg = {-180.0, 180.0};
  table.second_deg = {-90.0, 90.0};
  table.candela.assign(4, cd);
  return table;
}

TEST(Fog, ExtinctionIsThatOfFivePercent) {
  EXPECT_NEAR(extinction_per_m(100.0), 0.02995732273553991, 1e-16);
  EXPECT_NEAR(transmittance(extinction_per_m(300.0), 300.0), 0.05, 1e-15);
  EXPECT_EQ(transmittance(extinction_per_m(1.0), 1e4), 0.0);
}

TEST(Fog, WhatScattersSendsAllLightSomewhere) {
  for (const FogDroplets& droplets : {FogDroplets{0.0}, FogDroplets{0.85}, FogDroplets{-0.3}, FogDroplets{}}) {
    double sum = 0.0;
    constexpr int kSteps = 40000;
    for (int i = 0; i < kSteps; ++i) {
      const double angle = std::numbers::pi * (i + 0.5) / kSteps;
      sum += 2.0 * std::numbers::pi * phase_per_sr(droplets, angle) * std::sin(angle) * std::numbers::pi / kSteps;
    }
    EXPECT_NEAR(sum, 1.0, 1e-4);  // midpoints: the forward peak of 0.3° takes 40 of them
  }
  // Droplets, as the table has them: far more light comes back to the lamp than Henyey–Greenstein's 0.85 sends.
  const double back = phase_per_sr({}, std::numbers::pi);
  EXPECT_GT(back, 8.0 * phase_per_sr({0.85}, std::numbers::pi));
  EXPECT_LT(std::abs(phase_per_sr({}, 0.5 * std::numbers::pi) / 0.0022 - 1.0), 0.1) << "scaled by a few percent only";
}

/// An isotropic lamp in isotropic fog: a closed form (Sun et al. 2005) has 0.54591.
TEST(Fog, AnEvenLampGivesWhatTheClosedFormHas) {
  const IntensityTable table = even_table(1000.0);
  const double angle = 15.0 * std::numbers::pi / 180.0;
  const PlacedSource lamp{.table = &table, .position_m = {20.0 * std::cos(angle), 20.0 * std::sin(angle), 0.0}};
  EXPECT_NEAR(airlight_cdm2(std::span(&lamp, 1), extinction_per_m(100.0), {0.0}, {}, {1, 0, 0}, 40.0), 0.54591, 1e-5);
}

/// Visibility 1 m and 100 km, the eye at the lamp, the lamp behind the eye, a ray through the lamp: finite, and rising
/// with the length of the ray.
TEST(Fog, StaysFiniteWhereItIsHard) {
  const IntensityTable table = even_table(40000.0);
  for (const double visibility_m : {1.0, 10.0, 1e5})
    for (const glm::dvec3& at_m : {glm::dvec3(0.0), glm::dvec3(1e-6, 0, 0), glm::dvec3(-2, 0, 0), glm::dvec3(30, 0, 0),
                                   glm::dvec3(5, 1e-9, 0)}) {
      const PlacedSource lamp{.table = &table, .position_m = at_m};
      double before = 0.0;
      for (const double length_m : {0.001, 1.0, 10.0, 1000.0}) {
        const double now =
            airlight_cdm2(std::span(&lamp, 1), extinction_per_m(visibility_m), {}, {}, {1, 0, 0}, length_m);
        EXPECT_TRUE(std::isfinite(now)) << visibility_m << " m, lamp at " << at_m.x << ", " << length_m;
        EXPECT_GE(now, before * (1.0 - 1e-6));
        before = now;
      }
    }
}

TEST(Fog, TransmittanceIsThatOfTheReference) {
  PHARE_NEEDS_SHARED_DATA("photometry-reference/h_transmittance.csv");
  const Csv csv(shared_data("photometry-reference/h_transmittance.csv"));
  double worst = 0.0;
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const double sigma = extinction_per_m(csv.number(i, "MOR_5pct_m")), expected = csv.number(i, "transmittance");
    worst = std::max(worst, std::abs(transmittance(sigma, csv.number(i, "distance_m")) / expected - 1.0));
  }
  std::printf("transmittance: %zu rows, worst relative difference %.2g\n", csv.rows.size(), worst);
  EXPECT_GT(csv.rows.size(), 10u);
  EXPECT_LE(worst, 1e-10);
}

TEST(Fog, AirlightIsThatOfTheReference) {
  PHARE_NEEDS_SHARED_DATA("photometry-reference/h_airlight.csv");
  const auto folder = shared_data("photometry-reference");
  nlohmann::json manifest;
  std::ifstream(folder / "manifest.json") >> manifest;
  const auto vec = [](const nlohmann::json& v) { return glm::dvec3(v[0], v[1], v[2]); };
  const auto table_of = [&](const char* beam) {
    const auto key = manifest["primary_file_per_beam"][beam].get<std::string>();
    return std::move(*read_lamp(folder / manifest["files"][key]["file"].get<std::string>(), {}));
  };
  const IntensityTable low = table_of("low");
  const auto placed = [&](const nlohmann::json& mountings) {
    std::vector<PlacedSource> sources;
    for (const auto& m : mountings)
      sources.push_back({&low, vec(m["position_m"]), {vec(m["forward"]), vec(m["left"]), vec(m["up"])}});
    return sources;
  };
  const std::vector<PlacedSource> own = placed(manifest["mounting"]["low"]),
                                  oncoming = placed(manifest["oncoming_lamps"]);
  const Csv csv(folder / "h_airlight.csv");
  double worst = 0.0;
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const auto media = manifest["media"];
    const auto medium = std::find_if(media.begin(), media.end(),
                                     [&](const nlohmann::json& m) { return m["name"] == csv.text(i, "medium"); });
    ASSERT_NE(medium, media.end());
    const auto& sources = csv.text(i, "kind") == "oncoming" ? oncoming : own;
    const FogDroplets droplets{(*medium)["g"].get<double>(), (*medium)["albedo"].get<double>()};
    const double expected = csv.number(i, "L_air");
    const double found =
        airlight_cdm2(sources, (*medium)["sigma_t"], droplets, vec(manifest["eye_m"]),
                      {csv.number(i, "dx"), csv.number(i, "dy"), csv.number(i, "dz")}, csv.number(i, "length_m"));
    const double off = std::abs(found - expected) / (expected > 0.0 ? expected : 1.0);
    worst = std::max(worst, off);
    EXPECT_LE(off, 1e-6) << csv.text(i, "kind") << " " << csv.text(i, "medium") << " row " << i << ": expected "
                         << expected << ", got " << found;
  }
  std::printf("airlight: %zu rays, worst relative difference %.2g\n", csv.rows.size(), worst);
  EXPECT_GT(csv.rows.size(), 50u);
}

}  // namespace
}  // namespace phare
