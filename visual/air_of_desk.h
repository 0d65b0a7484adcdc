// Weather that the desk has set.
#pragma once

#include "config/desk.h"
#include "visual/photometry/table/air.h"

namespace phare {

inline Air air_of(const Desk& desk) {
  return {.visibility_m = desk.visibility_m, .rain_mmph = desk.rain_mmph, .snow_mmph = desk.snow_mmph};
}

/// There is water on the ground.
inline bool wet(const Desk& desk) {
  return desk.ground.value_or(desk.rain_mmph > 0.0 ? 1 : 0) > 0;
}

/// What shows most of others' lamps is their light in a mirror or in the air (visual/process/traffic.h).
inline bool lamps_toward_first(const Desk& desk) {
  return wet(desk) || extinction_per_m(air_of(desk)) > 0.0;
}

}  // namespace phare
