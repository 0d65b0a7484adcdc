// reference: what the lean shaders (shaders/lean.frag) draw, against those that draw everything, and against float64.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "config/base/paths.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/photometry/table/illuminance.h"

namespace phare {
namespace {

class Lean : public SharedRenderer {};

/// Light whose colour is this far from that of a table: the shaders of lamps that differ in colour light with it, and
/// no step of a display shows it.
BeamImage hardly_tinted(const IntensityTable& table) {
  BeamImage image = image_of(table);
  image.colour.x += 1e-6f;
  return image;
}

/// A quad with these normals at its corners.
void add_quad(Scene& scene, std::uint32_t material, glm::vec3 corner, glm::vec3 u, glm::vec3 v,
              const std::array<glm::vec3, 4>& normals) {
  SceneChunk chunk{.node = "quad", .material = material};
  chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
  chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
  const std::array<glm::vec3, 4> corners{corner, corner + u, corner + u + v, corner + v};
  chunk.low_m = glm::dvec3(1e9), chunk.high_m = glm::dvec3(-1e9);
  for (std::size_t i = 0; i < 4; ++i) {
    scene.vertices.push_back({corners[i], glm::normalize(normals[i])});
    chunk.low_m = glm::min(chunk.low_m, glm::dvec3(corners[i]));
    chunk.high_m = glm::max(chunk.high_m, glm::dvec3(corners[i]));
  }
  for (std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(i);
  chunk.index_count = 6;
  chunk.vertex_count = 4;
  scene.chunks.push_back(chunk);
}

/// A level road whose normals turn, a slope that lies flat, and a plate that shows its back, all as large as float32
/// has exactly.
Scene road_slope_and_back() {
  Scene scene;
  scene.materials = {{.name = "road", .reflectance = glm::vec3(0.1f), .surface = Surface::kAsphalt},
                     {.name = "slope", .reflectance = glm::vec3(0.3f)},
                     {.name = "plate", .reflectance = glm::vec3(0.5f), .double_sided = true}};
  add_quad(scene, 0, {-4, -8, 0}, {64, 0, 0}, {0, 8, 0},
           {glm::vec3(0, 0, 1), {0.02f, 0, 1}, {0, 0.02f, 1}, {-0.02f, 0, 1}});
  const glm::vec3 u(32, 0, 4), v(0, 8, 0), slope = glm::normalize(glm::cross(u, v));
  add_quad(scene, 1, {8, 0, 0}, u, v, {slope, slope, slope, slope});
  const glm::vec3 away(1, 0, 0);
  add_quad(scene, 2, {16, -4, 0.5f}, {0, 2, 0}, {0, 0, 2}, {away, away, away, away});
  return scene;
}

TEST(Flat, IsWhatLiesAsItsNormalSays) {
  Scene scene;
  const glm::vec3 up(0, 0, 1);
  add_quad(scene, 0, {100, 50, 7}, {3, 0, 0}, {0, 2, 0}, {up, up, up, up});
  EXPECT_TRUE(is_flat(scene.vertices, scene.indices));
  scene.vertices[1].normal = glm::normalize(glm::vec3(1e-4f, 0, 1));
  EXPECT_FALSE(is_flat(scene.vertices, scene.indices)) << "its normal turns";
  scene.vertices[1].normal = up;
  scene.vertices[1].position_m.z += 1e-3f;
  EXPECT_FALSE(is_flat(scene.vertices, scene.indices)) << "all have one normal, which is not that of the plane";

  Scene slope;
  const glm::vec3 u(3.3f, 0.1f, 0.7f), v(-0.2f, 2.1f, 0.4f), n = glm::normalize(glm::cross(u, v));
  add_quad(slope, 0, {31.7f, -48.3f, 5.1f}, u, v, {n, n, n, n});
  EXPECT_TRUE(is_flat(slope.vertices, slope.indices)) << "as float32 rounds its corners";
}

// Pixels of each kind of surface, lamps with the same axes and with others: the light is that of float64 at the pixel's
// place and normal. The bound: 1e-5, as at points that are given, and what the light changes by when the place moves by
// 2e-6 of its distance from the eye, which is how far the rasterizer interpolates it off (docs/accuracy.md).
TEST_F(Lean, LightIsThatOfFloat64) {
  const IntensityTable table = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  renderer->set_beam(0, image_of(table));
  ASSERT_TRUE(renderer->load_scene(road_slope_and_back()).ok());
  for (const double toe_in_rad : {0.0, 0.02}) {
    FrameInput input = driver_view();
    input.lamps[1].world_from_image = aim_rotation(toe_in_rad, -0.01, 0);
    std::size_t slope = 0, back = 0, road = 0;
    for (const AuditSample& sample : renderer->audit(input, 3000, 7)) {
      const glm::dvec3& n = sample.point.normal;
      const auto lx_at = [&](const glm::dvec3& point_m) {
        double lx = 0.0;
        for (const PlacedLamp& lamp : input.lamps)
          lx += illuminance_lx(lamp.position_m, lamp.world_from_image, table, 1.0, point_m, n);
        return lx;
      };
      const glm::dvec3& at_m = sample.point.position_m;
      const double expected_lx = lx_at(at_m);
      if (expected_lx < 0.01) continue;
      const glm::dvec3 off_m(0.0, 0.0, 2e-6 * glm::length(at_m - input.camera.eye_m));
      const double moved_lx =
          std::max(std::abs(lx_at(at_m + off_m) - expected_lx), std::abs(lx_at(at_m - off_m) - expected_lx));
      ASSERT_NEAR(sample.illuminance_lx, expected_lx, 1e-5 * expected_lx + moved_lx)
          << at_m.x << ' ' << at_m.y << ' ' << at_m.z;
      ++(n.x < -0.9 ? back : n.x < -0.1 ? slope : road);
    }
    EXPECT_GT(slope, 100u);
    EXPECT_GT(back, 20u);
    EXPECT_GT(road, 500u);
  }
}

// Every material of the country road, with and without shadows, photo and clipping marks: the picture of the shaders
// that draw everything.
TEST_F(Lean, ThePictureIsThatOfTheShadersThatDrawEverything) {
  const IntensityTable table = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  const Result<Scene> country = read_scene(generated_dir() / "scenes/country_road.glb");
  ASSERT_TRUE(country.ok()) << country.error().text();
  ASSERT_TRUE(renderer->load_scene(*country).ok());
  renderer->set_beam(0, image_of(table));
  renderer->set_beam(1, hardly_tinted(table));
  for (const double toe_in_rad : {0.0, 0.01})
    for (const std::size_t shadows : {0u, 2u})
      for (const View view : {View::kPhoto, View::kClipping}) {
        FrameInput input;
        input.camera.eye_m = {25.0, -1.2, 1.22};
        for (const double y_m : {-1.0, -2.2})
          input.lamps.push_back({.position_m = {26.9, y_m, 0.65}, .world_from_image = aim_rotation(0.0, -0.01, 0.0)});
        input.lamps[1].world_from_image = aim_rotation(toe_in_rad, -0.01, 0.0);
        input.effects[static_cast<std::size_t>(Effect::kShadows)] = shadows;
        input.view = view;
        input.want_image = true;
        renderer->draw(input);
        const Image8 lean = renderer->read_image();
        input.lamps[1].beam = 1;
        renderer->draw(input);
        const Image8 whole = renderer->read_image();
        ASSERT_EQ(lean.rgba.size(), whole.rgba.size());
        std::size_t off = 0;
        for (std::size_t i = 0; i < lean.rgba.size(); ++i)
          off += std::abs(int{lean.rgba[i]} - int{whole.rgba[i]}) > 1 ? 1 : 0;
        // A channel that lies on the edge of a mark or of a texel of a map falls on either side: float32 rounds both
        // ways apart.
        EXPECT_LE(off, lean.rgba.size() / 100'000) << "toed in by " << toe_in_rad << ", shadows " << shadows;
      }
}

}  // namespace
}  // namespace phare
