// How slippery a road is along a path: zones for the left and the right track. Reader of their CSV columns.
#pragma once

#include <filesystem>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// A piece of path with its own friction, for either track; 1: as the tyre was measured.
struct FrictionZone {
  double from_m = 0.0, to_m = 0.0;
  double left = 1.0, right = 1.0;
};

/// Least and most friction that any input may give.
inline constexpr double kLeastFriction = 0.01, kMostFriction = 2.0;

/// Of a CSV with x_m and friction, or friction_left and friction_right: each row holds from its x_m to the next row's,
/// the last one for good. Empty when it has none of these columns (a height profile alone). Errors name file and line:
/// one of the columns missing, out of range, x_m that does not rise, more than 64 changes.
Result<std::vector<FrictionZone>> read_friction(const std::filesystem::path& csv_file);

/// "country_road.glb" may have "country_road_friction.csv" beside it.
std::filesystem::path friction_file_of(const std::filesystem::path& scene_file);

}  // namespace phare
