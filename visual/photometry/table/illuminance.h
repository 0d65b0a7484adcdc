// Illuminance at a point in float64, from the tables themselves: what every faster way of this program is measured
// against.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// A table placed in the world. Sources with the same `lamp` index belong to one lamp.
struct PlacedSource {
  const IntensityTable* table = nullptr;
  glm::dvec3 position_m{0.0};       ///< world
  glm::dmat3 world_from_lamp{1.0};  ///< columns: the lamp's forward, left, up in the world
  double scale = 1.0;               ///< multiplies candela
  std::size_t lamp = 0;
};

/// E = I·cos/r² in lux at `point_m` (world) on a surface with unit normal. 0 where the surface faces away and at the
/// lamp itself (r = 0). Lamps are points. Error below 1e-12 relative, except where a far origin costs digits of point -
/// lamp.
double illuminance_lx(const glm::dvec3& lamp_m, const glm::dmat3& world_from_lamp, const IntensityTable& table,
                      double scale, const glm::dvec3& point_m, const glm::dvec3& unit_normal);

/// Of several sources, summed in their order.
double illuminance_lx(std::span<const PlacedSource> sources, const glm::dvec3& point_m, const glm::dvec3& unit_normal);

/// Illuminance of several sources, lamp by lamp.
struct Illuminance {
  double total_lx = 0.0;
  std::vector<double> lamps_lx;  ///< one per lamp index
};

/// Sums in the order of `sources`. Every `lamp` index must be below `lamp_count`.
Illuminance illuminance_lx(std::span<const PlacedSource> sources, std::size_t lamp_count, const glm::dvec3& point_m,
                           const glm::dvec3& unit_normal);

}  // namespace phare
