// What of a triangle lies before a plane across a lamp's axis: what reaches past the lamp has no place in its view.
#pragma once

#include <array>
#include <cstddef>

namespace phare {

/// None, three or four corners in their order: forward, left, up.
template <typename Corner>
struct ClippedTriangle {
  std::array<Corner, 4> corners{};
  std::size_t count = 0;
};

/// By Sutherland and Hodgman 1974.
template <typename Corner>
ClippedTriangle<Corner> ahead_of(typename Corner::value_type near_m, const std::array<Corner, 3>& triangle) {
  ClippedTriangle<Corner> clipped;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = triangle[i], &b = triangle[(i + 1) % 3];
    if (a.x >= near_m) clipped.corners[clipped.count++] = a;
    if ((a.x < near_m) == (b.x < near_m)) continue;
    const Corner at = a + (b - a) * ((near_m - a.x) / (b.x - a.x));
    clipped.corners[clipped.count++] = {near_m, at.y, at.z};
  }
  return clipped;
}

}  // namespace phare
