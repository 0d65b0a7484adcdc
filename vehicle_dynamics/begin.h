// What a drive starts from: the rig's car, its road with what lies on it, and the car at simulated time 0.
#pragma once

#include <optional>
#include <string>

#include "config/rig.h"
#include "vehicle_dynamics/levelling.h"
#include "vehicle_dynamics/road_laid.h"
#include "vehicle_dynamics/step.h"

namespace phare {

struct Begin {
  RunSetup setup;
  CarState state;
};

/// What is asked for besides the rig.
struct BeginOptions {
  std::string level{};                         ///< empty: the rig's
  std::string drive_file{};                    ///< to replay (level pose), or to take the first pose from
  std::optional<levelling::Kind> levelling{};  ///< nothing: the vehicle file's
  Conditions conditions{};
};

/// Error: a file that cannot be read, or an option that does not fit the level.
Result<Begin> begin_of(const Rig& rig, const BeginOptions& options);

}  // namespace phare
