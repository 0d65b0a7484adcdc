// What moves: drawn where it is as if it stood in the scene there, lit by the same lamps; and no work where nothing
// does.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"

namespace phare {
namespace {

class MovingOnDevice : public SharedRenderer {};

// An upright wedge about the origin, so that turns and normals count.
Scene wedge() {
  Scene scene;
  scene.materials = {{.name = "wedge", .reflectance = {0.5f, 0.3f, 0.2f}}};
  const glm::vec3 corners[] = {{1, -1, 0}, {1, 1, 0}, {-1, 0, 0}, {0.6f, -0.5f, 2}, {0.6f, 0.5f, 2}, {-0.5f, 0, 2}};
  const int faces[][3] = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}, {3, 4, 5}};
  for (const auto& face : faces) {
    const glm::vec3 a = corners[face[0]], b = corners[face[1]], c = corners[face[2]];
    for (const glm::vec3& p : {a, b, c}) {
      scene.indices.push_back(static_cast<std::uint32_t>(scene.vertices.size()));
      scene.vertices.push_back({p, glm::normalize(glm::cross(b - a, c - a))});
    }
  }
  scene.chunks = {{.node = "wedge", .material = 0, .origin_m = {}, .low_m = {-1, -1, 0}, .high_m = {1, 1, 2}}};
  scene.chunks[0].index_count = static_cast<std::uint32_t>(scene.indices.size());
  scene.chunks[0].vertex_count = static_cast<std::uint32_t>(scene.vertices.size());
  return scene;
}

// The same, its vertices put where the frame has it.
Scene with_wedge_standing(Scene scene, const PlacedMesh& at) {
  Scene there = wedge();
  SceneChunk chunk = there.chunks[0];
  chunk.material = static_cast<std::uint32_t>(scene.materials.size());
  chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
  chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
  chunk.origin_m = at.position_m;
  chunk.low_m = at.position_m - 3.0, chunk.high_m = at.position_m + 3.0;
  const glm::mat3 turn(at.world_from_mesh);
  for (SceneVertex& vertex : there.vertices) vertex = {turn * vertex.position_m, turn * vertex.normal};
  scene.materials.push_back(there.materials[0]);
  scene.vertices.insert(scene.vertices.end(), there.vertices.begin(), there.vertices.end());
  scene.indices.insert(scene.indices.end(), there.indices.begin(), there.indices.end());
  scene.chunks.push_back(chunk);
  return scene;
}

FrameInput lit_view() {
  FrameInput input = driver_view();
  input.exposure_per_cdm2 = 0.3;
  input.want_image = true;
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  return input;
}

TEST_F(MovingOnDevice, LooksAsIfItStoodThere) {
  const PlacedMesh at{0, {9.0, 1.2, 0.3}, aim_rotation(0.7, 0.2, -0.3)};
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  ASSERT_TRUE(renderer->load_scene(with_wedge_standing(yard(), at)).ok());
  FrameInput input = lit_view();
  input.effects = {};  // with shadows
  renderer->draw(input);
  const Image8 standing = renderer->read_image();

  ASSERT_TRUE(renderer->load_scene(yard(), wedge()).ok());
  renderer->draw(input);
  const Image8 without = renderer->read_image();
  input.moving = {at};
  renderer->draw(input);
  const Image8 moving = renderer->read_image();
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  renderer->draw(input);
  const Image8 unshadowed = renderer->read_image();
  int wedge_px = 0, other = 0, in_shadow = 0;
  for (std::size_t i = 0; i < moving.rgba.size(); i += 4) {
    const auto differs = [&](const Image8& a, const Image8& b, int by) {
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int{a.rgba[i + c]} - int{b.rgba[i + c]}));
      return most > by;
    };
    wedge_px += differs(moving, without, 0) ? 1 : 0;
    in_shadow += differs(moving, unshadowed, 8) ? 1 : 0;
    other += differs(moving, standing, 1) ? 1 : 0;
  }
  EXPECT_GT(wedge_px, 500);
  EXPECT_GT(in_shadow, 100) << "its shadow is seen";
  // Turned in float32 once more than in the vertices: an edge moves by 1e-6 m where a pixel covers 0.03 m, so that of
  // its 200 pixels less than one takes the other side.
  EXPECT_LE(other, 1);
}

TEST_F(MovingOnDevice, NothingThatMovesIsNoWork) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = lit_view();
  renderer->draw(input);
  const FrameResult alone = renderer->draw(input);
  ASSERT_TRUE(renderer->load_scene(yard(), wedge()).ok());
  renderer->draw(input);
  const FrameResult with_meshes = renderer->draw(input);
  EXPECT_EQ(with_meshes.draws, alone.draws);
  EXPECT_EQ(with_meshes.triangles, alone.triangles);
  input.moving = {{0, {9.0, 1.2, 0.3}}, {0, {-30.0, 0.0, 0.0}}, {7, {9.0, 0.0, 0.0}}};  // one in view; one unknown
  const FrameResult moving = renderer->draw(input);
  EXPECT_EQ(moving.draws, alone.draws + 1);
  EXPECT_EQ(moving.triangles, alone.triangles + 7);
}

}  // namespace
}  // namespace phare
