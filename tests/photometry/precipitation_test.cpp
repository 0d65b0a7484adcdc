// Reference: rain and snow against figures of the literature; unit: what all drops together are.
#include "visual/photometry/table/precipitation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "visual/photometry/table/air.h"

namespace phare {
namespace {

TEST(Precipitation, TakesWhatTheRateSays) {
  // LOWTRAN 7 at 2.5, 10 and 50 mm/h, half of it diffraction.
  for (const auto& [rate, per_km] : {std::pair(2.5, 0.650), std::pair(10.0, 1.557), std::pair(50.0, 4.292)})
    EXPECT_NEAR(extinction_per_m(Air{.rain_mmph = rate}), 0.5e-3 * per_km, 0.5e-3 * 0.0006) << rate;
  EXPECT_NEAR(extinction_per_m(Air{.snow_mmph = 2.0}), 4.92e-3, 1e-9);
  EXPECT_NEAR(extinction_per_m(Air{.visibility_m = 300.0, .rain_mmph = 10.0}),
              extinction_per_m(300.0) + extinction_per_m(Air{.rain_mmph = 10.0}), 1e-15);
  EXPECT_EQ(extinction_per_m(Air{}), 0.0);
}

/// Number and size of drops by one source, extinction by another: they meet within a few percent, without a factor.
TEST(Precipitation, DropsOfMarshallAndPalmerMeetWhatLowtranSays) {
  for (const double rate : {2.5, 10.0, 50.0})
    EXPECT_NEAR(particles_of(Precipitation::kRain, rate).area_factor, 1.0, 0.05) << rate;
}

TEST(Precipitation, FallsAsAtlasMeasured) {
  for (const auto& [mm, mps] : {std::pair(1.0, 4.00), std::pair(2.0, 6.55), std::pair(3.0, 7.95)})
    EXPECT_NEAR(fall_mps(Precipitation::kRain, mm), mps, 0.006) << mm;
  EXPECT_NEAR(fall_mps(Precipitation::kRain, 0.5 - 1e-9), fall_mps(Precipitation::kRain, 0.5), 1e-6);
  EXPECT_EQ(fall_mps(Precipitation::kRain, 0.0), 0.0);
  EXPECT_EQ(fall_mps(Precipitation::kSnow, 3.0), 1.0);
}

TEST(Precipitation, ScattersAllThatItTakesAndBackAsMeasured) {
  for (const Air& air : {Air{.rain_mmph = 10.0}, Air{.snow_mmph = 1.0}, Air{.visibility_m = 200.0, .rain_mmph = 30.0},
                         Air{.visibility_m = 200.0, .snow_mmph = 3.0}}) {
    double all = 0.0, particles = 0.0;
    constexpr int kSteps = 40000;
    for (int i = 0; i < kSteps; ++i) {
      const double angle = std::numbers::pi * (i + 0.5) / kSteps;
      const double ring_sr = 2.0 * std::numbers::pi * std::sin(angle) * std::numbers::pi / kSteps;
      all += phase_per_sr(air, angle) * ring_sr, particles += phase_of_particles_per_sr(air, angle) * ring_sr;
    }
    EXPECT_NEAR(all, 1.0, 1e-4);
    EXPECT_NEAR(particles, air.particles().scattering_per_m / scattering_per_m(air), 1e-4);
  }
  // Mie's theory has 0.009 per sr over 160° to 180°.
  EXPECT_NEAR(phase_per_sr(Air{.rain_mmph = 10.0}, std::numbers::pi), 0.009, 0.001);
}

/// The notes' veil: 20,000 cd in 10 mm/h between 2 and 50 m, seen from the lamp: 0.067 cd/m² with a phase of 0.009, and
/// what the phase and the way through the rain make of it.
TEST(Precipitation, VeilsABeamAsWorkedOutByHand) {
  IntensityTable table;
  table.first_deg = {-180.0, 180.0};
  table.second_deg = {-90.0, 90.0};
  table.candela.assign(4, 20000.0);
  const Air air{.rain_mmph = 10.0};
  const PlacedSource lamp{.table = &table, .position_m = {0.0, kNearestToLamp_m, 0.0}};
  const auto to = [&](double length_m) {
    return airlight_cdm2(std::span(&lamp, 1), air, {}, {1.0, 0.0, 0.0}, length_m);
  };
  const double back = phase_per_sr(air, std::numbers::pi), sigma = extinction_per_m(air);
  const double without_loss = sigma * back * 20000.0 * (1.0 / 2.0 - 1.0 / 50.0);
  EXPECT_NEAR(0.067 * back / 0.009, without_loss, 0.001);
  const double found = to(50.0) - to(2.0);
  EXPECT_LT(found, without_loss);
  EXPECT_GT(found, without_loss * std::exp(-2.0 * sigma * 10.0)) << "most of it comes from nearer than 10 m";
}

TEST(Precipitation, ClassesOfDropsHoldAllThatAreLargeAndNoMoreThanTheyMay) {
  for (const Precipitation kind : {Precipitation::kRain, Precipitation::kSnow})
    for (const double rate : {0.05, 0.1, 1.0, 10.0}) {
      const Particles p = particles_of(kind, rate);
      double share = 0.0, above_mm = std::numeric_limits<double>::infinity();
      const auto classes = drop_classes(p);
      for (std::size_t i = kDropClasses; i-- > 0;) {
        const DropClass& one = classes[i];
        EXPECT_EQ(one.most_mm, above_mm);
        EXPECT_LE(one.least_mm, one.most_mm);
        EXPECT_LE(one.count, kMostDrops);
        const double cube_m3 = one.cube_m * one.cube_m * one.cube_m;
        EXPECT_NEAR((p.number_per_m3(one.least_mm) - p.number_per_m3(one.most_mm)) * cube_m3,
                    static_cast<double>(one.count), 0.51);
        share += one.share, above_mm = one.least_mm;
      }
      EXPECT_GT(share, 0.0);
      EXPECT_LE(share, 1.0 + 1e-12);
    }
  // Quadrature: of D² that of drops from a millimetre on.
  const Particles p = particles_of(Precipitation::kRain, 10.0);
  double from_1 = 0.0, all = 0.0;
  for (double mm = 0.0005; mm < 20.0; mm += 0.001) {
    const double term = mm * mm * std::exp(-p.slope_per_mm * mm);
    all += term, from_1 += mm > 1.0 ? term : 0.0;
  }
  EXPECT_NEAR(p.share_of_larger(1.0), from_1 / all, 1e-6);
}

}  // namespace
}  // namespace phare
