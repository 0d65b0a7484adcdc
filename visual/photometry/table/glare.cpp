#include "visual/photometry/table/glare.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace phare {

Glare glare_at_eye(const Viewer& viewer, std::span<const GlareSource> sources, double adaptation_cdm2) {
  assert(adaptation_cdm2 > 0.0);
  const double per_lamp = 0.003 * (1.0 + std::sqrt(adaptation_cdm2 / 0.04));
  Glare glare;
  double discomfort = 0.0;
  for (const GlareSource& source : sources) {
    const double angle_min = 60.0 * std::max(source.angle_deg, 0.1);
    glare.illuminance_lx += source.illuminance_lx;
    glare.veil_cdm2 += source.illuminance_lx * veil_general_per_sr(viewer, source.angle_deg);
    discomfort += source.illuminance_lx / (per_lamp * std::pow(angle_min, 0.46));
  }
  glare.threshold_increment_percent = threshold_increment_percent(glare.veil_cdm2, adaptation_cdm2);
  if (discomfort > 0.0) glare.de_boer = std::clamp(5.0 - 2.0 * std::log10(discomfort), kDeBoerWorst, kDeBoerBest);
  return glare;
}

}  // namespace phare
