// unit, reference: the eye's white follows the light, as slowly as was measured, and by simulated time alone.
#include "visual/process/adaptation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "visual/photometry/beam/beam_image.h"

namespace phare {
namespace {

SimTime at_s(double seconds) {
  return SimTime{static_cast<std::int64_t>(seconds * 1e9)};
}

// Of the way from one light to another, how much is done: in the red of the white, which `colour / (D + (1 - D)
// colour)` gives back.
double done(const EyeAdaptation& eye, const glm::vec3& from, const glm::vec3& to) {
  const double degree = degree_of_adaptation(0.3), white = static_cast<double>(eye.white().x);
  const double colour = degree / (1.0 / white - (1.0 - degree));
  return (colour - static_cast<double>(from.x)) / (static_cast<double>(to.x) - static_cast<double>(from.x));
}

TEST(EyeAdaptation, FirstLightFindsTheEyeAdapted) {
  EyeAdaptation eye;
  eye.see(at_s(3.0), black_body_colour(3200.0));
  // McCamy's formula is good to some kelvin here.
  EXPECT_NEAR(eye.adapted_k(), 3200.0, 30.0);
  eye.see(at_s(9.0), black_body_colour(3200.0));
  EXPECT_NEAR(eye.adapted_k(), 3200.0, 30.0);
}

// Rinner and Gegenfurtner 2000: more than half within some 40 to 70 ms, the rest with a half-life of 20 s. Exponentials
// are exact: the tolerance is of the float of the white.
TEST(EyeAdaptation, FollowsAnotherLightInTheTimesThatWereMeasured) {
  const glm::vec3 halogen = black_body_colour(3200.0), led = black_body_colour(5500.0);
  EyeAdaptation eye;
  eye.see(at_s(0.0), halogen);
  eye.see(at_s(0.0), led);
  EXPECT_NEAR(done(eye, halogen, led), 0.0, 1e-5);
  eye.see(at_s(0.055), led);
  const double slow_there = 1.0 - std::exp2(-0.055 / 20.0);
  EXPECT_NEAR(done(eye, halogen, led), 0.55 * 0.5 + 0.45 * slow_there, 1e-5);
  eye.see(at_s(0.5), led);
  EXPECT_GT(done(eye, halogen, led), 0.5) << "the picture right after a switch is not blue";
  eye.see(at_s(20.0), led);
  EXPECT_NEAR(done(eye, halogen, led), 1.0 - 0.45 * 0.5, 1e-5);
  eye.see(at_s(400.0), led);
  EXPECT_NEAR(done(eye, halogen, led), 1.0, 1e-5);
}

// Each frame's step is exact, so what the frames are does not matter: only rounding of 6000 products, 6000 · 2^-52.
TEST(EyeAdaptation, DependsOnTimeAndLightNotOnFrames) {
  const glm::vec3 halogen = black_body_colour(3200.0), led = black_body_colour(5500.0);
  EyeAdaptation one, many;
  one.see(at_s(0.0), halogen);
  many.see(at_s(0.0), halogen);
  for (int frame = 1; frame <= 600; ++frame) many.see(at_s(frame / 60.0), led);
  one.see(at_s(10.0), led);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(one.white()[i], many.white()[i], 1e-6f);
}

TEST(EyeAdaptation, DarknessLeavesItAsItIs) {
  const glm::vec3 halogen = black_body_colour(3200.0);
  EyeAdaptation eye;
  eye.see(at_s(0.0), halogen);
  const glm::vec3 before = eye.white();
  eye.see(at_s(30.0), std::nullopt);
  EXPECT_EQ(eye.white(), before);
}

// At night adaptation is not complete: a lamp keeps a third of what sets it apart from the display's white, and as
// bright as it was.
TEST(EyeAdaptation, AtNightAThirdOfTheColourIsLeft) {
  EXPECT_NEAR(degree_of_adaptation(0.0), 0.659, 0.0005);
  EXPECT_NEAR(degree_of_adaptation(5.0), 0.667, 0.0005);
  EXPECT_NEAR(degree_of_adaptation(1e4), 0.8, 1e-9);  // F of CIECAM02 for a dark surround
  for (const double kelvin : {2700.0, 3200.0, 4300.0, 5500.0, 6500.0}) {
    const glm::vec3 light = black_body_colour(kelvin);
    EyeAdaptation eye;
    eye.see(at_s(0.0), light);
    const glm::dvec3 seen = glm::dvec3(light) / glm::dvec3(eye.white());
    EXPECT_NEAR(0.2126 * seen.x + 0.7152 * seen.y + 0.0722 * seen.z, 1.0, 1e-5) << kelvin;
    EXPECT_NEAR(seen.x - 1.0, 0.34 * (static_cast<double>(light.x) - 1.0), 0.002 * std::abs(seen.x)) << kelvin;
    EXPECT_NEAR(seen.z - 1.0, 0.34 * (static_cast<double>(light.z) - 1.0), 0.002 * std::abs(seen.z)) << kelvin;
  }
}

TEST(EyeAdaptation, FixedStaysWhatItIs) {
  EyeAdaptation eye(4000.0);
  eye.see(at_s(0.0), black_body_colour(3200.0));
  eye.see(at_s(100.0), black_body_colour(5500.0));
  EXPECT_EQ(eye.white(), black_body_colour(4000.0));
  EXPECT_EQ(eye.adapted_k(), 4000.0);
}

// A light without blue (an amber lamp) must not make the picture infinite.
TEST(EyeAdaptation, LightWithoutBlueKeepsTheBalanceFinite) {
  EyeAdaptation eye;
  eye.see(at_s(0.0), chromaticity_colour({0.64, 0.33}));
  for (int i = 0; i < 3; ++i) EXPECT_GT(eye.white()[i], 0.1f);
}

TEST(EyeAdaptation, AnotherProcessGoesOnFromItsState) {
  EyeAdaptation eye, other;
  eye.see(at_s(0.0), black_body_colour(3200.0));
  eye.see(at_s(2.0), black_body_colour(5500.0));
  ASSERT_TRUE(other.restore(nlohmann::json::parse(eye.json().dump())));
  EXPECT_EQ(other.white(), eye.white());
  eye.see(at_s(2.5), black_body_colour(5500.0));
  other.see(at_s(2.5), black_body_colour(5500.0));
  EXPECT_EQ(other.white(), eye.white());
  EXPECT_FALSE(other.restore(nlohmann::json{{"fast", 3}}));
  EXPECT_EQ(other.white(), eye.white());
}

}  // namespace
}  // namespace phare
