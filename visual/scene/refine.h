// The same surfaces from more triangles: what methods need that compute light at the vertices. Pure.
#pragma once

#include <functional>

#include "visual/scene/scene.h"

namespace phare {

/// Each triangle in four, the new corners in the middle of its sides, `times` times over; of chunks whose material
/// `which` names, the others as they are. Corners stay shared within a chunk.
Scene refined(
    const Scene& scene, int times,
    const std::function<bool(const SceneMaterial&)>& which = [](const SceneMaterial&) { return true; });

/// In the middle between two corners.
CornerLook look_between(const CornerLook& a, const CornerLook& b);

/// Roads, their markings and the ground beside them, which share sides.
bool is_ground(const SceneMaterial& material);

}  // namespace phare
