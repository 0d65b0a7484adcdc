// Which drops and flakes a view shows one by one. Pure: no device.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "visual/photometry/table/air.h"
#include "visual/view.h"

namespace phare {

/// When a picture is, and how its eye moves: drops fall past it.
struct Falling {
  double time_s = 0.0;
  glm::dvec3 eye_mps{0.0};  ///< in the world
};

/// So far from the eye a view of perspective shows the drops of a class: all that lies nearer and in view lies within
/// the cube before the eye, however that is turned.
double drawn_to_m(const DropClass& drops, const ViewGeometry& view);

/// Of what all particles scatter, what a view shows one by one: shares[i] up to to_m[i], from the smallest class on.
struct DrawnShares {
  std::array<double, kDropClasses> to_m{}, shares{};
};
DrawnShares drawn_shares(const Particles& particles, const ViewGeometry& view);

}  // namespace phare
