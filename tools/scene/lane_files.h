// The two tables beside the scene: the right-hand lane metre by metre, and where things stand along it.
#pragma once

#include <string>

#include "tools/scene/alignment.h"

namespace phare::scene {

/// Stations (m along the centreline) of what a drive meets; the scene's objects are built from the same numbers.
inline constexpr double kPedestrian1_m = 180.0;  ///< dark clothes, right verge
inline constexpr double kParkedCar_m = 240.0;    ///< lay-by on the right
inline constexpr double kBarn_m = 462.0;         ///< outside of the first bend, its light wall faces the driver
inline constexpr double kPedestrian2_m = 640.0;  ///< steps towards the road from the right
inline constexpr double kCyclist_m = 862.0;      ///< on the right edge, behind the crest
inline constexpr double kRailDipBegin_m = 1010.0, kRailDipEnd_m = 1130.0;    ///< right side, through the dip
inline constexpr double kRailBendBegin_m = 1230.0, kRailBendEnd_m = 1490.0;  ///< left side, outside of the second bend
inline constexpr double kWoodBegin_m = 1545.0, kWoodEnd_m = 1770.0;

/// CSV `s_m,x_m,y_m,z_m,heading_rad,curvature_1pm`: centre of the right-hand lane, each metre of its own arc length.
std::string lane_csv(const Alignment& road);

/// JSON object: name → {"s_m": …} or {"begin_s_m": …, "end_s_m": …}; s as in the lane's CSV.
std::string places_json(const Alignment& road);

}  // namespace phare::scene
