// Snow that lies: what looks up gets its reflectance, lux stay, markings are hidden, and nothing is paid without it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <tuple>

#include "shaders/lib/snow.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/fixed_light.h"
#include "visual/scene/material_library.h"

namespace phare {
namespace {

TEST(SnowCover, LiesOnWhatLooksUp) {
  EXPECT_EQ(shader::snow_share(1.0f, 0.6f), 0.6f);
  EXPECT_NEAR(shader::snow_share(std::cos(0.78f), 1.0f), 1.0f, 0.02f) << "up to 45°";
  EXPECT_EQ(shader::snow_share(std::cos(1.23f), 1.0f), 0.0f) << "not steeper than 70°";
  EXPECT_EQ(shader::snow_share(0.0f, 1.0f), 0.0f);
  EXPECT_EQ(shader::snow_share(-1.0f, 1.0f), 0.0f) << "from below";
}

TEST(SnowCover, IsTheSnowOfTheLibrary) {
  const Result<MaterialLibrary> library = MaterialLibrary::read();
  ASSERT_TRUE(library) << library.error().text();
  const Result<const LibraryMaterial*> snow = library->named("snow");
  ASSERT_TRUE(snow) << snow.error().text();
  EXPECT_EQ((*snow)->reflectance, shader::kSnow);
}

// Bare as it was; covered as rough ground of snow's reflectance, whatever is below; a marking keeps its strength in the
// 30 m geometry while it is bare.
TEST(SnowCover, MixesStrengthsAndReflectances) {
  const glm::vec4 asphalt(0.08f, 0.08f, 0.08f, 1.0f), marking(0.5f, 0.5f, 0.48f, 1.2f);
  EXPECT_EQ(shader::snowed(asphalt, 0.0f, false), asphalt);
  for (const bool is_marking : {false, true}) {
    const glm::vec4 all = shader::snowed(is_marking ? marking : asphalt, 1.0f, is_marking);
    EXPECT_EQ(glm::vec3(all), shader::kSnow);
    EXPECT_FLOAT_EQ(all.w, 1.0f);
  }
  EXPECT_FLOAT_EQ(shader::snowed(marking, 0.0f, true).w * shader::kFacetsAt30m, 1.2f);
  const glm::vec4 half = shader::snowed(asphalt, 0.5f, false);
  EXPECT_NEAR(half.w * half.y, 0.5f * (0.08f + 0.82f), 1e-6f);
}

class SnowCoverOnDevice : public SharedRenderer {
 protected:
  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer == nullptr) return;
    IntensityTable table;
    table.first_deg = {-80.0, 0.0, 80.0};
    table.second_deg = {-80.0, 0.0, 80.0};
    table.candela.assign(9, 1000.0);
    renderer->set_beam(0, image_of(table));
  }
  /// Asphalt to the left, a marking to the right, and a wall at 25 m.
  static Scene street() {
    Scene scene;
    const auto retro = [](const char* name) { return *retroreflection(name, std::nullopt, std::nullopt); };
    scene.materials = {{.name = "asphalt", .reflectance = glm::vec3(0.08f), .retro = retro("upright facets")},
                       {.name = "marking", .reflectance = glm::vec3(0.5f), .retro = retro("EN 1436 R4")},
                       {.name = "wall", .reflectance = glm::vec3(0.3f)}};
    const auto quad = [&](std::uint32_t material, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
      SceneChunk chunk{.node = scene.materials[material].name, .material = material};
      chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
      chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
      for (const glm::vec3& p : {corner, corner + u, corner + u + v, corner + v})
        scene.vertices.push_back({p, glm::normalize(glm::cross(u, v))});
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(i);
      chunk.index_count = 6, chunk.vertex_count = 4;
      chunk.low_m = glm::dvec3(glm::min(corner, corner + u + v));
      chunk.high_m = glm::dvec3(glm::max(corner, corner + u + v));
      scene.chunks.push_back(chunk);
    };
    quad(0, {0, 0, 0}, {25, 0, 0}, {0, 20, 0});
    quad(1, {0, -20, 0}, {25, 0, 0}, {0, 20, 0});
    quad(2, {25, 20, 0}, {0, -40, 0}, {0, 0, 8});
    return scene;
  }
  static FrameInput view(double cover_01) {
    FrameInput input;
    input.camera.eye_m = {0.0, 0.0, 1.2};
    input.lamps = {{.position_m = {0.0, 0.0, 0.65}, .world_from_image = glm::dmat3(1.0)}};
    input.sky_luminance_cdm2 = 0.0;
    input.snow_cover_01 = cover_01;
    input.want_hdr = true;
    return input;
  }
  struct Seen {
    double cdm2 = 0.0, lx = 0.0;
  };
  /// Of the pixel that sees a point.
  Seen at(const ImageF& image, const FrameInput& input, const glm::dvec3& point_m) const {
    const ViewGeometry geometry(input.camera, 320.0 / 180.0);
    const glm::dvec4 clip = geometry.clip_from_eye() * glm::dvec4(point_m - input.camera.eye_m, 1.0);
    const auto x = static_cast<std::size_t>(320.0 * (0.5 + 0.5 * clip.x / clip.w)),
               y = static_cast<std::size_t>(180.0 * (0.5 + 0.5 * clip.y / clip.w));
    const float* rgba = &image.rgba[4 * (y * 320 + x)];
    return {0.2126 * static_cast<double>(rgba[0]) + 0.7152 * static_cast<double>(rgba[1]) +
                0.0722 * static_cast<double>(rgba[2]),
            static_cast<double>(rgba[3])};
  }
};

/// Pixels by pixels: the light that arrives is the same, what the ground sends of it is snow's; where it looks up.
TEST_F(SnowCoverOnDevice, ChangesLuminanceAndNotLux) {
  ASSERT_TRUE(renderer->load_scene(street()).ok());
  std::vector<ImageF> images;
  for (const double cover_01 : {0.0, 0.5, 1.0}) {
    const FrameResult drawn = renderer->draw(view(cover_01));
    EXPECT_EQ(drawn.effects.on(Effect::kSnowCover), cover_01 > 0.0);
    images.push_back(renderer->read_hdr());
  }
  for (std::size_t i = 3; i < images[0].rgba.size(); i += 4) {
    // Lean shaders and those that know snow: their lux differ by roundings of half floats.
    ASSERT_NEAR(images[2].rgba[i], images[0].rgba[i], 2e-3f * images[0].rgba[i] + 1e-6f);
  }
  const FrameInput input = view(0.0);
  const double snow_rho = glm::dot(glm::dvec3(shader::kSnow), glm::dvec3(0.2126, 0.7152, 0.0722));
  for (const double x_m : {6.0, 12.0, 20.0}) {
    const glm::dvec3 on_asphalt(x_m, 1.0, 0.0), on_marking(x_m, -1.0, 0.0);
    const Seen bare = at(images[0], input, on_asphalt), half = at(images[1], input, on_asphalt),
               all = at(images[2], input, on_asphalt), hidden = at(images[2], input, on_marking);
    const Seen marking = at(images[0], input, on_marking);
    std::printf("%.0f m: asphalt %.4g, half covered %.4g, covered %.4g, a marking %.4g, covered %.4g cd/m²\n", x_m,
                bare.cdm2, half.cdm2, all.cdm2, marking.cdm2, hidden.cdm2);
    // Both are rough ground of their own reflectance; the lamp's light is white here. A pixel is the same in all three.
    EXPECT_NEAR(all.cdm2 / bare.cdm2, snow_rho / 0.08, 0.01 * snow_rho / 0.08);
    EXPECT_NEAR(half.cdm2 / (0.5 * (bare.cdm2 + all.cdm2)), 1.0, 0.01);
    EXPECT_GT(marking.cdm2 / bare.cdm2, 2.0);
    EXPECT_NEAR(hidden.cdm2 / all.cdm2, 1.0, 0.01) << "on either side of the lamp, as far from it";
  }
  const glm::dvec3 on_wall(25.0, 3.0, 2.0);
  EXPECT_NEAR(at(images[2], input, on_wall).cdm2, at(images[0], input, on_wall).cdm2, 2e-3)
      << "what stands upright is bare";
}

/// What the sky does not reach stays bare and dry: the same pixels as without snow and rain, and everything else has
/// it.
TEST_F(SnowCoverOnDevice, NeitherItNorRainReachesWhatIsUnderARoof) {
  Scene scene = street();
  scene.materials[0].surface = scene.materials[1].surface = Surface::kAsphalt;
  const glm::dvec3 roofed(8.0, 1.0, 0.0), open(8.0, -1.0, 0.0);
  const auto drawn = [&](double cover_01, std::size_t ground) {
    FrameInput input = view(cover_01);
    input.effects[static_cast<std::size_t>(Effect::kWetGround)] = ground;
    renderer->draw(input);
    return std::pair(at(renderer->read_hdr(), input, roofed).cdm2, at(renderer->read_hdr(), input, open).cdm2);
  };
  for (const float sky_share : {1.0f, 0.0f}) {
    scene.materials[0].sky_share = sky_share;
    ASSERT_TRUE(renderer->load_scene(scene).ok());
    const auto dry = drawn(0.0, 0), snow = drawn(1.0, 0), wet = drawn(0.0, 2);
    EXPECT_GT(snow.second, 1.2 * dry.second);
    EXPECT_LT(wet.second, 0.9 * dry.second);
    if (sky_share > 0.5f) {
      EXPECT_GT(snow.first, 1.2 * dry.first);
      EXPECT_LT(wet.first, 0.9 * dry.first);
    } else {
      // Of one material and one lamp; shaders that are lean differ from those that know snow by roundings.
      EXPECT_NEAR(snow.first, dry.first, 2e-3 * dry.first);
      EXPECT_NEAR(wet.first, dry.first, 2e-3 * dry.first);
    }
  }
}

/// What shines by itself keeps its luminance, however dark it is: snow melts on it, and its light is no reflected one.
TEST_F(SnowCoverOnDevice, WhatShinesKeepsItsLuminance) {
  Scene scene = street();
  scene.materials[0].reflectance = glm::vec3(0.001f);  // as black is read where it shines
  scene.materials[0].retro = {};
  scene.materials[0].surface = Surface::kAsphalt;
  scene.materials[0].emission_cdm2 = glm::vec3(20.0f);
  auto light = FixedLight::of(scene, {}, std::nullopt);
  ASSERT_TRUE(light);
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, std::make_shared<const FixedLight>(std::move(*light))));
  std::optional<double> bare;  // 20 cd/m² with the grain of asphalt there
  for (const double cover_01 : {0.0, 1.0})
    for (const std::size_t ground : {0u, 2u}) {
      FrameInput input = view(cover_01);
      input.lamps.clear();
      input.effects[static_cast<std::size_t>(Effect::kWetGround)] = ground;
      renderer->draw(input);
      const double cdm2 = at(renderer->read_hdr(), input, {12.0, 3.0, 0.0}).cdm2;
      if (!bare) bare = cdm2;
      EXPECT_GT(cdm2, 10.0);
      EXPECT_NEAR(cdm2, *bare, 1e-3 * *bare) << cover_01 << ", " << ground;
    }
}

/// Nothing is divided by black: every pixel of it is a number, wet and under snow, as asphalt, paint and marking.
TEST_F(SnowCoverOnDevice, BlackGroundIsDrawnInNumbers) {
  for (const glm::vec3& colour : {glm::vec3(0.0f), glm::vec3(0.0f, 0.0f, 1.0f)})
    for (const char* retro : {"upright facets", "EN 1436 R4", "EN 1436 RW2"}) {
      Scene scene = street();
      scene.materials[0] = {.name = "black",
                            .reflectance = colour,
                            .surface = Surface::kPaint,
                            .retro = *retroreflection(retro, std::nullopt, std::nullopt)};
      ASSERT_TRUE(renderer->load_scene(scene).ok());
      for (const double cover_01 : {0.0, 0.5}) {
        FrameInput input = view(cover_01);
        input.effects[static_cast<std::size_t>(Effect::kWetGround)] = 2;
        renderer->draw(input);
        for (const float value : renderer->read_hdr().rgba) ASSERT_TRUE(std::isfinite(value)) << retro;
      }
    }
}

TEST_F(SnowCoverOnDevice, CostsNothingWithout) {
  ASSERT_TRUE(renderer->load_scene(street()).ok());
  FrameInput input = view(0.0);
  input.want_hdr = false, input.want_image = true;
  const auto drawn = [&] {
    renderer->draw(input);
    const FrameResult result = renderer->draw(input);
    return std::tuple(result.pass_count, result.draws, result.triangles, result.images, result.image_bytes,
                      result.pipelines_made, renderer->read_image().rgba);
  };
  const auto before = drawn();
  input.snow_cover_01 = 0.8;
  const auto covered = drawn();
  EXPECT_EQ(std::get<0>(covered), std::get<0>(before)) << "no pass more";
  EXPECT_EQ(std::get<1>(covered), std::get<1>(before)) << "no draw more";
  EXPECT_EQ(std::get<4>(covered), std::get<4>(before)) << "no byte more";
  EXPECT_NE(std::get<6>(covered), std::get<6>(before));
  // More of it is no other pipeline; none is what it was, to the bit.
  input.snow_cover_01 = 0.3;
  EXPECT_EQ(renderer->draw(input).pipelines_made, 0u);
  input.snow_cover_01 = 0.0;
  EXPECT_EQ(drawn(), before);
}

}  // namespace
}  // namespace phare
