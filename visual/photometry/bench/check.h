// A lamp judged by a rulebook: aimed as the rule says, every row evaluated, each with its margin and what the file's
// own grid and digits leave open.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "visual/photometry/bench/cutoff.h"
#include "visual/photometry/bench/rule_beam.h"
#include "visual/photometry/bench/rulebook.h"
#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// kWithinResolution: the margin, for or against, is smaller than what the file can tell; kNoData: the table does not
/// reach all of the row's place, and what it has does not fail. From good to bad.
enum class RuleVerdict { kPass, kWithinResolution, kNoData, kFail };

/// "pass", "within resolution", "no data", "fail".
std::string verdict_name(RuleVerdict verdict);

struct CheckRow {
  std::string id;
  std::string clause;
  std::string unit;         ///< "cd", "lm", "deg" or "" (G)
  std::string open{};       ///< what would meet the clause too, and was not looked at; empty: nothing
  double min = kNoMinimum;  ///< limits as they apply, shares of the peak and factors worked out
  double max = kNoMaximum;
  double lowest = 0.0;  ///< over the row's points; of a sum, the sum
  double highest = 0.0;
  HV lowest_at, highest_at;   ///< in the frame of the rule, mirrored rows as mirrored
  bool by_min = false;        ///< the margin is that to the lower limit, of `lowest`
  bool has_value = true;      ///< false: nothing to measure there; lowest, highest and margin are 0
  double margin = 0.0;        ///< smallest distance to a limit; negative: missed by that
  double resolution = 0.0;    ///< what interpolation and rounding of the table may be off there
  bool no_data = false;       ///< somewhere in the row, first at `no_data_at`; values are of the rest
  bool not_measured = false;  ///< no data, of a list of points: kNoData is then "not measured"
  HV no_data_at;
  HV reaim;                       ///< FMVSS: the quarter degree that the deciding point used (right, up)
  std::vector<HV> reaims;         ///< of each point, where the row has several and was re-aimed
  std::optional<HV> passes_by{};  ///< the re-aim without which the row does not pass (right, up); empty: none needed
  RuleVerdict verdict = RuleVerdict::kPass;
  std::string unconfirmed;  ///< from the rulebook
  RowShape shape = RowShape::kPoints;
  std::vector<HV> at;  ///< the row's place, mirrored where the check was

  double value() const { return by_min ? lowest : highest; }  ///< that decides
};

/// Of a row: "not measured" where a list of points lacks it.
std::string verdict_name(const CheckRow& row);

/// How one lamp was aimed.
struct LampAim {
  bool found = true;    ///< false: the rule aims by the cut-off and there is none; as filed
  double up_deg = 0.0;  ///< turned by this from how the file has it
  double right_deg = 0.0;
  Cutoff cutoff;                ///< on the rule's scan, as aimed
  double row_step_deg = 0.0;    ///< of the table at the cut-off
  double resolution_deg = 0.0;  ///< to this the rows tell the inflection
};

/// How the side of traffic came about. kAssumed: no cut-off that rises tells it.
enum class TrafficSource { kGiven, kFound, kAssumed };

/// "given", "by the cut-off", "assumed".
std::string traffic_source_name(TrafficSource source);

struct CheckResult {
  std::string rule_id, rule_name, document;
  std::string function;    ///< of the rule: "low", "high", "fog"
  bool left_hand = false;  ///< rows were mirrored
  TrafficSource traffic_source = TrafficSource::kAssumed;
  CutoffShape shape;       ///< of the first lamp that tells its side, else of the first; as filed
  std::string other_side;  ///< an assumed side: the verdict for the other one, "fail, 12 rows"; empty: the same rows
  std::string aim_method;  ///< "as filed", "cut-off", "VOL", "VOR", "given", "as measured", "no cut-off found, as
                           ///< filed"
  std::string aim_unconfirmed;  ///< from the rulebook
  double aim_up_deg = 0.0;      ///< of the first lamp
  double aim_right_deg = 0.0;
  bool reaimed = false;        ///< the re-aim allowance of the rule was used
  HV reaim;                    ///< by this (right, up) on top of the rule's aim
  Cutoff cutoff;               ///< of the first lamp
  std::vector<LampAim> lamps;  ///< each by its own cut-off
  std::vector<CheckRow> rows;
  std::size_t failed = 0, within_resolution = 0, no_data = 0, unconfirmed = 0;
  double shortfall = 0.0;  ///< of the failed rows, in parts of their limits: which of two verdicts is the worse
  RuleVerdict verdict = RuleVerdict::kPass;
};

enum class TrafficSide { kFind, kRight, kLeft };

struct CheckOptions {
  TrafficSide traffic = TrafficSide::kFind;  ///< kFind: by the side on which the cut-off rises
  std::optional<HV> aim;             ///< turn the lamp by this (right, up) instead of what the rule says
  bool reaim = true;                 ///< use the rule's allowance where the first aim fails
  std::string aim_name{};            ///< which of the rule's aims ("VOL", "VOR"); empty or unknown: by the beam
  bool led_module = false;           ///< limits for LED modules where the rule has their own
};

/// Lamps of a pair for different sides of the road? The error names which is which.
Status same_traffic(std::span<const IntensityTable* const> tables);

/// Checks one lamp, or the left and right one where the rule says half the sum (one table stands for both): each is
/// aimed by its own cut-off, then the rows are looked at in half the sum. Where nothing tells the side of traffic, a
/// passing beam is judged for both, and the side that it does better on is assumed: so a mirrored lamp gets the
/// mirrored verdict.
CheckResult check_lamp(std::span<const IntensityTable* const> tables, const Rulebook& rule,
                       const CheckOptions& options = {});

}  // namespace phare
