// Height and normal of the road against an analytic surface, and what a query costs.
#include "config/road/road_surface.h"

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
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
  // A scene whose axes are not glTF's has a road, but one that stands.
  EXPECT_NE(no_ground_below(surface, 0.0, 0.0).find("stands upright"), std::string::npos);
  EXPECT_NE(no_ground_below(RoadSurface(), 0.0, 0.0).find("no node"), std::string::npos);
}

// A winding strip of 2 m triangles through a country of few large ones, as real scenes are.
std::vector<RoadSurface::Triangle> winding_road() {
  std::vector<RoadSurface::Triangle> triangles;
  const auto strip = [](double s, double aside) {
    const double x = s * std::cos(s / 400.0), y = s * std::sin(s / 400.0), heading = s / 400.0 + std::atan(s / 400.0);
    const glm::dvec2 p(x - aside * std::sin(heading), y + aside * std::cos(heading));
    return glm::dvec3(p, hill(p.x, p.y));
  };
  for (int i = 0; i < 500; ++i)
    for (int j = -2; j < 2; ++j) {
      const double s = 2.0 * i, t = 1.75 * j;
      triangles.push_back({{strip(s, t), strip(s + 2.0, t), strip(s + 2.0, t + 1.75)}, true});
      triangles.push_back({{strip(s, t + 1.75), strip(s, t), strip(s + 2.0, t + 1.75)}, true});
    }
  for (int i = -12; i < 12; ++i)
    for (int j = -12; j < 12; ++j) {
      const auto corner = [&](int di, int dj) {
        const double x = 90.0 * (i + di), y = 90.0 * (j + dj);
        return glm::dvec3(x, y, hill(x, y) + 1.0);  // above the road, which counts all the same
      };
      triangles.push_back({{corner(0, 0), corner(1, 0), corner(1, 1)}, false});
      triangles.push_back({{corner(0, 1), corner(0, 0), corner(1, 1)}, false});
    }
  return triangles;
}

// The rule of the header, triangle by triangle.
std::optional<RoadPoint> looked_for_everywhere(const std::vector<RoadSurface::Triangle>& triangles, double x,
                                               double y) {
  std::optional<RoadPoint> best;
  for (const RoadSurface::Triangle& triangle : triangles) {
    const auto& corner = triangle.corner_m;
    const bool road = triangle.road;
    const glm::dvec3 p = corner[1] - corner[0], q = corner[2] - corner[0];
    const double area = p.x * q.y - p.y * q.x, dx = x - corner[0].x, dy = y - corner[0].y;
    const double u = (q.y * dx - q.x * dy) / area, v = (p.x * dy - p.y * dx) / area;
    if (std::min({u, v, 1.0 - u - v}) < -1e-7) continue;
    const double z = corner[0].z + u * p.z + v * q.z;
    if (!best || (road && !best->road) || (road == best->road && z > best->z_m)) best = RoadPoint{z, {}, road};
  }
  return best;
}

TEST(RoadSurface, CrowdedCellsFindWhatLookingEverywhereFinds) {
  const auto triangles = winding_road();
  const RoadSurface road = RoadSurface::from_triangles(triangles);
  std::vector<glm::dvec2> places;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (std::size_t i = 0; i < triangles.size(); i += 7) {  // corners, a point of an edge, one inside
    const auto& t = triangles[i];
    const double u = part(random), v = (1.0 - u) * part(random);
    places.emplace_back(t.corner_m[0]);
    places.emplace_back(t.corner_m[0] + u * (t.corner_m[1] - t.corner_m[0]));
    places.emplace_back(t.corner_m[0] + u * (t.corner_m[1] - t.corner_m[0]) + v * (t.corner_m[2] - t.corner_m[0]));
  }
  int on_road = 0;
  for (const glm::dvec2& p : places) {
    const auto found = road.at(p.x, p.y), expected = looked_for_everywhere(triangles, p.x, p.y);
    ASSERT_EQ(found.has_value(), expected.has_value()) << p.x << ", " << p.y;
    if (!found) continue;
    ASSERT_EQ(found->road, expected->road) << p.x << ", " << p.y;
    ASSERT_NEAR(found->z_m, expected->z_m, 1e-9) << p.x << ", " << p.y;
    ASSERT_EQ(road.height_m(p.x, p.y), found->z_m);
    on_road += found->road ? 1 : 0;
  }
  EXPECT_GT(on_road, 1000);
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
  const RoadSurface winding = RoadSurface::from_triangles(winding_road());
  double best_winding_ns = 1e9;
  for (int run = 0; run < 3; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kQueries; ++i) {
      const double s = 1000.0 * i / kQueries;
      sum += winding.height_m(s * std::cos(s / 400.0), s * std::sin(s / 400.0)).value_or(0.0);
    }
    best_winding_ns =
        std::min(best_winding_ns,
                 std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() / kQueries);
  }
  std::printf("winding road: %.0f ns over %zu triangles (checksum %.3g)\n", best_winding_ns, winding.triangle_count(),
              sum);
#ifdef NDEBUG
  EXPECT_LT(best_ns, 1000.0);
  EXPECT_LT(best_winding_ns, 1000.0);
#endif
}

}  // namespace
}  // namespace phare
