// Unit: the bands of the sky against the formula they stand for.
#include "visual/passes/sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shaders/lib/tone.h"
#include "shaders/sky.h"
#include "visual/lit_scene.h"
#include "visual/renderer.h"

namespace phare {
namespace {

glm::vec3 formula(const Sky& sky, double sine) {
  const glm::vec3 luminance = shader::sky_luminance(sky.zenith(), static_cast<float>(sine));
  return 255.0f * shader::srgb_encoded(shader::tone_curve(luminance * sky.exposure_per_cdm2));
}

Sky sky_exposed(float per_cdm2) {
  return {glm::vec3(1.1f, 1.0f, 0.8f) * per_cdm2, ViewInput{}.sky_luminance_cdm2};
}

// From black through the exposures that are used to white: no elevation is shown a step of the display off.
TEST(Sky, EveryElevationIsWithinAStepOfItsColour) {
  for (const float exposure : {1e-3f, 0.3f, 3.0f, 30.0f, 300.0f, 3e4f}) {
    const Sky sky = sky_exposed(exposure);
    const std::vector<SkyBand> bands = sky_bands(sky, SkyKind::kFlat);
    EXPECT_EQ(bands.front().low, 0.0f);
    EXPECT_EQ(bands.back().high, 1.0f);
    for (std::size_t i = 0; i < bands.size(); ++i) {
      if (i > 0) {
        EXPECT_EQ(bands[i].low, bands[i - 1].high);
      }
      EXPECT_EQ(bands[i].colour_low, bands[i].colour_high);
      for (double t = 0.0; t <= 1.0; t += 0.125) {
        const double sine = static_cast<double>(bands[i].low) * (1.0 - t) + static_cast<double>(bands[i].high) * t;
        const glm::vec3 off = glm::abs(255.0f * bands[i].colour_low - formula(sky, sine));
        // Half a step by rounding, half by the band, whose middle in sine is not quite its middle in colour.
        EXPECT_LT(static_cast<double>(std::max({off.x, off.y, off.z})), 1.1) << exposure << " " << sine;
      }
    }
  }
  EXPECT_EQ(sky_bands(sky_exposed(1e-3f), SkyKind::kFlat).size(), 1u) << "a black sky is one band";
  EXPECT_GT(sky_bands(sky_exposed(3.0f), SkyKind::kFlat).size(), 5u);
}

// What is blended is within half a step of the display.
TEST(Sky, WhatIsBlendedIsWithinHalfAStepOfItsColour) {
  for (const float exposure : {1e-3f, 0.3f, 3.0f, 30.0f, 300.0f, 3e4f}) {
    const Sky sky = sky_exposed(exposure);
    const std::vector<SkyBand> bands = sky_bands(sky, SkyKind::kBlended);
    EXPECT_EQ(bands.front().low, 0.0f);
    EXPECT_EQ(bands.back().high, 1.0f);
    for (std::size_t i = 0; i < bands.size(); ++i) {
      if (i > 0) {
        EXPECT_EQ(bands[i].low, bands[i - 1].high);
        EXPECT_EQ(bands[i].colour_low, bands[i - 1].colour_high);
      }
      for (double t = 0.0; t <= 1.0; t += 0.125) {
        const double sine = static_cast<double>(bands[i].low) * (1.0 - t) + static_cast<double>(bands[i].high) * t;
        const glm::vec3 blended = glm::mix(bands[i].colour_low, bands[i].colour_high, static_cast<float>(t));
        const glm::vec3 off = glm::abs(255.0f * blended - formula(sky, sine));
        EXPECT_LT(static_cast<double>(std::max({off.x, off.y, off.z})), 0.5) << exposure << " " << sine;
      }
    }
  }
}

// Where there is no light neither design is brighter; false colours have a colour for 0 lx.
TEST(Sky, IsBlackWhereDesignsAreCompared) {
  const ViewGeometry view({}, 1.5);
  for (const LampOutput output : {LampOutput::kDifference, LampOutput::kRatio, LampOutput::kFalseColour}) {
    const vk::ClearValue value = SkyPass::clear_value(sky_exposed(0.3f), output, view);
    EXPECT_EQ(value.color.float32[0], 0.0f);
    EXPECT_EQ(value.color.float32[1], 0.0f);
    EXPECT_EQ(value.color.float32[2], output == LampOutput::kFalseColour ? 0.1f : 0.0f);
  }
}

// Over a hundred pixels the mean of what is rounded is what was to be shown, and a step stays a step.
TEST(Dither, LeavesTheMeanAndWholeSteps) {
  for (const float value : {0.0f, 1.0f, 17.0f, 254.0f, 255.0f, 3.25f, 12.5f, 100.9f}) {
    double sum = 0.0, least = 1e9, most = -1e9;
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) {
        const float signal =
            value / 255.0f + shader::dither({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 300.5f});
        const double shown = std::round(255.0 * std::clamp(static_cast<double>(signal), 0.0, 1.0));
        sum += shown;
        least = std::min(least, shown);
        most = std::max(most, shown);
      }
    EXPECT_NEAR(sum / 1600.0, static_cast<double>(value), 0.02) << value;
    EXPECT_EQ(most - least, value == std::round(value) ? 0.0 : 1.0) << value;
  }
}

TEST(Sky, BlendedBandsOfAnHdrImageAreCloseToTheFormula) {
  const Sky sky = sky_exposed(3.0f);
  double worst = 0.0;
  for (const SkyBand& band : sky_bands(sky, SkyKind::kHdr))
    for (double t = 0.0; t <= 1.0; t += 0.05) {
      const auto point = [](float sine) {
        const double s = static_cast<double>(sine);
        return glm::dvec2(std::sqrt(1.0 - s * s), s);
      };
      const double sine = glm::normalize(point(band.low) * (1.0 - t) + point(band.high) * t).y;
      const double blended =
          static_cast<double>(band.colour_low.x) * (1.0 - t) + static_cast<double>(band.colour_high.x) * t;
      const double exact = static_cast<double>(shader::sky_luminance(sky.zenith(), static_cast<float>(sine)).x);
      worst = std::max(worst, std::abs(blended / exact - 1.0));
    }
  EXPECT_LT(worst, 4e-3) << "an eighth of (band's change)^2: 6 * 0.0975 / 2 at the widest, of 0.3 there";
  EXPECT_GT(worst, 1e-5);
}

// All that a view sees of the sky lies in its sectors, and their straight edges change no elevation's colour by more
// than a step.
TEST(Sky, SectorsCoverTheViewAndAreNarrow) {
  for (const double yaw : {0.0, 2.0, 3.1, -1.7})
    for (const double pitch : {-0.3, 0.0, 0.2, 0.7, 1.5})
      for (const auto& [fov, roll] : {std::pair(0.4, 0.0), std::pair(1.05, 0.0), std::pair(1.05, 0.05),
                                      std::pair(1.05, -0.1), std::pair(2.0, 0.0)}) {
        Camera camera;
        camera.fov_horizontal_rad = fov;
        const glm::dvec3 ahead(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch));
        const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0.0, 0.0, 1.0)));
        const glm::dvec3 up = glm::cross(right, ahead);
        camera.world_from_eye = {ahead, std::cos(roll) * -right + std::sin(roll) * up,
                                 std::cos(roll) * up + std::sin(roll) * right};
        const ViewGeometry view(camera, 16.0 / 9.0);
        const SkySectors sectors = sky_sectors(view);
        EXPECT_LE(sectors.step_rad, std::numbers::pi / 8.0 + 1e-9);
        double highest = -1.0;
        for (double x = -1.0; x <= 1.0; x += 0.05)
          for (double y = -1.0; y <= 1.0; y += 0.05) {
            const glm::dvec3 there =
                glm::normalize(glm::dvec3(view.direction_from_clip() * glm::dvec4(x, y, 1.0, 0.0)));
            highest = std::max(highest, there.z);
            if (there.z <= 1e-6) continue;
            ASSERT_GT(sectors.count, 0u);
            const double from_first = std::remainder(
                std::atan2(there.y, there.x) - sectors.first_rad - 0.5 * sectors.count * sectors.step_rad,
                2.0 * std::numbers::pi);
            EXPECT_LE(std::abs(from_first), 0.5 * sectors.count * sectors.step_rad + 1e-9)
                << yaw << " " << pitch << " " << fov << " at " << x << ", " << y;
            EXPECT_LE(there.z, sectors.highest_sine + 1e-9);
          }
        if (highest < 0.0) {
          EXPECT_EQ(sectors.count, 0u) << "a view of the ground alone draws no sky";
        }
      }
  const Sky sky = sky_exposed(3.0f);
  for (double sine = 0.0; sine < 1.0; sine += 0.01) {
    const double tangent = sine / std::sqrt(1.0 - sine * sine), raised = tangent / std::cos(std::numbers::pi / 16.0);
    const glm::vec3 off = glm::abs(formula(sky, sine) - formula(sky, raised / std::hypot(1.0, raised)));
    EXPECT_LT(static_cast<double>(std::max({off.x, off.y, off.z})), 1.0) << sine;
  }
}

}  // namespace
}  // namespace phare
