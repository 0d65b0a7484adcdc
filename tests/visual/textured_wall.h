// A square wall before an eye and a lamp, for tests of what its surface looks like.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"

namespace phare {

// The HDR image holds half floats, 2^-11 each way, and so does the reading that some are compared with; texels are hit
// in their middle.
inline constexpr double kTolerance = 2.0 / 1024.0;

/// How far a device may decode an sRGB byte off, relatively: half of a byte's step, as Direct3D's specification has it
/// and Vulkan leaves open. lavapipe has a polynomial that is 0.7 % off at byte 60.
inline double decode_room(std::uint8_t byte) {
  return 2.4 * 0.5 / (byte + 0.055 * 255.0);
}

inline constexpr double kLamp_cd = 20000.0, kWall_m = 10.0;

inline IntensityTable even_beam() {
  IntensityTable table;
  table.first_deg = {-80, 0, 80};
  table.second_deg = {-80, 0, 80};
  table.candela.assign(9, kLamp_cd);
  return table;
}

/// A square wall of 8 m at 10 m across x, its picture upright as the eye sees it: u to the right, v down.
inline Scene wall(const SceneMaterial& material, std::vector<SceneTexture> textures, double at_m = kWall_m,
           bool looks = true) {
  Scene scene;
  scene.materials = {material};
  scene.textures = std::move(textures);
  const auto x = static_cast<float>(at_m);
  for (const auto& [y, z, u, v] : {std::array{4.0f, -4.0f, 0.0f, 1.0f}, {-4.0f, -4.0f, 1.0f, 1.0f},
                                   {-4.0f, 4.0f, 1.0f, 0.0f}, {4.0f, 4.0f, 0.0f, 0.0f}}) {
    scene.vertices.push_back({{x, y, z}, {-1, 0, 0}});
    if (looks) scene.looks.push_back({{u, v}, glm::u16vec4(65535)});
  }
  scene.indices = {0, 1, 2, 0, 2, 3};
  scene.chunks = {{.node = "wall", .low_m = {at_m, -4, -4}, .high_m = {at_m, 4, 4}, .index_count = 6,
                   .vertex_count = 4}};
  if (looks) scene.chunks[0].first_look = 0;
  return scene;
}

inline SceneTexture chess(std::uint32_t side, glm::u8vec4 light, glm::u8vec4 dark) {
  SceneTexture texture{"chess", side, side, {}};
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x)
      for (int c = 0; c < 4; ++c) texture.rgba.push_back((x + y) % 2 == 0 ? light[c] : dark[c]);
  return texture;
}

class Textured : public SharedRenderer {
 protected:
  FrameInput view(const Scene& scene, double lamp_y_m = 0.0) {
    EXPECT_TRUE(renderer->load_scene(scene).ok());
    const IntensityTable table = even_beam();
    renderer->set_beam(0, image_of(table));
    FrameInput input;
    input.camera.eye_m = {0, 0, 0};
    input.camera.fov_horizontal_rad = std::numbers::pi / 3.0;
    input.lamps = {{.position_m = {0, lamp_y_m, 0}, .world_from_image = glm::dmat3(1.0)}};
    input.sky_luminance_cdm2 = 0.0;
    input.want_hdr = true;
    return input;
  }
  /// Luminance that a pixel shows, rgb, and where on the plane of the wall it lies: y, z.
  struct Pixel {
    glm::dvec3 cdm2;
    double lx = 0.0;
    glm::dvec2 at_m;
  };
  Pixel pixel(const ImageF& picture, int x, int y, double at_m = kWall_m) {
    const double half = std::tan(std::numbers::pi / 6.0), aspect = 320.0 / 180.0;
    const std::size_t i = 4 * (static_cast<std::size_t>(y) * 320 + static_cast<std::size_t>(x));
    Pixel seen;
    for (int c = 0; c < 3; ++c) seen.cdm2[c] = static_cast<double>(picture.rgba[i + static_cast<std::size_t>(c)]);
    seen.lx = static_cast<double>(picture.rgba[i + 3]);
    seen.at_m = {-at_m * half * ((x + 0.5) / 160.0 - 1.0), -at_m * half / aspect * ((y + 0.5) / 90.0 - 1.0)};
    return seen;
  }
  /// The view by its first lamp and others beside it, in fog where `visibility_m` is above 0.
  static FrameInput lit_by(FrameInput input, std::size_t lamps, Method method, double visibility_m) {
    input.lamps.resize(1);
    for (std::size_t i = 1; i < lamps; ++i) {
      input.lamps.push_back(input.lamps[0]);
      input.lamps.back().position_m.y = 0.2 * static_cast<double>(i);
    }
    input.method = method;
    if (visibility_m > 0.0) input.air = Air{.visibility_m = visibility_m};
    return input;
  }
  ImageF drawn(const FrameInput& input) {
    last = renderer->draw(input);
    return renderer->read_hdr();
  }
  FrameResult last;
};

/// E of the lamp on the wall at (y, z).
inline double wall_lx(glm::dvec2 at_m, double lamp_y_m = 0.0) {
  const glm::dvec3 way(kWall_m, at_m.x - lamp_y_m, at_m.y);
  return kLamp_cd * kWall_m / std::pow(glm::length(way), 3.0);
}

/// Of the lamp's light, luminance 1.
inline const glm::dvec3 kColour(black_body_colour(AimedSource{}.colour_temperature_k));

inline SceneMaterial with_texture(glm::vec4 factor) {
  SceneMaterial material{.name = "chess"};
  material.look.base = factor;
  material.look.base_texture = 0;
  material.look.sampler.nearest = true;
  return material;
}

}  // namespace phare
