#include "visual/photometry/bench/check_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "visual/photometry/bench/check_rows.h"
#include "visual/photometry/readers/file_text.h"

namespace phare {
namespace {

class PointJudge {
 public:
  PointJudge(const PointList& list, bool mirrored) : list_(list), mirrored_(mirrored), used_(list.points.size()) {}

  CheckRow judge(const Rulebook& rule, const RuleRow& row);
  /// How many of the rule's points the list has.
  std::size_t matches(const Rulebook& rule) {
    std::size_t count = 0;
    for (const RuleRow& row : rule.rows) {
      if (row.shape != RowShape::kPoints && row.shape != RowShape::kSum) continue;
      for (std::size_t k = 0; k < row.at.size(); ++k) count += at_point(row, k) != nullptr ? 1 : 0;
    }
    return count;
  }
  std::vector<std::string> unused() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < used_.size(); ++i) {
      if (!used_[i] && list_.points[i].cd) names.push_back(list_.points[i].name);
    }
    return names;
  }

 private:
  const MeasuredPoint* take(std::size_t i) {
    used_[i] = true;
    return &list_.points[i];
  }
  /// In the frame of the rule.
  std::optional<HV> place(const MeasuredPoint& point) const {
    if (!point.at) return std::nullopt;
    return HV{mirrored_ ? 0.0 - point.at->h_deg : point.at->h_deg, point.at->v_deg};
  }
  const MeasuredPoint* named(const std::string& name) {
    const std::string plain = plain_name(name), wanted = mirrored_ ? mirrored_name(plain) : plain;
    for (std::size_t i = 0; i < list_.points.size(); ++i) {
      const MeasuredPoint& point = list_.points[i];
      if (!point.cd) continue;
      const std::string own = plain_name(point.name);
      const bool zone = !point.at && own == "10U90U" && wanted.starts_with(own);
      if (zone || (!point.at && own == wanted)) return take(i);
    }
    return nullptr;
  }
  /// The k-th point of a row, by its place or its name.
  const MeasuredPoint* at_point(const RuleRow& row, std::size_t k) {
    for (std::size_t i = 0; i < list_.points.size(); ++i) {
      const auto p = place(list_.points[i]);
      if (list_.points[i].cd && p && std::abs(p->h_deg - row.at[k].h_deg) <= kSamePoint_deg &&
          std::abs(p->v_deg - row.at[k].v_deg) <= kSamePoint_deg)
        return take(i);
    }
    if (row.at.size() == 1) return named(row.id);
    std::string part = row.id;  // "P1+P2+P3"
    if (static_cast<std::size_t>(std::count(part.begin(), part.end(), '+')) + 1 != row.at.size()) return nullptr;
    for (std::size_t skip = 0; skip < k; ++skip) part.erase(0, part.find('+') + 1);
    return named(part.substr(0, part.find('+')));
  }
  const MeasuredPoint* peak() {
    for (const char* name : {"Imax", "Emax", "max", "maximum", "peak"}) {
      if (const MeasuredPoint* point = named(name); point != nullptr) return point;
    }
    return nullptr;
  }

  const PointList& list_;
  bool mirrored_;
  std::vector<bool> used_;
};

void take_value(CheckRow& result, const MeasuredPoint& point, HV at) {
  if (!result.has_value || *point.cd < result.lowest) result.lowest = *point.cd, result.lowest_at = at;
  if (!result.has_value || *point.cd > result.highest) result.highest = *point.cd, result.highest_at = at;
  result.has_value = true;
  result.resolution = std::max(result.resolution, 0.5 * point.step_cd);
}

CheckRow PointJudge::judge(const Rulebook& rule, const RuleRow& row) {
  CheckRow result;
  result.id = row.id;
  result.clause = row.clause;
  result.unit = "cd";
  result.shape = row.shape;
  result.unconfirmed = row.unconfirmed;
  result.min = row.min_cd;
  result.max = row.max_cd;
  result.at = row.at;
  result.has_value = false;
  bool whole = true;  // all of the row is known
  bool sum_of_all = false;
  if (row.shape == RowShape::kPoints || row.shape == RowShape::kSum) {
    double sum = 0.0, open = 0.0;
    for (std::size_t k = 0; k < row.at.size(); ++k) {
      const MeasuredPoint* point = at_point(row, k);
      if (point == nullptr) {
        if (whole) result.no_data_at = row.at[k];
        whole = false;
        continue;
      }
      take_value(result, *point, row.at[k]);
      // Measured by direction and by name: both hold.
      if (const MeasuredPoint* other = row.at.size() == 1 ? named(row.id) : nullptr; other != nullptr)
        take_value(result, *other, row.at[k]);
      sum += *point->cd;
      open += 0.5 * point->step_cd;
    }
    sum_of_all = row.shape == RowShape::kSum && result.has_value;
    if (sum_of_all) result.lowest = result.highest = sum, result.resolution = open;
    if (!whole) {  // the row by its own name
      if (const MeasuredPoint* point = row.at.size() > 1 ? named(row.id) : nullptr; point != nullptr) {
        result.has_value = false;
        take_value(result, *point, row.at.front());
        whole = true;
      }
    }
  } else if (const MeasuredPoint* point = row.shape == RowShape::kPeak ? peak() : named(row.id); point != nullptr) {
    take_value(result, *point, row.at.empty() ? HV{} : row.at.front());
  } else {
    whole = false;
    for (std::size_t i = 0; i < list_.points.size(); ++i) {
      const auto p = place(list_.points[i]);
      if (!list_.points[i].cd || !p) continue;
      if (row.shape == RowShape::kPeak || lies_in(row, *p)) take_value(result, *take(i), *p);
    }
    if (!row.at.empty()) result.no_data_at = row.at.front();
  }

  // Limits that hang on other values.
  bool limit_known = true;
  if (row.min_of_peak_01 > 0.0) {
    const MeasuredPoint* top = peak();
    double highest = top != nullptr ? *top->cd : 0.0;
    for (const MeasuredPoint& point : list_.points) highest = std::max(highest, point.cd.value_or(0.0));
    result.min = std::max(result.min, row.min_of_peak_01 * highest);
    limit_known = top != nullptr;  // else it is at least this high: below it fails, above it is open
  }
  if (row.max_factor > 0.0) {
    RuleRow other = *rule.row(row.max_of);
    other.max_factor = 0.0;
    const CheckRow of = judge(rule, other);
    if (of.has_value && !of.no_data) {
      result.max = std::min(result.max, row.max_factor * of.highest);
    } else {
      limit_known = false;
    }
  }

  result.no_data = !whole || !limit_known;
  if (result.has_value) {
    const double above = result.lowest - result.min, below = result.max - result.highest;
    result.by_min = result.min > kNoMinimum && (result.max >= kNoMaximum || above < below);
    result.margin = result.by_min ? above : below;
  }
  result.verdict = !result.has_value                             ? RuleVerdict::kNoData
                   : std::abs(result.margin) < result.resolution ? RuleVerdict::kWithinResolution
                   : result.margin >= 0.0                        ? RuleVerdict::kPass
                                                                 : RuleVerdict::kFail;
  if (!result.no_data) return result;
  result.not_measured = true;
  const bool enough = result.has_value && result.by_min && result.verdict == RuleVerdict::kPass && limit_known &&
                      result.max >= kNoMaximum && (sum_of_all || row.shape == RowShape::kPeak);
  // Part of a sum, or a peak that may yet be higher, misses no least.
  const bool open_least = (sum_of_all || row.shape == RowShape::kPeak) && result.by_min;
  const bool failed = result.has_value && result.verdict == RuleVerdict::kFail && !open_least;
  if (enough || failed) return result;
  result.verdict = RuleVerdict::kNoData;
  if (!limit_known && row.max_factor > 0.0 && result.max >= kNoMaximum) result.has_value = false;
  return result;
}

}  // namespace

std::string function_of_beam(const std::string& beam) {
  const std::string name = upper_case(beam);
  const auto has = [&](std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&](const char* w) { return name.find(w) != std::string::npos; });
  };
  if (has({"FOG"})) return "fog";
  if (has({"LOW", "PASS", "DIPPED"}) || name.starts_with("LB")) return "low";
  if (has({"HIGH", "UPPER", "DRIV", "MAIN"}) || name.starts_with("UB") || name.starts_with("HB")) return "high";
  return "";
}

int points_for_right(const PointList& list, const Rulebook& rule) {
  return static_cast<int>(PointJudge(list, false).matches(rule)) -
         static_cast<int>(PointJudge(list, true).matches(rule));
}

CheckResult check_points(const PointList& list, const Rulebook& rulebook, const CheckOptions& options,
                         std::vector<std::string>* unused) {
  const Rulebook rule = options.led_module ? rulebook.for_led_modules() : rulebook;
  CheckResult result;
  result.rule_id = rule.id;
  result.rule_name = rule.name;
  result.document = rule.document;
  result.function = rule.function;
  result.aim_method = "as measured";
  const int for_right = points_for_right(list, rule);
  result.left_hand = options.traffic == TrafficSide::kFind ? for_right < 0 : options.traffic == TrafficSide::kLeft;
  result.traffic_source = options.traffic != TrafficSide::kFind ? TrafficSource::kGiven
                          : for_right != 0                      ? TrafficSource::kFound
                                                                : TrafficSource::kAssumed;
  PointJudge judge(list, result.left_hand);
  for (const RuleRow& row : rule.rows) result.rows.push_back(judge.judge(rule, row));
  const auto not_measured = [&](std::string id, const std::string& clause, std::string unit, double min, double max) {
    CheckRow row;
    row.id = std::move(id);
    row.clause = clause;
    row.unit = std::move(unit);
    row.min = min;
    row.max = max;
    row.shape = RowShape::kPeak;
    row.has_value = false;
    row.no_data = row.not_measured = true;
    row.verdict = RuleVerdict::kNoData;
    result.rows.push_back(std::move(row));
  };
  if (!rule.cutoff_aims.empty()) {
    const CutoffAim& aim = rule.cutoff_aims.front();
    if (aim.sharpness_min > 0.0 || aim.sharpness_max < kNoMaximum)
      not_measured("cut-off sharpness G", aim.clause, "", aim.sharpness_min, aim.sharpness_max);
    if (!aim.linearity_h_deg.empty())
      not_measured("cut-off linearity", aim.clause, "deg", kNoMinimum, aim.linearity_max_deg);
  }
  if (rule.flux_min_lm > 0.0) not_measured("luminous flux", rule.clause, "lm", rule.flux_min_lm, kNoMaximum);
  if (result.left_hand) mirror_rows(result.rows);
  count_rows(result);
  if (unused != nullptr) *unused = judge.unused();
  return result;
}

}  // namespace phare
