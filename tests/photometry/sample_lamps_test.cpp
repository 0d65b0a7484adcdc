// Our sample lamps: as written and read back, against the regulation rows, and smooth to the eye.
#include "visual/photometry/sample_lamps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "photometry_test_files.h"
#include "visual/photometry/beam_image.h"
#include "visual/photometry/regulation.h"

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
    const std::string text = lm63_text(made);
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

TEST(SampleLamps, PassTheirRows) {
  const auto expect = [](const SampleLamp& l, const glm::dmat3& aim, std::span<const RegulationRow> rows,
                         bool mirrored) {
    for (const RowResult& row : check_rows(l.table, aim, rows, mirrored)) {
      EXPECT_TRUE(row.passed) << l.file << " " << row.id << ": " << row.lowest_cd << " to " << row.highest_cd;
    }
  };
  for (const SampleLamp& l : lamps()) {
    switch (l.kind) {
      case SampleKind::kLowRight:
      case SampleKind::kLowLeft:
        expect(l, mounted(), r149_passing_class_c(), l.kind == SampleKind::kLowLeft);
        EXPECT_GE(l.table.flux_lm(), 1000.0);
        break;
      case SampleKind::kHigh:
        for (const glm::dmat3& aim : {glm::dmat3{1.0}, mounted()}) {
          expect(l, aim, r149_driving_class_a(), false);
          expect(l, aim, r149_driving_class_b(), false);
          expect(l, aim, fmvss108_upper_ub2(), false);
        }
        EXPECT_EQ(l.table.peak_cd(), l.table.intensity_at_cd({0.0, 0.0}));
        break;
      case SampleKind::kFog:
        break;
    }
  }
}

TEST(SampleLamps, ARightHandBeamFailsTheLeftHandRows) {
  std::size_t failed = 0;
  for (const RowResult& row : check_rows(lamp("low_rht.ies").table, mounted(), r149_passing_class_c(), true))
    failed += row.passed ? 0 : 1;
  EXPECT_GT(failed, 2u);
}

TEST(SampleLamps, CutoffIsSharpLevelAndOnItsLine) {
  for (const char* file : {"low_rht.ies", "led_low_rht.ies"}) {
    const Cutoff at_line = find_cutoff(lamp(file).table, mounted(), -2.5);
    EXPECT_GE(at_line.sharpness_g, 0.20) << file;
    EXPECT_LE(at_line.sharpness_g, 0.40) << file;
    for (const double h : {-1.5, -2.5, -3.5})
      EXPECT_NEAR(find_cutoff(lamp(file).table, mounted(), h).elevation_deg, -0.57, 0.055) << file << h;
    // To the right it rises by 15°: tan 15° = 0.268 per degree.
    EXPECT_NEAR(find_cutoff(lamp(file).table, glm::dmat3{1.0}, 3.0).elevation_deg, 3.0 * 0.268, 0.06) << file;
  }
  EXPECT_GT(find_cutoff(lamp("led_low_rht.ies").table, mounted(), -2.5).sharpness_g,
            find_cutoff(lamp("low_rht.ies").table, mounted(), -2.5).sharpness_g);
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

/// Compares our rows with a list of the regulation data set; both ways, every limit and every point.
void expect_same_rows(std::span<const RegulationRow> ours, const nlohmann::json& theirs, const char* id_key) {
  EXPECT_EQ(ours.size(), theirs.size());
  for (const auto& row : theirs) {
    const std::string id = row.at(id_key);
    const auto mine = std::find_if(ours.begin(), ours.end(), [&](const RegulationRow& r) { return r.id == id; });
    ASSERT_NE(mine, ours.end()) << id;
    const auto limit = [&](const char* key, double none) {
      return row.contains(key) && !row[key].is_null() ? row[key].get<double>() : none;
    };
    EXPECT_EQ(mine->min_cd, limit("min_cd", kNoMinimum)) << id;
    EXPECT_EQ(mine->max_cd, limit("max_cd", kNoMaximum)) << id;
    EXPECT_EQ(mine->min_of_peak_01, limit("min_fraction_of_Imax", 0.0)) << id;
    EXPECT_EQ(mine->max_of_first, limit("max_factor", 0.0)) << id;
    nlohmann::json points = nlohmann::json::array();
    RowShape shape = RowShape::kPoints;
    if (row.contains("sum_of")) {
      shape = RowShape::kSum;
      points = row["sum_of"];
    } else if (!row.contains("at")) {
      shape = RowShape::kPeak;
    } else if (row["at"].is_array()) {
      points = row["at"];
    } else if (row["at"].contains("line")) {
      shape = RowShape::kLine;
      const auto& line = row["at"]["line"];
      points = {{line[0], line[1]}, {line[2], line[3]}};
    } else if (row["at"].contains("polygon")) {
      shape = RowShape::kPolygon;
      points = row["at"]["polygon"];
    } else {
      shape = RowShape::kBelow;
      EXPECT_EQ(row["at"]["region"], "v<=-4, h in [-4.5,2]");
      points = {{-4.5, -4.0}, {2.0, -4.0}};
    }
    EXPECT_EQ(mine->shape, shape) << id;
    std::vector<std::pair<double, double>> a, b;
    for (const auto& p : points) a.emplace_back(p[0].get<double>(), p[1].get<double>());
    for (const HV& p : mine->at) b.emplace_back(p.h_deg, p.v_deg);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    EXPECT_EQ(a, b) << id;
  }
}

TEST(Regulation, RowsAgreeWithTheDataSet) {
  PHARE_NEEDS_SHARED_DATA("regulation/un_r149_01_headlamps.json");
  nlohmann::json r149, fmvss;
  std::ifstream(test::shared_data("regulation/un_r149_01_headlamps.json")) >> r149;
  std::ifstream(test::shared_data("regulation/fmvss108_headlamps.json")) >> fmvss;
  expect_same_rows(r149_passing_class_c(), r149["passing"]["C"], "id");
  expect_same_rows(r149_driving_class_b(), r149["driving"]["B"], "id");
  expect_same_rows(r149_driving_class_a(), r149["driving"]["A"], "id");
  expect_same_rows(fmvss108_upper_ub2(), fmvss["upper"]["UB2"], "row");
}

// A flat 512 cd everywhere: what passes and fails can be said without a computer.
TEST(Regulation, ChecksAFlatTable) {
  IntensityTable flat;
  flat.first_deg = {-90, 90};
  flat.second_deg = {-90, 90};
  flat.candela.assign(4, 512.0);
  for (const RowResult& row : check_rows(flat, glm::dmat3{1.0}, r149_passing_class_c())) {
    const bool expected = row.id == "Zone III" || row.id == "BR" || row.id == "Segment BLL" || row.id == "P" ||
                          row.id == "Segment 15" || row.id == "Segment 10" || row.id.starts_with("S50+") ||
                          row.id.starts_with("S100+");
    EXPECT_EQ(row.passed, expected) << row.id;
    if (row.id.starts_with("S50+")) {
      EXPECT_NEAR(row.lowest_cd, 1536.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace phare
