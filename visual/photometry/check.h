// A lamp judged by a rulebook: aimed as the rule says, every row evaluated, each with its margin and what the file's
// own grid and digits leave open.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "visual/photometry/cutoff.h"
#include "visual/photometry/intensity_table.h"
#include "visual/photometry/rulebook.h"

namespace phare {

/// kWithinResolution: the margin, for or against, is smaller than what the file can tell.
enum class Verdict { kPass, kWithinResolution, kFail };

struct CheckRow {
  std::string id;
  std::string clause;
  std::string unit;         ///< "cd", "lm", "deg" or "" (G)
  double min = kNoMinimum;  ///< limits as they apply, shares of the peak and factors worked out
  double max = kNoMaximum;
  double lowest = 0.0;  ///< over the row's points; of a sum, the sum
  double highest = 0.0;
  HV lowest_at, highest_at;  ///< in the frame of the rule, mirrored rows as mirrored
  double margin = 0.0;       ///< smallest distance to a limit; negative: missed by that
  double resolution = 0.0;   ///< what interpolation and rounding of the table may be off there
  HV reaim;                  ///< FMVSS: the quarter degree that this row used (right, up)
  Verdict verdict = Verdict::kPass;
  std::string unconfirmed;  ///< from the rulebook
  RowShape shape = RowShape::kPoints;
  std::vector<HV> at;  ///< the row's place, mirrored where the check was
};

struct CheckResult {
  std::string rule_id, rule_name, document;
  bool left_hand = false;   ///< rows were mirrored
  std::string aim_method;   ///< "as filed", "cut-off", "VOL", "VOR", "given"
  double aim_up_deg = 0.0;  ///< the lamp was turned by this from how the file has it
  double aim_right_deg = 0.0;
  bool reaimed = false;  ///< the re-aim allowance of the rule was used
  Cutoff cutoff;         ///< on the rule's scan, as aimed
  std::vector<CheckRow> rows;
  std::size_t failed = 0, within_resolution = 0, unconfirmed = 0;
  Verdict verdict = Verdict::kPass;
};

enum class Traffic { kFind, kRight, kLeft };

struct CheckOptions {
  Traffic traffic = Traffic::kFind;  ///< kFind: by the side on which the cut-off rises
  std::optional<HV> aim;             ///< turn the lamp by this (right, up) instead of what the rule says
  bool reaim = true;                 ///< use the rule's allowance where the first aim fails
};

/// Checks one lamp, or the left and right one where the rule says half the sum (one table stands for both).
CheckResult check_lamp(std::span<const IntensityTable* const> tables, const Rulebook& rule,
                       const CheckOptions& options = {});

/// What bilinear interpolation and the digits of the file leave open at these angles of the table, cd: the second
/// differences of the neighbouring nodes over 8 (the bound of linear interpolation), scaled to where between the nodes,
/// and half a unit of the last digit.
double interpolation_error_cd(const IntensityTable& table, TableAngles angles);

}  // namespace phare
