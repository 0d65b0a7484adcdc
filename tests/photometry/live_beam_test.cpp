// The live beam against an image composed from nothing, and how much it does.
#include "visual/photometry/beam/live_beam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "visual/photometry/bench/sample_lamps.h"

namespace phare {
namespace {

/// Type A, a bump of `peak_cd` at (h, v), dark at its limits.
IntensityTable bump(double peak_cd, double h_deg, double v_deg, double half_width_deg,
                    PhotometricType type = PhotometricType::kA) {
  IntensityTable table;
  table.type = type;
  for (int i = -4; i <= 4; ++i) table.first_deg.push_back(h_deg + half_width_deg * i / 4.0);
  for (int j = -4; j <= 4; ++j) table.second_deg.push_back(v_deg + half_width_deg * j / 4.0);
  for (int j = -4; j <= 4; ++j)
    for (int i = -4; i <= 4; ++i) table.candela.push_back(peak_cd * (1.0 - i * i / 16.0) * (1.0 - j * j / 16.0));
  return table;
}

/// The largest difference in cd over directions near the axis.
double worst_difference_cd(const BeamImage& image, const std::vector<AimedSource>& lit) {
  IntensityTable table;
  table.type = image.type;
  table.axis = image.axis;
  table.first_deg = image.first_deg;
  table.second_deg = image.second_deg;
  table.candela.assign(image.candela.begin(), image.candela.end());
  double worst = 0.0;
  for (double h = -20.0; h <= 20.0; h += 0.37) {
    for (double v = -10.0; v <= 10.0; v += 0.23) {
      const glm::dvec3 in_car = direction_hv(h, v);
      double truth_cd = 0.0;
      for (const AimedSource& source : lit)
        truth_cd += source.scale * source.table->intensity_cd(in_car * source.car_from_lamp);
      worst = std::max(worst, std::abs(table.intensity_cd(in_car * image.car_from_image) - truth_cd));
    }
  }
  return worst;
}

// float32 nodes and products of float32: four roundings of 2^-24 of at most the peak of the sum.
constexpr double kRounding = 4.0 / (1 << 24);

TEST(LiveBeam, IsTheSumOfItsLitSources) {
  const IntensityTable low = bump(20000.0, 0.5, -1.5, 6.0), high = bump(50000.0, 0.0, 0.5, 4.0);
  LiveBeam beam({{.table = &low}, {.table = &high, .scale = 0.5}});
  EXPECT_EQ(beam.update(), LiveBeam::Change::kNone);
  EXPECT_TRUE(beam.image().dark);
  beam.set_dimming(0, 1.0);
  EXPECT_EQ(beam.update(), LiveBeam::Change::kWhole);
  EXPECT_LT(worst_difference_cd(beam.image(), {{.table = &low}}), 45000.0 * kRounding);
  beam.set_dimming(1, 0.5);
  EXPECT_EQ(beam.update(), LiveBeam::Change::kPart);
  ASSERT_EQ(beam.changed().size(), 1u);
  EXPECT_LT(worst_difference_cd(beam.image(), {{.table = &low}, {.table = &high, .scale = 0.25}}), 45000.0 * kRounding);
  beam.set_dimming(0, 0.0);
  beam.set_dimming(1, 0.0);
  EXPECT_EQ(beam.update(), LiveBeam::Change::kPart);  // dark now
  EXPECT_TRUE(beam.image().dark);
  EXPECT_TRUE(beam.changed().empty());
  EXPECT_EQ(beam.update(), LiveBeam::Change::kNone);
}

// Sources of another aim or type cost accuracy only while they are lit together.
TEST(LiveBeam, ResamplesOnlyWhatHasNoAnglesInCommon) {
  const IntensityTable low = bump(20000.0, 0.5, -1.5, 6.0), high = bump(50000.0, 0.0, 0.5, 4.0, PhotometricType::kB);
  const AimedSource low_source{.table = &low, .car_from_lamp = aim_rotation(0.0, -0.01, 0.0)};
  const AimedSource high_source{.table = &high, .car_from_lamp = aim_rotation(0.0, -0.005, 0.0)};
  LiveBeam beam({low_source, high_source});
  beam.set_dimming(0, 1.0);
  beam.update();
  EXPECT_FALSE(beam.image().resampled);
  EXPECT_LT(worst_difference_cd(beam.image(), {low_source}), 20000.0 * kRounding);
  beam.set_dimming(1, 1.0);
  EXPECT_EQ(beam.update(), LiveBeam::Change::kWhole);
  EXPECT_TRUE(beam.image().resampled);
  // Steps of at most 0.5° below 10°, and half a bump of 1 - x² over 4°: second derivative 2·50,000/16 cd/deg², error of
  // a chord h²/8 of it per axis.
  EXPECT_LT(worst_difference_cd(beam.image(), {low_source, high_source}),
            2.0 * (0.1 * 0.1 / 8.0) * 2.0 * 50000.0 / 16.0);
  beam.set_dimming(0, 0.0);
  EXPECT_EQ(beam.update(), LiveBeam::Change::kWhole);
  EXPECT_EQ(beam.image().type, PhotometricType::kB);
  EXPECT_LT(worst_difference_cd(beam.image(), {high_source}), 50000.0 * kRounding);
}

// A matrix lamp: one segment dimmed sums its rectangle and no more; none dimmed, nothing; and what comes out never
// drifts.
TEST(LiveBeam, OfAMatrixSumsOneSegmentsRectangle) {
  const std::vector<SampleLamp> segments = matrix_segments();
  ASSERT_EQ(segments.size(), 36u);
  std::vector<AimedSource> sources;
  for (const SampleLamp& segment : segments) sources.push_back({.table = &segment.table});
  LiveBeam beam(sources), fresh(sources);
  for (std::size_t k = 0; k < 36; ++k) beam.set_dimming(k, 1.0);
  beam.update();
  const std::uint64_t all = beam.summed_texels();
  beam.set_dimming(17, 0.3);
  EXPECT_EQ(beam.update(), LiveBeam::Change::kPart);
  const std::uint64_t one = beam.summed_texels() - all;
  EXPECT_GT(one, 0u);
  EXPECT_LT(one, beam.image().candela.size() / 4);
  for (int frame = 0; frame < 100; ++frame) {
    beam.set_dimming(17, 0.3);
    EXPECT_EQ(beam.update(), LiveBeam::Change::kNone);
  }
  EXPECT_EQ(beam.summed_texels(), all + one);

  std::mt19937 random(11);
  std::vector<double> dimming(36, 1.0);
  dimming[17] = 0.3;
  for (int change = 0; change < 1000; ++change) {
    const std::size_t k = random() % 36;
    dimming[k] = static_cast<double>(random() % 101) / 100.0;
    beam.set_dimming(k, dimming[k]);
    beam.update();
  }
  for (std::size_t k = 0; k < 36; ++k) fresh.set_dimming(k, dimming[k]);
  fresh.update();
  EXPECT_EQ(beam.image().candela, fresh.image().candela);
  EXPECT_EQ(beam.image().colour, fresh.image().colour);
}

TEST(LiveBeam, ColourIsTheFluxWeightedMean) {
  const IntensityTable table = bump(1000.0, 0.0, 0.0, 5.0);
  const AimedSource warm{.table = &table, .colour_temperature_k = 3000.0};
  const AimedSource amber{.table = &table, .chromaticity_xy = glm::dvec2{0.57, 0.42}};
  LiveBeam beam({warm, amber});
  beam.set_dimming(0, 1.0);
  beam.update();
  EXPECT_EQ(beam.image().colour, black_body_colour(3000.0));
  beam.set_dimming(1, 1.0);
  beam.update();
  const glm::vec3 mean = 0.5f * (black_body_colour(3000.0) + light_colour(amber));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(beam.image().colour[i], mean[i], 1e-6f);
}

// Tables of colour are there exactly while colours differ, follow every dimming by its rectangle, and equal bit for bit
// what a fresh beam and, to float32, what a composed image has.
TEST(LiveBeam, TintsAreKeptWhileColoursDifferAndFollowDimming) {
  const IntensityTable left = bump(1000.0, -6.0, 0.0, 4.0), right = bump(3000.0, 5.0, 1.0, 4.0);
  const std::vector<AimedSource> sources{{.table = &left, .colour_temperature_k = 5500.0},
                                         {.table = &right, .colour_temperature_k = 3200.0},
                                         {.table = &left, .colour_temperature_k = 5500.0}};
  LiveBeam beam(sources);
  beam.set_dimming(0, 1.0);
  beam.set_dimming(2, 0.5);
  beam.update();
  EXPECT_TRUE(beam.image().tints.empty());
  beam.set_dimming(1, 1.0);
  EXPECT_EQ(beam.update(), LiveBeam::Change::kWhole);
  EXPECT_EQ(beam.image().tints.size(), beam.image().candela.size());
  std::mt19937 random(5);
  for (int change = 0; change < 200; ++change) {
    std::vector<double> dimming(3);
    for (std::size_t k = 0; k < 3; ++k)
      beam.set_dimming(k, dimming[k] = 0.01 + static_cast<double>(random() % 100) / 100.0);
    ASSERT_NE(beam.update(), LiveBeam::Change::kWhole);
    LiveBeam fresh(sources);
    for (std::size_t k = 0; k < 3; ++k) fresh.set_dimming(k, dimming[k]);
    fresh.update();
    ASSERT_EQ(beam.image().candela, fresh.image().candela);
    ASSERT_EQ(beam.image().tints, fresh.image().tints);
    std::vector<AimedSource> dimmed = sources;
    for (std::size_t k = 0; k < 3; ++k) dimmed[k].scale = dimming[k];
    const BeamImage composed = compose_beam_image(dimmed);
    for (std::size_t i = 0; i < composed.tints.size(); ++i) {
      // Three products and two sums of float32: 5 · 2^-24.
      ASSERT_NEAR(beam.image().tints[i].x, composed.tints[i].x, 3e-7f * composed.tints[i].x);
      ASSERT_NEAR(beam.image().tints[i].y, composed.tints[i].y, 3e-7f * composed.tints[i].y);
    }
  }
  beam.set_dimming(1, 0.0);
  EXPECT_EQ(beam.update(), LiveBeam::Change::kWhole);
  EXPECT_TRUE(beam.image().tints.empty());
}

// sRGB's own white and red come back as (1, 1, 1) and (R, 0, 0), by the coordinates that IEC 61966-2-1 gives them.
TEST(LightColour, OfAChromaticityIsInLinearSrgb) {
  const glm::vec3 white = chromaticity_colour({0.3127, 0.3290});
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 1.0f, 1e-3f);  // xy with four digits
  const glm::vec3 red = chromaticity_colour({0.64, 0.33});
  EXPECT_NEAR(red.x, 1.0f / 0.2126f, 2e-3f);
  EXPECT_NEAR(red.y, 0.0f, 2e-3f);
  EXPECT_NEAR(red.z, 0.0f, 2e-3f);
}

}  // namespace
}  // namespace phare
