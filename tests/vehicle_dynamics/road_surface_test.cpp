// Height and normal of the road against an analytic surface, and what a query costs.
#include "config/road_surface.h"

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "test_car.h"

namespace phare {
namespace {

double hill(double x, double y) {
  return 2.0 * std::sin(0.02 * x) + 0.05 * y;
}

// A road 400 m long and 8 m wide in cells of `cell_m`.
RoadSurface hilly_road(double cell_m) {
  std::vector<RoadSurface::Triangle> triangles;
  const auto point = [&](int i, int j) {
    const double x = i * cell_m, y = j * cell_m - 4.0;
    return glm::dvec3(x, y, hill(x, y));
  };
  for (int i = 0; i < static_cast<int>(400.0 / cell_m); ++i)
    for (int j = 0; j < static_cast<int>(8.0 / cell_m); ++j) {
      triangles.push_back({{point(i, j), point(i + 1, j), point(i + 1, j + 1)}, true});
      triangles.push_back({{point(i, j + 1), point(i, j), point(i + 1, j + 1)}, true});
    }
  return RoadSurface::from_triangles(triangles);
}

TEST(RoadSurface, FollowsAnAnalyticSurface) {
  const double cell = 0.5;
  const RoadSurface road = hilly_road(cell);
  EXPECT_EQ(road.triangle_count(), 2u * 800u * 16u);
  const double height_bound = cell * cell / 8.0 * 2.0 * 0.02 * 0.02 + 1e-12;  // h^2/8 max|z''|
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(0.0, 400.0), across(-4.0, 4.0);
  for (int i = 0; i < 20'000; ++i) {
    const double x = along(random), y = across(random);
    const auto point = road.at(x, y);
    ASSERT_TRUE(point) << x << ", " << y;
    EXPECT_NEAR(point->z_m, hill(x, y), height_bound);
    const glm::dvec3 slope(-0.04 * std::cos(0.02 * x), -0.05, 1.0);
    EXPECT_GT(glm::dot(point->normal, glm::normalize(slope)), 1.0 - 1e-6);
  }
}

TEST(RoadSurface, LeavesNoCracks) {
  const RoadSurface road = hilly_road(0.5);
  for (double x = 0.0; x <= 400.0; x += 0.25)  // corners, edges and diagonals of the cells
    for (double y = -4.0; y <= 4.0; y += 0.25) ASSERT_TRUE(road.at(x, y)) << x << ", " << y;
}

TEST(RoadSurface, NothingBesideIt) {
  const RoadSurface road = hilly_road(0.5);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(road.at(-0.01, 0.0));
  EXPECT_FALSE(road.at(10.0, 4.01));
  EXPECT_FALSE(road.at(kNan, 0.0));
  EXPECT_FALSE(road.at(0.0, -kInf));
  EXPECT_FALSE(road.at(1e300, 1e300));
  EXPECT_FALSE(RoadSurface().at(0.0, 0.0));
}

TEST(RoadSurface, RoadGoesBeforeGround) {
  const auto square = [](double z, bool road) {
    return RoadSurface::Triangle{{glm::dvec3(-9, -9, z), glm::dvec3(9, -9, z), glm::dvec3(0, 9, z)}, road};
  };
  const RoadSurface surface = RoadSurface::from_triangles({square(0.0, true), square(0.3, false), square(-1.0, true)});
  EXPECT_EQ(surface.at(0.0, 0.0)->z_m, 0.0);
  EXPECT_TRUE(surface.at(0.0, 0.0)->road);
}

TEST(RoadSurface, DegenerateTrianglesAreLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const RoadSurface surface =
      RoadSurface::from_triangles({{{glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(2, 0, 0)}, true},  // a line
                                   {{glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(1, 0, 5)}, true},  // a wall
                                   {{glm::dvec3(kNan, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 5)}, true}});
  EXPECT_EQ(surface.triangle_count(), 0u);
}

TEST(RoadSurface, QueryTime) {
  const RoadSurface road = hilly_road(0.5);
  constexpr int kQueries = 1'000'000;
  double sum = 0.0, best_ns = 1e9;
  for (int run = 0; run < 3; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kQueries; ++i) {
      const auto point = road.at(std::fmod(i * 0.037, 400.0), std::fmod(i * 0.011, 8.0) - 4.0);
      sum += point ? point->z_m : 0.0;
    }
    best_ns = std::min(
        best_ns, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() / kQueries);
  }
  std::printf("road query: %.0f ns over %zu triangles (checksum %.3g)\n", best_ns, road.triangle_count(), sum);
#ifdef NDEBUG
  EXPECT_LT(best_ns, 1000.0);
#endif
}

}  // namespace
}  // namespace phare
