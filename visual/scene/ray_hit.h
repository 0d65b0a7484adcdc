// Where a ray meets the world, on the CPU in float64: for the lux under the mouse, and for what stands between a lamp
// and a point.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "visual/scene/world.h"

namespace phare {

struct RayHit {
  double distance_m = 0.0;
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< of the triangle, unit, toward the ray's origin
  const SceneChunk* chunk = nullptr;
  const Scene* scene = nullptr;  ///< that the chunk is of: what stands, or the meshes of what moves
};

/// The nearest triangle that the ray meets between `least_m` and `most_m`, by Möller and Trumbore 1997. `direction`:
/// unit. Tests every triangle of every chunk whose box the ray meets: well below a millisecond for our scenes, so it
/// needs no tree.
std::optional<RayHit> ray_hit(const World& world, const glm::dvec3& origin_m, const glm::dvec3& direction,
                              double least_m, double most_m);

/// What hides the lamp from the point: the chunk that is nearest to the point; nullptr: nothing. A surface that the
/// point lies on, within a millimetre of the way, hides nothing; nor does paint, which a scene lays on a road by its
/// thickness or more, and whose edge would hide a decimetre of road at grazing light.
const SceneChunk* occluder(const World& world, const glm::dvec3& lamp_m, const glm::dvec3& point_m);

/// What it is called: its node.
const std::string& name_of(const SceneChunk& chunk);

}  // namespace phare
