// Lists of measured points for the lamp bench: which files are some, and the names that they may use.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "visual/photometry/bench/check.h"
#include "visual/photometry/readers/point_list.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {

/// The file as a list of points; nothing where it is none, and then read_lamp is to be asked.
Result<std::optional<PointLists>> read_as_points(const std::string& file, const LampReadSettings& settings);

/// The beams of a list that are called `beam` in any case; all where it is empty. The error names those there are.
Result<std::vector<PointList>> beams_named(const PointLists& lists, const std::string& beam);

/// Of several beams those that a rule can be for: a beam that by its name has another function than the rule is left
/// out. All where none would be left.
std::vector<PointList> beams_for(const std::vector<PointList>& lists, const Rulebook& rule);

/// As check_points, but for the side of traffic that all rulebooks of the rule's function tell together, so that a list
/// is not taken for one side by one rule and for the other by the next.
CheckResult check_list(const PointList& list, const Rulebook& rule, std::span<const Rulebook> rules,
                       CheckOptions options, std::vector<std::string>& unused);

/// "led.csv", "led.csv, low beam".
std::string list_title(const std::string& file, const PointList& list);

}  // namespace phare
