// Where in a lamp's view something that casts may hide its light, coarsely and on the safe side, so that pieces of a
// scene that no shadow can reach are drawn without asking for one. Pure: no device.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "visual/shadow_casters.h"
#include "visual/tangent_cells.h"

namespace phare {

/// Corners of a box of the world in a lamp's frame: forward, left, up, m.
using BoxCorners = std::array<glm::vec3, 8>;
BoxCorners box_corners(const glm::dmat3& image_from_world, const glm::dvec3& lamp_m, const glm::dvec3& low_m,
                       const glm::dvec3& high_m);

class CasterGrid {
 public:
  CasterGrid() = default;  ///< nothing casts
  /// Of the view to the tangents `half_sides` either way. `texel`: tangents across one of the map's first picture; the
  /// second shows the middle `zoom` times as large.
  CasterGrid(const CastBy& cast, const glm::dvec2& half_sides, const glm::dvec2& texel, double zoom);

  /// False only if nothing that casts is nearer to the lamp, along its axis, than a point of the box behind it, or than
  /// one beside that whose texels are weighed with its own.
  bool may_shade(const BoxCorners& box) const;

 private:
  static constexpr int kColumns = 256, kRows = 128, kBlock = 8;
  struct Cells {
    int first_column = 0, end_column = 0, first_row = 0, end_row = 0;
  };
  /// `room`: tangents across what is weighed about a point in the map's first picture.
  struct Axis : TangentCells {
    float room = 0.0f, zoom = 1.0f;
    bool close(float least, float most) const;
    float widened(float tangent, float way, bool close) const;
  };
  Cells cells_of(const glm::vec2& least, const glm::vec2& most) const;
  void add_in_parts(const CastBy& cast, const glm::vec2& half_sides);
  /// Of all that casts one of so many parts.
  void add(const CastBy& cast, const glm::vec2& half_sides, std::size_t part, std::size_t parts);

  Axis across_, up_;
  /// Row by row from the lowest, in each from the rightmost: 1 over how far forward what may show in the cell begins,
  /// 1/m, 0 where nothing does; and the most in each block of cells.
  std::vector<float> per_m_, per_m_of_block_;
  int end_row_ = 0;           ///< of those that are kept
  float above_per_m_ = 0.0f;  ///< the most above them
};

}  // namespace phare
