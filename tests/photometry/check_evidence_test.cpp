// What a check may claim: nothing where the table has no data, nothing finer than its rows, no cut-off where there is
// none; each lamp of a pair by its own aim.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "check_helpers.h"
#include "visual/photometry/bench/check.h"
#include "visual/photometry/bench/check_rows.h"
#include "visual/photometry/bench/lint.h"
#include "visual/photometry/bench/rule_beam.h"
#include "visual/photometry/bench/sample_lamps.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/table/combine.h"

namespace phare {
namespace {

const IntensityTable& sample_table(const std::string& file) {
  static const std::vector<SampleLamp> all = sample_lamps();
  return std::find_if(all.begin(), all.end(), [&](const SampleLamp& l) { return l.file == file; })->table;
}

using test::row_of, test::rule;

CheckResult check_by(const IntensityTable& table, const std::string& name, const CheckOptions& options = {}) {
  return test::check(table, rule(name), options);
}

// On a ridge between two steps of the walk: 1000 cd/deg to both sides of H 0.011.
TEST(CheckEvidence, TheExtremeOfALineLiesBetweenItsSteps) {
  IntensityTable ridge;
  ridge.type = PhotometricType::kA;
  ridge.first_deg = {-10.0, 0.011, 10.0};
  ridge.second_deg = {-5.0, 5.0};
  ridge.candela = {0.0, 10000.0, 0.0, 0.0, 10000.0, 0.0};
  const IntensityTable* tables[] = {&ridge};
  RuleBeam beam(tables, false);
  RuleRow line;
  line.id = "line";
  line.shape = RowShape::kLine;
  line.at = {{-1.0, 0.0}, {1.0, 0.0}};
  line.max_cd = 9999.0;
  const CheckRow row = judge_row(beam, rule("r112-passing-b"), line, {}, false);
  EXPECT_NEAR(row.highest, 10000.0, 0.2);
  EXPECT_LT(row.margin, 0.0);
  EXPECT_NEAR(row.highest_at.h_deg, 0.011, 2.1e-4);
}

/// The part of a type A table between these angles; the rest cut off, or kept as zeros.
IntensityTable cropped(const IntensityTable& table, double h_deg, double low_v_deg, double high_v_deg,
                       bool zeros_outside = false) {
  IntensityTable part = table;
  part.first_deg.clear();
  part.second_deg.clear();
  part.candela.clear();
  for (std::size_t j = 0; j < table.second_deg.size(); ++j) {
    const double v = table.second_deg[j];
    const bool v_in = v >= low_v_deg - 1e-9 && v <= high_v_deg + 1e-9;
    if (!v_in && !zeros_outside) continue;
    part.second_deg.push_back(v);
    for (std::size_t i = 0; i < table.first_deg.size(); ++i) {
      const double h = table.first_deg[i];
      const bool in = v_in && std::abs(h) <= h_deg + 1e-9;
      if (!in && !zeros_outside) continue;
      if (part.second_deg.size() == 1) part.first_deg.push_back(h);
      part.candela.push_back(in ? table.candela[j * table.first_deg.size() + i] : 0.0);
    }
  }
  return part;
}

/// The same beam filed `up_deg` higher; exact, because every node moves.
IntensityTable filed_higher(IntensityTable table, double up_deg) {
  for (double& v : table.second_deg) v += up_deg;
  // Nodes beyond the pole are no directions; the rows there are dark in our lamps.
  while (table.second_deg.back() > 90.0) {
    table.second_deg.pop_back();
    table.candela.resize(table.candela.size() - table.first_deg.size());
  }
  return table;
}

/// log10 E falls by a logistic step of steepness s at V = 0: G = log10(ratio)·0.1/(4 s), on rows `row_deg` apart that
/// lie half a row beside the step.
IntensityTable logistic_beam(double g, double row_deg) {
  constexpr double kRatio = 40.0;
  const double s = std::log10(kRatio) * 0.1 / (4.0 * g);
  IntensityTable table;
  table.first_deg = {-90, 90};
  for (double v = -6.0 + 0.5 * row_deg; v <= 5.0; v += row_deg) table.second_deg.push_back(v);
  for (const double v : table.second_deg)
    table.candela.insert(table.candela.end(), 2, 200.0 * std::pow(kRatio, 1.0 / (1.0 + std::exp(v / s))));
  return table;
}

TEST(CheckEvidence, NothingPassesWhereTheTableHasNoData) {
  const IntensityTable part = cropped(sample_table("low_rht.ies"), 9.6, -4.8, 0.8);
  const CheckResult r112 = check_by(part, "r112-passing-b");
  for (const char* id : {"B50L", "BR", "Zone III", "P1+P2+P3", "P4+P5+P6"}) {
    EXPECT_EQ(row_of(r112, id).verdict, RuleVerdict::kNoData) << id;
    EXPECT_FALSE(id == std::string("B50L") && row_of(r112, id).has_value);
  }
  EXPECT_EQ(row_of(r112, "75R").verdict, RuleVerdict::kPass);
  EXPECT_EQ(r112.verdict, RuleVerdict::kNoData);
  EXPECT_EQ(r112.no_data, 5u);
  const CheckResult r149 = check_by(part, "r149-passing-c");
  for (const char* id : {"Segment BLL", "B50L", "Segment 15", "Segment 25L"})
    EXPECT_EQ(row_of(r149, id).verdict, RuleVerdict::kNoData) << id;
  // Without a printed end: as far as there are data, which have to hold where it begins.
  EXPECT_EQ(row_of(r149, "Segment 10 and below").verdict, RuleVerdict::kPass);
  const IntensityTable shallow = cropped(sample_table("low_rht.ies"), 9.6, -3.0, 0.8);
  EXPECT_EQ(row_of(check_by(shallow, "r149-passing-c"), "Segment 10 and below").verdict, RuleVerdict::kNoData);
  EXPECT_EQ(row_of(r149, "luminous flux").verdict, RuleVerdict::kNoData);  // light outside can only add
  // So can other light: the clause takes flux in two zones in its place, which is not checked.
  IntensityTable dim = sample_table("low_rht.ies");
  for (double& cd : dim.candela) cd *= 0.3;
  const CheckRow flux = row_of(check_by(dim, "r149-passing-c"), "luminous flux");
  EXPECT_LT(flux.value(), 1000.0);
  EXPECT_EQ(flux.verdict, RuleVerdict::kNoData);
  EXPECT_NE(flux.open.find("400 lm in zone I"), std::string::npos);
  EXPECT_EQ(check_by(part, "fmvss108-lb2v").failed, 0u);
  for (const char* id : {"Points 1, 2", "Points 8, 9"})
    EXPECT_EQ(row_of(check_by(cropped(sample_table("fog.ies"), 20.0, -10.0, 10.0), "r19-f3"), id).verdict,
              RuleVerdict::kNoData);
  // What is there and too bright fails, whatever is missing beside it.
  IntensityTable bright = part;
  for (double& cd : bright.candela) cd *= 20.0;
  EXPECT_EQ(row_of(check_by(bright, "r149-passing-c"), "Zone III").verdict, RuleVerdict::kFail);
}

// A table to ±90° knows all that a lamp can throw ahead, turned or not.
TEST(CheckEvidence, AWholeTableLacksNothing) {
  for (const char* id : {"r112-passing-b", "r149-passing-c", "fmvss108-lb2v", "fmvss108-lb1m", "r123-passing-c"})
    EXPECT_EQ(check_by(sample_table("low_rht.ies"), id).no_data, 0u) << id;
  EXPECT_EQ(check_by(sample_table("high.ies"), "fmvss108-ub2").no_data, 0u);
  EXPECT_EQ(check_by(sample_table("fog.ies"), "r19-f3").no_data, 0u);
}

TEST(CheckEvidence, TheEndOfATableIsNoCutoff) {
  const IntensityTable& whole = sample_table("low_rht.ies");
  const CheckResult truth = check_by(whole, "r149-passing-c");
  for (const bool zeros : {false, true}) {  // the file ends at 0.3° up, or goes on with zeros
    const IntensityTable part = cropped(whole, 90.0, -90.0, 0.3, zeros);
    const CheckResult result = check_by(part, "r149-passing-c");
    EXPECT_EQ(result.aim_method, "cut-off");
    EXPECT_NEAR(result.aim_up_deg, truth.aim_up_deg, 1e-9) << zeros;
    EXPECT_NEAR(result.cutoff.sharpness_g, truth.cutoff.sharpness_g, 1e-9) << zeros;
    EXPECT_NEAR(row_of(result, "75R").lowest, row_of(truth, "75R").lowest, 1e-9) << zeros;
  }
  EXPECT_EQ(lint_lamp(cropped(whole, 90.0, -90.0, 1.2)).cutoff.side, CutoffSide::kRisesRight);
  const LampReport flat = lint_lamp(cropped(whole, 90.0, -90.0, 0.3));
  EXPECT_TRUE(std::any_of(flat.findings.begin(), flat.findings.end(),
                          [](const Finding& f) { return f.text.find("a kink cannot be told") != std::string::npos; }));
  EXPECT_EQ(check_by(cropped(whole, 9.5, -4.8, 0.8), "fmvss108-lb2v").aim_method, "VOL");
  // Ends in the middle of the fall: the steepest place may lie outside.
  const CheckResult open = check_by(cropped(whole, 90.0, -90.0, 0.0), "r149-passing-c");
  EXPECT_EQ(open.aim_method, "no cut-off found, as filed");
  EXPECT_EQ(open.aim_up_deg, 0.0);
  EXPECT_TRUE(open.cutoff.at_edge);
  EXPECT_EQ(row_of(open, "cut-off sharpness G").verdict, RuleVerdict::kNoData);
  EXPECT_EQ(row_of(open, "cut-off linearity").verdict, RuleVerdict::kNoData);
}

// A ray-traced beam whose light ends in true zeros from one row to the next has its cut-off there.
TEST(CheckEvidence, AStepToZeroIsACutoffWhereThereIsNoOther) {
  IntensityTable table;
  table.first_deg = {-20, 20};
  for (double v = -6.0; v <= 4.001; v += 0.05) table.second_deg.push_back(v);
  for (const double v : table.second_deg)
    table.candela.insert(table.candela.end(), 2, v < 0.001 ? 8000.0 + 900.0 * v : 0.0);
  const Cutoff cutoff = find_cutoff(mounted_intensity(table, glm::dmat3{1.0}), -2.5);
  ASSERT_TRUE(cutoff.found);
  EXPECT_NEAR(cutoff.elevation_deg, 0.025, 0.1);  // in the row of the step, to the width of G's span
  EXPECT_GT(cutoff.sharpness_g, 1.0);
}

TEST(CheckEvidence, SharpnessIsToldNoFinerThanTheRows) {
  // G 0.573 on rows of 0.05°: fails for certain. On 0.5°: cannot be told. G 0.2: on 0.05° passes for certain.
  const CheckRow sharp = row_of(check_by(logistic_beam(0.573, 0.05), "r112-passing-b"), "cut-off sharpness G");
  EXPECT_NEAR(sharp.lowest, 0.573, sharp.resolution + 0.01);
  EXPECT_EQ(sharp.verdict, RuleVerdict::kFail);
  const CheckResult coarse = check_by(logistic_beam(0.573, 0.5), "r112-passing-b");
  const CheckRow blurred = row_of(coarse, "cut-off sharpness G");
  EXPECT_EQ(blurred.verdict, RuleVerdict::kWithinResolution) << blurred.lowest;
  EXPECT_GE(blurred.lowest + blurred.resolution, 0.55);  // the true G, less what 0.1° of finite span costs it
  EXPECT_EQ(row_of(coarse, "cut-off linearity").verdict, RuleVerdict::kWithinResolution);
  EXPECT_NEAR(coarse.lamps.front().row_step_deg, 0.5, 0.01);
  const CheckResult fine = check_by(logistic_beam(0.2, 0.05), "r112-passing-b");
  EXPECT_EQ(row_of(fine, "cut-off sharpness G").verdict, RuleVerdict::kPass);
  EXPECT_LT(row_of(fine, "cut-off sharpness G").resolution, 0.03);
  EXPECT_EQ(row_of(fine, "cut-off linearity").verdict, RuleVerdict::kPass);
  // FMVSS 108 asks for no upper limit: rows of 0.25° are enough to say that G is above 0.13.
  EXPECT_EQ(row_of(check_by(logistic_beam(0.4, 0.25), "fmvss108-lb2v"), "cut-off sharpness G").verdict,
            RuleVerdict::kPass);
}

// The range told of a coarse table holds the G of the beam it was made of.
TEST(CheckEvidence, SharpnessRangeHoldsTheTruth) {
  for (const double g : {0.15, 0.274, 0.4, 0.573}) {
    for (const double rows : {0.02, 0.05, 0.1, 0.25, 0.5}) {
      const IntensityTable fine = logistic_beam(g, 0.005), table = logistic_beam(g, rows);
      const double truth = find_cutoff(mounted_intensity(fine, glm::dmat3{1.0}), -2.5).sharpness_g;
      const IntensityTable* tables[] = {&table};
      const RuleBeam beam(tables, false);
      const Cutoff cutoff = find_cutoff(beam.intensity(), -2.5);
      ASSERT_TRUE(cutoff.found) << g << " " << rows;
      const RuleBeam::SharpnessRange range = beam.sharpness_range(0, -2.5, cutoff);
      EXPECT_LE(range.lowest_g, truth + 0.01) << g << " " << rows;  // 0.05° steps may straddle the steepest place
      EXPECT_GE(range.highest_g, truth - 0.01) << g << " " << rows;
      EXPECT_NEAR(range.row_step_deg, rows, 1e-4) << g << " " << rows;
    }
  }
}

/// As a goniometer with rows `step` apart would file it to `reach` up and down, the first one `phase` of a step higher.
IntensityTable on_rows(const IntensityTable& whole, double step_deg, double phase_01, double reach_deg) {
  IntensityTable coarse = whole;
  coarse.second_deg.clear();
  coarse.candela.clear();
  for (double v = -reach_deg + step_deg * phase_01; v <= reach_deg; v += step_deg) coarse.second_deg.push_back(v);
  for (const double v : coarse.second_deg) {
    for (const double h : whole.first_deg) coarse.candela.push_back(whole.intensity_at_cd({h, v}));
  }
  return coarse;
}

// Inflections of beams whose own is known, from rows of any width and phase: within what the check tells.
TEST(CheckEvidence, CoarseRowsTellTheAim) {
  const IntensityTable logistic = logistic_beam(0.573, 0.005);
  const struct {
    const IntensityTable* table;
    double truth_deg;
  } beams[] = {{&sample_table("low_rht.ies"), -0.0060},  // of the formula, by a search in 1e-4 apart from this program
               {&sample_table("led_low_rht.ies"), -0.0046},
               {&logistic, 0.0}};
  for (const auto& [whole, truth_deg] : beams) {
    for (const double step : {0.05, 0.1, 0.15, 0.2, 0.25, 0.5, 1.0}) {
      for (const double phase : {0.0, 0.15, 0.3, 0.5, 0.7, 0.85}) {
        const IntensityTable table = on_rows(*whole, step, phase, 6.0);
        const Cutoff cutoff = find_cutoff(mounted_intensity(table, glm::dmat3{1.0}), -2.5);
        ASSERT_TRUE(cutoff.found);
        const double told_deg = step > 0.11 ? 0.01 + 0.35 * step : 0.01;
        EXPECT_NEAR(cutoff.elevation_deg, truth_deg, told_deg) << step << " " << phase;
        if (phase == 0.3 && (step == 0.05 || step == 0.25)) {
          const LampAim aim = check_by(table, "r149-driving-b").lamps.front();  // no cut-off asked: nothing told
          EXPECT_EQ(aim.resolution_deg, 0.0);
          EXPECT_NEAR(check_by(table, "fmvss108-lb2v").lamps.front().resolution_deg, told_deg, 1e-3) << step;
        }
      }
    }
  }
}

// Scans in steps of 0.01° fall on rows of 0.05° to the last bit: none of them may be missed.
TEST(CheckEvidence, NoRowIsMissed) {
  const IntensityHv intensity = mounted_intensity(sample_table("low_rht.ies"), glm::dmat3{1.0});
  for (const double from : {-4.0, -3.99, -3.95, -2.0, -1.0 / 3.0})
    EXPECT_NEAR(find_cutoff(intensity, -2.5, from).elevation_deg, -0.0060, 0.001) << from;
}

// No row may pass or fail that does otherwise in truth, and values lie within the resolution told. On rows of 1°, of
// which the linter warns, a cut-off falls between two rows: there 6 of 225 values lie outside, and one of the verdicts
// (FMVSS LB2V, 0.86 D 3.5 L) is wrong.
TEST(CheckEvidence, CoarseRowsNeverPassOrFailAgainstTheTruth) {
  std::size_t told = 0, all = 0;
  CheckOptions options;
  options.reaim = false;
  const char* const rules[] = {"r112-passing-b", "r149-passing-c", "r123-passing-e", "fmvss108-lb2v"};
  std::vector<CheckResult> truths;
  for (const char* id : rules) truths.push_back(check_by(sample_table("low_rht.ies"), id, options));
  for (const double step : {0.1, 0.2, 0.25, 0.5}) {
    for (const double phase : {0.3, 0.7}) {
      const IntensityTable table = on_rows(sample_table("low_rht.ies"), step, phase, 20.0);
      for (std::size_t k = 0; k < truths.size(); ++k) {
        const char* const id = rules[k];
        const CheckResult& truth = truths[k];
        const CheckResult result = check_by(table, id, options);
        for (const CheckRow& row : result.rows) {
          const CheckRow& true_row = row_of(truth, row.id);
          std::ostringstream what;
          what << id << ", rows " << step << ", phase " << phase << ", " << row.id << ": " << row.value() << " +- "
               << row.resolution << ", true " << true_row.value();
          if (row.unit == "cd" && row.has_value && row.by_min == true_row.by_min) {
            EXPECT_LE(std::abs(row.value() - true_row.value()), row.resolution + true_row.resolution) << what.str();
          }
          ++all;
          if (row.verdict != RuleVerdict::kPass && row.verdict != RuleVerdict::kFail) continue;
          ++told;
          EXPECT_TRUE(true_row.verdict == row.verdict || true_row.verdict == RuleVerdict::kWithinResolution)
              << what.str();
        }
      }
    }
  }
  EXPECT_GT(told, all / 2);  // and yet most are told
  std::printf("%zu of %zu verdicts told\n", told, all);
}

TEST(CheckEvidence, WithoutACutoffTheAimAndTheLinearitySaySo) {
  const CheckResult result = check_by(sample_table("high.ies"), "r112-passing-b");
  EXPECT_EQ(result.aim_method, "no cut-off found, as filed");
  EXPECT_EQ(result.aim_up_deg, 0.0);
  EXPECT_EQ(row_of(result, "cut-off sharpness G").verdict, RuleVerdict::kFail);
  EXPECT_EQ(row_of(result, "cut-off linearity").verdict, RuleVerdict::kFail);
  EXPECT_FALSE(row_of(result, "cut-off linearity").has_value);
}

TEST(CheckEvidence, EachLampOfAPairIsAimedByItself) {
  const IntensityTable& left = sample_table("low_rht.ies");
  const IntensityTable right = filed_higher(left, 1.0);
  const IntensityTable *pair[] = {&left, &right}, *alone[] = {&left};
  const Rulebook r123 = rule("r123-passing-c");
  const CheckResult both = check_lamp(pair, r123), one = check_lamp(alone, r123);
  ASSERT_EQ(both.lamps.size(), 2u);
  EXPECT_NEAR(both.lamps[1].up_deg, both.lamps[0].up_deg - 1.0, 0.003);  // the aim's own tolerance
  for (const CheckRow& row : one.rows) {
    if (row.unit != "cd") continue;
    // The table turned by 1.57° is not the table turned by 0.57°: type A nodes move by cos V, below 1e-3 here.
    EXPECT_NEAR(row_of(both, row.id).value(), row.value(), 0.01 * row.value() + 1.0) << row.id;
    EXPECT_EQ(row_of(both, row.id).verdict, row.verdict) << row.id;
  }
  EXPECT_EQ(row_of(both, "cut-off sharpness G, right lamp").verdict, RuleVerdict::kPass);
  const IntensityTable* mixed[] = {&left, &sample_table("low_lht.ies")};
  EXPECT_FALSE(same_traffic(mixed).ok());
  EXPECT_TRUE(same_traffic(pair).ok());
}

TEST(CheckEvidence, OurFogLampPassesAimedByItsCutoff) {
  const CheckResult result = check_by(sample_table("fog.ies"), "r19-f3");
  EXPECT_EQ(result.aim_method, "cut-off");
  EXPECT_FALSE(result.aim_unconfirmed.empty());
  EXPECT_NEAR(result.cutoff.elevation_deg, -1.0, 0.006);
  EXPECT_EQ(result.failed, 0u);
}

// FMVSS 108 S14.2.5.5: each test point is re-aimed by itself, here each towards the middle.
TEST(CheckEvidence, PointsOfOneRowAreReaimedOneByOne) {
  IntensityTable table;
  for (double h = -20.0; h <= 20.001; h += 0.05) table.first_deg.push_back(h);
  table.second_deg = {-90, 90};
  for (int row = 0; row < 2; ++row) {
    for (const double h : table.first_deg) table.candela.push_back(1490.0 + 256.0 * (12.0 - std::abs(h)));
  }
  const IntensityTable* tables[] = {&table};
  Rulebook ub2 = rule("fmvss108-ub2");
  std::erase_if(ub2.rows, [](const RuleRow& r) { return r.id != "H 12L & 12R"; });
  const CheckRow row = check_lamp(tables, ub2).rows.front();
  EXPECT_EQ(row.verdict, RuleVerdict::kPass) << row.lowest;
  ASSERT_EQ(row.reaims.size(), 2u);
  EXPECT_LT(row.reaims[0].h_deg, 0.0);  // beam turned left: the left point sees what lies right of it
  EXPECT_GT(row.reaims[1].h_deg, 0.0);
  // Known to 20 cd only: turned on until 1500 cd are certain.
  EXPECT_LT(std::abs(row.reaims[0].h_deg), 0.1);
  table.header.smallest_step_cd = 40.0;
  const CheckRow rounded = check_lamp(tables, ub2).rows.front();
  EXPECT_EQ(rounded.verdict, RuleVerdict::kPass) << rounded.lowest;
  EXPECT_GE(rounded.lowest, 1520.0);
  CheckOptions fixed;
  fixed.reaim = false;
  EXPECT_NEAR(check_lamp(tables, ub2, fixed).rows.front().margin, -10.0, 1e-6);
}

TEST(CheckEvidence, AimAndLedModuleAsAsked) {
  CheckOptions options;
  options.aim_name = "vor";
  const CheckResult vor = check_by(sample_table("low_rht.ies"), "fmvss108-lb2v", options);
  EXPECT_EQ(vor.aim_method, "VOR");
  EXPECT_NEAR(vor.cutoff.elevation_deg, 0.0, 0.006);
  EXPECT_EQ(check_by(sample_table("low_rht.ies"), "fmvss108-lb2v").aim_method, "VOL");
  EXPECT_EQ(rule("fmvss108-lb2v").aim("nonsense"), nullptr);
  CheckOptions led;
  led.led_module = true;
  EXPECT_EQ(row_of(check_by(sample_table("low_rht.ies"), "r112-passing-b"), "50L").max, 13200.0);
  EXPECT_EQ(row_of(check_by(sample_table("low_rht.ies"), "r112-passing-b", led), "50L").max, 18500.0);
  EXPECT_FALSE(rule("r149-passing-c").has_led_module_limits());
}

}  // namespace
}  // namespace phare
