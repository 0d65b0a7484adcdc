// Judging a beam by a rulebook.
// Computes: the aim (inflection of log E on the rule's scan put on its line, UN R112 annex 9, FMVSS 108 S10.18.9), then
// every row (check_rows.cpp), re-aimed where the rule allows it, and the cut-off's own quality. Sources of the numbers:
// config/rules.
// Frame: H, V of the rule as the lamp is mounted. Leaves out: the receiver's size (65 mm at 25 m), horizontal aim by
// the 0.2 D line (the file's H is taken as aimed, within the re-aim allowance), temperature and voltage. Checked by
// tests/photometry/check_test.cpp.
#include "visual/photometry/bench/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "visual/photometry/bench/check_rows.h"

namespace phare {
namespace {

constexpr double kReaimStep_deg = 0.05;
// How well rows tell the inflection. Our passing beams, G 0.27 to 0.57, filed on rows of 0.05° to 1° at any phase were
// aimed within this (CoarseRowsTellTheAim measures it).
constexpr double kFineRow_deg = 0.101, kFineAim_deg = 0.01, kAimOfWideRow_01 = 0.35;

/// A row that is no candela of a place; `lowest` to `highest` is what the value may be.
CheckRow measured(std::string id, std::string clause, std::string unit, double value, double lowest, double highest,
                  double min, double max) {
  CheckRow row;
  row.id = std::move(id);
  row.clause = std::move(clause);
  row.unit = std::move(unit);
  row.min = min;
  row.max = max;
  row.lowest = row.highest = value;
  row.verdict = lowest >= min && highest <= max ? RuleVerdict::kPass
                : highest < min || lowest > max ? RuleVerdict::kFail
                                                : RuleVerdict::kWithinResolution;
  row.by_min = min > kNoMinimum && (max >= kNoMaximum || value - min < max - value);
  // Inside both limits the one that it may yet miss is told.
  if (row.verdict == RuleVerdict::kWithinResolution && value >= min && value <= max &&
      (lowest < min) != (highest > max))
    row.by_min = lowest < min;
  row.margin = row.by_min ? value - min : max - value;
  row.resolution = row.by_min == (row.margin >= 0.0) ? value - lowest : highest - value;
  row.shape = RowShape::kPeak;
  return row;
}

/// A row that there is nothing to measure for.
CheckRow nothing(CheckRow row, RuleVerdict verdict) {
  row.has_value = false;
  row.lowest = row.highest = row.margin = row.resolution = 0.0;
  row.no_data = verdict == RuleVerdict::kNoData;
  row.verdict = verdict;
  return row;
}

/// Turns one lamp until its inflection lies on the line; as filed where there is none.
LampAim aim_by_cutoff(RuleBeam& beam, const CutoffAim& aim) {
  LampAim result;
  for (int round = 0; round < 5; ++round) {
    const Cutoff cutoff = find_cutoff(beam.intensity(), aim.scan_h_deg);
    result.found = cutoff.found;
    if (!cutoff.found) {
      beam.set_aim(0, {});
      return result;
    }
    const double off = aim.line_v_deg - cutoff.elevation_deg;
    const double step = beam.sharpness_range(0, aim.scan_h_deg, cutoff).row_step_deg;
    result.resolution_deg = kFineAim_deg + (step > kFineRow_deg ? kAimOfWideRow_01 * step : 0.0);
    if (std::abs(off) < 0.003) break;
    beam.turn({0.0, off});
  }
  return result;
}

/// Sharpness and linearity of one lamp's own cut-off.
void judge_cutoff(const RuleBeam& lamp, const CutoffAim& aim, const std::string& whose, LampAim& result,
                  std::vector<CheckRow>& rows) {
  result.cutoff = find_cutoff(lamp.intensity(), aim.scan_h_deg);
  const Cutoff& cutoff = result.cutoff;
  const RuleVerdict none = cutoff.at_edge ? RuleVerdict::kNoData : RuleVerdict::kFail;
  RuleBeam::SharpnessRange range{cutoff.sharpness_g, cutoff.sharpness_g, 0.0};
  if (cutoff.found) range = lamp.sharpness_range(0, aim.scan_h_deg, cutoff);
  result.row_step_deg = range.row_step_deg;
  if (aim.sharpness_min > 0.0 || aim.sharpness_max < kNoMaximum) {
    CheckRow row = measured("cut-off sharpness G" + whose, aim.clause, "", cutoff.sharpness_g, range.lowest_g,
                            range.highest_g, aim.sharpness_min, aim.sharpness_max);
    rows.push_back(cutoff.at_edge ? nothing(std::move(row), none) : std::move(row));
  }
  if (aim.linearity_h_deg.empty()) return;
  double low = 90.0, high = -90.0, step = 0.0;
  RuleVerdict missing = RuleVerdict::kPass;
  for (const double h : aim.linearity_h_deg) {
    const Cutoff at = find_cutoff(lamp.intensity(), h);
    if (!at.found) {
      missing = std::max(missing, at.at_edge ? RuleVerdict::kNoData : RuleVerdict::kFail);
      continue;
    }
    low = std::min(low, at.elevation_deg);
    high = std::max(high, at.elevation_deg);
    step = std::max(step, lamp.sharpness_range(0, h, at).row_step_deg);
  }
  const double spread = high - low;
  CheckRow row = measured("cut-off linearity" + whose, aim.clause, "deg", spread, std::max(0.0, spread - step),
                          spread + step, 0.0, aim.linearity_max_deg);
  rows.push_back(missing != RuleVerdict::kPass ? nothing(std::move(row), missing) : std::move(row));
}

/// Rows that fail or are not known, and by how much.
double total_shortfall(const std::vector<CheckRow>& rows, std::size_t& failed) {
  double sum = 0.0;
  failed = 0;
  for (const CheckRow& row : rows) {
    if (row.margin >= 0.0 && !row.no_data) continue;
    ++failed;
    sum += row.margin < 0.0 ? -row.margin / std::max(1.0, row.max < kNoMaximum ? row.max : row.min) : 1.0;
  }
  return sum;
}

std::vector<CheckRow> judge_all(RuleBeam& beam, const Rulebook& rule, HV shift, bool coarse) {
  std::vector<CheckRow> rows;
  for (const RuleRow& row : rule.rows) rows.push_back(judge_row(beam, rule, row, shift, coarse));
  return rows;
}

/// The re-aim within the rule's allowance with the fewest failed rows, of these the smallest. Searched by shifting the
/// rows (exact to second order in the shift), which keeps the nodes where they are.
HV best_reaim(RuleBeam& beam, const Rulebook& rule) {
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

bool passes(const RuleBeam& beam, const RuleRow& row, CheckRow result) {
  conclude_row(beam, row, result);
  return result.verdict == RuleVerdict::kPass;
}

/// FMVSS 108: a test point that fails may be looked at with the beam turned by up to a quarter degree. As far as it
/// takes to pass for certain: on the smallest of four circles, in the best of 16 directions, which lie alike to both
/// sides.
void reaim_one(RuleBeam& beam, const Rulebook& rule, const RuleRow& row, CheckRow& result) {
  const double a = std::cos(glm::radians(22.5)), b = std::sin(glm::radians(22.5)), c = std::sqrt(0.5);
  const HV quarter[] = {{1.0, 0.0}, {a, b}, {c, c}, {b, a}, {0.0, 1.0}};
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    if (result.margin >= 0.0 && passes(beam, row, result)) return;
    const double radius = part * rule.point_reaim_deg;
    for (const HV to : quarter) {
      for (const double right : {1.0, -1.0}) {
        for (const double up : {1.0, -1.0}) {
          if ((to.h_deg == 0.0 && right < 0.0) || (to.v_deg == 0.0 && up < 0.0)) continue;
          const HV shift{right * radius * to.h_deg, up * radius * to.v_deg};
          const CheckRow turned = judge_row(beam, rule, row, shift, false);
          if (turned.margin > result.margin && turned.has_value && turned.no_data <= result.no_data) result = turned;
        }
      }
    }
  }
}

/// The points of a row each by itself; a line or an area as a whole.
void reaim_row(RuleBeam& beam, const Rulebook& rule, const RuleRow& row, CheckRow& result) {
  if (row.shape != RowShape::kPoints || row.at.size() < 2) return reaim_one(beam, rule, row, result);
  CheckRow worst;
  std::vector<HV> reaims;
  double lowest = kNoMaximum, highest = 0.0;
  HV lowest_at, highest_at;
  for (const HV p : row.at) {
    RuleRow single = row;
    single.at = {p};
    CheckRow one = judge_row(beam, rule, single, {}, false);
    if (one.has_value) reaim_one(beam, rule, single, one);
    reaims.push_back(one.reaim);
    if (one.has_value && one.lowest < lowest) lowest = one.lowest, lowest_at = one.lowest_at;
    if (one.has_value && one.highest > highest) highest = one.highest, highest_at = one.highest_at;
    if (reaims.size() == 1 || !worst.has_value || (one.has_value && one.margin < worst.margin)) worst = one;
  }
  worst.no_data = result.no_data;
  worst.no_data_at = result.no_data_at;
  worst.lowest = lowest;
  worst.highest = highest;
  worst.lowest_at = lowest_at;
  worst.highest_at = highest_at;
  worst.reaims = std::move(reaims);
  result = std::move(worst);
}

/// The largest turn among a row's points; none where no point was turned.
std::optional<HV> farthest_reaim(const CheckRow& row) {
  HV farthest = row.reaim;
  for (const HV reaim : row.reaims) {
    if (std::hypot(reaim.h_deg, reaim.v_deg) > std::hypot(farthest.h_deg, farthest.v_deg)) farthest = reaim;
  }
  if (farthest.h_deg == 0.0 && farthest.v_deg == 0.0) return std::nullopt;
  return farthest;
}

/// What the deciding value changes by when the beam is turned up or down by this.
double change_by_aim(RuleBeam& beam, const Rulebook& rule, const RuleRow& row, const CheckRow& at, double aim_deg) {
  double most = 0.0;
  for (const double side : {-aim_deg, aim_deg}) {
    const CheckRow turned = judge_row(beam, rule, row, {at.reaim.h_deg, at.reaim.v_deg + side}, false);
    if (turned.has_value)
      most = std::max(most, std::abs(at.by_min ? turned.lowest - at.lowest : turned.highest - at.highest));
  }
  return most;
}

/// Of several aims (VOL, VOR) the one asked for, or that on the flat side of the kink; without a kink the sharper.
/// `side`: where the beam rises, in the frame of the rule.
const CutoffAim* choose_aim(const RuleBeam& beam, const Rulebook& rule, const std::string& name, CutoffSide side) {
  if (const CutoffAim* asked = rule.aim(name); asked != nullptr) return asked;
  const CutoffAim* best = nullptr;
  double sharpest = 0.0;
  for (const CutoffAim& candidate : rule.cutoff_aims) {
    double g = find_cutoff(beam.intensity(), candidate.scan_h_deg).sharpness_g;
    if (side == CutoffSide::kRisesRight && candidate.scan_h_deg > 0.0) g = 0.0;
    if (side == CutoffSide::kRisesLeft && candidate.scan_h_deg < 0.0) g = 0.0;
    if (best == nullptr || g > sharpest) {
      best = &candidate;
      sharpest = g;
    }
  }
  return best;
}

}  // namespace

std::string verdict_name(RuleVerdict verdict) {
  switch (verdict) {
    case RuleVerdict::kPass:
      return "pass";
    case RuleVerdict::kWithinResolution:
      return "within resolution";
    case RuleVerdict::kNoData:
      return "no data";
    case RuleVerdict::kFail:
      break;
  }
  return "fail";
}

std::string verdict_name(const CheckRow& row) {
  return row.not_measured && row.verdict == RuleVerdict::kNoData ? "not measured" : verdict_name(row.verdict);
}

std::string traffic_source_name(TrafficSource source) {
  return source == TrafficSource::kGiven ? "given" : source == TrafficSource::kFound ? "by the cut-off" : "assumed";
}

Status same_traffic(std::span<const IntensityTable* const> tables) {
  const IntensityTable *right = nullptr, *left = nullptr;
  for (const IntensityTable* table : tables) {
    const CutoffSide side = cutoff_shape(mounted_intensity(*table, glm::dmat3{1.0})).side;
    if (side == CutoffSide::kRisesRight) right = table;
    if (side == CutoffSide::kRisesLeft) left = table;
  }
  if (right == nullptr || left == nullptr) return Done{};
  return Error{left->name, "is for left-hand traffic, " + right->name + " for right-hand traffic: no pair"};
}

namespace {

/// For the side that `result` names.
void check_side(std::span<const IntensityTable* const> tables, const Rulebook& rule, const CheckOptions& options,
                CheckResult& result) {
  // Each lamp by itself is aimed, and its cut-off judged; the rows are of half the sum.
  RuleBeam beam(tables, result.left_hand);
  std::vector<RuleBeam> each;
  for (std::size_t k = 0; k < tables.size(); ++k) each.emplace_back(tables.subspan(k, 1), result.left_hand);
  result.lamps.resize(tables.size());
  const CutoffSide side = !result.shape.tells_side() || !result.left_hand ? result.shape.side
                          : result.shape.side == CutoffSide::kRisesLeft   ? CutoffSide::kRisesRight
                                                                          : CutoffSide::kRisesLeft;
  const CutoffAim* aim = rule.cutoff_aims.empty() ? nullptr : choose_aim(each.front(), rule, options.aim_name, side);
  result.aim_method = "as filed";
  bool aimed = true;
  for (std::size_t k = 0; k < each.size(); ++k) {
    if (options.aim) {
      each[k].turn({result.left_hand ? 0.0 - options.aim->h_deg : options.aim->h_deg, options.aim->v_deg});
      result.aim_method = "given";
    } else if (aim != nullptr) {
      result.lamps[k] = aim_by_cutoff(each[k], *aim);
      aimed = aimed && result.lamps[k].found;
      result.aim_method = aimed ? aim->name : "no cut-off found, as filed";
      result.aim_unconfirmed = aim->unconfirmed;
    }
    beam.set_aim(k, each[k].aim());
  }

  std::vector<CheckRow> rows = judge_all(beam, rule, {}, false);
  std::size_t failed = 0;
  const double shortfall = total_shortfall(rows, failed);
  const bool any_fails = std::any_of(rows.begin(), rows.end(), [](const CheckRow& row) { return row.margin < 0.0; });
  const double allowance = rule.reaim_left_deg + rule.reaim_right_deg + rule.reaim_up_deg + rule.reaim_down_deg;
  if (any_fails && options.reaim && !options.aim && aimed && allowance > 0.0) {
    const HV turn = best_reaim(beam, rule);
    beam.turn(turn);
    std::vector<CheckRow> turned = judge_all(beam, rule, {}, false);
    std::size_t still_failed = 0;
    const double still = total_shortfall(turned, still_failed);
    result.reaimed = still_failed < failed || (still_failed == failed && still < shortfall);
    if (result.reaimed) {
      result.reaim = {result.left_hand ? 0.0 - turn.h_deg : turn.h_deg, turn.v_deg};
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].margin < 0.0 && turned[i].margin >= 0.0) turned[i].passes_by = turn;
      }
      rows = std::move(turned);
    }
    for (std::size_t k = 0; k < each.size(); ++k) {
      if (result.reaimed) each[k].turn(turn);
      beam.set_aim(k, each[k].aim());
    }
  }
  // Another aim within what the rows leave open counts, but for what the rule lets be re-aimed anyway.
  double aim_open_deg = 0.0;
  for (const LampAim& lamp : result.lamps) aim_open_deg = std::max(aim_open_deg, lamp.resolution_deg);
  if (options.reaim && !result.reaimed)
    aim_open_deg -= std::max(std::min(rule.reaim_up_deg, rule.reaim_down_deg), rule.point_reaim_deg);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (aim_open_deg > 0.0 && rows[i].has_value)
      rows[i].resolution = change_by_aim(beam, rule, rule.rows[i], rows[i], aim_open_deg);
    const bool open = rows[i].margin < 0.0 || (!rows[i].no_data && !passes(beam, rule.rows[i], rows[i]));
    if (rule.point_reaim_deg > 0.0 && options.reaim && rows[i].has_value && open) {
      reaim_row(beam, rule, rule.rows[i], rows[i]);
      rows[i].passes_by = farthest_reaim(rows[i]);
    }
    conclude_row(beam, rule.rows[i], rows[i]);
    if (rows[i].verdict != RuleVerdict::kPass) rows[i].passes_by.reset();
    rows[i].at = rule.rows[i].at;
  }

  for (std::size_t k = 0; k < each.size(); ++k) {
    LampAim& lamp = result.lamps[k];
    lamp.up_deg = each[k].aim().v_deg;
    lamp.right_deg = result.left_hand ? 0.0 - each[k].aim().h_deg : each[k].aim().h_deg;
    const std::string whose = each.size() < 2 ? "" : k == 0 ? ", left lamp" : ", right lamp";
    if (aim != nullptr) judge_cutoff(each[k], *aim, whose, lamp, rows);
  }
  if (rule.flux_min_lm > 0.0) {
    const double flux_lm = beam.flux_lm();
    CheckRow row =
        measured("luminous flux", rule.clause, "lm", flux_lm, flux_lm, flux_lm, rule.flux_min_lm, kNoMaximum);
    row.unconfirmed = rule.rows.front().unconfirmed;
    // What lies outside the table can only add.
    if (row.verdict == RuleVerdict::kFail && !rule.flux_or.empty()) row.open = "or " + rule.flux_or + ": not checked";
    row.no_data = row.verdict == RuleVerdict::kFail && (!row.open.empty() || !beam.covers_the_front());
    if (row.no_data) row.verdict = RuleVerdict::kNoData;
    rows.push_back(std::move(row));
  }
  if (result.left_hand) mirror_rows(rows);
  result.aim_up_deg = result.lamps.front().up_deg;
  result.aim_right_deg = result.lamps.front().right_deg;
  result.cutoff = result.lamps.front().cutoff;
  result.rows = std::move(rows);
  count_rows(result);
}

/// Is `a` the better verdict? Equal ones: neither.
bool better(const CheckResult& a, const CheckResult& b) {
  if (a.failed != b.failed) return a.failed < b.failed;
  if (a.no_data != b.no_data) return a.no_data < b.no_data;
  if (a.within_resolution != b.within_resolution) return a.within_resolution < b.within_resolution;
  return a.shortfall < b.shortfall;
}

}  // namespace

CheckResult check_lamp(std::span<const IntensityTable* const> tables, const Rulebook& rulebook,
                       const CheckOptions& options) {
  const Rulebook rule = options.led_module ? rulebook.for_led_modules() : rulebook;
  CheckResult result;
  result.rule_id = rule.id;
  result.rule_name = rule.name;
  result.document = rule.document;
  result.function = rule.function;
  for (const IntensityTable* table : tables) {
    CutoffShape shape = cutoff_shape(mounted_intensity(*table, glm::dmat3{1.0}));
    if (table == tables.front() || shape.tells_side()) result.shape = std::move(shape);
    if (result.shape.tells_side()) break;
  }
  if (options.traffic != TrafficSide::kFind) {
    result.left_hand = options.traffic == TrafficSide::kLeft;
    result.traffic_source = TrafficSource::kGiven;
  } else if (result.shape.tells_side()) {
    // Rules of other beams are the same for both sides; their rows stay as printed.
    result.left_hand = rule.function == "low" && result.shape.side == CutoffSide::kRisesLeft;
    result.traffic_source = rule.function == "low" ? TrafficSource::kFound : TrafficSource::kAssumed;
  }
  if (result.traffic_source != TrafficSource::kAssumed || rule.function != "low") {
    check_side(tables, rule, options, result);
    return result;
  }
  CheckResult left = result;
  left.left_hand = true;
  check_side(tables, rule, options, result);
  check_side(tables, rule, options, left);
  if (better(left, result)) std::swap(left, result);
  result.other_side = verdict_name(left.verdict) + ", " + std::to_string(left.failed) + " rows failed";
  return result;
}

}  // namespace phare
