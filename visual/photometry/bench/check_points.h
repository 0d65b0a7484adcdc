// A laboratory's list of points judged by a rulebook: the rows that have their point, and what a point decides of the
// others.
#pragma once

#include <string>
#include <vector>

#include "visual/photometry/bench/check.h"
#include "visual/photometry/readers/point_list.h"

namespace phare {

/// As the laboratory aimed the lamp; nothing is re-aimed or interpolated. A row has a verdict
/// - of points, where each is in the list (within kSamePoint_deg, or by its name),
/// - of a line, an area or the peak, where the list names it as a whole, or where a point of the list that lies in it
///   breaks the limit (or makes the peak's least),
/// - of a sum, where all its points are there, or those that are decide.
/// The rest is not measured: kNoData with `not_measured`. `unused` gets the measured points that no row looked at.
/// Side of traffic: the one on which more points of the rule are in the list; of equals the right, assumed.
CheckResult check_points(const PointList& list, const Rulebook& rule, const CheckOptions& options,
                         std::vector<std::string>* unused = nullptr);

/// How many more of the rule's points the list has for right-hand traffic than for left-hand traffic.
int points_for_right(const PointList& list, const Rulebook& rule);

/// Where a list's point is taken for a rule's: laboratories print 0.01°.
inline constexpr double kSamePoint_deg = 0.015;

/// Low, high or fog by the beam's name in the list; empty: not told.
std::string function_of_beam(const std::string& beam);

}  // namespace phare
