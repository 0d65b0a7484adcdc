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
  EXPECT_FALSE(occluder(marked_road(), kLamp_m, {10.05, 0.0, 0.0}).has_value());
}

TEST(Occluder, AKerbHidesTheRoadBehindItAndIsNamed) {
  const Scene scene = marked_road();
  const auto by = occluder(scene, kLamp_m, {20.5, 0.0, 0.0});
  ASSERT_TRUE(by.has_value());
  EXPECT_EQ(scene.chunks[*by].node, "kerb");
  EXPECT_FALSE(occluder(scene, kLamp_m, {19.9, 0.0, 0.0}).has_value());
}

TEST(RayHit, StillMeetsAMarking) {
  const Scene scene = marked_road();
  const auto hit = ray_hit(scene, {9.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 0.0, 10.0);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(scene.chunks[hit->chunk].node, "marking");
}

}  // namespace
}  // namespace phare
