// Rulebooks, aim and check: every number of our rule files against the regulation data set, beams of known cut-off,
// rows that pass and fail by hand.
#include "visual/photometry/bench/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "check_helpers.h"
#include "photometry_test_files.h"
#include "tests/paths.h"
#include "visual/photometry/beam/beam_image.h"

namespace phare {
namespace {

using test::check, test::row_of, test::rule;

IntensityTable flat(double cd) {
  IntensityTable table;
  table.first_deg = {-90, 90};
  table.second_deg = {-90, 90};
  table.candela.assign(4, cd);
  return table;
}

/// A beam whose log E falls by a logistic step at `line(h)`: G and the inflection are known in closed form.
IntensityTable stepped(double step_deg, double line_v_deg, double rise_right, double node_deg = 0.02) {
  IntensityTable table;
  for (double h = -10; h <= 10.001; h += 0.25) table.first_deg.push_back(h);
  for (double v = -6; v <= 4.0001; v += node_deg) table.second_deg.push_back(v);
  for (const double v : table.second_deg) {
    for (const double h : table.first_deg) {
      const double line = line_v_deg + (h > 0 ? rise_right * h : 0.0);
      table.candela.push_back(200.0 * std::pow(60.0, 1.0 / (1.0 + std::exp((v - line) / step_deg))));
    }
  }
  return table;
}

TEST(Rulebook, EveryFileReadsAndNamesItsSources) {
  const auto rules = read_rulebooks(rules_dir());
  ASSERT_TRUE(rules.ok()) << rules.error().text();
  EXPECT_GE(rules->size(), 25u);
  for (const Rulebook& r : *rules) {
    EXPECT_FALSE(r.rows.empty()) << r.id;
    // A number that only one source gives says so.
    for (const RuleRow& row : r.rows)
      EXPECT_TRUE(r.sources.size() > 1 || !row.unconfirmed.empty()) << r.id << " " << row.id;
  }
  EXPECT_EQ(rule("R149 Class C").id, "r149-passing-c");
  EXPECT_EQ(rule("LB2V").id, "fmvss108-lb2v");
  EXPECT_NE(find_rulebook(rules_dir(), "r149-passing-d").error().text().find("did you mean"), std::string::npos);
}

TEST(Rulebook, RefusalsSayWhereAndWhy) {
  const auto reason = [](const std::string& text) {
    const auto read = read_rulebook(test::temporary_file("rule.toml", text));
    return read.ok() ? "read" : read.error().text().substr(read.error().text().find("rule.toml"));
  };
  const std::string head = "name = \"n\"\ndocument = \"d\"\nclause = \"1\"\nsources = [\"s\"]\nfunction = \"low\"\n";
  EXPECT_EQ(reason(head), "rule.toml:1: \"name\": a rulebook needs at least one [[row]]");
  EXPECT_EQ(reason(head + "[[row]]\nid = \"a\"\nat_deg = [1.0]\nmin_cd = 1.0\n"),
            "rule.toml:8: \"row.at_deg\": expected pairs of H and V in degrees");
  EXPECT_EQ(reason(head + "[[row]]\nid = \"a\"\nat_deg = [1.0, 2.0]\n"),
            "rule.toml:7: \"row.id\": a row needs a limit");
  EXPECT_EQ(reason(head + "[[row]]\nid = \"a\"\nmin_cd = 1.0\n"),
            "rule.toml:7: \"row.id\": a row has one of at_deg, line_deg, area_deg, polygon_deg, sum_deg, peak");
}

/// Compares a rulebook with a list of the regulation data set; every limit and every point.
void expect_same_rows(const Rulebook& ours, const nlohmann::json& theirs, const char* id_key) {
  EXPECT_EQ(ours.rows.size(), theirs.size()) << ours.id;
  for (const auto& row : theirs) {
    const std::string id = row.at(id_key);
    const RuleRow* mine = ours.row(id);
    ASSERT_NE(mine, nullptr) << ours.id << " " << id;
    const auto limit = [&](const char* key, double none) {
      return row.contains(key) && !row[key].is_null() ? row[key].get<double>() : none;
    };
    EXPECT_EQ(mine->min_cd, limit("min_cd", kNoMinimum)) << id;
    EXPECT_EQ(mine->max_cd, limit("max_cd", kNoMaximum)) << id;
    EXPECT_EQ(mine->min_of_peak_01, limit("min_fraction_of_Imax", 0.0)) << id;
    EXPECT_EQ(mine->max_factor, limit("max_factor", 0.0)) << id;
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
    } else if (row["at"].contains("zone")) {
      shape = RowShape::kArea;
      const auto& zone = row["at"]["zone"];
      points = {{zone[0], zone[1]}, {zone[2], zone[3]}};
    } else if (row["at"].contains("polygon")) {
      shape = RowShape::kPolygon;
      points = row["at"]["polygon"];
    } else {
      shape = RowShape::kArea;
      EXPECT_EQ(row["at"]["region"], "v<=-4, h in [-4.5,2]");
      points = {{-4.5, -90.0}, {2.0, -4.0}};
    }
    EXPECT_EQ(mine->shape, shape) << id;
    std::vector<std::pair<double, double>> a, b;
    for (const auto& p : points) a.emplace_back(p[0].get<double>(), p[1].get<double>());
    for (const HV& p : mine->at) b.emplace_back(p.h_deg, p.v_deg);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    EXPECT_EQ(a, b) << ours.id << " " << id;
  }
}

TEST(Rulebook, RowsAgreeWithTheDataSet) {
  PHARE_NEEDS_SHARED_DATA("regulation/un_r149_01_headlamps.json");
  nlohmann::json r149, fmvss;
  std::ifstream(test::shared_data("regulation/un_r149_01_headlamps.json")) >> r149;
  std::ifstream(test::shared_data("regulation/fmvss108_headlamps.json")) >> fmvss;
  expect_same_rows(rule("r149-passing-c"), r149["passing"]["C"], "id");
  expect_same_rows(rule("r149-passing-v"), r149["passing"]["V"], "id");
  expect_same_rows(rule("r149-driving-b"), r149["driving"]["B"], "id");
  expect_same_rows(rule("r149-driving-a"), r149["driving"]["A"], "id");
  for (const char* beam : {"upper", "lower"}) {
    for (const auto& [column, rows] : fmvss[beam].items()) expect_same_rows(rule(column), rows, "row");
  }
}

// G of a logistic step in log I: log10(60)·0.1°/(4·s) to first order, and the inflection on the line.
TEST(Cutoff, SharpnessAndPlaceOfAKnownStep) {
  for (const double s : {0.10, 0.135, 0.2}) {
    for (const double line : {-0.57, 0.0, 0.333}) {
      const IntensityTable table = stepped(s, line, 0.0);
      const Cutoff cutoff = find_cutoff(mounted_intensity(table, glm::dmat3{1.0}), -2.5);
      ASSERT_TRUE(cutoff.found);
      const auto share = [s](double x) { return 1.0 / (1.0 + std::exp(x / s)); };
      const double expected = std::log10(60.0) * (share(-0.05) - share(0.05));
      EXPECT_NEAR(cutoff.sharpness_g, expected, 0.006) << s << " " << line;  // 0.05° steps may straddle the line
      EXPECT_NEAR(cutoff.elevation_deg, line, 0.012) << s << " " << line;
    }
  }
  EXPECT_FALSE(find_cutoff(mounted_intensity(flat(500), glm::dmat3{1.0}), -2.5).found);
}

TEST(Cutoff, ShapeTellsTheSide) {
  const double rise = std::tan(glm::radians(15.0));
  const IntensityTable right = stepped(0.135, 0.1, rise);
  const CutoffShape shape = cutoff_shape(mounted_intensity(right, glm::dmat3{1.0}));
  EXPECT_EQ(shape.side, CutoffSide::kRisesRight);
  EXPECT_NEAR(shape.rise_deg, 15.0, 0.5);
  EXPECT_NEAR(shape.flat_v_deg, 0.1, 0.01);
  EXPECT_NEAR(shape.kink_h_deg, 0.0, 0.1);
  IntensityTable left = right;
  for (std::size_t j = 0; j < left.second_deg.size(); ++j) {
    const auto row = left.candela.begin() + static_cast<std::ptrdiff_t>(j * left.first_deg.size());
    std::reverse(row, row + static_cast<std::ptrdiff_t>(left.first_deg.size()));
  }
  EXPECT_EQ(cutoff_shape(mounted_intensity(left, glm::dmat3{1.0})).side, CutoffSide::kRisesLeft);
  EXPECT_EQ(cutoff_shape(mounted_intensity(stepped(0.135, 0, 0), glm::dmat3{1.0})).side, CutoffSide::kFlat);
  EXPECT_EQ(cutoff_shape(mounted_intensity(flat(500), glm::dmat3{1.0})).side, CutoffSide::kNone);
}

TEST(Check, AimPutsTheInflectionOnTheLine) {
  for (const double line : {-1.2, 0.0, 0.8}) {
    const CheckResult result = check(stepped(0.135, line, std::tan(glm::radians(15.0))), rule("r149-passing-c"));
    EXPECT_EQ(result.aim_method, "cut-off");
    EXPECT_NEAR(result.aim_up_deg, -0.57 - line, 0.02);
    EXPECT_NEAR(result.cutoff.elevation_deg, -0.57, 0.006);  // a third of the table's rows
    EXPECT_FALSE(result.left_hand);
  }
  CheckOptions given;
  given.aim = HV{0.1, -0.2};
  const CheckResult result = check(stepped(0.135, 0.0, 0.0), rule("r149-passing-c"), given);
  EXPECT_EQ(result.aim_method, "given");
  EXPECT_EQ(result.aim_up_deg, -0.2);
}

// A flat 512 cd everywhere: what passes and fails can be said without a computer.
TEST(Check, AFlatTable) {
  const CheckResult result = check(flat(512.0), rule("r149-passing-c"));
  for (const CheckRow& row : result.rows) {
    const bool expected = row.id == "Zone III" || row.id == "BR" || row.id == "Segment BLL" || row.id == "P" ||
                          row.id == "Segment 15" || row.id == "Segment 10" || row.id.starts_with("S50+") ||
                          row.id.starts_with("S100+") || row.id == "luminous flux";
    EXPECT_EQ(row.verdict == RuleVerdict::kPass, expected) << row.id;
    if (row.id.starts_with("S50+")) {
      EXPECT_NEAR(row.lowest, 1536.0, 1e-9);
      EXPECT_NEAR(row.margin, 1346.0, 1e-9);
    }
    if (row.id == "Segment 10 and below") {
      EXPECT_NEAR(row.max, 0.8 * 512.0, 1e-9);
    }
  }
  EXPECT_EQ(result.verdict, RuleVerdict::kFail);
}

// A single bright node inside zone III must be found, however fine.
TEST(Check, AreasFindEveryNode) {
  IntensityTable table;
  for (double h = -10; h <= 10.001; h += 0.1) table.first_deg.push_back(h);
  for (double v = -6; v <= 6.001; v += 0.1) table.second_deg.push_back(v);
  table.candela.assign(table.first_deg.size() * table.second_deg.size(), 100.0);
  table.candela[83 * table.first_deg.size() + 57] = 626.0;  // V 2.3, H -4.3
  CheckOptions as_filed;
  as_filed.aim = HV{0.0, 0.0};
  const CheckRow row = row_of(check(table, rule("r149-passing-c"), as_filed), "Zone III");
  EXPECT_NEAR(row.highest, 626.0, 1e-6);
  EXPECT_NEAR(row.highest_at.h_deg, -4.3, 1e-6);
  EXPECT_NEAR(row.highest_at.v_deg, 2.3, 1e-6);
  EXPECT_NEAR(row.margin, -1.0, 1e-6);
}

TEST(Check, WithinResolutionIsNeitherPassNorFail) {
  IntensityTable table = flat(350.5);
  table.header.smallest_step_cd = 10.0;  // written in tens: 350.5 may be 345.5 to 355.5
  CheckOptions as_filed;
  as_filed.aim = HV{0.0, 0.0};
  const CheckRow row = row_of(check(table, rule("r149-passing-c"), as_filed), "B50L");
  EXPECT_EQ(row.verdict, RuleVerdict::kWithinResolution);
  EXPECT_NEAR(row.margin, -0.5, 1e-9);
  EXPECT_NEAR(row.resolution, 5.0, 1e-9);
}

TEST(Check, InterpolationErrorBoundsAParabola) {
  IntensityTable table;
  const auto f = [](double h) { return 1000.0 - 3.0 * h * h; };
  for (double h = -5; h <= 5; h += 1) table.first_deg.push_back(h);
  table.second_deg = {-1, 1};
  for (int row = 0; row < 2; ++row) {
    for (const double h : table.first_deg) table.candela.push_back(f(h));
  }
  for (double h = -4.5; h <= 4.5; h += 0.1) {
    const double error = std::abs(table.intensity_at_cd({h, 0.3}) - f(h));
    EXPECT_NEAR(interpolation_error_cd(table, {h, 0.3}), error, 1e-9) << h;  // a parabola meets the bound exactly
  }
}

TEST(Check, HalfTheSumOfBothSides) {
  const IntensityTable a = flat(400.0), b = flat(100.0);
  const IntensityTable* both[] = {&a, &b};
  CheckOptions as_filed;
  as_filed.aim = HV{0.0, 0.0};
  const CheckResult result = check_lamp(both, rule("r123-passing-c"), as_filed);
  EXPECT_NEAR(row_of(result, "B50L").highest, 250.0, 1e-9);
  EXPECT_EQ(row_of(result, "B50L").verdict, RuleVerdict::kPass);
}

// A beam filed half a degree to the right passes only with R112's horizontal allowance.
TEST(Check, ReaimAllowanceIsUsedAndReported) {
  const IntensityTable table = stepped(0.135, 0.0, std::tan(glm::radians(15.0)));
  Rulebook small = rule("r112-passing-b");
  small.rows = {{.id = "a", .clause = "", .at = {{0.6, -0.25}}, .min_cd = 2000.0, .max_of = "", .unconfirmed = ""}};
  const CheckResult fixed = check(table, small, {.traffic = TrafficSide::kRight, .aim = {}, .reaim = false});
  EXPECT_EQ(row_of(fixed, "a").verdict, RuleVerdict::kFail) << row_of(fixed, "a").lowest;
  const CheckResult turned = check(table, small, {.traffic = TrafficSide::kRight, .aim = {}, .reaim = true});
  EXPECT_TRUE(turned.reaimed);
  EXPECT_NE(row_of(turned, "a").verdict, RuleVerdict::kFail) << row_of(turned, "a").lowest;
  EXPECT_LE(std::abs(turned.aim_right_deg), 0.75 + 1e-9);
}

// FMVSS 108: a point may be looked at a quarter degree beside.
TEST(Check, QuarterDegreeForEachPoint) {
  IntensityTable table;
  for (double h = -5; h <= 5.001; h += 0.05) table.first_deg.push_back(h);
  table.second_deg = {-5, 5};
  for (int row = 0; row < 2; ++row) {
    for (const double h : table.first_deg) table.candela.push_back(1000.0 + 100.0 * h);
  }
  Rulebook small = rule("fmvss108-ub2");
  small.rows = {{.id = "in reach", .clause = "", .at = {{0.0, 0.0}}, .min_cd = 1020.0, .max_of = "", .unconfirmed = ""},
                {.id = "too far", .clause = "", .at = {{0.0, 0.0}}, .min_cd = 1030.0, .max_of = "", .unconfirmed = ""}};
  const CheckResult result = check(table, small);
  EXPECT_EQ(row_of(result, "in reach").verdict, RuleVerdict::kPass);
  EXPECT_NEAR(row_of(result, "in reach").reaim.h_deg, -0.25, 0.1);
  EXPECT_EQ(row_of(result, "too far").verdict, RuleVerdict::kFail);
}

}  // namespace
}  // namespace phare
