#include "visual/process/glare_into_eye.h"

namespace phare {

std::vector<GlaringLamp> glare_into_eye(const ViewInput& view, const Lamps& lamps, const ShiningAround& around) {
  const glm::dvec3& eye_m = view.camera.eye_m;
  if (view.camera.orthographic_width_m > 0.0) return {};
  std::vector<GlaringLamp> glare = lamps.glare_at(around.car, eye_m, around.world, view.air);
  const auto add = [&](const std::vector<GlaringLamp>& more) { glare.insert(glare.end(), more.begin(), more.end()); };
  add(around.traffic.glare_at(around.users, eye_m, around.world, view.air));
  if (view.effects[static_cast<std::size_t>(Effect::kFixedLight)] != std::size_t{0})
    add(around.fixed.glare_at(eye_m, view.air));
  return glare;
}

}  // namespace phare
