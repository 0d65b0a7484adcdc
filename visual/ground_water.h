// How much water stands on a road. Pure.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "config/desk.h"

namespace phare {

/// Of the road, chosen: mean depth of its texture.
inline constexpr double kRoadTexture_mm = 0.8;

/// Depth of the film over the texture of a road, mm (Gallaway et al. 1979): 4 m from the crown, 2 % across. Negative:
/// the texture still stands out.
inline double film_mm(double rain_mmph) {
  constexpr double kPath_m = 4.0, kSlope = 0.02;
  return 0.01485 * std::pow(kRoadTexture_mm, 0.11) * std::pow(kPath_m, 0.43) * std::pow(rain_mmph, 0.59) /
             std::pow(kSlope, 0.42) -
         kRoadTexture_mm;
}

/// Water in the texture and over it, mm: as it rains, within what the level of the effect `ground` (kWetNames) stands
/// for; without rain a chosen depth of that level.
inline double water_mm(double rain_mmph, std::size_t level) {
  static constexpr std::array<double, 4> kLeast_mm{0.0, 0.02, 0.1, kRoadTexture_mm},
      kMost_mm{0.0, 0.1, kRoadTexture_mm, 2.5}, kAfterRain_mm{0.0, 0.05, 0.4, 1.2};
  static_assert(kAfterRain_mm.size() == kWetNames.size());
  if (rain_mmph <= 0.0) return kAfterRain_mm[level];
  return std::clamp(film_mm(rain_mmph) + kRoadTexture_mm, kLeast_mm[level], kMost_mm[level]);
}

}  // namespace phare
