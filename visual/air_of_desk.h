// The air that the desk has set.
#pragma once

#include "config/desk.h"
#include "visual/photometry/table/air.h"

namespace phare {

inline Air air_of(const Desk& desk) {
  return {.visibility_m = desk.visibility_m, .rain_mmph = desk.rain_mmph, .snow_mmph = desk.snow_mmph};
}

}  // namespace phare
