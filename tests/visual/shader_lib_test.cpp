// The pure functions of shaders/lib, called as the shaders call them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shaders/lib/angles.h"
#include "shaders/lib/tone.h"

namespace phare::shader {
namespace {

// float32 rounds each of about six steps: 6 · 2^-24 = 3.6e-7 of the angle, and of 45° where the range was reduced.
TEST(Angles, Atan2AgreesWithDoubleAllTheWayRound) {
  for (int i = -180000; i <= 180000; ++i) {
    const double angle_rad = i * std::numbers::pi / 180000.0;
    const auto y = static_cast<float>(7.0 * std::sin(angle_rad)), x = static_cast<float>(7.0 * std::cos(angle_rad));
    const double expected_deg = std::atan2(static_cast<double>(y), static_cast<double>(x)) * 180.0 / std::numbers::pi;
    ASSERT_NEAR(atan2_deg(y, x), expected_deg, 4e-7 * std::max(std::abs(expected_deg), 45.0)) << i;
  }
}

TEST(Angles, SmallAnglesKeepTheirRelativePrecision) {
  for (float t : {1e-6f, 1e-4f, 0.01f, 0.02f, 0.3f}) {
    const double expected_deg = std::atan(static_cast<double>(t)) * 180.0 / std::numbers::pi;
    EXPECT_NEAR(atan2_deg(t, 1.0f) / expected_deg, 1.0, 4e-7) << t;
  }
}

TEST(Angles, AxesAndOriginAreExact) {
  EXPECT_EQ(atan2_deg(0.0f, 1.0f), 0.0f);
  EXPECT_EQ(atan2_deg(1.0f, 0.0f), 90.0f);
  EXPECT_EQ(atan2_deg(-1.0f, 0.0f), -90.0f);
  EXPECT_EQ(atan2_deg(0.0f, -1.0f), 180.0f);
  EXPECT_EQ(atan2_deg(0.0f, 0.0f), 0.0f);
}

TEST(Tone, DarkStaysProportionalWhiteIsReachedAndNothingLeavesTheRange) {
  EXPECT_NEAR(tone_curve(vec3(1e-4f)).x, 1e-4f, 2e-8f);
  EXPECT_NEAR(tone_curve(vec3(12.0f)).x, 1.0f, 1e-5f);
  float last = 0.0f;
  for (float y = 0.0f; y < 100.0f; y += 0.01f) {
    const float now = tone_curve(vec3(y)).x;
    ASSERT_GE(now, last);
    ASSERT_LE(now, 1.0f);
    last = now;
  }
}

TEST(FalseColour, RisesInBrightnessUpToTheYellowOfThirtyLux) {
  float last = -1.0f;
  for (float e : {0.1f, 0.5f, 1.0f, 3.0f, 10.0f, 30.0f}) {
    const vec3 colour = false_colour(e);
    const float y = dot(colour, vec3(0.2126f, 0.7152f, 0.0722f));
    EXPECT_GE(y, last) << e;
    last = y;
  }
}

}  // namespace
}  // namespace phare::shader
