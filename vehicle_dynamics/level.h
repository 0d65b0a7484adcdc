// Names of the levels of the car.
#pragma once

#include <string>

#include "config/base/result.h"

namespace phare {

/// The ladder of models; those not yet there are refused by name. What each can do: levels.h.
/// kAuto: kinematic, single-track or full, by what the scene calls for.
enum class Level { kPose, kKinematic, kSingleTrack, kFull, kAuto };

const char* name(Level level);

/// Of those that auto goes up and down on: 0 kinematic, 1 single-track, 2 full.
constexpr int rung_of(Level level) {
  return static_cast<int>(level) - static_cast<int>(Level::kKinematic);
}
constexpr Level level_of_rung(int rung) {
  return static_cast<Level>(rung + static_cast<int>(Level::kKinematic));
}

/// The level of that name, or an Error that names those there are. `place`: flag or file the name came from.
Result<Level> parse_level(const std::string& text, const std::string& place);

}  // namespace phare
