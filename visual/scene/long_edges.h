// A place on a triangle comes out of its corners in float32, and where they stand kilometres away it is off by as much
// as shows on the slope of a beam: 1e-4 of the lux 30 m ahead where the ground is one square of 2 km. So edges longer
// than kLongestEdge_m are halved until none is left. Whether an edge is halved, and where, hangs on its two ends alone,
// so that neighbours stay together. Checked by tests/visual/long_edges_test.cpp.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "visual/scene/scene.h"

namespace phare {

struct MeshCorner {
  glm::dvec3 position;  ///< world, m
  glm::vec3 normal{0.0f};
};

/// Corners of a primitive; looks only where its material has one.
struct MeshCorners {
  std::vector<MeshCorner> at;
  std::vector<CornerLook> looks{};
};

inline constexpr double kLongestEdge_m = 128.0;

/// Puts what was halved in place of `triangles`, three indices of `corners` each, and new corners behind the others.
/// Returns the longest edge that there may be now, m: where more than 65,536 triangles and as many again as there were
/// would come of it, kLongestEdge_m times a power of two.
double halve_long_edges(MeshCorners& corners, std::vector<std::uint32_t>& triangles);

}  // namespace phare
