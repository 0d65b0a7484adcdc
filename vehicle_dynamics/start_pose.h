// Where a drive begins when nothing else says so: on the lane that belongs to the scene.
#pragma once

#include <filesystem>

#include "config/result.h"
#include "vehicle_dynamics/state.h"

namespace phare {

/// The lane file of a scene: "country_road.glb" has "country_road_lane.csv" beside it.
std::filesystem::path lane_file_of(const std::filesystem::path& scene_file);

/// The car at rest on the first row of a lane file (columns x_m, y_m, z_m, heading_rad, in any order).
Result<CarState> start_of_lane(const std::filesystem::path& lane_file);

}  // namespace phare
