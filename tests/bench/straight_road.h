// The road that frame times are quoted for: straight, level, little on it, so that light is what costs.
#pragma once

#include "visual/photometry/table/intensity_table.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare::bench {

/// 200 m of road 8 m wide, ground to 60 m on both sides, 20 sign plates on posts, 10 boxes of a person's size, one of a
/// car's: about 700 triangles, six Lambert materials, no surface detail. Made by us to the measures of the road that
/// other engines were timed on.
Scene straight_road();

/// A low beam of our own formula for right-hand traffic, 256 × 128 nodes over H ±45°, V −20° to 10°, peak 30,000 cd.
enum class Nodes { kEven, kRounded };  ///< as computed, or rounded to 1e-4° as a file has them
IntensityTable straight_road_beam(Nodes nodes);

/// Driver's eye and both lamps of a car at `x_m`.
FrameInput straight_road_view(double x_m);

}  // namespace phare::bench
