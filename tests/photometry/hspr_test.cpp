// HSPR with sources whose ranges, widths and flux can be worked out by hand.
#include "visual/photometry/hspr.h"

#include <gtest/gtest.h>

#include <cmath>

#include "visual/photometry/sample_lamps.h"

namespace phare {
namespace {

IntensityTable constant(double cd) {
  IntensityTable table;
  table.first_deg = {-90, 90};
  table.second_deg = {-90, 90};
  table.candela.assign(4, cd);
  return table;
}

const HsprRow& row(const HsprResult& result, const std::string& id) {
  for (const HsprRow& r : result.rows) {
    if (r.id == id) return r;
  }
  return result.rows.front();
}

TEST(Hspr, IlluminanceOnTheVerticalPlane) {
  const IntensityTable table = constant(1000);
  const std::vector<HsprLamp> one{{&table, 0.0, 0.65, 0.0}};
  EXPECT_NEAR(hspr_illuminance_lx(one, 0, 0.65, 10), 10.0, 1e-12);
  EXPECT_NEAR(hspr_illuminance_lx(one, 3, 0.65, 4), 1000.0 / 25.0 * 0.8, 1e-12);
  EXPECT_EQ(hspr_illuminance_lx(one, 0, 0, -1), 0.0);
}

// A point source of I cd in the origin's axis: E = I·z/d³ > t, far away z = sqrt(I/t), walked in half metres.
TEST(Hspr, RangesOfAConstantSource) {
  const IntensityTable table = constant(15000);
  const std::vector<HsprLamp> pair{{&table, -0.6, 0.65, 0.0}, {&table, 0.6, 0.65, 0.0}};
  const HsprResult low = hspr_low_beam(pair);
  const auto range = [](double x, double threshold) {
    double z = 400.0;
    const auto lux = [&](double at) {
      double sum = 0.0;
      for (const double lamp : {-0.6, 0.6})
        sum += 15000.0 * at / std::pow(at * at + (x - lamp) * (x - lamp) + 0.65 * 0.65, 1.5);
      return sum;
    };
    while (lux(z) <= threshold) z -= 0.5;
    return z;
  };
  double expected = 0.0;
  for (const double t : {1.0, 3.0, 5.0}) {
    for (const double x : {0.0, 1.5, 3.0}) expected += range(x, t) / 9.0;
  }
  EXPECT_NEAR(row(low, "A").value, expected, 1e-9);
  EXPECT_NEAR(row(low, "D off").value, row(low, "D near").value, 1e-9);  // symmetric
  // 15,000 cd into 90° × 20°: ∫ cos V over -15 to 5° times 90° in rad, two lamps.
  const double rad = M_PI / 180.0;
  EXPECT_NEAR(row(low, "flux").value, 2 * 15000 * 90 * rad * (std::sin(5 * rad) + std::sin(15 * rad)), 1.0);
  const HsprResult high = hspr_high_beam(pair);
  EXPECT_FALSE(high.complete);
  EXPECT_NEAR(row(high, "0, h").value, 100.0, 1.0);  // sqrt(30000/3)
}

TEST(Hspr, PointsAreLinearAndAHeadlampScoresInside) {
  const std::vector<SampleLamp> lamps = sample_lamps();
  const std::vector<HsprLamp> pair{{&lamps[0].table, -0.6, 0.65, -0.573}, {&lamps[0].table, 0.6, 0.65, -0.573}};
  const HsprResult result = hspr_low_beam(pair);
  ASSERT_TRUE(result.complete);
  double weighted = 0.0;
  for (const HsprRow& r : result.rows) {
    EXPECT_NEAR(r.one_point + (r.points - 1.0) * (r.two_points - r.one_point), r.value, 1e-9) << r.id;
    weighted += r.weight * r.points;
  }
  EXPECT_NEAR(result.weighted, weighted, 1e-12);
  EXPECT_GT(result.weighted, 4.0);
  EXPECT_LT(result.weighted, 25.0);
}

TEST(Hspr, TheScaleRunsFromWorstToBest) {
  const IntensityTable table = constant(15000);
  const std::vector<HsprLamp> pair{{&table, -0.6, 0.65, 0.0}, {&table, 0.6, 0.65, 0.0}};
  const HsprResult low = hspr_low_beam(pair);
  EXPECT_NEAR(low.worst + low.on_scale_01 * (low.best - low.worst), low.weighted, 1e-9);
  EXPECT_FALSE(row(low, "glare").chosen.empty());  // the weights inside the window are ours
  EXPECT_TRUE(row(low, "A").chosen.empty());
}

TEST(Hspr, WhichBeamAPairIs) {
  const std::vector<SampleLamp> lamps = sample_lamps();
  const auto beam_of = [&](const char* left, const char* right, HsprBeam asked = HsprBeam::kFind) {
    std::vector<HsprLamp> pair;
    for (const char* file : {left, right}) {
      for (const SampleLamp& lamp : lamps)
        if (lamp.file == file) pair.push_back({&lamp.table, 0.0, 0.65, 0.0});
    }
    const auto beam = hspr_beam(pair, asked);
    return beam ? std::string(*beam == HsprBeam::kLow ? "low" : "high") : beam.error().place;
  };
  EXPECT_EQ(beam_of("low_rht.ies", "led_low_rht.ies"), "low");
  EXPECT_EQ(beam_of("high.ies", "led_high.ies"), "high");
  EXPECT_EQ(beam_of("low_rht.ies", "high.ies"), "high.ies");  // refused: no pair
  EXPECT_EQ(beam_of("low_rht.ies", "high.ies", HsprBeam::kLow), "high.ies");
  EXPECT_EQ(beam_of("low_rht.ies", "low_lht.ies"), "low_lht.ies");  // the one that it is
  EXPECT_EQ(beam_of("fog.ies", "fog.ies"), "fog.ies");
  EXPECT_EQ(beam_of("fog.ies", "fog.ies", HsprBeam::kLow), "low");
}

}  // namespace
}  // namespace phare
