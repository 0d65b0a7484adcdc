// Light scattered in the eye: which lamps it is drawn of, and the picture of it against the equation in float64.
#include "visual/glare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shaders/lib/tone.h"
#include "shaders/lib/veil.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/effects_of_frame.h"

namespace phare {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kDegPerRad;
}

// A direction so many degrees to the left of ahead, at 50 m from the eye.
glm::dvec3 aside(const Camera& camera, double left_deg, double up_deg = 0.0) {
  const double h = left_deg / kDegPerRad, v = up_deg / kDegPerRad;
  return camera.eye_m + 50.0 * glm::dvec3(std::cos(v) * std::cos(h), std::cos(v) * std::sin(h), std::sin(v));
}

// ---- which lamps

TEST(Glare, NoLampIsNearerToTheViewThanItIs) {
  const ViewGeometry view({}, 16.0 / 9.0);
  EXPECT_EQ(least_angle_deg(view, {50.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(least_angle_deg(view, {50.0, 28.0, 10.0}), 0.0) << "in the upper left of 60° across";
  for (const double left_deg : {31.0, 45.0, 90.0, 135.0, 180.0})
    for (const double up_deg : {-50.0, 0.0, 20.0, 85.0}) {
      const glm::dvec3 place = aside({}, left_deg, up_deg);
      double nearest_deg = 180.0;
      for (int x = 0; x <= 64; ++x)
        for (int y = 0; y <= 36; ++y)
          nearest_deg = std::min(nearest_deg, angle_deg(view.ray_through(x - 0.5, y - 0.5, 64, 36).direction, place));
      EXPECT_LE(least_angle_deg(view, place), nearest_deg + 1e-6) << left_deg << " " << up_deg;
    }
  EXPECT_GT(least_angle_deg(view, aside({}, 180.0)), 140.0) << "and not so careful that all lamps count";
}

TEST(Glare, WhatTheDisplayCannotShowIsLeftOut) {
  const ViewGeometry view({}, 16.0 / 9.0);
  const Viewer viewer;
  const std::vector<GlaringLamp> in_view{{{50, 0, 0}, 1e-3}}, behind{{{-50, 0, 0}, 1e-3}}, none{{{50, 0, 0}, 0.0}};
  EXPECT_EQ(glare_seen(view, in_view, viewer, 0.3).size(), 1u);
  EXPECT_EQ(glare_seen(view, behind, viewer, 0.3).size(), 0u);
  EXPECT_EQ(glare_seen(view, none, viewer, 0.3).size(), 0u);
  EXPECT_EQ(glare_seen(view, in_view, viewer, 1e-6).size(), 0u);
  // The bound is where the veil of the nearest point of the view is half a step of 8 bits.
  const double beside_deg = least_angle_deg(view, aside({}, 60.0));
  const double edge_lx = 0.5 / 255.0 / 12.92 / 0.3 / veil_general_per_sr(viewer, beside_deg) /
                         std::cos(beside_deg * std::numbers::pi / 180.0);
  const std::vector<GlaringLamp> more{{aside({}, 60.0), 1.01 * edge_lx}}, less{{aside({}, 60.0), 0.99 * edge_lx}};
  EXPECT_EQ(glare_seen(view, more, viewer, 0.3).size(), 1u);
  EXPECT_EQ(glare_seen(view, less, viewer, 0.3).size(), 0u);
}

TEST(Glare, OfTooManyTheWeakestAreLeftOutAndParallelRaysHaveNoEye) {
  std::vector<GlaringLamp> many;
  for (int i = 0; i < 20; ++i) many.push_back({{50.0, 0.1 * i, 0.0}, 0.1 + 0.01 * i});
  const std::vector<GlaringLamp> seen = glare_seen(ViewGeometry({}, 1.0), many, {}, 0.3);
  ASSERT_EQ(seen.size(), kMostGlaringLamps);
  EXPECT_DOUBLE_EQ(seen.front().eye_lx, 0.29);
  // Of 0.21, 0.20, 0.19 and 0.18 lx the shares of the way from 0.17, which is left out, to 0.21.
  EXPECT_DOUBLE_EQ(seen[7].eye_lx, 0.22);
  EXPECT_DOUBLE_EQ(seen[8].eye_lx, 0.21);
  EXPECT_NEAR(seen[10].eye_lx, 0.5 * 0.19, 1e-12);
  EXPECT_NEAR(seen.back().eye_lx, 0.25 * 0.18, 1e-12);
  EXPECT_TRUE(glare_seen(ViewGeometry({.orthographic_width_m = 80.0}, 1.0), many, {}, 0.3).empty());
}

// As a lamp comes nearer it takes the place of another without a jump in what the eye gets of either.
TEST(Glare, WhatChangesPlacesDoesNotJump) {
  const ViewGeometry view({}, 1.0);
  const auto lx_of = [&](double strength, double y_m) {
    std::vector<GlaringLamp> many{{{50.0, 5.0, 0.0}, strength}};
    for (int i = 0; i < 15; ++i) many.push_back({{50.0, 0.1 * i, 0.0}, 0.1 + 0.01 * i});
    for (const GlaringLamp& lamp : glare_seen(view, many, {}, 0.3))
      if (lamp.place_m.y == y_m) return lamp.eye_lx;
    return 0.0;
  };
  double before = lx_of(0.05, 5.0);
  EXPECT_EQ(before, 0.0) << "the weakest of sixteen";
  for (double strength = 0.0505; strength < 0.26; strength += 0.0005) {
    const double now = lx_of(strength, 5.0);
    EXPECT_LT(std::abs(now - before), 0.012) << strength;
    before = now;
  }
  EXPECT_NEAR(before, 0.26, 1e-3);
}

// float32 beside float64, over the angles that a picture has: the bounds that shaders/lib/veil.h states.
TEST(Glare, TheShadersEquationIsThatOfFloat64) {
  for (const Viewer& viewer : {Viewer{25.0, 0.0}, Viewer{40.0, 0.5}, Viewer{75.0, 1.2}}) {
    const glm::vec3 terms(veil_terms(viewer));
    for (double deg = 0.02; deg < 90.0; deg *= 1.07) {
      const glm::vec3 a(1.0f, 0.0f, 0.0f), b(glm::dvec3(std::cos(deg / kDegPerRad), std::sin(deg / kDegPerRad), 0.0));
      const glm::vec3 apart = b - a;
      const double ratio = shader::veil_per_sr(terms, glm::dot(apart, apart)) / veil_general_per_sr(viewer, deg);
      EXPECT_NEAR(ratio, 1.0, deg < 1.0 ? 2e-3 : deg < 70.0 ? 1e-4 : 1e-2) << deg << "° " << viewer.age_years;
    }
  }
}

// ---- the picture

class GlareOnDevice : public SharedRenderer {};

FrameInput dark_view() {
  FrameInput input;
  input.camera.eye_m = {-1.5, 0.37, 1.22};
  input.white = glm::vec3(1.0f);
  input.sky_luminance_cdm2 = 0.0;
  input.exposure_per_cdm2 = 0.3;
  input.want_image = true;
  return input;
}

// Each pixel of a black scene is the veil of two lamps, one in view and one beside it; of whom looks, too.
TEST_F(GlareOnDevice, PixelsAreTheEquation) {
  for (const Viewer& viewer : {Viewer{25.0, 0.5}, Viewer{70.0, 1.2}}) {
    FrameInput input = dark_view();
    input.viewer = viewer;
    const glm::vec3 warm(1.25f, 0.93f, 0.6f);
    input.glare = {{aside(input.camera, 4.3, 1.1), 0.8, warm}, {aside(input.camera, -41.0, -3.0), 30.0}};
    const FrameResult result = renderer->draw(input);
    ASSERT_TRUE(result.effects.on(Effect::kGlare)) << explain(result.effects);
    const Image8 image = renderer->read_image();
    const ViewGeometry view(input.camera, 320.0 / 180.0);
    int lit = 0;
    float worst = 0.0f;
    for (int y = 0; y < image.height_px; ++y)
      for (int x = 0; x < image.width_px; ++x) {
        const glm::dvec3 way = view.ray_through(x, y, image.width_px, image.height_px).direction;
        glm::dvec3 veil_cdm2(0.0);
        for (const GlaringLamp& source : input.glare) {
          const double apart_deg = angle_deg(way, source.place_m - input.camera.eye_m);
          // Illuminance is that of a plane across the line of sight.
          veil_cdm2 += glm::dvec3(source.colour) * source.eye_lx *
                       std::max(std::cos(apart_deg * std::numbers::pi / 180.0), 0.0) *
                       veil_general_per_sr(viewer, apart_deg);
        }
        const glm::vec3 shown = shader::srgb_encoded(shader::tone_curve(glm::vec3(veil_cdm2 * 0.3)));
        for (int channel = 0; channel < 3; ++channel) {
          const int value = image.rgba[static_cast<std::size_t>(4 * (y * image.width_px + x) + channel)];
          worst =
              std::max(worst, std::abs(static_cast<float>(value) - 255.0f * glm::clamp(shown[channel], 0.0f, 1.0f)));
          lit += value > 2 ? 1 : 0;
        }
      }
    // Of a step of 8 bits a device may be off by 0.6 as it rounds (Direct3D's functional specification, to UNORM;
    // Vulkan names no number); the equation's float32 is far below that.
    EXPECT_LT(worst, 1.11f) << "with half a step of dither";
    EXPECT_GT(lit, 320 * 180) << "the veil lies over the whole picture";
  }
}

// The luminance image stays what the scene is: the veil lies in the eye.
TEST_F(GlareOnDevice, TheSceneItselfIsAsItWas) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  FrameInput input = driver_view();
  input.want_hdr = true;
  renderer->draw(input);
  const ImageF before = renderer->read_hdr();
  input.glare = {{aside(input.camera, 5.0), 2.0}};
  renderer->draw(input);
  EXPECT_EQ(renderer->read_hdr().rgba, before.rgba);
}

// Without a lamp in the eye there is no pass, image, byte or pipeline; with one the luminance image and one pass; and
// all of it is gone again with the lamp.
TEST_F(GlareOnDevice, CostsNothingWhereNoLampShinesIntoTheEye) {
  FrameInput input = dark_view();
  renderer->draw(input);
  const FrameResult without = renderer->draw(input);
  const std::uint64_t bytes = renderer->device_memory_bytes();
  for (const PassTime& pass : without.passes) EXPECT_NE(pass.name, "glare");
  EXPECT_EQ(without.effects[Effect::kGlare].reason, "no lamp shines into the eye");

  input.glare = {{aside(input.camera, 5.0), 0.5}};
  const FrameResult with = renderer->draw(input);
  EXPECT_EQ(with.pass_count, without.pass_count + 1);
  EXPECT_EQ(with.images, without.images + 1);
  EXPECT_EQ(with.effects[Effect::kGlare].reason, "1 lamp shines into the eye, 0.5 lx");

  input.glare.clear();
  const FrameResult again = renderer->draw(input);
  EXPECT_EQ(again.pass_count, without.pass_count);
  EXPECT_EQ(again.image_bytes, without.image_bytes);
  EXPECT_EQ(again.pipelines_made, 0u);
  // What stays is the lamps' buffer of half a kilobyte, for the next time.
  EXPECT_LE(renderer->device_memory_bytes(), bytes + 4096);
}

// Each view has an eye of its own.
TEST_F(GlareOnDevice, ViewsHaveTheirOwnVeil) {
  FrameInput input = dark_view();
  ViewInput other = input;
  other.part = {0.5, 0.0, 0.5, 1.0};
  input.part = {0.0, 0.0, 0.5, 1.0};
  other.glare = {{aside(input.camera, 0.0), 1.0}};
  input.more_views = {other};
  const FrameResult result = renderer->draw(input);
  EXPECT_FALSE(result.views[0].effects.on(Effect::kGlare));
  EXPECT_TRUE(result.views[1].effects.on(Effect::kGlare));
  // The frame has it, by the view that calls for it, and what that has otherwise than the frame's own is told.
  EXPECT_EQ(result.effects[Effect::kGlare].reason, "in view 2: 1 lamp shines into the eye, 1 lx");
  EXPECT_EQ(result.effect_costs[static_cast<std::size_t>(Effect::kGlare)].passes, 1u);
  EXPECT_EQ(differing_effects(result.views[0], result.views[0]), std::vector<Effect>{});
  EXPECT_EQ(differing_effects(result.views[0], result.views[1]), (std::vector{Effect::kHdrImage, Effect::kGlare}));
  const Image8 image = renderer->read_image();
  const auto at = [&](int x) { return static_cast<int>(image.rgba[static_cast<std::size_t>(4 * (90 * 320 + x))]); };
  EXPECT_EQ(at(80), 0);
  EXPECT_GE(at(240), 254) << "white, and half a step of dither";
}

}  // namespace
}  // namespace phare
