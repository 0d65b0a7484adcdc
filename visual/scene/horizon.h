// What the ground hides from an eye that is above it: behind a crest nothing need be drawn. On the safe side, and pure:
// no device.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "visual/scene/ground_heights.h"

namespace phare {

class Horizon {
 public:
  /// `ground` is read as it is asked for.
  Horizon(const GroundHeights& ground, const glm::dvec3& eye_m);

  /// True only if every way from the eye into the box of the world leads through the ground before it, as it is drawn
  /// in full or from afar (visual/scene/far_mesh.h).
  bool hides(const glm::dvec3& low_m, const glm::dvec3& high_m);

 private:
  static constexpr int kSectors = 512;  ///< all round, of 0.45° to 0.9°
  const float* sector(int number);

  const GroundHeights* ground_;
  glm::dvec3 eye_m_;
  std::size_t steps_ = 0;                        ///< of a cell each, away from the eye
  std::array<std::int16_t, kSectors> row_of_{};  ///< in `above_`; -1: not looked at yet
  /// A row for each sector: the tangent under which nothing is seen beyond so many steps.
  std::vector<float> above_;
};

}  // namespace phare
