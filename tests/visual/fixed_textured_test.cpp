// reference: surfaces with textures, holes and relief under light that does not change, and under lamps besides.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/visual/textured_wall.h"
#include "visual/fixed_light.h"

namespace phare {
namespace {

class FixedTextured : public Textured {
 protected:
  /// The lamp of the scene, a point of so many candela.
  static constexpr double kBulb_cd = 4000.0;
  static void hang_bulb(Scene& scene, const glm::dvec3& at_m) {
    scene.lights.push_back({.name = "bulb", .position_m = at_m, .intensity = kBulb_cd});
  }
  FrameInput lit(const Scene& scene, const Scene& moving = {}) {
    auto made = FixedLight::of(scene, {}, std::nullopt);
    EXPECT_TRUE(made) << made.error().text();
    light = std::make_shared<const FixedLight>(std::move(*made));
    FrameInput input = view(scene);
    EXPECT_TRUE(renderer->load_scene(scene, moving, light).ok());
    return input;
  }
  std::shared_ptr<const FixedLight> light;
};

/// The white of a lamp of the file is that of the display, not a lamp's colour temperature.
double bulb_lx(glm::dvec2 at_m, const glm::dvec3& bulb_m, double candela) {
  const glm::dvec3 way = bulb_m - glm::dvec3(kWall_m, at_m);
  return candela * (kWall_m - bulb_m.x) / std::pow(glm::length(way), 3.0);
}

TEST_F(FixedTextured, APixelIsWhatItsTextureSaysUnderALampOfTheScene) {
  Scene scene = wall(with_texture(glm::vec4(0.8f)), {chess(8, {230, 188, 128, 255}, {60, 90, 120, 255})});
  const glm::dvec3 bulb(2.0, 1.0, 1.0);
  hang_bulb(scene, bulb);
  FrameInput input = lit(scene);
  for (const bool headlamp : {false, true}) {
    const std::vector<PlacedLamp> lamps = std::exchange(input.lamps, {});
    if (headlamp) input.lamps = lamps;
    const ImageF picture = drawn(input);
    EXPECT_EQ(last.effects[Effect::kFixedLight].reason, "1 street lamp");
    int seen_texels = 0;
    for (int y = 20; y < 160; y += 7)
      for (int x = 70; x < 250; x += 7) {
        const Pixel seen = pixel(picture, x, y);
        const glm::dvec2 texel(4.0 - seen.at_m.x, 4.0 - seen.at_m.y), part = glm::fract(texel);
        if (texel.x < 0.1 || texel.y < 0.1 || texel.x > 7.9 || texel.y > 7.9) continue;
        if (std::abs(part.x - 0.5) > 0.4 || std::abs(part.y - 0.5) > 0.4) continue;
        ++seen_texels;
        const bool is_light = (static_cast<int>(texel.x) + static_cast<int>(texel.y)) % 2 == 0;
        const std::uint8_t byte = is_light ? 188 : 90;
        const double of_bulb = bulb_lx(seen.at_m, bulb, kBulb_cd), of_lamp = headlamp ? wall_lx(seen.at_m) : 0.0;
        EXPECT_NEAR(light->lux_at({kWall_m, seen.at_m}, {-1, 0, 0}), of_bulb, 1e-6 * of_bulb);
        // Interpolated between vertices: the level's tolerance, 4/3 of it within a side.
        const double room = 4.0 / 3.0 * kBakeLevels[1].tolerance * of_bulb;
        EXPECT_NEAR(seen.lx, of_bulb + of_lamp, room + kTolerance * seen.lx);
        const double rho = 0.8 * static_cast<double>(linear_of_srgb_byte(byte));
        // By what the pixel says of lux, so that interpolation does not count: the bulb is white, the lamp has its hue.
        const double green = rho / std::numbers::pi * (seen.lx - of_lamp + of_lamp * kColour.y);
        EXPECT_NEAR(seen.cdm2.y, green, (kTolerance * 2.0 + decode_room(byte)) * green) << x << ' ' << y << headlamp;
      }
    EXPECT_GT(seen_texels, 100);
    input.lamps = lamps;
  }
}

TEST_F(FixedTextured, HolesAreThere) {
  SceneMaterial fence = with_texture(glm::vec4(1.0f));
  fence.look.cut_below = 0.5f;
  Scene scene = wall(fence, {chess(8, {255, 255, 255, 255}, {255, 255, 255, 0})});
  hang_bulb(scene, {2.0, 0.0, 0.0});
  FrameInput input = lit(scene);
  input.lamps.clear();
  for (const std::size_t depth_first : {0u, 1u}) {
    input.effects[static_cast<std::size_t>(Effect::kDepthFirst)] = depth_first;
    const ImageF picture = drawn(input);
    EXPECT_GT(pixel(picture, 153, 83).lx, 1.0) << depth_first;
    EXPECT_EQ(pixel(picture, 166, 83).cdm2.y, 0.0) << depth_first;
  }
}

TEST_F(FixedTextured, WhatMovesHasItsTextureToo) {
  Scene scene = wall({.name = "plain"}, {}, 30.0, false);
  hang_bulb(scene, {2.0, 0.0, 3.0});
  Scene board = wall(with_texture(glm::vec4(1.0f)), {chess(2, {255, 255, 255, 255}, {188, 188, 188, 255})}, 0.0);
  FrameInput input = lit(scene, board);
  input.lamps.clear();
  input.moving = {{0, {kWall_m, 0, 0}}};
  const ImageF picture = drawn(input);
  const Pixel full = pixel(picture, 140, 60), dim = pixel(picture, 180, 60);
  EXPECT_GT(full.lx, 1.0);
  EXPECT_NEAR(full.lx, dim.lx, kTolerance * full.lx) << "one for the whole of it";
  EXPECT_NEAR(full.cdm2.y, full.lx / std::numbers::pi, 2.0 * kTolerance * full.cdm2.y);
  EXPECT_NEAR(dim.cdm2.y / full.cdm2.y, static_cast<double>(linear_of_srgb_byte(188)),
              2.0 * kTolerance + decode_room(188));
}

/// Every shader that is made for it, under validation.
TEST_F(FixedTextured, EveryMethodLevelAndAirDrawsIt) {
  SceneMaterial relief = with_texture(glm::vec4(1.0f));
  relief.look.normal_texture = relief.look.rough_texture = 0;
  for (const ImageLevel level : {ImageLevel::kFloatNodes, ImageLevel::kHalfEven}) {
    Result<Renderer> made =
        Renderer::create({.width_px = 160, .height_px = 90, .validation = true, .beam_level = level});
    ASSERT_TRUE(made);
    SceneMaterial road = with_texture(glm::vec4(1.0f)), rough_road = relief;
    road.r_table = rough_road.r_table = true;
    for (const SceneMaterial& material : {with_texture(glm::vec4(1.0f)), relief, road, rough_road}) {
      Scene scene = wall(material, {chess(8, {230, 188, 128, 255}, {60, 90, 120, 255})});
      hang_bulb(scene, {2.0, 1.0, 1.0});
      ASSERT_TRUE(made->load_scene(scene, Scene{}, std::make_shared<const FixedLight>(*FixedLight::of(scene, {}, {}))));
      made->set_beam(0, image_of(even_beam()));
      for (const Method method : {Method::kFragment, Method::kVertex, Method::kReference})
        for (const bool fog : {false, true}) {
          if (method == Method::kReference && (made->no_reference() || level != ImageLevel::kFloatNodes || fog))
            continue;
          FrameInput input;
          input.camera.fov_horizontal_rad = std::numbers::pi / 3.0;
          input.lamps = {{.position_m = {0, 0, 0}, .world_from_image = glm::dmat3(1.0)}};
          input.method = method;
          if (fog) input.air.visibility_m = 100.0;
          const FrameResult drawn = made->draw(input);
          EXPECT_TRUE(drawn.effects.on(Effect::kFixedLight));
          EXPECT_EQ(drawn.effects.on(Effect::kAsphalt), material.r_table);
        }
    }
    EXPECT_EQ(made->validation_messages(), 0u);
  }
}

}  // namespace
}  // namespace phare
