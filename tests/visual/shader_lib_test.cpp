// The pure functions of shaders/lib, called as the shaders call them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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

// Taken apart at multiples of 45° the rest stays small, and with it its rounding: about four steps of 2^-24 of it, and
// of the float32 arguments.
TEST(Angles, OctantsKeepEveryAngleAsExactlyAsASmallOne) {
  for (int i = 0; i < 360000; ++i) {
    const double angle_rad = i * std::numbers::pi / 180000.0;
    const auto y = static_cast<float>(7.0 * std::sin(angle_rad)), x = static_cast<float>(7.0 * std::cos(angle_rad));
    double expected_rad = std::atan2(static_cast<double>(y), static_cast<double>(x));
    if (expected_rad < 0.0) expected_rad += 2.0 * std::numbers::pi;
    const vec2 octants = atan2_octants(y, x);
    ASSERT_EQ(octants.x, std::round(octants.x)) << i;
    ASSERT_LT(std::abs(octants.y), 0.3928f) << i;  // 22.5° and the last digit
    const double rest_rad = expected_rad - static_cast<double>(octants.x) * std::numbers::pi / 4.0;
    ASSERT_NEAR(static_cast<double>(octants.y), rest_rad, 3e-7 * std::abs(rest_rad) + 6e-8) << i;
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

// Both halves of the range and both reductions; the limit is that of atan2_deg, in radians.
TEST(Angles, ForwardInRadiansIsExactToFloat) {
  for (double degrees = -89.99; degrees < 90.0; degrees += 0.0137) {
    for (const double length : {1e-3, 1.0, 4321.0}) {
      const auto y = static_cast<float>(length * std::sin(degrees * std::numbers::pi / 180.0));
      const auto x = static_cast<float>(length * std::cos(degrees * std::numbers::pi / 180.0));
      const double truth = std::atan2(static_cast<double>(y), static_cast<double>(x));
      ASSERT_NEAR(static_cast<double>(atan2_forward_rad(y, x)), truth, 3e-7 * std::abs(truth) + 1e-12)
          << degrees << " degrees";
    }
  }
}

// The most that an angle up to `to_deg` is off, relatively, as ahead() of lib/beam.glsl has it from the tangent of its
// half and a polynomial of that squared.
double worst_half_angle(float (*polynomial)(float), double to_deg) {
  double worst = 0.0;
  for (double deg = 0.001; deg < to_deg; deg += 0.001) {
    const auto t = static_cast<float>(std::tan(deg * M_PI / 360.0));
    const double exact = 2.0 * std::atan(static_cast<double>(t));
    worst = std::max(worst, std::abs(2.0 * static_cast<double>(t * polynomial(t * t)) / exact - 1.0));
  }
  return worst;
}

// The polynomials are off by 2.6e-8 and 1.7e-8; float32 adds some 2^-24 for each of the last operations.
TEST(Angles, HalfAnglesAreExactToFloat) {
  EXPECT_LT(worst_half_angle(atan_over_t, 46.4), 2.6e-8 + 3 * std::exp2(-24));
  EXPECT_LT(worst_half_angle(atan_over_t_wide, 90.4), 1.7e-8 + 4 * std::exp2(-24));  // a sum near 1 more
}

// Those for 8 bits are off by 2.2e-5 and 3.1e-5: by Remez' exchange, beside which float32 is nothing.
TEST(Angles, ShownHalfAnglesAreOffByAThirtiethOfAPixelAtMost) {
  EXPECT_LT(worst_half_angle(atan_over_t_shown, 46.4), 2.25e-5);
  EXPECT_LT(worst_half_angle(atan_over_t_wide_shown, 90.4), 3.2e-5);
}

TEST(Tone, TheSignalIsThatOfIec61966) {
  double worst_steps = 0.0;
  for (int i = 0; i <= 100'000; ++i) {
    const double x = std::pow(i / 100'000.0, 2.0);
    const double exact = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
    worst_steps = std::max(worst_steps,
                           255.0 * std::abs(static_cast<double>(srgb_encoded(vec3(static_cast<float>(x))).y) - exact));
  }
  EXPECT_LT(worst_steps, 0.2);
  EXPECT_EQ(srgb_encoded(vec3(0.0f)).x, 0.0f);
  EXPECT_EQ(srgb_encoded(vec3(100.0f)).x, srgb_encoded(vec3(1.0f)).x);
}

TEST(Tone, DarkStaysProportionalWhiteIsReachedAndOnlyBrighterIsClipped) {
  EXPECT_NEAR(tone_curve(vec3(1e-4f)).x, 1e-4f, 2e-8f);
  EXPECT_NEAR(tone_curve(vec3(12.0f)).x, 1.0f, 1e-5f);
  float last = 0.0f;
  for (float y = 0.0f; y < 100.0f; y += 0.01f) {
    const float now = tone_curve(vec3(y)).x;
    ASSERT_GE(now, last);
    if (std::abs(y - 12.0f) > 0.01f) {
      ASSERT_EQ(now > 1.0f, y > 12.0f) << y;
    }
    last = now;
  }
}

// Where half floats hold no more, some devices write infinity, of which the curve is no number.
TEST(Tone, InfiniteLightIsWhite) {
  const vec3 most(std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(tone_curve(most).x));
  EXPECT_GT(tone_curve(held_by_half(most) * 0.3f).x, 1.0f);
  EXPECT_EQ(srgb_encoded(tone_curve(held_by_half(most) * 0.3f)).x, srgb_encoded(vec3(1.0f)).x);
  EXPECT_EQ(held_by_half(vec3(0.25f)).x, 0.25f);
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
