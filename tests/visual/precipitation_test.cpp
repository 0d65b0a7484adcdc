// On the device: rain and snow near the eye are the light that the air would scatter, drop by drop; they follow from
// the time alone, and cost nothing where nothing falls.
#include "visual/passes/precipitation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <vector>

#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/falling.h"

namespace phare {
namespace {

IntensityTable even_lamp() {
  IntensityTable table;
  table.first_deg = {-60.0, 0.0, 60.0};
  table.second_deg = {-60.0, 0.0, 60.0};
  table.candela.assign(9, 1000.0);
  return table;
}

constexpr auto kPrecipitation = static_cast<std::size_t>(Effect::kPrecipitation);

class PrecipitationOnDevice : public SharedRenderer {
 protected:
  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer == nullptr) return;
    renderer->set_beam(0, image_of(even_lamp()));
    ASSERT_TRUE(renderer->load_scene(black_wall(80.0)).ok());
  }

  /// A lamp behind the eye, so that no drop is next to it; the eye looks aside and down.
  static FrameInput falling(const Air& air) {
    FrameInput input;
    input.camera.eye_m = {0.0, 0.0, 1.2};
    input.camera.world_from_eye = aim_rotation(0.3, -0.1, 0.05);
    input.lamps.push_back({.position_m = {-3.0, 0.4, 1.0}, .world_from_image = aim_rotation(0.2, 0.0, 0.0)});
    input.sky_luminance_cdm2 = 0.0;
    input.air = air;
    input.effects[static_cast<std::size_t>(Effect::kFog)] = 3;
    input.want_hdr = true;
    return input;
  }
  std::vector<float> luminance(const FrameInput& input) { return luminance(*renderer, input); }
  static std::vector<float> luminance(Renderer& by, const FrameInput& input) {
    by.draw(input);
    const ImageF image = by.read_hdr();
    std::vector<float> values;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      values.push_back(0.2126f * image.rgba[i] + 0.7152f * image.rgba[i + 1] + 0.0722f * image.rgba[i + 2]);
    return values;
  }
  static double sum(const std::vector<float>& values) {
    double all = 0.0;
    for (const float value : values) all += static_cast<double>(value);
    return all;
  }

  /// Of the light by air alone: the mean of many moments with drops and its scatter, and how much of it is drops.
  struct Shares {
    double mean = 0.0, error = 0.0, drops = 0.0;
  };
  static Shares shares_of(Renderer& by, const Air& air) {
    FrameInput input = falling(air);
    input.effects[kPrecipitation] = 0;
    const double by_air = sum(luminance(by, input));
    EXPECT_GT(by_air, 0.0);
    input.effects[kPrecipitation].reset();
    constexpr int kMoments = 60;
    std::vector<double> totals;
    std::vector<float> least;
    for (int i = 0; i < kMoments; ++i) {
      input.falling = {.time_s = 100.0 + 1.37 * i, .eye_mps = {i % 2 == 0 ? 0.0 : 20.0, 0.0, 0.0}};
      const std::vector<float> values = luminance(by, input);
      totals.push_back(sum(values) / by_air);
      if (least.empty()) least = values;
      for (std::size_t k = 0; k < values.size(); ++k) least[k] = std::min(least[k], values[k]);
    }
    Shares found{.drops = 1.0 - sum(least) / by_air};
    for (const double total : totals) found.mean += total / kMoments;
    for (const double total : totals)
      found.error += (total - found.mean) * (total - found.mean) / (kMoments - 1) / kMoments;
    found.error = std::sqrt(found.error);
    std::printf("%s: %.4f of the light, +- %.4f; drops are %.3f of it\n", words_of(air).c_str(), found.mean,
                found.error, found.drops);
    return found;
  }
};

/// What is drawn drop by drop and what is left in the air are together what the air alone scatters: over many moments
/// the same light, to the scatter of their mean and a twentieth of the drops: a line begins and ends at whole pixels.
TEST_F(PrecipitationOnDevice, DropsAreTheLightThatTheAirDoesNotShow) {
  for (const Air& air :
       {Air{.rain_mmph = 10.0}, Air{.snow_mmph = 1.0}, Air{.visibility_m = 500.0, .rain_mmph = 40.0}}) {
    const Shares found = shares_of(*renderer, air);
    EXPECT_NEAR(found.mean, 1.0, 4.0 * found.error + 0.05 * found.drops) << words_of(air);
    EXPECT_GT(found.drops, 0.01) << words_of(air) << ": there was nothing to be compared";
  }
}

TEST_F(PrecipitationOnDevice, NorWithFourSamplesAPixel) {
  Result<Renderer> four = Renderer::create({.width_px = 320, .height_px = 180, .samples = 4, .validation = true});
  ASSERT_TRUE(four) << four.error().text();
  four->set_beam(0, image_of(even_lamp()));
  ASSERT_TRUE(four->load_scene(black_wall(80.0)).ok());
  const Shares found = shares_of(*four, {.rain_mmph = 10.0});
  EXPECT_NEAR(found.mean, 1.0, 4.0 * found.error + 0.05 * found.drops);
  EXPECT_EQ(four->validation_messages(), 0u);
}

TEST_F(PrecipitationOnDevice, FollowsFromTheTimeAlone) {
  FrameInput input = falling({.rain_mmph = 20.0});
  input.falling.time_s = 12.25;
  const std::vector<float> now = luminance(input);
  input.falling.time_s = 12.30;
  EXPECT_NE(luminance(input), now);
  input.falling.time_s = 12.25;
  EXPECT_EQ(luminance(input), now) << "to the bit";
  input.falling.time_s = 12.25 + 64.0 * 1e6;  // two years later: time counts from the last period
  EXPECT_EQ(luminance(input), now);
}

/// A streak is as long as the way past the eye while it sums light: seen from a car, drops are spread over more pixels.
TEST_F(PrecipitationOnDevice, StreaksGrowWithSpeed) {
  FrameInput input = falling({.snow_mmph = 0.2});
  const auto lit_pixels = [&](double mps) {
    input.falling = {.time_s = 3.0, .eye_mps = {mps, 0.0, 0.0}};
    const std::vector<float> drawn = luminance(input);
    input.effects[kPrecipitation] = 0;
    const std::vector<float> air = luminance(input);
    input.effects[kPrecipitation].reset();
    std::size_t count = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) count += drawn[i] > air[i] ? 1u : 0u;
    return count;
  };
  const std::size_t still = lit_pixels(0.0), fast = lit_pixels(30.0);
  std::printf("%zu pixels brighter than the air when standing, %zu at 30 m/s\n", still, fast);
  EXPECT_GT(fast, 2 * still);
}

/// Mirrors and insets have drops of their own eye, among views in which nothing is drawn drop by drop.
TEST_F(PrecipitationOnDevice, FallInEveryViewOfAFrame) {
  FrameInput input = falling({.snow_mmph = 2.0});
  ViewInput mirror = input;
  mirror.camera.world_from_eye[1] = -mirror.camera.world_from_eye[1];
  mirror.part = {0.0, 0.0, 0.5, 0.5};
  ViewInput dry = input;
  dry.air = {};
  dry.part = {0.5, 0.0, 0.5, 0.5};
  ViewInput false_colour = input;
  false_colour.view = View::kFalseColour;
  false_colour.part = {0.5, 0.5, 0.5, 0.5};
  for (ViewInput* view : {&mirror, &dry, &false_colour}) view->want_hdr = false;
  input.more_views = {mirror, dry, false_colour};
  const FrameResult frame = renderer->draw(input);
  ASSERT_EQ(frame.views.size(), 4u);
  EXPECT_TRUE(frame.views[0].effects.on(Effect::kPrecipitation));
  EXPECT_TRUE(frame.views[1].effects.on(Effect::kPrecipitation));
  EXPECT_FALSE(frame.views[2].effects.on(Effect::kPrecipitation));
  EXPECT_FALSE(frame.views[3].effects.on(Effect::kPrecipitation));
  EXPECT_EQ(frame.views[1].draws, frame.views[2].draws + 2) << "the drops, and the tone curve";
}

/// Where nothing falls the frame is one that knows of no rain; where no lamp shines it is not drawn either.
TEST_F(PrecipitationOnDevice, CostsNothingWhereNothingFalls) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = falling({});
  input.want_hdr = false;
  input.want_image = true;
  input.effects = {};
  const auto dry = [&] {
    FrameInput without = input;
    without.air = {};
    renderer->draw(without);  // what the frame before left is gone
    const FrameResult result = renderer->draw(without);
    return std::tuple(result.pass_count, result.draws, result.triangles, result.images, result.image_bytes,
                      renderer->read_image().rgba);
  };
  const auto before = dry();
  input.air.rain_mmph = 5.0;
  const FrameResult wet = renderer->draw(input);
  EXPECT_EQ(wet.effects[Effect::kPrecipitation].reason, "1 lamp lights drops near the eye");
  EXPECT_EQ(wet.effects[Effect::kFog].reason, "rain 5 mm/h between the eye and what it sees");
  EXPECT_TRUE(wet.effects.on(Effect::kHdrImage));
  EXPECT_EQ(wet.pass_count, std::get<0>(before) + 2) << "the grid of the air, and the tone curve";
  EXPECT_NE(renderer->read_image().rgba, std::get<5>(before)) << "within one frame";
  EXPECT_EQ(dry(), before);

  input.effects[kPrecipitation] = 0;
  EXPECT_EQ(renderer->draw(input).pass_count, std::get<0>(before) + 1) << "only the grid";
  input.effects[kPrecipitation].reset();
  input.lamps.clear();
  EXPECT_FALSE(renderer->draw(input).effects.on(Effect::kPrecipitation));
}

/// All that a view shows within the reach of a class lies in the cube of that class, whichever way the eye looks.
TEST(Falling, WhatIsInReachAndInViewIsInTheCube) {
  for (const double yaw : {0.0, 0.4, 0.785, 2.5})
    for (const double pitch : {-0.6, 0.0, 0.3}) {
      Camera camera;
      camera.world_from_eye = aim_rotation(yaw, pitch, 0.0);
      camera.fov_horizontal_rad = 1.3;
      const ViewGeometry view(camera, 16.0 / 9.0);
      const DropClass one{.cube_m = 8.0};
      const double reach_m = drawn_to_m(one, view);
      EXPECT_GT(reach_m, 5.0);
      const glm::dvec3 middle = 4.0 * camera.world_from_eye[0];
      for (int x = 0; x <= 20; ++x)
        for (int y = 0; y <= 20; ++y) {
          const glm::dvec3 at = view.ray_through(x, y, 21, 21).direction * reach_m - middle;
          EXPECT_LE(std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}), 4.0 + 1e-9);
        }
    }
}

}  // namespace
}  // namespace phare
