// Illuminance at a point. Computes E = I·cos/r² (the photometric distance law). Source: CIE S 017 (illuminance of a
// point source). Frame: world. Leaves out: the extent of the lamp, shadows, fog. Checked by
// tests/photometry/reference_test.cpp.
#include "visual/photometry/table/illuminance.h"

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace phare {

double illuminance_lx(const glm::dvec3& lamp_m, const glm::dmat3& world_from_lamp, const IntensityTable& table,
                      double scale, const glm::dvec3& point_m, const glm::dvec3& unit_normal) {
  const glm::dvec3 d = point_m - lamp_m;
  const double r2 = glm::dot(d, d);
  const double facing = -glm::dot(d, unit_normal);  // r·cos
  if (!(r2 > 0.0) || !(facing > 0.0)) return 0.0;
  const double intensity_cd =
      scale * table.intensity_cd(d * world_from_lamp);  // row vector times matrix: the transpose turns back
  return intensity_cd * (facing / std::sqrt(r2)) / r2;
}

double illuminance_lx(std::span<const PlacedSource> sources, const glm::dvec3& point_m, const glm::dvec3& unit_normal) {
  double sum_lx = 0.0;
  for (const PlacedSource& source : sources)
    sum_lx +=
        illuminance_lx(source.position_m, source.world_from_lamp, *source.table, source.scale, point_m, unit_normal);
  return sum_lx;
}

Illuminance illuminance_lx(std::span<const PlacedSource> sources, std::size_t lamp_count, const glm::dvec3& point_m,
                           const glm::dvec3& unit_normal) {
  Illuminance result;
  result.lamps_lx.assign(lamp_count, 0.0);
  for (const PlacedSource& source : sources) {
    assert(source.table != nullptr && source.lamp < lamp_count);
    const double e =
        illuminance_lx(source.position_m, source.world_from_lamp, *source.table, source.scale, point_m, unit_normal);
    result.lamps_lx[source.lamp] += e;
    result.total_lx += e;
  }
  return result;
}

}  // namespace phare
