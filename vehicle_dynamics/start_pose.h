// Where a drive begins when nothing else says so: on the lane that belongs to the scene.
#pragma once

#include <filesystem>

#include "config/road/lane.h"
#include "vehicle_dynamics/state.h"

namespace phare {

/// The car at rest on the first row of a lane file.
Result<CarState> start_of_lane(const std::filesystem::path& lane_file);

}  // namespace phare
