// Animals' eyes: found in meshes, as bright toward the eye as the table of their class says, and drawn so.
#include "visual/eyeshine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

#include "shaders/eyeshine.h"
#include "shaders/lib/luminance.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/scene/pupils.h"

namespace phare {
namespace {

SceneMaterial eye_material() {
  SceneMaterial material{.name = "eye", .reflectance = {0.3f, 0.33f, 0.2f}};
  material.retro = *retroreflection("tapetum lucidum", std::nullopt, std::nullopt);
  return material;
}

/// Two squares of 10 mm that look along -x, 80 mm apart, in one chunk.
Scene two_pupils(const glm::dvec3& at_m) {
  Scene scene;
  scene.materials = {eye_material()};
  for (const float y : {-0.04f, 0.04f}) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const auto& [a, b] : {std::pair(-0.005f, -0.005f), {0.005f, -0.005f}, {0.005f, 0.005f}, {-0.005f, 0.005f}})
      scene.vertices.push_back({{0.0f, y + a, b}, {-1.0f, 0.0f, 0.0f}});
    for (const std::uint32_t i : {0u, 2u, 1u, 0u, 3u, 2u}) scene.indices.push_back(first + i);
  }
  scene.chunks = {{.node = "deer",
                   .origin_m = at_m,
                   .low_m = at_m - 0.1,
                   .high_m = at_m + 0.1,
                   .index_count = 12,
                   .vertex_count = 8}};
  return scene;
}

double cd_of(const glm::vec3& rgb) {
  return static_cast<double>(shader::luminance_of(rgb));
}

/// Light of illuminant A, for which figures are stated.
LightOnPupil lamp_of(const glm::dvec3& at_m, double cd) {
  return {at_m, cd, black_body_colour(2856.0)};
}

TEST(Eyeshine, PupilsAreFoundPieceByPiece) {
  const Scene deer = two_pupils({0.0, 0.0, 1.0}), empty;
  const Pupils pupils(empty, deer);
  ASSERT_FALSE(pupils.none());
  World world(empty, deer);
  EXPECT_TRUE(pupils.in(world).empty()) << "it is nowhere";
  world.move({{0, {50.0, 2.0, 0.0}, aim_rotation(std::numbers::pi / 2.0, 0.0, 0.0)}});
  const std::vector<Pupil> there = pupils.in(world);
  ASSERT_EQ(there.size(), 2u);
  for (const Pupil& pupil : there) {
    EXPECT_NEAR(pupil.area_m2, 1e-4, 1e-9);
    EXPECT_NEAR(glm::distance(pupil.normal, glm::dvec3(0.0, -1.0, 0.0)), 0.0, 1e-6) << "turned to the left";
    EXPECT_NEAR(std::abs(pupil.place_m.x - 50.0), 0.04, 1e-6);
    EXPECT_NEAR(pupil.place_m.z, 1.0, 1e-6);
  }
  EXPECT_TRUE(Pupils(yard(), yard()).none());
}

// 1000 cd at 50 m are 0.4 lx; 300 cd/(lx·m²) of 1 cm² send 0.012 cd; at 1.5°, 60: typed once more from the table.
TEST(Eyeshine, SendsWhatTheTableSays) {
  const SceneMaterial material = eye_material();
  const Pupil pupil{{50.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, 1e-4, &material};
  const auto candela = [&](double observation_deg, const Air& air) {
    const double up_m = 50.0 * std::tan(observation_deg * std::numbers::pi / 180.0);
    const std::array lights{lamp_of({0.0, 0.0, 1.0}, 1000.0)};
    return cd_of(shining(pupil, lights, {0.0, 0.0, 1.0 + up_m}, air).candela);
  };
  // float32: logarithms of the table as in tests/scene/retro_test.cpp, three colours.
  EXPECT_NEAR(candela(0.5, {}) / 0.012, 1.0, 1e-5);
  EXPECT_NEAR(candela(1.5, {}) / 0.0024, 1.0, 1e-5);
  EXPECT_LT(candela(6.0, {}), 1e-5) << "a lamp beside the eye, or that of others";
  EXPECT_NEAR(candela(0.5, {.visibility_m = 100.0}) / candela(0.5, {}),
              std::exp(std::log(0.05) / 100.0 * (50.0 + 50.0 / std::cos(0.5 * std::numbers::pi / 180.0))), 1e-5);
  const Pupil away{pupil.place_m, {1.0, 0.0, 0.0}, 1e-4, &material};
  const std::array lights{lamp_of({0.0, 0.0, 0.6}, 1000.0)};
  EXPECT_EQ(shining(away, lights, {0.0, 0.0, 1.2}, {}).candela, glm::vec3(0.0f));
}

TEST(Eyeshine, AllPixelsTogetherGetTheWhole) {
  for (const float radius_px : {0.05f, 0.5f, 0.9f, 1.7f, 6.0f})
    for (const glm::vec2 middle : {glm::vec2(10.0f), glm::vec2(10.5f, 10.2f), glm::vec2(9.7f, 10.9f)}) {
      double sum = 0.0;
      for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x)
          sum += static_cast<double>(shader::eyeshine_share(glm::vec2(x, y) - middle, radius_px));
      // A disc's rim is read in the middles of pixels: 7.4 % at the worst of these, of one of 0.9 pixels.
      EXPECT_NEAR(sum, 1.0, radius_px < shader::kEyeshineDisc_px ? 1e-5 : 0.08) << radius_px;
    }
}

class EyeshineOnDevice : public SharedRenderer {
 protected:
  /// A dark wall at 70 m; an eye that sees a pupil at a distance, somewhere between the pixels.
  FrameInput looking(double distance_m, double cd) const {
    FrameInput input;
    input.camera.eye_m = {0.0, 0.0, 1.2};
    input.sky_luminance_cdm2 = 0.0;
    input.want_hdr = true;
    const std::array lights{lamp_of({0.0, 0.0, 0.8}, cd)};
    const Pupil pupil{{distance_m, 0.07 * distance_m, 1.0}, {-1.0, 0.0, 0.0}, 1.1e-4, &material_};
    input.pupils = {shining(pupil, lights, input.camera.eye_m, {})};
    return input;
  }
  std::vector<double> luminances(const FrameInput& input) {
    renderer->draw(input);
    std::vector<double> values;
    const ImageF image = renderer->read_hdr();
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      values.push_back(cd_of({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]}));
    return values;
  }
  SceneMaterial material_ = eye_material();
};

// What all its pixels send is the candela toward the eye, wherever it lies between them; and 60 m away it is by far
// brighter than a body of rho 0.15 about it.
TEST_F(EyeshineOnDevice, PixelsTogetherAreTheCandela) {
  ASSERT_TRUE(renderer->load_scene(black_wall(200.0)).ok());
  for (const double distance_m : {20.0, 61.3, 117.0}) {
    const FrameInput input = looking(distance_m, 10000.0);
    const std::vector<double> values = luminances(input);
    double sum = 0.0, brightest = 0.0;
    for (const double value : values) sum += value, brightest = std::max(brightest, value);
    const glm::dvec3 way = input.pupils[0].place_m - input.camera.eye_m;
    const double r = glm::length(way), cosine = way.x / r;
    const double tangent = 2.0 * std::tan(0.5 * input.camera.fov_horizontal_rad) / 320.0;
    const double found_cd = sum * tangent * tangent * cosine * cosine * cosine * r * r;
    const double body_cdm2 = 0.15 / std::numbers::pi * 10000.0 / (r * r);
    std::printf("%.0f m: %.4g cd, brightest pixel %.3g cd/m², a body %.3g\n", distance_m, found_cd, brightest,
                body_cdm2);
    EXPECT_NEAR(found_cd / cd_of(input.pupils[0].candela), 1.0, 2e-3) << "half floats";
    if (distance_m > 50.0) {
      EXPECT_GT(brightest, 3.0 * body_cdm2) << distance_m << " m, in pixels as wide as four of a display";
    }
  }
}

// Near, it is a disc as bright as its class says.
TEST_F(EyeshineOnDevice, ADiscHasItsLuminance) {
  ASSERT_TRUE(renderer->load_scene(black_wall(200.0)).ok());
  FrameInput input = looking(0.9, 100.0);
  input.camera.fov_horizontal_rad = 0.5;
  const Pupil pupil{{0.9, 0.06, 1.1}, {-1.0, 0.0, 0.0}, 1.1e-4, &material_};
  const std::array lights{lamp_of(input.camera.eye_m, 100.0)};  // where the eye is, so that it sees what comes back
  input.pupils = {shining(pupil, lights, input.camera.eye_m, {})};
  const double cdm2 = cd_of(input.pupils[0].candela) / input.pupils[0].area_m2;
  const std::vector<double> values = luminances(input);
  ASSERT_GT(cdm2, 1.0);
  EXPECT_NEAR(*std::ranges::max_element(values) / cdm2, 1.0, 0.05) << "but for the rim of one pixel";
}

TEST_F(EyeshineOnDevice, CostsNothingWhereNoneLooks) {
  ASSERT_TRUE(renderer->load_scene(black_wall(100.0)).ok());
  FrameInput input = looking(60.0, 10000.0);
  input.want_hdr = false, input.want_image = true;
  const std::vector<ShiningPupil> pupils = std::exchange(input.pupils, {});
  renderer->draw(input);
  const FrameResult none = renderer->draw(input);
  const std::vector<std::uint8_t> dark = renderer->read_image().rgba;
  input.pupils = pupils;
  const FrameResult shown = renderer->draw(input);
  EXPECT_EQ(shown.effects[Effect::kEyeshine].reason, "1 eye of an animal sends light back");
  EXPECT_FALSE(shown.effects.on(Effect::kHdrImage)) << "no luminance image for it";
  EXPECT_EQ(shown.pass_count, none.pass_count);
  EXPECT_EQ(shown.draws, none.draws + 1);
  EXPECT_EQ(shown.image_bytes, none.image_bytes);
  EXPECT_NE(renderer->read_image().rgba, dark);
  // Hidden, aside of the view, too weak, or switched off.
  input.pupils[0].place_m.x = 120.0;
  renderer->draw(input);
  EXPECT_EQ(renderer->read_image().rgba, dark) << "behind the wall";
  const auto draws_of = [&] { return renderer->draw(input).draws; };
  input.pupils[0].place_m = {-60.0, 0.0, 1.0};
  EXPECT_EQ(draws_of(), none.draws);
  input.pupils = pupils;
  input.pupils[0].candela *= 1e-6f;
  EXPECT_EQ(draws_of(), none.draws);
  input.pupils = pupils;
  input.effects[static_cast<std::size_t>(Effect::kEyeshine)] = 0;
  EXPECT_EQ(draws_of(), none.draws);
  EXPECT_EQ(renderer->read_image().rgba, dark);
}

}  // namespace
}  // namespace phare
