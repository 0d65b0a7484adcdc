// Cells of one side of a lamp's view, finer toward its axis, where a degree of road is long. Pure: no device.
#pragma once

#include <cmath>

namespace phare {

/// Tangents from -half to half in so many cells. `finest`: the tangent where a cell is four times as wide as in the
/// middle.
struct TangentCells {
  float half = 1.0f, finest = 1.0f;
  int cells = 0;

  /// In cells from the side at -half; what lies beyond the sides goes on a little past 0 and `cells`.
  float at(float tangent) const { return middle() + scale() * tangent / (std::abs(tangent) + finest); }
  /// Of the lower or right side of a cell.
  float tangent(int cell) const {
    const float from_middle = (static_cast<float>(cell) - middle()) / scale();
    return finest * from_middle / (1.0f - std::abs(from_middle));
  }

 private:
  float middle() const { return 0.5f * static_cast<float>(cells); }
  float scale() const { return middle() * (half + finest) / half; }
};

}  // namespace phare
