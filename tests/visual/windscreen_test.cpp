// Rain on the windscreen: how much water, when the blade was there, and on the device what of a lamp's light it
// spreads.
#include "visual/windscreen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>

#include "shaders/windscreen.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"

namespace phare {
namespace {

// Worked out by hand for 10 mm/h: slope 2.528 per mm, 894 drops of more than 0.5 mm in a m³, their mean square 0.959
// mm², spread to twice as wide; 20 m/s on glass 30° over the level, and their own 3.63 m/s.
TEST(Windscreen, GetsAsMuchWaterAsItMeets) {
  const Air rain{.rain_mmph = 10.0};
  EXPECT_NEAR(covered_per_s(rain, 20.0), 894.0 * (10.0 + 3.63 * 0.866) * 3.012e-6, 2e-4);
  EXPECT_NEAR(covered_per_s(rain, 0.0), 894.0 * 3.63 * 0.866 * 3.012e-6, 2e-4);
  EXPECT_GT(covered_per_s({.rain_mmph = 20.0}, 20.0), covered_per_s(rain, 20.0));
  EXPECT_EQ(covered_per_s({.visibility_m = 50.0}, 20.0), 0.0);
}

TEST(Windscreen, TheBladeGoesThereAndBack) {
  constexpr float kPeriod = 1.5f, kStroke = 0.4f;
  for (const float left : {0.0f, 0.3f, 1.0f}) {
    float before = 0.0f;
    int passes = 0;
    for (float time = 10.0f * kPeriod; time < 12.0f * kPeriod; time += 0.01f) {
      const glm::vec2 since = shader::since_wiped(left, time, kPeriod, kStroke);
      EXPECT_GE(since.x, 0.0f);
      EXPECT_LE(since.x, kPeriod);
      if (since.x < before) ++passes;
      before = since.x;
    }
    // On the far side both strokes pass at once; where it rests it passes as it leaves and as it comes back.
    EXPECT_GE(passes, 2) << left;
    EXPECT_LE(passes, 4) << left;
  }
  EXPECT_GT(shader::since_wiped(0.5f, 3.0f, 0.0f, kStroke).x, 1000.0f) << "it stands";
  EXPECT_NEAR(shader::since_wiped(0.5f, 10.0f * kPeriod + 0.25f, kPeriod, kStroke).x, 0.05f, 1e-4f);
}

// Sizes and shapes change nothing of what drops cover: integrals over sizes, and over a drop in its own half axes.
TEST(Windscreen, ShapesCoverWhatADiscWould) {
  double mean = 0.0;
  constexpr int kSizes = 100000;
  for (int i = 0; i < kSizes; ++i)
    mean += static_cast<double>(shader::drop_area((static_cast<float>(i) + 0.5f) / kSizes)) / kSizes;
  EXPECT_NEAR(mean, 1.0, 0.55 * std::exp(-5.0) + 1e-3) << "but for those cut off at the largest size";
  const double disc = 2.0 / 3.0 * std::numbers::pi;
  for (const float taper : {-0.6f, 0.0f, 0.25f, 0.6f})
    for (const float lobe : {0.0f, 1.0f}) {
      // The most that the shader draws, of each kind half.
      const float each = lobe * shader::kMostOfLobes / std::sqrt(8.0f);
      double covered = 0.0;
      float farthest = 0.0f;
      constexpr float kStep = 0.005f;
      for (float x = -2.0f; x <= 2.0f; x += kStep)
        for (float y = -2.0f; y <= 2.0f; y += kStep) {
          const float within = shader::within_drop({x, y}, taper, glm::vec4(each, -each, each, each));
          if (within >= 1.0f) continue;
          covered += static_cast<double>(shader::screen_disc(within)) * static_cast<double>(kStep * kStep);
          farthest = std::max({farthest, std::abs(x) / (1.0f + 0.35f * std::abs(taper)), std::abs(y)});
        }
      // Lobes of amplitude a of either kind: (1 + m)² has the mean 1 + a², and as much with the taper. Sums: a step's square.
      const double a = static_cast<double>(lobe * shader::kMostOfLobes) / 2.0;
      EXPECT_NEAR(covered / disc, 1.0, a * a * (1.0 + std::abs(static_cast<double>(taper))) + 1e-3)
          << taper << ", " << lobe;
      EXPECT_LE(farthest, 1.0f + shader::kMostOfLobes) << "within the triangles that are drawn for it";
    }
}

class WindscreenOnDevice : public SharedRenderer {
 protected:
  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer == nullptr) return;
    ASSERT_TRUE(renderer->load_scene(black_wall(80.0)).ok());
  }
  /// An eye that a lamp of 1 lx shines into from the middle of what it sees, by night and rain.
  static FrameInput glared(Wiper wiper, double time_s) {
    FrameInput input;
    input.camera.eye_m = {0.0, 0.0, 1.2};
    input.camera.fov_horizontal_rad = 1.2;
    input.sky_luminance_cdm2 = 0.0;
    input.air.rain_mmph = 10.0;
    input.glare = {{{40.0, 0.0, 1.2}, 1.0}};
    input.windscreen = Windscreen{time_s, 20.0, wiper};
    input.want_hdr = true;
    return input;
  }
  /// What all pixels together send to the eye, lx: of luminance and solid angle.
  double seen_lx(const FrameInput& input) {
    renderer->draw(input);
    const ImageF image = renderer->read_hdr();
    const double pixel = 2.0 * std::tan(0.5 * input.camera.fov_horizontal_rad) / 320.0;
    double sum = 0.0;
    for (int y = 0; y < 180; ++y)
      for (int x = 0; x < 320; ++x) {
        const glm::dvec3 way(1.0, pixel * (159.5 - x), pixel * (89.5 - y));
        const float* rgb = &image.rgba[4 * static_cast<std::size_t>(y * 320 + x)];
        sum += (0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
                0.0722 * static_cast<double>(rgb[2])) *
               pixel * pixel / std::pow(glm::length(way), 3.0);
      }
    return sum;
  }
};

/// Drops that cover a share of the glass send that share of a lamp's light to the eye from about it, no more: 1 − exp of
/// the share, where discs lie over each other. Some 1,100 discs lie within 15° of the lamp, so 3 % are chance; the disc
/// of 15° is flat in the picture and a cone in the eye, 4 %.
TEST_F(WindscreenOnDevice, DropsSpreadTheirShareOfALampsLight) {
  const double standing = seen_lx(glared(Wiper::kOff, 0.0));
  std::printf("of 1 lx drops send %.3f lx to the eye\n", standing);
  EXPECT_NEAR(standing / (1.0 - std::exp(-kMostCovered_01)), 1.0, 0.1);
  // Between strokes they come again, as many as fall: after the blade's return at 0.9 s to its next way at 1.33 s.
  const double fresh = seen_lx(glared(Wiper::kSlow, 0.92)), later = seen_lx(glared(Wiper::kSlow, 1.32));
  std::printf("just wiped %.4f lx, before the next stroke %.4f lx\n", fresh, later);
  EXPECT_LT(later, 0.5 * standing);
  EXPECT_LT(fresh, 0.8 * later);
  const double rate = covered_per_s({.rain_mmph = 10.0}, 20.0);
  // In the middle the blade has passed at 0.68 s: 0.64 s of rain lie there, a hundred drops, whose weights have a mean
  // square of 4/3 and their areas one of 1.3: three standard deviations of their sum.
  EXPECT_NEAR(later / (rate * 0.64), 1.0, 3.0 * std::sqrt(1.3 * 4.0 / 3.0 / 100.0));
  FrameInput none = glared(Wiper::kOff, 0.0);
  none.windscreen.reset();
  EXPECT_EQ(seen_lx(none), 0.0);
}

TEST_F(WindscreenOnDevice, CostsNothingWhereItIsDry) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  FrameInput input = driver_view();
  input.want_image = true;
  const auto drawn = [&] {
    renderer->draw(input);
    const FrameResult result = renderer->draw(input);
    return std::tuple(result.pass_count, result.draws, result.images, result.image_bytes, renderer->read_image().rgba);
  };
  const auto dry = drawn();
  input.windscreen = Windscreen{1.0, 20.0, Wiper::kSlow};
  EXPECT_EQ(drawn(), dry) << "a dry screen";
  input.air.rain_mmph = 10.0;
  const auto wet = drawn();
  const FrameResult result = renderer->draw(input);
  EXPECT_EQ(result.effects[Effect::kWindscreen].reason, "rain of 10 mm/h falls on the windscreen");
  input.want_hdr = true;
  renderer->draw(input);
  const ImageF behind = renderer->read_hdr();
  input.windscreen.reset();
  renderer->draw(input);
  const ImageF bare = renderer->read_hdr();
  input.want_hdr = false;
  const auto without = drawn();
  EXPECT_EQ(std::get<0>(wet), std::get<0>(without) + 2);
  EXPECT_EQ(std::get<1>(wet), std::get<1>(without) + 2);
  EXPECT_EQ(std::get<2>(wet), std::get<2>(without) + 1);
  EXPECT_NE(std::get<4>(wet), std::get<4>(without));
  for (std::size_t i = 3; i < bare.rgba.size(); i += 4) ASSERT_EQ(behind.rgba[i], bare.rgba[i]) << "lux stay";
}

/// The same moment is the same picture; another stroke has other drops.
TEST_F(WindscreenOnDevice, FollowsFromTheTimeAlone) {
  const auto picture = [&](double time_s) {
    renderer->draw(glared(Wiper::kSlow, time_s));
    return renderer->read_hdr().rgba;
  };
  const auto first = picture(1.2), next = picture(1.2 + 60.0 / 45.0);
  EXPECT_EQ(picture(1.2), first);
  EXPECT_NE(next, first);
}

}  // namespace
}  // namespace phare
