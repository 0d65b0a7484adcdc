// The lane that belongs to a scene: the line that the car's origin follows on it. Reader of its CSV file, the only one.
#pragma once

#include <filesystem>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// World frame; heading from x to y, curvature positive to the left.
struct LanePoint {
  double s_m = 0.0, x_m = 0.0, y_m = 0.0, z_m = 0.0, heading_rad = 0.0, curvature_1pm = 0.0;
};

/// "country_road.glb" has "country_road_lane.csv" beside it.
std::filesystem::path lane_file_of(const std::filesystem::path& scene_file);

/// Columns s_m, x_m, y_m, z_m, heading_rad, curvature_1pm, in any order; s_m rises; at least two points. Errors with
/// file:line.
Result<std::vector<LanePoint>> read_lane(const std::filesystem::path& file);

/// The first point of a lane file, which may lack s_m and curvature_1pm and have no other point.
Result<LanePoint> read_lane_start(const std::filesystem::path& file);

/// The lane of a scene; empty where it has none beside it, or where the file is of one point and says the start alone.
Result<std::vector<LanePoint>> lane_beside(const std::filesystem::path& scene_file);

}  // namespace phare
