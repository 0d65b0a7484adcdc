// unit: what the ground hides from an eye above it. Whatever is said to be hidden must be, ray by ray; and what is
// plainly behind a hill must be said to be.
#include "visual/scene/horizon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "config/base/paths.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

using Height = std::function<float(float, float)>;

/// Ground of squares of `side_m` over [low, high], of what `keeps` lets stand; one chunk.
void add_ground(
    Scene& scene, const glm::vec2& low, const glm::vec2& high, const Height& height, float side_m = 5.0f,
    const std::function<bool(float, float)>& keeps = [](float, float) { return true; }) {
  SceneChunk chunk{.node = "ground", .material = 0};
  chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
  chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
  chunk.low_m = glm::dvec3(1e9), chunk.high_m = glm::dvec3(-1e9);
  for (float x = low.x; x < high.x; x += side_m) {
    for (float y = low.y; y < high.y; y += side_m) {
      if (!keeps(x + 0.5f * side_m, y + 0.5f * side_m)) continue;
      const auto first = static_cast<std::uint32_t>(scene.vertices.size()) - chunk.first_vertex;
      for (const glm::vec2 at : {glm::vec2(x, y), {x + side_m, y}, {x + side_m, y + side_m}, {x, y + side_m}}) {
        scene.vertices.push_back({{at, height(at.x, at.y)}, {0, 0, 1}});
        chunk.low_m = glm::min(chunk.low_m, glm::dvec3(scene.vertices.back().position_m));
        chunk.high_m = glm::max(chunk.high_m, glm::dvec3(scene.vertices.back().position_m));
      }
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(first + i);
    }
  }
  chunk.vertex_count = static_cast<std::uint32_t>(scene.vertices.size()) - chunk.first_vertex;
  chunk.index_count = static_cast<std::uint32_t>(scene.indices.size()) - chunk.first_index;
  scene.chunks.push_back(chunk);
}

Scene of_ground(const Height& height) {
  Scene scene;
  scene.materials = {{.name = "meadow", .surface = Surface::kGrass}};
  add_ground(scene, {-50, -100}, {500, 100}, height);
  return scene;
}

/// A hill of 6 m across the way, its top at 150 m.
float hill(float x, float) {
  return 6.0f * std::exp(-(x - 150.0f) * (x - 150.0f) / (2.0f * 25.0f * 25.0f));
}

constexpr glm::dvec3 kEye_m{0.0, 0.0, 1.2};

bool hides(const Scene& scene, const glm::dvec3& low_m, const glm::dvec3& high_m, const glm::dvec3& eye_m = kEye_m) {
  const GroundHeights ground(scene);
  Horizon horizon(ground, eye_m);
  return horizon.hides(low_m, high_m);
}

TEST(Horizon, AHillHidesWhatIsLowBehindItAndNothingElse) {
  const Scene scene = of_ground(hill);
  EXPECT_TRUE(hides(scene, {250, -5, 0}, {260, 5, 3}));
  EXPECT_TRUE(hides(scene, {250, -60, 0}, {300, 60, 3})) << "as wide as the hill";
  EXPECT_FALSE(hides(scene, {250, -5, 0}, {260, 5, 12})) << "rises above";
  EXPECT_FALSE(hides(scene, {100, -5, 0}, {110, 5, 3})) << "before the hill";
  EXPECT_FALSE(hides(scene, {100, -5, 0}, {260, 5, 3})) << "begins before it";
  EXPECT_FALSE(hides(scene, {-40, -5, 0}, {-30, 5, 3})) << "the other way";
  EXPECT_FALSE(hides(scene, {-10, -10, 0}, {300, 10, 1})) << "around the eye";
  EXPECT_FALSE(hides(scene, {250, -5, 0}, {260, 5, 3}, {0, 0, 30})) << "seen from above";
  EXPECT_FALSE(hides(scene, {250, -5, 0}, {260, 5, 3}, {0, 0, -1})) << "an eye in the ground sees what it sees";
  EXPECT_FALSE(hides(scene, {250, 100, 0}, {260, 200, 3})) << "partly beyond the ground's side";
  EXPECT_FALSE(hides({}, {250, -5, 0}, {260, 5, 3})) << "no ground";
}

TEST(Horizon, PlainGroundHidesWhatIsUnderIt) {
  const Scene scene = of_ground([](float, float) { return 0.0f; });
  EXPECT_TRUE(hides(scene, {200, -5, -9}, {220, 5, -2}));
  EXPECT_FALSE(hides(scene, {200, -5, -9}, {220, 5, 0}));
  EXPECT_FALSE(hides(scene, {200, -5, 0}, {220, 5, 0})) << "the ground itself";
}

// One sees through a hole in the ground, and under a bridge that stands in the air.
TEST(Horizon, WhatTheGroundDoesNotCoverHidesNothing) {
  Scene holed;
  holed.materials = {{.name = "meadow", .surface = Surface::kGrass}};
  add_ground(holed, {-50, -100}, {500, 100}, hill, 5.0f,
             [](float x, float y) { return std::abs(x - 130.0f) > 10.0f || std::abs(y) > 10.0f; });
  EXPECT_FALSE(hides(holed, {250, -5, 0}, {260, 5, 3}));
  EXPECT_TRUE(hides(holed, {250, 60, 0}, {260, 70, 3})) << "beside the hole the hill stands as before";

  Scene bridge;
  bridge.materials = {{.name = "meadow", .surface = Surface::kGrass}};
  add_ground(bridge, {-50, -100}, {100, 100}, [](float, float) { return 0.0f; });
  add_ground(bridge, {100, -100}, {500, 100}, [](float, float) { return 6.0f; });  // a deck, nothing beneath
  EXPECT_FALSE(hides(bridge, {250, -5, 0}, {260, 5, 3}));
}

// A road through a hill: the ground in the tube is its road, however high the hill above it.
TEST(Horizon, ATubeThroughAHillIsOpen) {
  Scene scene = of_ground(hill);
  add_ground(scene, {-50, -5}, {500, 5}, [](float, float) { return 0.0f; });
  EXPECT_FALSE(hides(scene, {250, -2, 0}, {260, 2, 2}));
  EXPECT_TRUE(hides(scene, {250, 60, 0}, {260, 70, 3}));
}

// Rays into boxes of the country road, from eyes along it: where a box is hidden each of them meets the ground before
// it.
TEST(Horizon, NoRayReachesABoxThatIsHidden) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/country_road.glb");
  ASSERT_TRUE(scene.ok());
  Scene ground_alone = *scene;
  std::erase_if(ground_alone.chunks, [&](const SceneChunk& chunk) {
    const Surface surface = scene->materials[chunk.material].surface;
    return surface != Surface::kAsphalt && surface != Surface::kGrass;
  });
  const GroundHeights ground(*scene);
  std::mt19937 random(1999);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::size_t hidden = 0, rays = 0;
  for (int eye = 0; eye < 12; ++eye) {
    // On the first straight and around the crest, as high as eyes are; at times a bird's.
    const glm::dvec2 place(between(0.0, 300.0), between(-3.0, 3.0));
    const auto road = ray_hit(ground_alone, {place, 200.0}, {0, 0, -1}, 0.0, 500.0);
    if (!road) continue;
    const glm::dvec3 eye_m(place, 200.0 - road->distance_m + (eye % 4 == 3 ? 15.0 : between(0.6, 2.5)));
    Horizon horizon(ground, eye_m);
    for (int box = 0; box < 400; ++box) {
      const double way_m = between(20.0, 600.0), angle = between(-0.6, 0.6);
      const glm::dvec2 at = glm::dvec2(eye_m) + way_m * glm::dvec2(std::cos(angle), std::sin(angle));
      const auto foot = ray_hit(ground_alone, {at, 200.0}, {0, 0, -1}, 0.0, 500.0);
      if (!foot) continue;
      const double up_m = 200.0 - foot->distance_m;
      const glm::dvec3 low_m(at, up_m),
          high_m(at + glm::dvec2(between(0.5, 40.0), between(0.5, 40.0)), up_m + between(0.1, 6.0));
      if (!horizon.hides(low_m, high_m)) continue;
      ++hidden;
      for (int k = 0; k < 6; ++k) {
        const glm::dvec3 to_m(between(low_m.x, high_m.x), between(low_m.y, high_m.y), k < 4 ? high_m.z : low_m.z);
        const double length_m = glm::distance(eye_m, to_m);
        ++rays;
        EXPECT_TRUE(ray_hit(ground_alone, eye_m, (to_m - eye_m) / length_m, 0.0, length_m))
            << "from " << eye_m.x << ' ' << eye_m.y << ' ' << eye_m.z << " to " << to_m.x << ' ' << to_m.y << ' '
            << to_m.z;
      }
    }
  }
  std::printf("%zu boxes hidden, %zu rays into them\n", hidden, rays);
  EXPECT_GT(hidden, 200u);
}

}  // namespace
}  // namespace phare
