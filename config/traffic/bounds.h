// Bounds that no road user reaches: they catch a mistyped exponent. python/phare/control/road_users.py and
// recorded_path.py have the same.
#pragma once

namespace phare {

inline constexpr double kFarthestOfRoadUsers_m = 1e6, kFastestOfRoadUsers_kmh = 1000.0, kLongestOfRoadUsers_s = 1e9;

}  // namespace phare
