// unit: what hides a lamp from a point.
#include "visual/scene/ray_hit.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/common.hpp>

namespace phare {
namespace {

/// A road, a marking 7 mm above it from x = 8 m to 10 m, and a kerb 0.15 m high at x = 20 m.
Scene marked_road() {
  Scene scene;
  scene.materials = {{.name = "asphalt", .surface = Surface::kAsphalt},
                     {.name = "marking", .surface = Surface::kPaint},
                     {.name = "kerb"}};
  const auto add = [&](const char* node, std::uint32_t material, const std::array<glm::vec3, 4>& corners) {
    SceneChunk chunk;
    chunk.node = node;
    chunk.material = material;
    chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
    chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
    chunk.low_m = chunk.high_m = corners[0];
    for (const glm::vec3& corner : corners) {
      scene.vertices.push_back({corner, {0, 0, 1}});
      chunk.low_m = glm::min(chunk.low_m, glm::dvec3(corner));
      chunk.high_m = glm::max(chunk.high_m, glm::dvec3(corner));
    }
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(i);
    chunk.vertex_count = 4;
    chunk.index_count = 6;
    scene.chunks.push_back(chunk);
  };
  const auto level = [](float from, float to, float z) {
    return std::array<glm::vec3, 4>{glm::vec3{from, -5, z}, {to, -5, z}, {to, 5, z}, {from, 5, z}};
  };
  add("road", 0, level(0, 100, 0));
  add("marking", 1, level(8, 10, 0.007f));
  add("kerb", 2, {glm::vec3{20, -5, 0}, {20, 5, 0}, {20, 5, 0.15f}, {20, -5, 0.15f}});
  return scene;
}

constexpr glm::dvec3 kLamp_m{0.0, 0.0, 0.65};

TEST(Occluder, TheEdgeOfAMarkingHidesNoLight) {
  // At 10 m a lamp at 0.65 m sees over 7 mm of paint at 3.7°: 0.11 m behind it would be dark.
  EXPECT_FALSE(occluder(marked_road(), kLamp_m, {10.05, 0.0, 0.0}));
}

TEST(Occluder, AKerbHidesTheRoadBehindItAndIsNamed) {
  const Scene scene = marked_road();
  const SceneChunk* by = occluder(scene, kLamp_m, {20.5, 0.0, 0.0});
  ASSERT_TRUE(by);
  EXPECT_EQ(name_of(*by), "kerb");
  EXPECT_FALSE(occluder(scene, kLamp_m, {19.9, 0.0, 0.0}));
}

TEST(RayHit, StillMeetsAMarking) {
  const Scene scene = marked_road();
  const auto hit = ray_hit(scene, {9.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 0.0, 10.0);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->chunk->node, "marking");
}

// A plate of 2 by 2 m that looks along its own x, turned and placed as an upright plate of the scene would stand.
TEST(RayHit, MeetsWhatMovesWhereItIsNow) {
  Scene meshes;
  meshes.materials.resize(1);
  for (const glm::vec3 at : {glm::vec3{0, -1, 0}, {0, 1, 0}, {0, 1, 2}, {0, -1, 2}})
    meshes.vertices.push_back({at, {1, 0, 0}});
  meshes.indices = {0, 1, 2, 0, 2, 3};
  SceneChunk plate{.node = "plate", .low_m = {0, -1, 0}, .high_m = {0, 1, 2}};
  plate.vertex_count = 4, plate.index_count = 6;
  meshes.chunks = {plate};
  const Scene road = marked_road();
  World world(road, meshes);
  const double turn = 0.5;
  const glm::dmat3 turned{{std::cos(turn), std::sin(turn), 0}, {-std::sin(turn), std::cos(turn), 0}, {0, 0, 1}};
  world.move({{0, {12.0, 0.5, 0.0}, turned}});
  const auto hit = ray_hit(world, {2.0, 0.5, 1.0}, {1.0, 0.0, 0.0}, 0.0, 100.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance_m, 10.0, 1e-12);
  EXPECT_NEAR(glm::distance(hit->normal, -turned[0]), 0.0, 1e-12) << "toward the ray's origin";
  EXPECT_EQ(hit->chunk->node, "plate");
  EXPECT_EQ(hit->scene, &meshes);
  // It hides the lamp from the road behind it, and no more once it has gone.
  const SceneChunk* by = occluder(world, kLamp_m, {14.0, 0.3, 0.0});
  ASSERT_TRUE(by);
  EXPECT_EQ(name_of(*by), "plate");
  EXPECT_FALSE(occluder(world.without(0), kLamp_m, {14.0, 0.3, 0.0}));
  world.move({{0, {12.0, 4.0, 0.0}, turned}});
  EXPECT_FALSE(occluder(world, kLamp_m, {14.0, 0.3, 0.0}));
}

}  // namespace
}  // namespace phare
