// visual: long edges are halved, the same on both sides, and light on a wide plain is what float64 says.
#include "visual/scene/long_edges.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <tuple>

namespace phare {
namespace {

MeshCorners square(double side_m, double height_m = 0.0) {
  const double h = 0.5 * side_m;
  MeshCorners corners;
  for (const glm::dvec3& at :
       {glm::dvec3(-h, -h, 0), glm::dvec3(h, -h, height_m), glm::dvec3(h, h, 0), glm::dvec3(-h, h, 0)})
    corners.at.push_back({at, {0, 0, 1}});
  return corners;
}

double longest_m(const MeshCorners& corners, const std::vector<std::uint32_t>& t) {
  double longest = 0.0;
  for (std::size_t i = 0; i + 2 < t.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      longest =
          std::max(longest, glm::distance(corners.at[t[i + k]].position, corners.at[t[i + (k + 1) % 3]].position));
  return longest;
}

TEST(LongEdges, ASquareIsTheSameSurfaceOfSmallTriangles) {
  MeshCorners corners = square(1000.0);
  std::vector<std::uint32_t> triangles{0, 1, 2, 0, 2, 3};
  EXPECT_EQ(halve_long_edges(corners, triangles), kLongestEdge_m);
  EXPECT_LE(longest_m(corners, triangles), kLongestEdge_m);
  double area_m2 = 0.0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;  // each inner side is that of two, one in each sense
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const auto at = [&](std::size_t k) { return corners.at[triangles[i + k]].position; };
    const glm::dvec3 twice = glm::cross(at(1) - at(0), at(2) - at(0));
    EXPECT_GT(twice.z, 0.0) << "none is turned over";
    area_m2 += 0.5 * twice.z;
    for (std::size_t k = 0; k < 3; ++k) ++sides[{triangles[i + k], triangles[i + (k + 1) % 3]}];
  }
  EXPECT_NEAR(area_m2, 1e6, 1e-6);
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    const glm::dvec3 a = corners.at[side.first].position, b = corners.at[side.second].position;
    const bool at_the_edge = (std::abs(a.x) == 500 && a.x == b.x) || (std::abs(a.y) == 500 && a.y == b.y);
    EXPECT_EQ(sides.count({side.second, side.first}), at_the_edge ? 0u : 1u);
  }
}

TEST(LongEdges, NeighboursOfTwoPrimitivesHalveTheirSideAlike) {
  // A slope beside the square, whose corners it has in another order.
  MeshCorners left = square(777.0), right;
  right.at = {left.at[2], {glm::dvec3(900.0, 31.0, 5.0), {0, 0, 1}}, left.at[1]};
  std::vector<std::uint32_t> of_left{0, 1, 2, 0, 2, 3}, of_right{1, 0, 2};
  halve_long_edges(left, of_left);
  halve_long_edges(right, of_right);
  const auto on_side = [](const MeshCorners& corners) {
    std::set<std::tuple<double, double, double>> there;
    for (const MeshCorner& c : corners.at)
      if (c.position.x == 388.5) there.insert({c.position.x, c.position.y, c.position.z});
    return there;
  };
  EXPECT_GT(on_side(left).size(), 7u);
  EXPECT_EQ(on_side(left), on_side(right));
}

TEST(LongEdges, ShortOnesStayAsTheyAreAndAPlanetIsNotMadeOfSand) {
  MeshCorners corners = square(90.0);
  std::vector<std::uint32_t> triangles{0, 1, 2, 0, 2, 3};
  halve_long_edges(corners, triangles);
  EXPECT_EQ(triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(corners.at.size(), 4u);
  MeshCorners wide = square(3e5);
  const double left_m = halve_long_edges(wide, triangles);
  EXPECT_GT(left_m, kLongestEdge_m);
  EXPECT_LE(longest_m(wide, triangles), left_m);
  EXPECT_LE(triangles.size(), 12u + 3u * 65536u);
}

}  // namespace
}  // namespace phare
