// The point of the world under a pixel, on the CPU in float64: for the lux probe under the mouse.
#pragma once

#include <optional>

#include "visual/renderer.h"
#include "visual/scene/world.h"

namespace phare {

/// The nearest triangle hit within `most_m`, with its flat unit normal turned toward the ray's origin
/// (visual/scene/ray_hit.h).
std::optional<MeasurePoint> pick(const World& world, const Ray& ray, double most_m = 1000.0);

/// What a picture shows at a place of it, in shares of its width and height from the upper left corner: of the view
/// that is drawn there last. `world` has what moves in none of its views; `aspect`: width of the picture over its
/// height.
std::optional<MeasurePoint> pick(const World& world, const FrameInput& picture, double aspect, double x_01,
                                 double y_01);

}  // namespace phare
