// Judging a beam by a rulebook.
// Computes: the aim (inflection of log E on the rule's scan put on its line, UN R112 annex 9, FMVSS 108 S10.18.9), then
// for every row its lowest and highest intensity. Lines are walked in 0.02°; areas by their edge and by every node of
// the table inside, between which a bilinear table has no extreme of its own. Sources of the numbers: config/rules.
// Frame: H, V of the rule as the lamp is mounted. Leaves out: the receiver's size (65 mm at 25 m), horizontal aim by
// the 0.2 D line (the file's H is taken as aimed, within the re-aim allowance), temperature and voltage. Checked by
// tests/photometry/check_test.cpp.
#include "visual/photometry/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "visual/photometry/beam_image.h"

namespace phare {
namespace {

constexpr double kLineStep_deg = 0.02;
constexpr double kSearchStep_deg = 0.25;
constexpr double kReaimStep_deg = 0.05;

struct Node {
  HV at;
  double cd;
};

/// The beam as mounted with an aim: half the sum of its tables, H mirrored for left-hand traffic.
class Beam {
 public:
  Beam(std::span<const IntensityTable* const> tables, bool mirrored) : tables_(tables), mirrored_(mirrored) { aim({}); }

  void aim(HV aim) {
    aim_ = aim;
    const double side = mirrored_ ? -1.0 : 1.0;
    car_from_lamp_ = aim_rotation(-side * glm::radians(aim.h_deg), glm::radians(aim.v_deg), 0.0);
    nodes_.clear();
    peak_.reset();
  }
  HV aim() const { return aim_; }

  double at(double h_deg, double v_deg) const {
    const glm::dvec3 in_lamp = direction_hv(mirrored_ ? -h_deg : h_deg, v_deg) * car_from_lamp_;
    double sum = 0.0;
    for (const IntensityTable* table : tables_) sum += table->intensity_cd(in_lamp);
    return sum / static_cast<double>(tables_.size());
  }
  double resolution(HV p) const {
    const glm::dvec3 in_lamp = direction_hv(mirrored_ ? -p.h_deg : p.h_deg, p.v_deg) * car_from_lamp_;
    double sum = 0.0;
    for (const IntensityTable* table : tables_) sum += interpolation_error_cd(*table, table->angles_of(in_lamp));
    return sum / static_cast<double>(tables_.size());
  }
  /// Every node of the tables in the frame of the rule. Made when first asked for.
  const std::vector<Node>& nodes() {
    if (!nodes_.empty()) return nodes_;
    for (const IntensityTable* table : tables_) {
      for (const double second : table->second_deg) {
        for (const double first : table->first_deg) {
          const glm::dvec3 d = car_from_lamp_ * table->direction_of({first, second});
          TableAngles hv = table_angles(PhotometricType::kA, GammaAxis::kGamma0, d);
          if (mirrored_) hv.first_deg = -hv.first_deg;
          nodes_.push_back({{hv.first_deg, hv.second_deg}, at(hv.first_deg, hv.second_deg)});
        }
      }
    }
    return nodes_;
  }
  Node peak() {
    if (!peak_) {
      const auto& all = nodes();
      peak_ = *std::max_element(all.begin(), all.end(), [](const Node& a, const Node& b) { return a.cd < b.cd; });
    }
    return *peak_;
  }
  double flux_lm() const {
    double sum = 0.0;
    for (const IntensityTable* table : tables_) sum += table->flux_lm();
    return sum / static_cast<double>(tables_.size());
  }

 private:
  std::span<const IntensityTable* const> tables_;
  bool mirrored_;
  HV aim_;
  glm::dmat3 car_from_lamp_{1.0};
  std::vector<Node> nodes_;
  std::optional<Node> peak_;
};

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
  void take(HV p, double cd) {
    if (cd < lowest) {
      lowest = cd;
      lowest_at = p;
    }
    if (cd > highest || (highest == 0.0 && cd == 0.0)) {
      highest = cd;
      highest_at = p;
    }
    sum += cd;
  }
};

Extremes scan(Beam& beam, const RuleRow& row, HV shift, bool coarse) {
  Extremes e;
  const auto look = [&](HV p) { e.take(p, beam.at(p.h_deg - shift.h_deg, p.v_deg - shift.v_deg)); };
  const double step = coarse ? kSearchStep_deg : kLineStep_deg;
  switch (row.shape) {
    case RowShape::kPoints:
    case RowShape::kSum:
      for (const HV p : row.at) look(p);
      break;
    case RowShape::kLine:
      for (std::size_t i = 0; i + 1 < row.at.size(); ++i) along(row.at[i], row.at[i + 1], step, look);
      break;
    case RowShape::kArea:
    case RowShape::kPolygon: {
      const std::vector<HV> edge = outline(row);
      for (std::size_t i = 0; i < edge.size(); ++i) along(edge[i], edge[(i + 1) % edge.size()], step, look);
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
      for (const Node& node : beam.nodes()) {
        const HV p{node.at.h_deg + shift.h_deg, node.at.v_deg + shift.v_deg};
        if (inside(edge, p)) e.take(p, node.cd);
      }
      break;
    }
    case RowShape::kPeak: {
      const Node peak = beam.peak();
      e.take({peak.at.h_deg + shift.h_deg, peak.at.v_deg + shift.v_deg}, peak.cd);
      break;
    }
  }
  if (row.shape == RowShape::kSum) e.lowest = e.highest = e.sum;
  return e;
}

CheckRow judge(Beam& beam, const Rulebook& rule, const RuleRow& row, HV shift, bool coarse) {
  CheckRow result;
  result.id = row.id;
  result.clause = row.clause;
  result.unit = "cd";
  result.shape = row.shape;
  result.unconfirmed = row.unconfirmed;
  result.min = row.min_cd;
  result.max = row.max_cd;
  result.reaim = shift;
  if (row.min_of_peak_01 > 0.0) result.min = std::max(result.min, row.min_of_peak_01 * beam.peak().cd);
  if (row.max_factor > 0.0)
    result.max = std::min(result.max, row.max_factor * scan(beam, *rule.row(row.max_of), shift, coarse).highest);
  const Extremes e = scan(beam, row, shift, coarse);
  result.lowest = e.lowest;
  result.highest = e.highest;
  result.lowest_at = e.lowest_at;
  result.highest_at = e.highest_at;
  const double above = e.lowest - result.min, below = result.max - e.highest;
  const bool by_min = result.min > kNoMinimum && (result.max >= kNoMaximum || above < below);
  result.margin = by_min ? above : below;
  return result;
}

/// Adds resolution and verdict.
void conclude(const Beam& beam, const RuleRow& row, CheckRow& result) {
  const double above = result.lowest - result.min;
  const HV tightest = result.margin == above ? result.lowest_at : result.highest_at;
  if (row.shape == RowShape::kSum) {
    for (const HV p : row.at) result.resolution += beam.resolution(p);
  } else {
    result.resolution = beam.resolution({tightest.h_deg - result.reaim.h_deg, tightest.v_deg - result.reaim.v_deg});
  }
  result.verdict = std::abs(result.margin) < result.resolution ? Verdict::kWithinResolution
                   : result.margin >= 0.0                      ? Verdict::kPass
                                                               : Verdict::kFail;
}

CheckRow measured(std::string id, std::string clause, std::string unit, double value, double min, double max,
                  double resolution) {
  CheckRow row;
  row.id = std::move(id);
  row.clause = std::move(clause);
  row.unit = std::move(unit);
  row.min = min;
  row.max = max;
  row.lowest = row.highest = value;
  row.margin = min > kNoMinimum ? std::min(value - min, max - value) : max - value;
  row.resolution = resolution;
  row.verdict = std::abs(row.margin) < resolution ? Verdict::kWithinResolution
                : row.margin >= 0.0               ? Verdict::kPass
                                                  : Verdict::kFail;
  row.shape = RowShape::kPeak;
  return row;
}

IntensityHv as_function(const Beam& beam) {
  return [&beam](double h, double v) { return beam.at(h, v); };
}

/// Turns the beam until the inflection lies on the line. False: no cut-off to aim by.
bool aim_by_cutoff(Beam& beam, const CutoffAim& aim) {
  HV turned = beam.aim();
  for (int round = 0; round < 5; ++round) {
    const Cutoff cutoff = find_cutoff(as_function(beam), aim.scan_h_deg);
    if (!cutoff.found) return false;
    const double off = aim.line_v_deg - cutoff.elevation_deg;
    if (std::abs(off) < 0.003) return true;
    turned.v_deg += off;
    beam.aim(turned);
  }
  return true;
}

double total_shortfall(const std::vector<CheckRow>& rows, std::size_t& failed) {
  double sum = 0.0;
  failed = 0;
  for (const CheckRow& row : rows) {
    if (row.margin >= 0.0) continue;
    ++failed;
    sum += -row.margin / std::max(1.0, row.max < kNoMaximum ? row.max : row.min);
  }
  return sum;
}

std::vector<CheckRow> judge_all(Beam& beam, const Rulebook& rule, HV shift, bool coarse) {
  std::vector<CheckRow> rows;
  for (const RuleRow& row : rule.rows) rows.push_back(judge(beam, rule, row, shift, coarse));
  return rows;
}

/// The re-aim within the rule's allowance with the fewest failed rows, of these the smallest. Searched by shifting the
/// rows (exact to second order in the shift), which keeps the nodes where they are.
HV best_reaim(Beam& beam, const Rulebook& rule) {
  HV best;
  std::size_t fewest = rule.rows.size() + 1;
  double least = kNoMaximum;
  const int left = static_cast<int>(std::lround(rule.reaim_left_deg / kReaimStep_deg));
  const int right = static_cast<int>(std::lround(rule.reaim_right_deg / kReaimStep_deg));
  const int down = static_cast<int>(std::lround(rule.reaim_down_deg / kReaimStep_deg));
  const int up = static_cast<int>(std::lround(rule.reaim_up_deg / kReaimStep_deg));
  for (int i = -left; i <= right; ++i) {
    for (int j = -down; j <= up; ++j) {
      const HV shift{i * kReaimStep_deg, j * kReaimStep_deg};
      std::size_t failed = 0;
      const double shortfall = total_shortfall(judge_all(beam, rule, shift, true), failed);
      const double cost = failed > 0 ? shortfall : 1e-6 * std::hypot(shift.h_deg, shift.v_deg);
      if (failed < fewest || (failed == fewest && cost < least)) {
        fewest = failed;
        least = cost;
        best = shift;
      }
    }
  }
  return best;
}

/// FMVSS 108: a row that fails may be looked at with the beam turned by up to a quarter degree.
void reaim_row(Beam& beam, const Rulebook& rule, const RuleRow& row, CheckRow& result) {
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    for (int k = 0; k < 16; ++k) {
      const double angle = k * glm::radians(22.5), radius = part * rule.point_reaim_deg;
      const CheckRow turned = judge(beam, rule, row, {radius * std::cos(angle), radius * std::sin(angle)}, false);
      if (turned.margin > result.margin) result = turned;
    }
    if (result.margin >= 0.0) return;
  }
}

/// Curvature of the values at four nodes i-1 … i+2 (ends clamped) as the largest error of a linear piece, at share u.
double piece_error(const double (&x)[4], const double (&f)[4], double u) {
  double curvature = 0.0;  // |f''|·h² of the middle interval
  const double h = x[2] - x[1];
  for (const int i : {0, 1}) {
    const double a = x[i + 1] - x[i], b = x[i + 2] - x[i + 1];
    if (a <= 0.0 || b <= 0.0) continue;
    const double second = 2.0 * ((f[i + 2] - f[i + 1]) / b - (f[i + 1] - f[i]) / a) / (a + b);
    curvature = std::max(curvature, std::abs(second) * h * h);
  }
  return curvature * 0.5 * u * (1.0 - u);  // = curvature / 8 in the middle
}

}  // namespace

double interpolation_error_cd(const IntensityTable& table, TableAngles angles) {
  const auto place = [](const std::vector<double>& nodes, double at, std::size_t& i, double& u) {
    if (!(at >= nodes.front() && at <= nodes.back())) return false;
    i = static_cast<std::size_t>(std::upper_bound(nodes.begin() + 1, nodes.end() - 1, at) - nodes.begin()) - 1;
    u = (at - nodes[i]) / (nodes[i + 1] - nodes[i]);
    return true;
  };
  std::size_t i = 0, j = 0;
  double u = 0.0, v = 0.0;
  const double digits = 0.5 * table.header.smallest_step_cd;
  if (!place(table.first_deg, angles.first_deg, i, u) || !place(table.second_deg, angles.second_deg, j, v)) return 0.0;
  const std::size_t columns = table.first_deg.size(), rows = table.second_deg.size();
  double along_first = 0.0, along_second = 0.0;
  for (const std::size_t other : {std::size_t{0}, std::size_t{1}}) {
    double x[4], f[4], y[4], g[4];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t column = std::min(std::max(i + k, std::size_t{1}) - 1, columns - 1);
      const std::size_t row = std::min(std::max(j + k, std::size_t{1}) - 1, rows - 1);
      x[k] = table.first_deg[column];
      f[k] = table.candela[(j + other) * columns + column];
      y[k] = table.second_deg[row];
      g[k] = table.candela[row * columns + i + other];
    }
    along_first = std::max(along_first, piece_error(x, f, u));
    along_second = std::max(along_second, piece_error(y, g, v));
  }
  return along_first + along_second + digits;
}

CheckResult check_lamp(std::span<const IntensityTable* const> tables, const Rulebook& rule,
                       const CheckOptions& options) {
  CheckResult result;
  result.rule_id = rule.id;
  result.rule_name = rule.name;
  result.document = rule.document;
  const bool asymmetric = rule.function == "low";
  result.left_hand = options.traffic == Traffic::kLeft;
  if (options.traffic == Traffic::kFind && asymmetric) {
    const Beam as_filed(tables, false);
    result.left_hand = cutoff_shape(as_function(as_filed)).side == CutoffSide::kRisesLeft;
  }

  Beam beam(tables, result.left_hand);
  result.aim_method = "as filed";
  const CutoffAim* aim = nullptr;
  double sharpest = 0.0;
  // Of VOL and VOR the one on the flat side of the kink; without a kink the sharper.
  const CutoffSide side = rule.cutoff_aims.size() > 1 ? cutoff_shape(as_function(beam)).side : CutoffSide::kNone;
  for (const CutoffAim& candidate : rule.cutoff_aims) {
    double g = find_cutoff(as_function(beam), candidate.scan_h_deg).sharpness_g;
    if (side == CutoffSide::kRisesRight && candidate.scan_h_deg > 0.0) g = 0.0;
    if (side == CutoffSide::kRisesLeft && candidate.scan_h_deg < 0.0) g = 0.0;
    if (aim == nullptr || g > sharpest) {
      aim = &candidate;
      sharpest = g;
    }
  }
  bool aimed = true;
  if (options.aim) {
    beam.aim(*options.aim);
    result.aim_method = "given";
  } else if (aim != nullptr) {
    result.aim_method = aim->name;
    aimed = aim_by_cutoff(beam, *aim);
  }

  std::vector<CheckRow> rows = judge_all(beam, rule, {}, false);
  std::size_t failed = 0;
  const double shortfall = total_shortfall(rows, failed);
  const double allowance = rule.reaim_left_deg + rule.reaim_right_deg + rule.reaim_up_deg + rule.reaim_down_deg;
  if (failed > 0 && options.reaim && !options.aim && aimed && allowance > 0.0) {
    const HV before = beam.aim();
    const HV turn = best_reaim(beam, rule);
    beam.aim({before.h_deg + turn.h_deg, before.v_deg + turn.v_deg});
    std::vector<CheckRow> turned = judge_all(beam, rule, {}, false);
    std::size_t still_failed = 0;
    const double still = total_shortfall(turned, still_failed);
    if (still_failed < failed || (still_failed == failed && still < shortfall)) {
      rows = std::move(turned);
      result.reaimed = true;
    } else {
      beam.aim(before);
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].margin < 0.0 && rule.point_reaim_deg > 0.0 && options.reaim)
      reaim_row(beam, rule, rule.rows[i], rows[i]);
    conclude(beam, rule.rows[i], rows[i]);
    rows[i].at = rule.rows[i].at;
  }
  result.aim_up_deg = beam.aim().v_deg;
  result.aim_right_deg = result.left_hand ? -beam.aim().h_deg : beam.aim().h_deg;

  if (aim != nullptr) {
    result.cutoff = find_cutoff(as_function(beam), aim->scan_h_deg);
    if (aim->sharpness_min > 0.0 || aim->sharpness_max < kNoMaximum) {
      rows.push_back(measured("cut-off sharpness G", "cut-off quality", "", result.cutoff.sharpness_g,
                              aim->sharpness_min, aim->sharpness_max, 0.0));
    }
    if (!aim->linearity_h_deg.empty()) {
      double low = 90.0, high = -90.0;
      for (const double h : aim->linearity_h_deg) {
        const double v = find_cutoff(as_function(beam), h).elevation_deg;
        low = std::min(low, v);
        high = std::max(high, v);
      }
      rows.push_back(
          measured("cut-off linearity", "cut-off quality", "deg", high - low, 0.0, aim->linearity_max_deg, 0.0));
    }
  }
  if (rule.flux_min_lm > 0.0) {
    rows.push_back(measured("luminous flux", rule.clause, "lm", beam.flux_lm(), rule.flux_min_lm, kNoMaximum, 0.0));
    rows.back().unconfirmed = rule.rows.front().unconfirmed;
  }
  if (result.left_hand) {
    for (CheckRow& row : rows) {
      for (HV* p : {&row.lowest_at, &row.highest_at, &row.reaim}) p->h_deg = -p->h_deg;
      for (HV& p : row.at) p.h_deg = -p.h_deg;
    }
  }
  for (const CheckRow& row : rows) {
    if (row.verdict == Verdict::kFail) ++result.failed;
    if (row.verdict == Verdict::kWithinResolution) ++result.within_resolution;
    if (!row.unconfirmed.empty()) ++result.unconfirmed;
  }
  result.verdict = result.failed > 0              ? Verdict::kFail
                   : result.within_resolution > 0 ? Verdict::kWithinResolution
                                                  : Verdict::kPass;
  result.rows = std::move(rows);
  return result;
}

}  // namespace phare
