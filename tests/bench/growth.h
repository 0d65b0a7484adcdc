// Scenes that grow in one thing alone, and the curve of what that costs.
#pragma once

#include <string>
#include <vector>

#include "visual/scene/scene.h"

namespace phare::bench {

/// `count` posts more, each in a cell of the ground of its own and so a draw of two triangles, some pixels large:
/// between 200 and 3000 m ahead of the origin, within 25° of x.
Scene with_more_draws(const Scene& scene, std::size_t count);

/// One point of a curve.
struct GrowthPoint {
  double amount = 0.0;  ///< of what grows
  double cpu_ms = 0.0, floors = 0.0;
};

/// A line a point with a bar, and the straight line of least squares through all: what the first costs, what each more.
std::string growth_curve(const std::string& title, const std::string& unit, const std::vector<GrowthPoint>& points);

}  // namespace phare::bench
