// Lists of measured points for the lamp bench: which files are some, and the names that they may use.
#pragma once

#include <optional>
#include <string>

#include "config/result.h"
#include "visual/photometry/point_list.h"
#include "visual/photometry/read_lamp.h"

namespace phare {

/// The file as a list of points; nothing where it is none, and then read_lamp is to be asked.
Result<std::optional<PointLists>> read_as_points(const std::string& file, const LampReadSettings& settings);

/// The beams of a list that are called `beam` in any case; all where it is empty. The error names those there are.
Result<std::vector<PointList>> beams_named(const PointLists& lists, const std::string& beam);

/// "led.csv", "led.csv, low beam".
std::string list_title(const std::string& file, const PointList& list);

}  // namespace phare
