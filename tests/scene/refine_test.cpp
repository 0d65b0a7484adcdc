// unit: the same surfaces from more triangles.
#include "visual/scene/refine.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace phare {
namespace {

/// Two triangles of asphalt that share a side, and one of a sign.
Scene road_and_sign() {
  Scene scene;
  scene.materials = {{.name = "asphalt", .surface = Surface::kAsphalt}, {.name = "sign"}};
  for (const glm::vec3 corner : {glm::vec3{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {9, 0, 0}, {9, 1, 0}, {9, 0, 1}})
    scene.vertices.push_back({corner, {0, 0, 1}});
  scene.indices = {0, 1, 2, 0, 2, 3, 0, 1, 2};
  SceneChunk road, sign;
  road.index_count = 6;
  road.vertex_count = 4;
  sign.material = 1;
  sign.first_index = 6;
  sign.index_count = 3;
  sign.first_vertex = 4;
  sign.vertex_count = 3;
  scene.chunks = {road, sign};
  return scene;
}

float area_of(const Scene& scene, const SceneChunk& chunk) {
  float area = 0.0f;
  for (std::uint32_t i = 0; i < chunk.index_count; i += 3) {
    const auto at = [&](std::uint32_t k) {
      return scene.vertices[chunk.first_vertex + scene.indices[chunk.first_index + i + k]].position_m;
    };
    area += 0.5f * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
  }
  return area;
}

TEST(Refined, CutsTheGroundInFourAndKeepsItsSurface) {
  const Scene scene = road_and_sign();
  for (int times = 0; times <= 3; ++times) {
    const Scene finer = refined(scene, times, is_ground);
    ASSERT_EQ(finer.chunks.size(), 2u);
    EXPECT_EQ(finer.chunks[0].index_count, 6u << (2 * times));
    // A grid of 2^times squares a side, corners shared.
    const std::uint32_t side = (1u << times) + 1;
    EXPECT_EQ(finer.chunks[0].vertex_count, side * side);
    EXPECT_FLOAT_EQ(area_of(finer, finer.chunks[0]), 12.0f);
    EXPECT_EQ(finer.chunks[1].index_count, 3u) << "the sign stays as it is";
    EXPECT_FLOAT_EQ(area_of(finer, finer.chunks[1]), 0.5f);
    for (const SceneVertex& vertex : finer.vertices) EXPECT_FLOAT_EQ(glm::length(vertex.normal), 1.0f);
  }
}

TEST(Refine, LooksLieBetweenTheirCorners) {
  Scene scene = road_and_sign();
  scene.chunks[1].first_look = 0;
  scene.looks = {{{0, 0}, glm::u16vec4(65535)}, {{1, 0}, glm::u16vec4(0)}, {{0, 1}, glm::u16vec4(65535)}};
  const Scene finer = refined(scene, 1);
  ASSERT_TRUE(finer.chunks[1].first_look);
  EXPECT_FALSE(finer.chunks[0].first_look);
  ASSERT_EQ(finer.looks.size(), finer.chunks[1].vertex_count);
  for (std::size_t i = 0; i < finer.looks.size(); ++i) {  // the corners lie at (9, u, v)
    const glm::vec3 at = finer.vertices[finer.chunks[1].first_vertex + i].position_m;
    EXPECT_EQ(finer.looks[i].uv, glm::vec2(at.y, at.z));
    EXPECT_EQ(finer.looks[i].colour.x, at.y == 0.5f ? 32767 : at.y == 1.0f ? 0 : 65535);
  }
}

}  // namespace
}  // namespace phare
