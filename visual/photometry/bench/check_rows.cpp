// Rows of a rulebook looked at in a beam.
// Computes: lowest and highest intensity of points, lines, areas and sums, and the verdict with what the file leaves
// open. Lines are walked in 0.02°, and in 0.0004° about their extremes; areas by their edge and by every node of the
// table inside, between which a bilinear table has no extreme of its own. Where a table has no data nothing passes.
// Frame: H, V of the rule. Leaves out: the receiver's size (65 mm at 25 m). Checked by tests/photometry/check_test.cpp
// and check_evidence_test.cpp.
#include "visual/photometry/bench/check_rows.h"

#include <algorithm>
#include <cmath>

namespace phare {
namespace {

constexpr double kLineStep_deg = 0.02, kFineLineStep_deg = 0.0004;
constexpr double kSearchStep_deg = 0.25;

bool inside(const std::vector<HV>& polygon, HV p) {
  bool is_inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const HV a = polygon[i], b = polygon[j];
    if ((a.v_deg > p.v_deg) != (b.v_deg > p.v_deg) &&
        p.h_deg < a.h_deg + (b.h_deg - a.h_deg) * (p.v_deg - a.v_deg) / (b.v_deg - a.v_deg)) {
      is_inside = !is_inside;
    }
  }
  return is_inside;
}

std::vector<HV> outline(const RuleRow& row) {
  if (row.shape != RowShape::kArea) return row.at;
  const HV a = row.at[0], b = row.at[1];
  return {{a.h_deg, a.v_deg}, {b.h_deg, a.v_deg}, {b.h_deg, b.v_deg}, {a.h_deg, b.v_deg}};
}

template <typename Visit>
void along(HV from, HV to, double step_deg, const Visit& visit) {
  const double length = std::hypot(to.h_deg - from.h_deg, to.v_deg - from.v_deg);
  const int steps = std::clamp(static_cast<int>(std::ceil(length / step_deg)), 1, 20000);
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    visit(HV{from.h_deg + t * (to.h_deg - from.h_deg), from.v_deg + t * (to.v_deg - from.v_deg)});
  }
}

/// Lowest and highest of a row; `shift` looks at places moved by it, as if the beam were turned the other way.
struct Extremes {
  double lowest = kNoMaximum, highest = 0.0, sum = 0.0;
  HV lowest_at, highest_at;
  bool any = false, no_data = false;
  HV no_data_at;
  void take(HV p, RuleBeam::Value value) {
    if (!value.known) {
      if (!no_data) no_data_at = p;
      no_data = true;
      return;
    }
    if (value.cd < lowest) {
      lowest = value.cd;
      lowest_at = p;
    }
    if (value.cd > highest || (highest == 0.0 && value.cd == 0.0)) {
      highest = value.cd;
      highest_at = p;
    }
    sum += value.cd;
    any = true;
  }
};

/// How far a place lies towards the side on which a row has no end.
double towards(OpenSide side, HV p) {
  return side == OpenSide::kLeft    ? -p.h_deg
         : side == OpenSide::kRight ? p.h_deg
         : side == OpenSide::kDown  ? -p.v_deg
                                    : 0.0;
}

Extremes scan(RuleBeam& beam, const RuleRow& row, HV shift, bool coarse) {
  Extremes e;
  double near = kNoMaximum;
  for (const HV p : row.at) near = std::min(near, towards(row.open, p));
  const auto take = [&](HV p, RuleBeam::Value value) {
    // An open row ends where the data end, but has to begin in them.
    if (value.known || towards(row.open, p) <= near + 1e-9) e.take(p, value);
  };
  const auto look = [&](HV p) { take(p, beam.at(p.h_deg - shift.h_deg, p.v_deg - shift.v_deg)); };
  const double step = coarse ? kSearchStep_deg : kLineStep_deg;
  // On a steep cut-off the extreme lies between two steps.
  const auto walk = [&](HV from, HV to) {
    Extremes of_line;
    const auto look_too = [&](HV p) {
      of_line.take(p, beam.at(p.h_deg - shift.h_deg, p.v_deg - shift.v_deg));
      look(p);
    };
    along(from, to, step, look_too);
    const double length = std::hypot(to.h_deg - from.h_deg, to.v_deg - from.v_deg);
    if (coarse || !of_line.any || !(length > 0.0)) return;
    for (const HV at : {of_line.highest_at, of_line.lowest_at}) {
      const double middle = std::hypot(at.h_deg - from.h_deg, at.v_deg - from.v_deg) / length;
      const auto point = [&](double t) {
        t = std::clamp(t, 0.0, 1.0);
        return HV{from.h_deg + t * (to.h_deg - from.h_deg), from.v_deg + t * (to.v_deg - from.v_deg)};
      };
      along(point(middle - step / length), point(middle + step / length), kFineLineStep_deg, look);
    }
  };
  switch (row.shape) {
    case RowShape::kPoints:
    case RowShape::kSum:
      for (const HV p : row.at) look(p);
      break;
    case RowShape::kLine:
      for (std::size_t i = 0; i + 1 < row.at.size(); ++i) walk(row.at[i], row.at[i + 1]);
      break;
    case RowShape::kArea:
    case RowShape::kPolygon: {
      const std::vector<HV> edge = outline(row);
      for (std::size_t i = 0; i < edge.size(); ++i) walk(edge[i], edge[(i + 1) % edge.size()]);
      if (coarse) {
        HV low = edge[0], high = edge[0];
        for (const HV p : edge) {
          low = {std::min(low.h_deg, p.h_deg), std::min(low.v_deg, p.v_deg)};
          high = {std::max(high.h_deg, p.h_deg), std::max(high.v_deg, p.v_deg)};
        }
        const double wide = std::max(step, (high.h_deg - low.h_deg) / 80.0),
                     tall = std::max(step, (high.v_deg - low.v_deg) / 80.0);
        for (double h = low.h_deg; h <= high.h_deg; h += wide) {
          for (double v = low.v_deg; v <= high.v_deg; v += tall) {
            if (inside(edge, {h, v})) look({h, v});
          }
        }
        break;
      }
      for (const RuleBeam::Node& node : beam.nodes()) {
        const HV p{node.at.h_deg + shift.h_deg, node.at.v_deg + shift.v_deg};
        if (inside(edge, p)) take(p, node.value);
      }
      break;
    }
    case RowShape::kPeak: {
      const RuleBeam::Node peak = beam.peak();
      e.take({peak.at.h_deg + shift.h_deg, peak.at.v_deg + shift.v_deg}, peak.value);
      break;
    }
  }
  if (row.shape == RowShape::kSum) e.lowest = e.highest = e.sum;
  return e;
}

}  // namespace

CheckRow judge_row(RuleBeam& beam, const Rulebook& rule, const RuleRow& row, HV shift, bool coarse) {
  CheckRow result;
  result.id = row.id;
  result.clause = row.clause;
  result.unit = "cd";
  result.shape = row.shape;
  result.unconfirmed = row.unconfirmed;
  result.min = row.min_cd;
  result.max = row.max_cd;
  result.reaim = shift;
  const Extremes e = scan(beam, row, shift, coarse);
  result.has_value = e.any;
  result.no_data = e.no_data;
  result.no_data_at = e.no_data_at;
  if (row.min_of_peak_01 > 0.0) result.min = std::max(result.min, row.min_of_peak_01 * beam.peak().value.cd);
  if (row.max_factor > 0.0) {
    const Extremes other = scan(beam, *rule.row(row.max_of), shift, coarse);
    result.max = std::min(result.max, row.max_factor * other.highest);
    if (!other.any || other.no_data) {  // a limit that is not known
      if (!result.no_data) result.no_data_at = other.no_data_at;
      result.no_data = true;
      if (!other.any) result.max = kNoMaximum;
    }
  }
  if (!e.any) return result;
  result.lowest = e.lowest;
  result.highest = e.highest;
  result.lowest_at = e.lowest_at;
  result.highest_at = e.highest_at;
  const double above = e.lowest - result.min, below = result.max - e.highest;
  result.by_min = result.min > kNoMinimum && (result.max >= kNoMaximum || above < below);
  result.margin = result.by_min ? above : below;
  return result;
}

void conclude_row(const RuleBeam& beam, const RuleRow& row, CheckRow& result) {
  const HV tightest = result.by_min ? result.lowest_at : result.highest_at;
  if (row.shape == RowShape::kSum) {
    for (const HV p : row.at) {
      const double error = beam.resolution_cd(p);
      if (std::isfinite(error)) result.resolution += error;
    }
  } else if (row.shape == RowShape::kPeak) {
    result.resolution +=
        beam.peak_resolution_cd({tightest.h_deg - result.reaim.h_deg, tightest.v_deg - result.reaim.v_deg});
  } else if (result.has_value) {
    result.resolution += beam.resolution_cd({tightest.h_deg - result.reaim.h_deg, tightest.v_deg - result.reaim.v_deg});
  }
  const bool close = std::abs(result.margin) < result.resolution;
  result.verdict = close                  ? RuleVerdict::kWithinResolution
                   : result.margin >= 0.0 ? RuleVerdict::kPass
                                          : RuleVerdict::kFail;
  if (!result.no_data) return;
  // Light is never negative: a sum that is enough without a point stays so. Any other row fails by what is there, or
  // is not known.
  const bool sum = row.shape == RowShape::kSum, failed = result.has_value && result.verdict == RuleVerdict::kFail;
  const bool sum_decided = sum && (result.by_min ? result.verdict == RuleVerdict::kPass : failed);
  if (sum ? !sum_decided : !failed) result.verdict = RuleVerdict::kNoData;
}

bool lies_in(const RuleRow& row, HV p) {
  constexpr double kOnEdge_deg = 0.015;  // laboratories print 0.01°
  if (row.shape == RowShape::kPoints || row.shape == RowShape::kSum || row.shape == RowShape::kPeak) return false;
  const std::vector<HV> edge = outline(row);
  const bool closed = row.shape != RowShape::kLine;
  if (closed && inside(edge, p)) return true;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < edge.size(); ++i) {
    const HV a = edge[i], b = edge[(i + 1) % edge.size()];
    const double x = b.h_deg - a.h_deg, y = b.v_deg - a.v_deg, length2 = x * x + y * y;
    const double along =
        length2 > 0.0 ? std::clamp(((p.h_deg - a.h_deg) * x + (p.v_deg - a.v_deg) * y) / length2, 0.0, 1.0) : 0.0;
    if (std::hypot(p.h_deg - a.h_deg - along * x, p.v_deg - a.v_deg - along * y) <= kOnEdge_deg) return true;
  }
  return false;
}

void mirror_rows(std::vector<CheckRow>& rows) {
  for (CheckRow& row : rows) {
    for (HV* p : {&row.lowest_at, &row.highest_at, &row.reaim, &row.no_data_at}) p->h_deg = 0.0 - p->h_deg;
    for (HV& p : row.at) p.h_deg = 0.0 - p.h_deg;
    for (HV& p : row.reaims) p.h_deg = 0.0 - p.h_deg;
    if (row.passes_by) row.passes_by->h_deg = 0.0 - row.passes_by->h_deg;
  }
}

void count_rows(CheckResult& result) {
  for (const CheckRow& row : result.rows) {
    if (row.verdict == RuleVerdict::kFail) ++result.failed;
    if (row.verdict == RuleVerdict::kFail && row.has_value)
      result.shortfall += std::abs(row.margin) / std::max(1.0, row.max < kNoMaximum ? row.max : row.min);
    if (row.verdict == RuleVerdict::kNoData) ++result.no_data;
    if (row.verdict == RuleVerdict::kWithinResolution) ++result.within_resolution;
    if (!row.unconfirmed.empty()) ++result.unconfirmed;
    result.verdict = std::max(result.verdict, row.verdict);
  }
}

}  // namespace phare
