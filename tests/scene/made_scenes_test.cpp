// unit: the line that town, motorway and tunnel are laid along, and what is laid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "config/base/conventions.h"
#include "config/base/paths.h"
#include "tools/scene/path.h"
#include "visual/scene/scene.h"

namespace phare::scene {
namespace {

// A bend of curvature (1 - cos)/2R turns by half its length over R; before and after it the line is straight.
TEST(Path, ABendTurnsByHalfItsLengthOverItsRadius) {
  const Path path(400.0, 50.0, {{100.0, 200.0, 80.0}, {250.0, 350.0, -60.0}});
  EXPECT_EQ(path.heading_rad(50.0), 0.0);
  EXPECT_EQ(path.point(50.0, 0.0), glm::dvec3(50.0, 0.0, 0.0));
  // Simpson's rule over steps of 1 m of a cosine of 100 m: exact to (2 pi/100)^4/2880 of it.
  EXPECT_NEAR(path.heading_rad(220.0), 100.0 / (2 * 80.0), 1e-6);
  EXPECT_NEAR(path.heading_rad(380.0), 100.0 / (2 * 80.0) - 100.0 / (2 * 60.0), 1e-6);
  EXPECT_NEAR(path.curvature_1pm(150.0), 1.0 / 80.0, 1e-15);
}

TEST(Path, OffsetsAreToItsLeft) {
  const Path path(400.0, 50.0, {{100.0, 200.0, 80.0}});
  for (const double s_m : {0.0, 120.5, 150.0, 300.25}) {
    const glm::dvec3 middle = path.point(s_m, 0.0), left = path.point(s_m, 3.5, 0.2);
    const double heading = path.heading_rad(s_m);
    EXPECT_NEAR(glm::distance(glm::dvec2(left), glm::dvec2(middle)), 3.5, 1e-12);
    EXPECT_NEAR(glm::dot(left - middle, glm::dvec3(std::cos(heading), std::sin(heading), 0.0)), 0.0, 1e-12);
    EXPECT_GT(glm::dot(left - middle, glm::dvec3(-std::sin(heading), std::cos(heading), 0.0)), 3.4);
    EXPECT_EQ(left.z, 0.2);
  }
}

// So that pieces that share a corner have it in one place, whichever origin each is stored about.
TEST(MadeScenes, EveryCornerLiesOnTheGridOfPlaces) {
  for (const char* name : {"country_road", "town", "motorway", "tunnel", "road_users"}) {
    const Result<Scene> scene = read_scene(generated_dir() / "scenes" / (std::string(name) + ".glb"));
    ASSERT_TRUE(scene.ok()) << scene.error().text();
    std::size_t off = 0;
    for (const SceneChunk& chunk : scene->chunks)
      for (std::uint32_t i = 0; i < chunk.vertex_count; ++i) {
        const glm::dvec3 at_m = chunk.origin_m + glm::dvec3(scene->vertices[chunk.first_vertex + i].position_m);
        off += at_m != on_place_grid(at_m);
      }
    EXPECT_EQ(off, 0u) << name << " of " << scene->vertices.size();
  }
}

// Rows of a lane are a metre of its own length apart, also where it bends beside the line.
TEST(Path, RowsOfALaneAreAMetreApart) {
  const Path path(400.0, 50.0, {{100.0, 300.0, 60.0}});
  for (const double t_m : {0.0, -1.75, 5.0}) {
    std::istringstream csv(path.lane_csv(t_m));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "s_m,x_m,y_m,z_m,heading_rad,curvature_1pm");
    glm::dvec3 before(0.0);
    int rows = 0;
    while (std::getline(csv, line)) {
      int s_m = 0;
      glm::dvec3 at(0.0);
      ASSERT_EQ(std::sscanf(line.c_str(), "%d,%lf,%lf,%lf", &s_m, &at.x, &at.y, &at.z), 4);
      EXPECT_EQ(s_m, rows);
      // A chord of 1 m of 1/60 m is shorter by 1²/(24·60²) = 1.2e-5; places are linear between knots a metre apart,
      // off by 1/(8·60) = 2 mm at most, half of it the other way at the next.
      if (rows > 0) {
        EXPECT_NEAR(glm::distance(at, before), 1.0, 3e-3) << rows << " at " << t_m;
      }
      before = at;
      ++rows;
    }
    EXPECT_GT(rows, 390);
  }
}

TEST(Path, PiecesCoverItOnce) {
  const Path path(120.0, 10.0, {});
  double at_m = path.begin_m();
  int next = 0;
  each_piece(path, [&](int number, double begin_m, double end_m) {
    EXPECT_EQ(number, next++);
    EXPECT_EQ(begin_m, at_m);
    EXPECT_LE(end_m - begin_m, kPiece_m);
    at_m = end_m;
  });
  EXPECT_EQ(at_m, path.end_m());
  EXPECT_EQ(numbered_node("road", 7), "road_007");
}

/// Places of all corners of a material, in the world.
std::vector<glm::dvec3> corners_of(const Scene& scene, const std::string& material) {
  std::vector<glm::dvec3> corners;
  for (const SceneChunk& chunk : scene.chunks)
    for (std::uint32_t i = 0; scene.materials[chunk.material].name == material && i < chunk.vertex_count; ++i)
      corners.push_back(chunk.origin_m + glm::dvec3(scene.vertices[chunk.first_vertex + i].position_m));
  return corners;
}

// Where one bends between two corners of the other, one sees through a crack along the road.
TEST(MadeScenes, TheTunnelsKerbHasItsCornersWhereTheAsphaltHas) {
  const Result<Scene> tunnel = read_scene(generated_dir() / "scenes/tunnel.glb");
  ASSERT_TRUE(tunnel) << tunnel.error().text();
  const std::vector<glm::dvec3> walk = corners_of(*tunnel, "walkway in tunnel"),
                                asphalt = corners_of(*tunnel, "asphalt in tunnel");
  constexpr double kSame_m = 1e-3;  // float32 at 2 km and less: 0.1 mm
  std::size_t feet = 0, alone = 0;
  for (const glm::dvec3& corner : walk) {
    // A kerb's foot has its edge right above it.
    const bool foot = std::ranges::any_of(walk, [&](const glm::dvec3& above) {
      return glm::distance(glm::dvec2(above), glm::dvec2(corner)) < kSame_m && above.z > corner.z + 0.02;
    });
    if (!foot) continue;
    ++feet;
    if (std::ranges::none_of(asphalt, [&](const glm::dvec3& at) { return glm::distance(at, corner) < kSame_m; }))
      ++alone;
  }
  EXPECT_GT(feet, 100u);
  EXPECT_EQ(alone, 0u);
}

}  // namespace
}  // namespace phare::scene
