// Unit: veil, threshold increment and discomfort of several lamps at an eye, against values worked out by hand.
#include "visual/photometry/table/glare.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace phare {
namespace {

double de_boer(double illuminance_lx, double angle_min, double adaptation_cdm2) {
  const GlareSource lamp{illuminance_lx, angle_min / 60.0};
  return glare_at_eye({}, {&lamp, 1}, adaptation_cdm2).de_boer.value();
}

TEST(Glare, DiscomfortIsWhatTheFormulaHas) {
  // Worked out apart, four decimals given: half of the last.
  EXPECT_NEAR(de_boer(0.5, 120.0, 1.0), 4.0255, 5e-5);
  EXPECT_NEAR(de_boer(0.5, 120.0, 0.1), 3.2928, 5e-5);
  EXPECT_NEAR(de_boer(1.0, 60.0, 1.0), 3.1464, 5e-5);
  const std::array<GlareSource, 2> pair{{{0.25, 110.0 / 60.0}, {0.25, 130.0 / 60.0}}};
  EXPECT_NEAR(glare_at_eye({}, pair, 1.0).de_boer.value(), 4.0234, 5e-5);
  // L_a 0.04 makes the bracket 2; E 0.006 lx at one minute would be the scale's 5, at ten times the light it is 3.
  EXPECT_NEAR(de_boer(0.006 * std::pow(6.0, 0.46), 6.0, 0.04), 5.0, 1e-12);
  EXPECT_NEAR(de_boer(0.06 * std::pow(6.0, 0.46), 6.0, 0.04), 3.0, 1e-12);
}

// The formula alone has 72.6, 12.6 and 9.27 for the first three, such light as comes through fog, and -2.6 for the
// last.
TEST(Glare, DiscomfortStaysOnItsScale) {
  for (const double lx : {2.5e-35, 2.5e-5, 1.2e-3}) EXPECT_EQ(de_boer(lx, 120.0, 1.0), 9.0) << lx;
  EXPECT_NEAR(de_boer(1.8e-3, 120.0, 1.0), 8.913, 5e-4) << "on the scale it is what it was";
  EXPECT_EQ(de_boer(1e3, 120.0, 1.0), 1.0);
}

TEST(Glare, VeilsOfLampsAddUp) {
  // Age 30, pigment 0.5, 0.5 lx: 7.65966 cd/m² at 1°, 1.29697 at 2°, 0.034585 at 10°, worked out apart; last digit.
  const Viewer viewer{30.0, 0.5};
  const std::array<GlareSource, 3> lamps{{{0.5, 1.0}, {0.5, 2.0}, {0.5, 10.0}}};
  const Glare glare = glare_at_eye(viewer, lamps, 2.0);
  EXPECT_NEAR(glare.veil_cdm2, 7.65966 + 1.29697 + 0.034585, 1.5e-5);
  EXPECT_DOUBLE_EQ(glare.illuminance_lx, 1.5);
  EXPECT_NEAR(glare.threshold_increment_percent, 65.0 * 8.991215 / std::pow(2.0, 0.8), 65.0 * 1.5e-5);
}

TEST(Glare, OfNoLightIsNone) {
  const GlareSource dark{0.0, 2.0};
  for (const auto& sources : {std::span<const GlareSource>{}, std::span<const GlareSource>(&dark, 1)}) {
    const Glare glare = glare_at_eye({}, sources, 1.0);
    EXPECT_EQ(glare.veil_cdm2, 0.0);
    EXPECT_EQ(glare.threshold_increment_percent, 0.0);
    EXPECT_FALSE(glare.de_boer);
  }
}

TEST(Glare, StraightInTheEyeHasNoSingularity) {
  const GlareSource ahead{1.0, 0.0}, near{1.0, 0.1};
  EXPECT_EQ(glare_at_eye({}, {&ahead, 1}, 1.0).de_boer, glare_at_eye({}, {&near, 1}, 1.0).de_boer);
  EXPECT_EQ(glare_at_eye({}, {&ahead, 1}, 1.0).veil_cdm2, glare_at_eye({}, {&near, 1}, 1.0).veil_cdm2);
}

}  // namespace
}  // namespace phare
