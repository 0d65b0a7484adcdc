// The point of the scene under a pixel, on the CPU in float64: for the lux probe under the mouse.
#pragma once

#include <optional>

#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {

struct Ray {
  glm::dvec3 origin_m{0.0};
  glm::dvec3 direction{1.0, 0.0, 0.0};  ///< unit
};

/// Through the middle of a pixel, counted from the top left of a picture of this size.
Ray ray_through(const Camera& camera, double x_px, double y_px, int width_px, int height_px);

/// The nearest triangle hit within `most_m`, with its flat unit normal turned toward the ray's origin. Tests every
/// triangle of every chunk whose box the ray meets: well below a millisecond for our scenes, so it needs no tree.
std::optional<MeasurePoint> pick(const Scene& scene, const Ray& ray, double most_m = 1000.0);

}  // namespace phare
