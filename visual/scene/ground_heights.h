// How high the ground is at least, by cells: what lies beneath it is hidden from an eye above it. Pure: no device.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "visual/scene/scene.h"

namespace phare {

class GroundHeights {
 public:
  GroundHeights() = default;  ///< nowhere
  explicit GroundHeights(const Scene& scene);

  bool none() const { return least_m_.empty(); }
  double cell_m() const { return cell_m_; }
  /// What the ground (is_ground) of the cell around a place of the world and of those beside it is nowhere below, m:
  /// where it lies in layers, the lowest. NaN where it does not cover them without gaps, or is steeper than 45°
  /// between them, as at a wall or under a bridge without ground.
  float least_m(const glm::dvec2& at_m) const;

 private:
  glm::dvec2 low_m_{0.0};
  double cell_m_ = 1.0;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<float> least_m_;  ///< row by row
};

}  // namespace phare
