// Unit: the dome of vertex colours against the formula it stands for.
#include "shaders/sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phare {
namespace {

// Along the chords between the corners of the dome, where blending departs from the formula most: in elevation within a
// ring, and in azimuth along a ring's edge.
TEST(Sky, BlendedCornersAreWithinAStepOfTheDisplay) {
  const glm::vec4 zenith(1.0f, 1.0f, 1.0f, 3.0f);
  const auto exact = [&](double sine) {
    return static_cast<double>(shader::sky_luminance(zenith, static_cast<float>(sine)).x);
  };
  const auto point = [](double sine, double azimuth) {
    const double cosine = std::sqrt(1.0 - sine * sine);
    return glm::dvec3(cosine * std::cos(azimuth), cosine * std::sin(azimuth), sine);
  };
  const double turn = 2.0 * std::numbers::pi / shader::kSkySectors;
  double worst = 0.0;
  for (shader::uint ring = 0; ring < shader::kSkyRings; ++ring) {
    const double low = static_cast<double>(shader::sky_ring_sine(ring));
    const double high = static_cast<double>(shader::sky_ring_sine(ring + 1));
    for (double t = 0.0; t <= 1.0; t += 0.05) {
      const glm::dvec3 rise = point(low, 0.0) * (1.0 - t) + point(high, 0.0) * t;
      worst =
          std::max(worst, std::abs((exact(low) * (1.0 - t) + exact(high) * t) / exact(glm::normalize(rise).z) - 1.0));
      const glm::dvec3 along = point(low, 0.0) * (1.0 - t) + point(low, turn) * t;
      worst = std::max(worst, std::abs(exact(low) / exact(glm::normalize(along).z) - 1.0));
      const glm::dvec3 across = point(low, 0.0) * (1.0 - t) + point(high, turn) * t;
      worst =
          std::max(worst, std::abs((exact(low) * (1.0 - t) + exact(high) * t) / exact(glm::normalize(across).z) - 1.0));
    }
  }
  // A step of 8-bit sRGB at the brightness of this sky (10 to 60 of 255) is 2 to 10 % in light; a third of the
  // smallest.
  EXPECT_LT(worst, 0.0074);
  EXPECT_GT(worst, 1e-4);
}

}  // namespace
}  // namespace phare
