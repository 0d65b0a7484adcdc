// unit: a mirrored lamp has the mirrored cut-off and the mirrored verdict, to the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "check_helpers.h"
#include "made_beams.h"
#include "visual/photometry/bench/sample_lamps.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {
namespace {

using test::check, test::made_beam, test::rule, test::step_line;

struct Named {
  std::string name;
  IntensityTable table;
};

/// Our lamps, a step, noise (so that no two values are alike by chance), a flat one that is not symmetric, a spot.
const std::vector<Named>& lamps() {
  static const std::vector<Named> all = [] {
    std::vector<Named> made;
    for (SampleLamp& lamp : sample_lamps()) made.push_back({lamp.file, std::move(lamp.table)});
    made.push_back({"step", made_beam({step_line(-0.42, 0.3, 0.3, 0.08), 0.12, 0.1, 0.05, 0.005})});
    made.push_back({"step on odd columns", made_beam({step_line(-0.42, 0.3, 0.13, 0.08), 0.12, 0.17, 0.07, 0.005})});
    made.push_back({"flat", made_beam({[](double h) { return -0.6 + 0.01 * h; }, 0.12, 0.1, 0.05, 0.005, 0.4})});
    made.push_back({"soft", made_beam({[](double) { return -0.6; }, 2.5, 0.2, 0.2, 0.005, 1.0})});
    return made;
  }();
  return all;
}

IntensityTable mirrored(IntensityTable table) {
  mirror_left_right(table);
  return table;
}

TEST(Mirror, IntensityToTheBit) {
  for (const auto& [name, table] : lamps()) {
    const IntensityTable other = mirrored(table);
    const glm::dmat3 up = glm::dmat3{1.0};
    const IntensityHv a = mounted_intensity(table, up), b = mounted_intensity(other, up);
    for (double h = -12.0; h <= 12.0; h += 0.37) {
      for (double v = -5.0; v <= 3.0; v += 0.13) {
        EXPECT_EQ(a(h, v), b(-h, v)) << name << " " << h << " " << v;
        EXPECT_EQ(a.evidence(h, v), b.evidence(-h, v)) << name << " " << h << " " << v;
      }
    }
  }
}

TEST(Mirror, CutoffToTheBit) {
  for (const auto& [name, table] : lamps()) {
    const IntensityTable other = mirrored(table);
    const CutoffShape a = cutoff_shape(mounted_intensity(table, glm::dmat3{1.0}));
    const CutoffShape b = cutoff_shape(mounted_intensity(other, glm::dmat3{1.0}));
    EXPECT_EQ(a.tells_side(), b.tells_side()) << name;
    if (a.tells_side()) {
      EXPECT_NE(a.side, b.side) << name;
    }
    if (!a.tells_side()) {
      EXPECT_EQ(a.side, b.side) << name;
    }
    EXPECT_EQ(a.form, b.form) << name;
    EXPECT_EQ(a.kink_h_deg, -b.kink_h_deg) << name;
    EXPECT_EQ(a.flat_v_deg, b.flat_v_deg) << name;
    EXPECT_EQ(a.upper_v_deg, b.upper_v_deg) << name;
    EXPECT_EQ(a.rise_deg, b.rise_deg) << name;
    EXPECT_EQ(a.sharpness_g, b.sharpness_g) << name;
    EXPECT_EQ(a.steps.size(), b.steps.size()) << name;
    for (std::size_t i = 0; i < std::min(a.steps.size(), b.steps.size()); ++i) {
      EXPECT_EQ(a.steps[i].foot_h_deg, -b.steps[i].foot_h_deg) << name;
      EXPECT_EQ(a.steps[i].height_deg, b.steps[i].height_deg) << name;
    }
  }
}

void expect_mirrored(const CheckResult& a, const CheckResult& b, const std::string& what) {
  EXPECT_EQ(a.verdict, b.verdict) << what;
  EXPECT_EQ(a.traffic_source, b.traffic_source) << what;
  EXPECT_EQ(a.aim_method, b.aim_method) << what;
  EXPECT_EQ(a.aim_up_deg, b.aim_up_deg) << what;
  // A beam that is its own mirror image is assumed to be for the right both times.
  EXPECT_EQ(a.aim_right_deg, a.left_hand == b.left_hand ? b.aim_right_deg : -b.aim_right_deg) << what;
  EXPECT_EQ(a.cutoff.sharpness_g, b.cutoff.sharpness_g) << what;
  ASSERT_EQ(a.rows.size(), b.rows.size()) << what;
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    EXPECT_EQ(a.rows[i].id, b.rows[i].id) << what;
    if (a.rows[i].unit == "lm") {  // a sum over the table in its own order: so many roundings of 1e-16 do not add up
      EXPECT_NEAR(a.rows[i].lowest, b.rows[i].lowest, 1e-12 * a.rows[i].lowest) << what;
      continue;
    }
    EXPECT_EQ(a.rows[i].verdict, b.rows[i].verdict) << what << " " << a.rows[i].id;
    EXPECT_EQ(a.rows[i].lowest, b.rows[i].lowest) << what << " " << a.rows[i].id;
    EXPECT_EQ(a.rows[i].highest, b.rows[i].highest) << what << " " << a.rows[i].id;
    EXPECT_EQ(a.rows[i].margin, b.rows[i].margin) << what << " " << a.rows[i].id;
    EXPECT_EQ(a.rows[i].resolution, b.rows[i].resolution) << what << " " << a.rows[i].id;
    EXPECT_EQ(a.rows[i].passes_by.has_value(), b.rows[i].passes_by.has_value()) << what << " " << a.rows[i].id;
  }
}

TEST(Mirror, VerdictOfPassingBeamsToTheBit) {
  for (const char* id : {"r112-passing-b", "r149-passing-c", "fmvss108-lb2v"}) {
    for (const auto& [name, table] : lamps()) {
      if (name != "low_rht.ies" && name != "step on odd columns" && name != "flat" && name != "fog.ies") continue;
      const IntensityTable other = mirrored(table);
      const CheckResult a = check(table, rule(id)), b = check(other, rule(id));
      expect_mirrored(a, b, name + " by " + id);
      // A side that is told changes; one that is assumed changes too, unless the beam is its own mirror image.
      if (a.traffic_source == TrafficSource::kFound) {
        EXPECT_NE(a.left_hand, b.left_hand) << name;
      }
    }
  }
}

// Rows of driving and fog beams are alike on both sides, but a row names its points in one order: those of one row are
// compared as a whole.
TEST(Mirror, VerdictOfOtherBeamsToTheBit) {
  for (const char* id : {"r149-driving-b", "fmvss108-ub2", "r19-f3"}) {
    for (const auto& [name, table] : lamps()) {
      if (name != "high.ies" && name != "fog.ies" && name != "soft" && name != "flat") continue;
      const IntensityTable other = mirrored(table);
      const CheckResult a = check(table, rule(id)), b = check(other, rule(id));
      EXPECT_EQ(a.traffic_source, TrafficSource::kAssumed) << name;
      EXPECT_EQ(a.verdict, b.verdict) << name << " by " << id;
      EXPECT_EQ(a.failed, b.failed) << name << " by " << id;
      EXPECT_DOUBLE_EQ(a.shortfall, b.shortfall) << name << " by " << id;
      EXPECT_EQ(a.within_resolution, b.within_resolution) << name << " by " << id;
    }
  }
}

TEST(Mirror, AnAssumedSideIsCalledSo) {
  const IntensityTable& flat = lamps()[lamps().size() - 2].table;
  const CheckResult result = check(flat, rule("r112-passing-b"));
  EXPECT_EQ(result.traffic_source, TrafficSource::kAssumed);
  EXPECT_FALSE(result.other_side.empty());
  EXPECT_EQ(traffic_source_name(result.traffic_source), "assumed");
  CheckOptions given;
  given.traffic = TrafficSide::kLeft;
  EXPECT_EQ(check(flat, rule("r112-passing-b"), given).traffic_source, TrafficSource::kGiven);
  EXPECT_EQ(check(lamps().front().table, rule("r112-passing-b")).traffic_source, TrafficSource::kFound);
}

}  // namespace
}  // namespace phare
