// The composer: bit equality with an image made from nothing, work counted; and the ladder of image levels.
#include "visual/photometry/beam/beam_composer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/beam/image_levels.h"
#include "visual/photometry/bench/sample_lamps.h"

namespace phare {
namespace {

std::vector<double> even(double low, double high, int count) {
  std::vector<double> nodes;
  for (int i = 0; i < count; ++i) nodes.push_back(low + (high - low) * i / (count - 1));
  return nodes;
}

const std::vector<SampleLamp>& segments() {
  static const std::vector<SampleLamp> all = matrix_segments();
  return all;
}

TEST(BeamComposer, NothingChangedIsNothingDone) {
  BeamComposer composer(even(-18, 18, 181), even(-6, 6, 61));
  for (const SampleLamp& segment : segments()) composer.add(segment.table);
  EXPECT_FALSE(composer.update().empty());
  const ComposeCount before = composer.count();
  EXPECT_EQ(before.sources, 36u);
  for (int frame = 0; frame < 100; ++frame) {
    composer.set_dimming(7, 1.0);  // the same values as before
    composer.set_swivel(3, 0.0, 0.0);
    composer.set_table(5, segments()[5].table);
    EXPECT_TRUE(composer.update().empty());
  }
  EXPECT_EQ(composer.count().texels, before.texels);
  EXPECT_EQ(composer.count().sources, before.sources);
  EXPECT_EQ(composer.count().images, before.images);
  EXPECT_EQ(composer.count().idle, before.idle + 100);
}

// Thousands of random changes: at the end the image is that of a composer made afresh, bit for bit.
TEST(BeamComposer, NeverDriftsFromAFreshImage) {
  const std::vector<double> h = even(-18, 18, 121), v = even(-6, 6, 41);
  BeamComposer kept(h, v);
  for (const SampleLamp& segment : segments()) kept.add(segment.table);
  std::mt19937 random(5);
  std::vector<double> dim(36, 1.0), yaw(36, 0.0);
  std::vector<std::size_t> table(36);
  for (std::size_t k = 0; k < 36; ++k) table[k] = k;
  for (int change = 0; change < 2000; ++change) {
    const std::size_t k = random() % 36;
    switch (random() % 12) {
      case 0:
        yaw[k] = 0.01 * static_cast<double>(random() % 10);
        kept.set_swivel(k, yaw[k], 0.0);
        break;
      case 1:
        table[k] = random() % 36;
        kept.set_table(k, segments()[table[k]].table);
        break;
      default:
        dim[k] = static_cast<double>(random() % 101) / 100.0;
        kept.set_dimming(k, dim[k]);
    }
    if (change % 3 == 0) kept.update();
  }
  kept.update();
  BeamComposer fresh(h, v);
  for (std::size_t k = 0; k < 36; ++k) {
    fresh.add(segments()[table[k]].table, aim_rotation(yaw[k], 0.0, 0.0));
    fresh.set_dimming(k, dim[k]);
  }
  fresh.update();
  for (std::size_t i = 0; i < kept.candela().size(); ++i) ASSERT_EQ(kept.candela()[i], fresh.candela()[i]) << i;
  EXPECT_GT(*std::max_element(kept.candela().begin(), kept.candela().end()), 1000.0f);
}

TEST(BeamComposer, OneChangeSumsOnlyItsRectangle) {
  BeamComposer composer(even(-18, 18, 361), even(-6, 6, 121));
  for (const SampleLamp& segment : segments()) composer.add(segment.table);
  composer.update();
  const std::size_t before = composer.count().texels;
  composer.set_dimming(17, 0.25);
  const auto changed = composer.update();
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(composer.count().texels - before, changed[0].texels());
  EXPECT_LT(changed[0].texels(), composer.columns() * composer.rows() / 10);
}

TEST(BeamComposer, AgreesWithTheTables) {
  const std::vector<double> h = even(-18, 18, 91), v = even(-6, 6, 31);
  BeamComposer composer(h, v);
  for (const SampleLamp& segment : segments()) composer.add(segment.table);
  composer.update();
  for (std::size_t j = 0; j < v.size(); ++j) {
    for (std::size_t i = 0; i < h.size(); ++i) {
      double sum = 0.0;
      for (const SampleLamp& segment : segments()) sum += segment.table.intensity_at_cd({h[i], v[j]});
      ASSERT_NEAR(static_cast<double>(composer.candela()[j * h.size() + i]), sum, 3e-6 * sum + 1e-9);
    }
  }
}

TEST(ImageLevels, HalfFloatsAreNearestAndComeBack) {
  for (std::uint32_t half = 0; half < 0x7c00u; ++half) {
    const float value = float_from_half(static_cast<std::uint16_t>(half));
    ASSERT_EQ(half_from_float(value), half) << value;
    const float next = float_from_half(static_cast<std::uint16_t>(half + 1));
    if (half + 1 < 0x7c00u) {
      ASSERT_EQ(half_from_float(value + 0.49f * (next - value)), half);
      ASSERT_EQ(half_from_float(value + 0.51f * (next - value)), half + 1);
      ASSERT_EQ(half_from_float(0.5f * (value + next)), half + half % 2);  // ties to even
    }
  }
  EXPECT_EQ(half_from_float(1e6f), 0x7c00u);
}

// Each step up the ladder is nearer the truth; own weights in float32 stay within their rounding.
TEST(ImageLevels, TheLadderClimbs) {
  const std::vector<SampleLamp> lamps = sample_lamps();
  const IntensityTable& low = lamps.front().table;
  double last = 1e300;
  for (const ImageLevel level : kImageLevels) {
    const LevelError error = level_error(low, LevelImage(low, level));
    std::printf("%-28s %8zu bytes, worst %.4g cd, %.3g %%\n", level_name(level).c_str(), error.bytes, error.worst_cd,
                error.worst_percent);
    EXPECT_LT(error.worst_cd, last);
    last = error.worst_cd;
    if (level == ImageLevel::kFloatNodes) {
      EXPECT_LT(error.worst_percent, 1e-3);  // 1e-5, the aim for the GPU
    }
    if (level == ImageLevel::kHalfNodes) {
      EXPECT_LE(error.worst_percent, 100.0 / 2048.0 * 1.01);  // half a unit of 11 bits
    }
  }
}

TEST(ImageLevels, EightBitsCannotHold350CandelaUnder40000) {
  IntensityTable table;
  table.first_deg = {-1, 0, 1};
  table.second_deg = {-1, 1};
  table.candela = {350, 40000, 350, 350, 40000, 350};
  EXPECT_GT(level_error(table, LevelImage(table, ImageLevel::kNormalised8, 3, 2)).worst_percent, 10.0);
  EXPECT_LT(level_error(table, LevelImage(table, ImageLevel::kFloatNodes)).worst_percent, 1e-4);
}

}  // namespace
}  // namespace phare
