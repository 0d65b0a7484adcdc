// Where the grid of fog has its nodes, and what pixels between them get. No device.
#include "visual/fog_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "visual/passes/fog.h"

namespace phare {
namespace {

/// Nodes rise from 0 to 1, lie closest about lamps, and pixels find their place among them.
TEST(FogNodes, LieCloseAboutLamps) {
  const NodeRow even = place_nodes(11, {}, {}, 0.5);
  for (std::size_t i = 0; i < even.at_01.size(); ++i) EXPECT_NEAR(even.at_01[i], 0.1 * static_cast<double>(i), 1e-8);
  const NodeRow row = place_nodes(72, {}, {{0.3, 1e-3}, {0.3001, 1e-3}, {0.8, 1e-2}}, 0.6);
  const std::vector<double>& nodes = row.at_01;
  ASSERT_EQ(nodes.front(), 0.0);
  ASSERT_EQ(nodes.back(), 1.0);
  ASSERT_TRUE(std::ranges::is_sorted(nodes, std::less_equal<>()));
  ASSERT_EQ(row.peaks.size(), 2u) << "two of one housing";
  const auto step_at = [&](double at_01) {
    const auto after = std::ranges::upper_bound(nodes, at_01);
    return *after - *(after - 1);
  };
  EXPECT_LT(step_at(0.3), 1e-3);
  EXPECT_LT(step_at(0.8), 1e-2);
  EXPECT_GT(step_at(0.55), 0.01);
  const auto pixels_of = [](const NodeRow& of) { return places_of_pixels(of, 10.0, 300.0); };
  const std::vector<double> places = pixels_of(row), along_even = pixels_of(even);
  ASSERT_EQ(places.size(), 310u);
  for (std::size_t px = 10; px < places.size(); ++px) {
    const double at_01 = (static_cast<double>(px) + 0.5 - 10.0) / 300.0;
    const auto node = static_cast<std::size_t>(places[px]);
    EXPECT_GE(at_01, nodes[node]);
    EXPECT_LT(at_01, nodes[node + 1]);
    EXPECT_GE(places[px], places[px - 1]);
    EXPECT_NEAR(along_even[px], 10.0 * at_01, 1e-3) << "without a lamp, straight";
  }
}

/// One over the distance from each of four lamps, of which two 50 m away, in a picture of 1280 × 720: what pixels get
/// of it between nodes of `medium`.
TEST(FogNodes, FollowTheFallBesideLamps) {
  const Camera camera{.eye_m = {-1.6, 0.35, 1.2}, .fov_horizontal_rad = 1.0};
  const ViewGeometry view(camera, 1280.0 / 720.0);
  std::vector<LampInFog> lamps;
  for (const glm::dvec3& at_m : {glm::dvec3(50.0, 4.1, 0.65), glm::dvec3(50.0, 2.9, 0.65)})
    lamps.push_back({at_m - camera.eye_m, {-1.0, 0.0, -0.01}});
  for (const glm::dvec3& at_m : {glm::dvec3(0.0, 0.6, 0.65), glm::dvec3(0.0, -0.6, 0.65)})
    lamps.push_back({at_m - camera.eye_m, {1.0, 0.0, -0.01}});
  const FogLevel& medium = kFogLevels[2];
  const FogNodes nodes =
      place_nodes(view, {1280, 720}, lamps, medium.columns, medium.rows, medium.columns_of_peaks);
  const auto light_at = [&](double x_01, double y_01, double* nearest_m) {
    const glm::dvec3 ray = view.ray_through(1280.0 * x_01 - 0.5, 720.0 * y_01 - 0.5, 1280, 720).direction;
    double sum = 0.0;
    for (const LampInFog& lamp : std::span(lamps).first(2)) {
      const double aside_m = glm::length(glm::cross(lamp.from_eye_m, ray));
      sum += 1.0 / aside_m;
      if (nearest_m) *nearest_m = std::min(*nearest_m, aside_m);
    }
    return sum;
  };
  const std::vector<double> across = places_of_pixels(nodes.columns, 0.0, 1280.0),
                            down = places_of_pixels(nodes.rows, 0.0, 720.0);
  double worst = 0.0;
  std::size_t pixels = 0;
  // A part of the picture about the two: 5 m to either side, 3 m up and down.
  for (std::size_t y = 280; y < 440; ++y)
    for (std::size_t x = 400; x < 680; ++x) {
      double nearest_m = 1e9;
      const double expected =
          light_at((static_cast<double>(x) + 0.5) / 1280.0, (static_cast<double>(y) + 0.5) / 720.0, &nearest_m);
      if (nearest_m < 0.1) continue;
      ++pixels;
      const auto column = static_cast<std::size_t>(across[x]), row = static_cast<std::size_t>(down[y]);
      const double u = across[x] - std::floor(across[x]), v = down[y] - std::floor(down[y]);
      const auto node = [&](std::size_t i, std::size_t k) {
        return light_at(nodes.columns.at_01[i], nodes.rows.at_01[k], nullptr);
      };
      const double found = (1.0 - v) * ((1.0 - u) * node(column, row) + u * node(column + 1, row)) +
                           v * ((1.0 - u) * node(column, row + 1) + u * node(column + 1, row + 1));
      worst = std::max(worst, std::abs(found / expected - 1.0));
    }
  std::printf("1/d beside lamps at 50 m: %zu pixels, worst relative difference %.2g\n", pixels, worst);
  EXPECT_GT(pixels, 40000u);
  // Of the 5 % that are asked of every ray at this level, a tenth is for steps and half floats. Straight lines between
  // nodes, with as many nodes for near lamps as for far ones, are off by 49 %.
  EXPECT_LE(worst, 0.045);
}

}  // namespace
}  // namespace phare
