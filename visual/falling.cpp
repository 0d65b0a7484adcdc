#include "visual/falling.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace phare {

// The cube's middle lies half an edge before the eye, and the ball about that of half an edge in the cube. The cone of
// the view with its tip in the eye lies in that ball up to the edge times the cosine of its half angle.
double drawn_to_m(const DropClass& drops, const ViewGeometry& view) {
  double least = 1.0;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const glm::dvec3 corner(view.direction_from_clip() * glm::dvec4(x, y, 1.0, 0.0));
      least = std::min(least, glm::dot(glm::normalize(corner), view.camera().world_from_eye[0]));
    }
  return drops.cube_m * least;
}

DrawnShares drawn_shares(const Particles& particles, const ViewGeometry& view) {
  DrawnShares drawn;
  const auto classes = drop_classes(particles);
  for (std::size_t i = 0; i < kDropClasses; ++i)
    drawn.to_m[i] = drawn_to_m(classes[i], view), drawn.shares[i] = classes[i].share;
  return drawn;
}

}  // namespace phare
