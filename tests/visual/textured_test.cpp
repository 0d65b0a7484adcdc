// reference: pixels of surfaces with textures, holes, colours at corners and light of their own are what those say,
// under a lamp whose light is known; and a scene without any of it makes nothing for it.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "shaders/lib/wet.h"
#include "tests/visual/textured_wall.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

TEST_F(Textured, APixelIsWhatTheTextureSaysUnderTheLamp) {
  const glm::vec4 factor(0.8f, 0.6f, 0.4f, 1.0f);
  const Scene scene = wall(with_texture(factor), {chess(8, {230, 188, 128, 255}, {60, 90, 120, 255})});
  const ImageF picture = drawn(view(scene));
  int light = 0, dark = 0;
  for (int y = 20; y < 160; y += 7)
    for (int x = 70; x < 250; x += 7) {
      const Pixel seen = pixel(picture, x, y);
      const glm::dvec2 texel((4.0 - seen.at_m.x), (4.0 - seen.at_m.y));  // one a metre, from the upper left
      if (texel.x < 0.1 || texel.y < 0.1 || texel.x > 7.9 || texel.y > 7.9) continue;
      const glm::dvec2 part = glm::fract(texel);
      if (std::abs(part.x - 0.5) > 0.4 || std::abs(part.y - 0.5) > 0.4) continue;  // a pixel is 36 mm
      const bool is_light = (static_cast<int>(texel.x) + static_cast<int>(texel.y)) % 2 == 0;
      ++(is_light ? light : dark);
      const std::array<std::uint8_t, 3> bytes =
          is_light ? std::array<std::uint8_t, 3>{230, 188, 128} : std::array<std::uint8_t, 3>{60, 90, 120};
      const double lx = wall_lx(seen.at_m);
      EXPECT_NEAR(seen.lx / lx, 1.0, kTolerance);
      for (int c = 0; c < 3; ++c) {
        const double rho = static_cast<double>(factor[c] * linear_of_srgb_byte(bytes[static_cast<std::size_t>(c)]));
        EXPECT_NEAR(seen.cdm2[c] / (rho * kColour[c] * lx / std::numbers::pi), 1.0,
                    kTolerance + decode_room(bytes[static_cast<std::size_t>(c)]))
            << x << ' ' << y << ' ' << c;
      }
    }
  EXPECT_GT(light, 50);
  EXPECT_GT(dark, 50);
}

TEST_F(Textured, FarAwayItIsTheMeanInLinearLight) {
  // 512 texels on 8 m at 200 m: 30 of them each way in a pixel.
  SceneMaterial material = with_texture(glm::vec4(1.0f));
  material.look.sampler.nearest = false;
  const Scene scene = wall(material, {chess(512, {255, 255, 255, 255}, {0, 0, 0, 255})}, 200.0);
  FrameInput input = view(scene);
  input.far_mesh_from_m = std::numeric_limits<double>::infinity();
  const Pixel seen = pixel(drawn(input), 159, 89, 200.0);
  // Half of the light lies between bytes 187 and 188 of sRGB: the next below is 0.6 % less, the next above 0.6 % more.
  EXPECT_NEAR(seen.cdm2.y / (0.5 * kColour.y * kLamp_cd / 4e4 / std::numbers::pi), 1.0,
              0.0062 + decode_room(188) + kTolerance);
}

TEST_F(Textured, ThroughHolesOneSeesWhatIsBehind) {
  SceneMaterial fence = with_texture(glm::vec4(1.0f));
  fence.look.cut_below = 0.5f;
  Scene scene = wall(fence, {chess(8, {255, 255, 255, 255}, {255, 255, 255, 0})});
  const Scene behind = wall({.name = "behind", .reflectance = glm::vec3(0.2f)}, {}, 20.0, false);
  scene.materials.push_back(behind.materials[0]);
  scene.chunks.push_back(behind.chunks[0]);
  scene.chunks[1].material = 1;
  scene.chunks[1].first_vertex = 4;
  scene.chunks[1].first_index = 6;
  scene.vertices.insert(scene.vertices.end(), behind.vertices.begin(), behind.vertices.end());
  scene.indices.insert(scene.indices.end(), behind.indices.begin(), behind.indices.end());
  FrameInput input = view(scene);
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  for (const std::size_t depth_first : {0u, 1u}) {
    input.effects[static_cast<std::size_t>(Effect::kDepthFirst)] = depth_first;
    const ImageF picture = drawn(input);
    // Texels of a metre about the middle: two are there and two are holes, with 4 m of the wall behind seen through.
    const Pixel there = pixel(picture, 153, 83), hole = pixel(picture, 166, 83);
    EXPECT_NEAR(there.cdm2.y / (kColour.y * wall_lx(there.at_m) / std::numbers::pi), 1.0, kTolerance) << depth_first;
    const glm::dvec2 at_m = hole.at_m * 2.0;
    const double lx = kLamp_cd * 20.0 / std::pow(glm::length(glm::dvec3(20.0, at_m)), 3.0);
    EXPECT_NEAR(hole.cdm2.y / (0.2 * kColour.y * lx / std::numbers::pi), 1.0, kTolerance) << depth_first;
  }
}

TEST_F(Textured, WhatShinesDoesSoWithoutALamp) {
  SceneMaterial material{.name = "window", .reflectance = glm::vec3(0.0f)};
  material.look.base = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  material.look.emitted_cdm2 = {40.0f, 20.0f, 10.0f};
  material.look.emissive_texture = 0;
  material.look.sampler.nearest = true;
  const Scene scene = wall(material, {chess(2, {255, 255, 255, 255}, {188, 188, 188, 255})});
  FrameInput input = view(scene);
  input.lamps.clear();
  const ImageF picture = drawn(input);
  const double half = static_cast<double>(linear_of_srgb_byte(188));
  const Pixel full = pixel(picture, 140, 60), dim = pixel(picture, 180, 60);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(full.cdm2[c] / static_cast<double>(material.look.emitted_cdm2[c]), 1.0, kTolerance);
    EXPECT_NEAR(dim.cdm2[c] / (half * static_cast<double>(material.look.emitted_cdm2[c])), 1.0,
                kTolerance + decode_room(188));
  }
}

TEST_F(Textured, ColoursAtCornersMultiplyTheReflectance) {
  SceneMaterial material{.name = "coloured", .reflectance = glm::vec3(0.5f)};
  material.look.base = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
  material.look.corner_colours = true;
  Scene scene = wall(material, {});
  for (CornerLook& look : scene.looks) look.colour = {65535, 32768, 16384, 65535};
  const Pixel seen = pixel(drawn(view(scene)), 160, 90);
  const double lx = wall_lx(seen.at_m);
  for (const auto& [c, share] : {std::pair{0, 1.0}, {1, 0.5}, {2, 0.25}})
    EXPECT_NEAR(seen.cdm2[c] / (0.5 * share * kColour[c] * lx / std::numbers::pi), 1.0, kTolerance + 1e-4);
}

TEST_F(Textured, EveryMethodNumberOfLampsAndWeatherShowsTheSameSurface) {
  SceneMaterial material = with_texture(glm::vec4(1.0f));
  const Scene scene = wall(material, {chess(1, {188, 188, 188, 255}, {188, 188, 188, 255})});
  const double rho = static_cast<double>(linear_of_srgb_byte(188));
  SceneMaterial plain{.name = "plain", .reflectance = glm::vec3(static_cast<float>(rho))};
  const Scene same = wall(plain, {}, kWall_m, false);
  const auto look = [&](const Scene& drawn_scene, std::size_t lamps, Method method, double visibility_m) {
    return pixel(drawn(lit_by(view(drawn_scene), lamps, method, visibility_m)), 150, 80);
  };
  struct Case {
    std::size_t lamps;
    Method method;
    double visibility_m;
  };
  for (const auto& [lamps, method, visibility_m] :
       {Case{1, Method::kFragment, 80.0}, Case{3, Method::kFragment, 0.0}, Case{3, Method::kFragment, 80.0},
        Case{1, Method::kVertex, 0.0}, Case{1, Method::kVertex, 80.0}, Case{3, Method::kVertex, 0.0},
        Case{1, Method::kVertex1998, 0.0}, Case{1, Method::kReference, 0.0}, Case{1, Method::kReference, 80.0}}) {
    if (method == Method::kReference && renderer->no_reference()) continue;
    const Pixel textured = look(scene, lamps, method, visibility_m), other = look(same, lamps, method, visibility_m);
    EXPECT_NEAR(textured.cdm2.y / other.cdm2.y, 1.0, kTolerance + decode_room(188))
        << lamps << " lamps, method " << static_cast<int>(method) << ", " << visibility_m << " m";
    EXPECT_NEAR(textured.lx / other.lx, 1.0, kTolerance);
  }
}

TEST_F(Textured, HolesLetLightThrough) {
  // A fence of 8 m at 5 m before a wall at 10 m: texels of a metre throw shadows of two.
  SceneMaterial fence = with_texture(glm::vec4(1.0f));
  fence.look.cut_below = 0.5f;
  Scene scene = wall(fence, {chess(8, {255, 255, 255, 255}, {255, 255, 255, 0})}, 5.0);
  const Scene behind = wall({.name = "behind", .reflectance = glm::vec3(0.2f)}, {}, 10.0, false);
  scene.materials.push_back(behind.materials[0]);
  scene.chunks.push_back(behind.chunks[0]);
  scene.chunks[1].material = 1;
  scene.chunks[1].first_vertex = 4;
  scene.chunks[1].first_index = 6;
  scene.vertices.insert(scene.vertices.end(), behind.vertices.begin(), behind.vertices.end());
  scene.indices.insert(scene.indices.end(), behind.indices.begin(), behind.indices.end());
  FrameInput input = view(scene);
  input.lamps[0].position_m = {0, 1, 0};
  int lit = 0, dark = 0;
  std::vector<MeasurePoint> points;
  for (double y = -3.75; y < 3.9; y += 0.5)
    for (double z = -3.75; z < 3.9; z += 0.5) points.push_back({{10.0, y, z}, {-1, 0, 0}});
  const std::vector<float> lx = renderer->measure(input.lamps, points, 2).front();
  for (const std::size_t by_rays : {kRayShadows, kRayShadows + 1})
    EXPECT_EQ(renderer->measure(input.lamps, points, by_rays).front(), lx) << by_rays;
  const World world(scene);
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Where the way to the lamp passes the fence: half-way, an eighth of a texel from its edge at least.
    const glm::dvec2 at((4.0 - 0.5 * (points[i].position_m.y + 1.0)), 4.0 - 0.5 * points[i].position_m.z);
    const bool solid = (static_cast<int>(std::floor(at.x)) + static_cast<int>(std::floor(at.y))) % 2 == 0;
    ++(solid ? dark : lit);
    if (solid)
      EXPECT_EQ(lx[i], 0.0f) << at.x << ' ' << at.y;
    else
      EXPECT_GT(lx[i], 1.0f) << at.x << ' ' << at.y;
    EXPECT_EQ(occluder(world, input.lamps[0].position_m, points[i].position_m) != nullptr, solid)
        << at.x << ' ' << at.y;
  }
  EXPECT_GT(lit, 100);
  EXPECT_GT(dark, 100);
}

TEST_F(Textured, AWetPictureIsDarkerAsAPlainSurfaceIs) {
  SceneMaterial material = with_texture(glm::vec4(1.0f));
  material.surface = Surface::kGrass;
  const Scene scene = wall(material, {chess(1, {100, 100, 100, 255}, {100, 100, 100, 255})});
  FrameInput input = view(scene);
  input.effects[static_cast<std::size_t>(Effect::kWetGround)] = 1;
  const Pixel seen = pixel(drawn(input), 80, 30);
  // Lamp and eye in one place: the film mirrors by slopes that face both.
  const double cosine = kWall_m / glm::length(glm::dvec3(kWall_m, seen.at_m));
  const auto toward = static_cast<float>(cosine);
  const double film = static_cast<double>(shader::water_lobe(0.15f, toward, toward, toward, 1.0f));
  const double rho = static_cast<double>(shader::wet_reflectance(glm::vec3(linear_of_srgb_byte(100))).y);
  EXPECT_NEAR(seen.cdm2.y / (kColour.y * wall_lx(seen.at_m) * (rho / std::numbers::pi + film)), 1.0,
              kTolerance + decode_room(100));
}

TEST_F(Textured, OneSampleAndFourShowTheSame) {
  Result<Renderer> made = Renderer::create({.width_px = 320, .height_px = 180, .samples = 4, .validation = true});
  ASSERT_TRUE(made);
  const Scene scene = wall(with_texture(glm::vec4(1.0f)), {chess(2, {230, 188, 128, 255}, {60, 90, 120, 255})});
  const FrameInput input = view(scene);
  const Pixel one = pixel(drawn(input), 140, 60);
  ASSERT_TRUE(made->load_scene(scene).ok());
  made->set_beam(0, image_of(even_beam()));
  made->draw(input);
  const Pixel four = pixel(made->read_hdr(), 140, 60);
  EXPECT_NEAR(four.cdm2.y / one.cdm2.y, 1.0, kTolerance);
  EXPECT_EQ(made->validation_messages(), 0u);
}

TEST_F(Textured, ASceneWithoutItMakesNothingForIt) {
  // The same wall with and without a look: as many draws, passes and images; of the plain one no byte is for a look.
  SceneMaterial plain{.name = "plain", .reflectance = glm::vec3(0.4f)};
  FrameInput input = view(wall(plain, {}, kWall_m, false));
  for (int i = 0; i < 3; ++i) drawn(input);  // what the tests before called for is freed
  const FrameResult without = last;
  const std::uint64_t plain_bytes = renderer->device_memory_bytes();
  input = view(wall(with_texture(glm::vec4(1.0f)), {chess(64, {255, 255, 255, 255}, {0, 0, 0, 255})}));
  drawn(input);
  EXPECT_GT(renderer->device_memory_bytes(), plain_bytes + 64 * 64 * 4);
  EXPECT_EQ(last.draws, without.draws);
  EXPECT_EQ(last.pass_count, without.pass_count);
  EXPECT_EQ(last.images, without.images);
  input = view(wall(plain, {}, kWall_m, false));
  for (int i = 0; i < 3; ++i) drawn(input);
  EXPECT_EQ(renderer->device_memory_bytes(), plain_bytes);  // nothing of the textures stays
  drawn(input);
  EXPECT_EQ(last.pipelines_made, 0u);
}

}  // namespace
}  // namespace phare
