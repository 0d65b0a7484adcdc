// Our sample lamps: as written and read back, against the regulation rows, and smooth to the eye.
#include "visual/photometry/bench/sample_lamps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "photometry_test_files.h"
#include "tests/paths.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/bench/check.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/readers/write_lamp.h"
#include "visual/photometry/table/combine.h"

namespace phare {
namespace {

const std::vector<SampleLamp>& lamps() {
  static const std::vector<SampleLamp> all = sample_lamps();
  return all;
}

const SampleLamp& lamp(const std::string& file) {
  return *std::find_if(lamps().begin(), lamps().end(), [&](const SampleLamp& l) { return l.file == file; });
}

glm::dmat3 mounted() {
  return aim_rotation(0.0, sample_pitch_rad(), 0.0);
}

TEST(SampleLamps, ComeBackFromTheirFiles) {
  for (const SampleLamp& made : lamps()) {
    const std::string text = lm63_text(made.table, kSampleGeneration);
    EXPECT_LT(text.size(), 400000u);
    const auto read = read_lm63(test::temporary_file(made.file, text));
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(read->version, "IES:LM-63-2019");
    EXPECT_TRUE(read->notes.empty());
    EXPECT_EQ(read->first_deg, made.table.first_deg);
    EXPECT_EQ(read->second_deg, made.table.second_deg);
    EXPECT_EQ(read->candela, made.table.candela);
  }
}

TEST(SampleLamps, PassTheirRules) {
  for (const SampleLamp& l : lamps()) {
    for (const std::string& id : l.rules) {
      const auto rule = find_rulebook(rules_dir(), id);
      ASSERT_TRUE(rule.ok()) << rule.error().text();
      const IntensityTable* table[] = {&l.table};
      CheckOptions options;
      if (l.kind == SampleKind::kFog) options.aim = HV{0.0, glm::degrees(sample_pitch_rad())};
      const CheckResult result = check_lamp(table, *rule, options);
      EXPECT_EQ(result.left_hand, l.kind == SampleKind::kLowLeft) << l.file;
      for (const CheckRow& row : result.rows)
        EXPECT_NE(row.verdict, RuleVerdict::kFail)
            << l.file << " " << id << " " << row.id << ": " << row.lowest << " to " << row.highest;
    }
    if (l.kind == SampleKind::kHigh) {
      EXPECT_EQ(l.table.peak_cd(), l.table.intensity_at_cd({0.0, 0.0}));
    }
  }
}

// 1000 cd at least at HV, which is the brightest place of V-V, and 200 cd at most 3.4° above: TA 23, 10 lx and 2 lx 10
// m away.
TEST(SampleLamps, ABicyclesIsWithinTa23) {
  const IntensityTable& table = lamp("bicycle.ies").table;
  EXPECT_NEAR(table.intensity_at_cd({0.0, 0.0}), 3000.0, 20.0);
  EXPECT_EQ(table.peak_cd(), table.intensity_at_cd({0.0, 0.0}));
  for (double h = -10.0; h <= 10.0; h += 1.0)
    for (double v = 3.4; v <= 20.0; v += 0.2) EXPECT_LT(table.intensity_at_cd({h, v}), 200.0) << h << " " << v;
}

TEST(SampleLamps, ARightHandBeamFailsTheLeftHandRows) {
  const auto rule = find_rulebook(rules_dir(), "r149-passing-c");
  ASSERT_TRUE(rule.ok()) << rule.error().text();
  const IntensityTable* table[] = {&lamp("low_rht.ies").table};
  CheckOptions options;
  options.traffic = TrafficSide::kLeft;
  EXPECT_GT(check_lamp(table, *rule, options).failed, 2u);
}

TEST(SampleLamps, CutoffIsSharpLevelAndOnItsLine) {
  for (const char* file : {"low_rht.ies", "led_low_rht.ies"}) {
    const IntensityHv as_mounted = mounted_intensity(lamp(file).table, mounted());
    const Cutoff at_line = find_cutoff(as_mounted, -2.5);
    EXPECT_GE(at_line.sharpness_g, 0.20) << file;
    EXPECT_LE(at_line.sharpness_g, 0.40) << file;
    for (const double h : {-1.5, -2.5, -3.5})
      EXPECT_NEAR(find_cutoff(as_mounted, h).elevation_deg, -0.573, 0.02) << file << h;
    // To the right it rises by 15°: tan 15° = 0.268 per degree.
    const IntensityHv level = mounted_intensity(lamp(file).table, glm::dmat3{1.0});
    EXPECT_NEAR(find_cutoff(level, 3.0).elevation_deg, 3.0 * 0.268, 0.06) << file;
  }
  const auto g = [](const char* file) {
    return find_cutoff(mounted_intensity(lamp(file).table, mounted()), -2.5).sharpness_g;
  };
  EXPECT_GT(g("led_low_rht.ies"), g("low_rht.ies"));
}

TEST(SampleLamps, LeftHandIsTheExactMirror) {
  for (const std::string prefix : {"", "led_"}) {
    const IntensityTable& right = lamp(prefix + "low_rht.ies").table;
    const IntensityTable& left = lamp(prefix + "low_lht.ies").table;
    const std::size_t columns = right.first_deg.size();
    ASSERT_EQ(left.candela.size(), right.candela.size());
    for (std::size_t i = 0; i < columns; ++i) {
      ASSERT_EQ(right.first_deg[i], -right.first_deg[columns - 1 - i]);
      for (std::size_t j = 0; j < right.second_deg.size(); ++j) {
        ASSERT_EQ(right.candela[j * columns + i], left.candela[j * columns + columns - 1 - i]);
      }
    }
    EXPECT_DOUBLE_EQ(right.flux_lm(), left.flux_lm());
  }
}

// No bands: along every column and row the intensity rises to one maximum and falls again (rounding aside).
TEST(SampleLamps, HaveNoBands) {
  const auto one_hill = [](const std::vector<double>& line) {
    const auto peak = std::max_element(line.begin(), line.end());
    const auto rising = [](double a, double b) { return b >= a - 2e-4 * a - 0.02; };
    for (auto it = line.begin(); it != peak; ++it) {
      if (!rising(*it, it[1])) return false;
    }
    for (auto it = peak; it + 1 != line.end(); ++it) {
      if (!rising(it[1], *it)) return false;
    }
    return true;
  };
  for (const SampleLamp& l : lamps()) {
    const std::size_t columns = l.table.first_deg.size();
    for (std::size_t i = 0; i < columns; ++i) {
      std::vector<double> column;
      for (std::size_t j = 0; j < l.table.second_deg.size(); ++j) column.push_back(l.table.candela[j * columns + i]);
      EXPECT_TRUE(one_hill(column)) << l.file << " H " << l.table.first_deg[i];
    }
    for (std::size_t j = 0; j < l.table.second_deg.size(); ++j) {
      // Above the flat cut-off a passing beam has two hills: its right shoulder, and the stray light ahead.
      if (l.table.second_deg[j] > 0.0 && l.table.second_deg[j] < 3.0) continue;
      const double* row = l.table.candela.data() + j * columns;
      EXPECT_TRUE(one_hill({row, row + columns})) << l.file << " V " << l.table.second_deg[j];
    }
  }
}

TEST(MatrixSegments, TogetherPassADrivingBeam) {
  const std::vector<SampleLamp> segments = matrix_segments();
  ASSERT_EQ(segments.size(), static_cast<std::size_t>(kMatrixRows * kMatrixColumns));
  std::vector<const IntensityTable*> tables;
  double flux_lm = 0.0;
  for (const SampleLamp& segment : segments) {
    tables.push_back(&segment.table);
    flux_lm += segment.table.flux_lm();
    EXPECT_GT(segment.table.peak_cd(), 500.0) << segment.file;
  }
  const IntensityTable sum = sum_tables(tables);
  EXPECT_NEAR(sum.flux_lm(), flux_lm, 1e-9 * flux_lm);
  for (const IntensityTable* segment : tables) EXPECT_LT(segment->peak_cd(), sum.peak_cd());
  const auto rule = find_rulebook(rules_dir(), "r149-driving-b");
  ASSERT_TRUE(rule.ok()) << rule.error().text();
  const IntensityTable* whole[] = {&sum};
  for (const CheckRow& row : check_lamp(whole, *rule).rows)
    EXPECT_EQ(row.verdict, RuleVerdict::kPass) << row.id << " " << row.lowest;
  // Smooth where segments meet: no ripple along H at V = 0 between the centres.
  for (double h = 0.0; h < 12.0; h += 0.05)
    EXPECT_GE(sum.intensity_at_cd({h, 0.0}), sum.intensity_at_cd({h + 0.05, 0.0}) * (1.0 - 1e-3)) << h;
}

}  // namespace
}  // namespace phare
