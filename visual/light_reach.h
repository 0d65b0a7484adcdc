// Whether a lamp can light anything that a view sees: a bound from the outside, so a lamp that is left out by it gives
// exactly nothing there. Pure: no device.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/view.h"

namespace phare {

/// A cone that holds every direction in which a beam image shines. Frame of the image: forward, left, up.
struct LightCone {
  glm::dvec3 axis{1.0, 0.0, 0.0};  ///< unit
  double half_angle_rad = 0.0;     ///< pi: every direction. Below 0: none, the beam is dark
};

/// About the smallest rectangle of the table that has all light, one node wider, and a little more, for the levels of
/// beam images that blur by a texel. At most 2.5° wider than the light on tables of 180°.
LightCone light_cone(const BeamImage& image);

/// The cone when only these rectangles of nodes have changed; never narrower than `before`.
LightCone light_cone_after(const LightCone& before, const BeamImage& image, std::span<const TexelRect> changed);

/// The same cone in the world, its tip at the lamp.
struct LampReach {
  glm::dvec3 tip_m{0.0};
  LightCone cone;

  LampReach(const glm::dvec3& position_m, const glm::dmat3& world_from_image, const LightCone& of_image)
      : tip_m(position_m), cone{world_from_image * of_image.axis, of_image.half_angle_rad} {}

  /// False only if no point of the view is in the cone.
  bool meets(const ViewGeometry& view) const;
  /// False only if no point of the box [low, high] of the world is.
  bool meets(const glm::dvec3& low_m, const glm::dvec3& high_m) const;
};

}  // namespace phare
