// visual: corners that pieces of a scene share are drawn in one place, and nothing behind them shows.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "config/base/conventions.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"

namespace phare {
namespace {

constexpr int kTiles = 60;
constexpr double kTile_m = 0.5;

/// Uneven ground of black tiles about `middle_m`, each a piece of its own about its own origin, by two materials in
/// turn.
Scene tiles(const glm::dvec3& middle_m) {
  Scene scene;
  scene.materials = {{.name = "a", .reflectance = glm::vec3(0.0f)},
                     {.name = "b", .reflectance = glm::vec3(0.0f), .surface = Surface::kGrass}};
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> off_m(-0.1, 0.1);
  std::vector<glm::dvec3> corners;
  for (int row = 0; row <= kTiles; ++row)
    for (int column = 0; column <= kTiles; ++column)
      corners.push_back(
          on_place_grid(middle_m + glm::dvec3((row - kTiles / 2) * kTile_m + off_m(random),
                                              (column - kTiles / 2) * kTile_m + off_m(random), off_m(random))));
  for (int row = 0; row < kTiles; ++row)
    for (int column = 0; column < kTiles; ++column) {
      const auto at = static_cast<std::size_t>(row * (kTiles + 1) + column);
      const std::array<glm::dvec3, 4> quad{corners[at], corners[at + kTiles + 1], corners[at + kTiles + 2],
                                           corners[at + 1]};
      SceneChunk chunk{.node = "tile", .material = static_cast<std::uint32_t>((row + column) % 2)};
      chunk.low_m = chunk.high_m = quad[0];
      for (const glm::dvec3& p : quad) chunk.low_m = glm::min(chunk.low_m, p), chunk.high_m = glm::max(chunk.high_m, p);
      chunk.origin_m = glm::round(middle_m) + (chunk.material == 0 ? glm::dvec3(397, -355, 0) : glm::dvec3(-13, 21, 3));
      chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
      chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
      for (const glm::dvec3& p : quad) scene.vertices.push_back({glm::vec3(p - chunk.origin_m), {0, 0, 1}});
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(i);
      chunk.index_count = 6, chunk.vertex_count = 4;
      scene.chunks.push_back(std::move(chunk));
    }
  return scene;
}

class Cracks : public SharedRenderer {};

TEST_F(Cracks, NothingShowsBetweenPiecesThatShareTheirCorners) {
  for (const glm::dvec3& middle_m : {glm::dvec3(0.0), glm::dvec3(4321.0, -876.0, 120.0)}) {
    ASSERT_TRUE(renderer->load_scene(tiles(middle_m)).ok());
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    std::size_t shown = 0;
    for (int view = 0; view < 25; ++view) {
      FrameInput input;
      input.camera.eye_m = middle_m + glm::dvec3(part(random) - 6.0, 2.0 * part(random) - 1.0, 1.3 + part(random));
      input.camera.world_from_eye = aim_rotation(0.2 * part(random), -0.55, 0.0);
      input.sky_luminance_cdm2 = 100.0;
      input.want_image = true;
      renderer->draw(input);
      const Image8 picture = renderer->read_image();
      for (std::size_t i = 0; i < picture.rgba.size(); i += 4) shown += picture.rgba[i] > 0;
    }
    EXPECT_EQ(shown, 0u) << "pixels of what is behind";
  }
}

}  // namespace
}  // namespace phare
