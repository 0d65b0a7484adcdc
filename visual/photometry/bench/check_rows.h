// One row of a rulebook looked at in a beam; check.h is the door.
#pragma once

#include "visual/photometry/bench/check.h"
#include "visual/photometry/bench/rule_beam.h"
#include "visual/photometry/bench/rulebook.h"

namespace phare {

/// Lowest, highest and margin. `shift` looks at places moved by it, as if the beam were turned the other way (exact to
/// second order); `coarse` walks in 0.25° for searches.
CheckRow judge_row(RuleBeam& beam, const Rulebook& rule, const RuleRow& row, HV shift, bool coarse);

/// Adds to the resolution what interpolation and digits leave open, and tells the verdict.
void conclude_row(const RuleBeam& beam, const RuleRow& row, CheckRow& result);

/// Is a place in a row's line, area or polygon, edges included?
bool lies_in(const RuleRow& row, HV p);

/// Back to the lamps' own left and right.
void mirror_rows(std::vector<CheckRow>& rows);

/// Counts the rows' verdicts into the result's.
void count_rows(CheckResult& result);

}  // namespace phare
