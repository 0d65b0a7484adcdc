#include "visual/scene/snow.h"

#include "shaders/lib/snow.h"

namespace phare {

double snow_share(const glm::dvec3& normal, double cover_01) {
  return static_cast<double>(shader::snow_share(static_cast<float>(normal.z), static_cast<float>(cover_01)));
}

glm::dvec3 snow_reflectance() {
  return glm::dvec3(shader::kSnow);
}

}  // namespace phare
