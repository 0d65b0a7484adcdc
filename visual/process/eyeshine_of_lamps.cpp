#include "visual/process/eyeshine_of_lamps.h"

#include <glm/geometric.hpp>

#include "visual/scene/ray_hit.h"

namespace phare {

std::vector<ShiningPupil> eyeshine_of(const Lamps& lamps, const VehicleState& car, const Pupils& pupils,
                                      const World& world, const glm::dvec3& eye_m, const Air& air) {
  std::vector<ShiningPupil> shine;
  if (pupils.none()) return shine;
  for (const Pupil& pupil : pupils.in(world)) {
    if (glm::distance(pupil.place_m, eye_m) > kEyeshineTo_m || glm::dot(eye_m - pupil.place_m, pupil.normal) <= 0.0)
      continue;
    std::vector<LightOnPupil> lights;
    for (const PointLight& light : lamps.lights_at(car, {pupil.place_m, pupil.normal}))
      if (light.candela > 0.0 && !occluder(world, light.lamp_m, pupil.place_m))
        lights.push_back({light.lamp_m, light.candela, glm::vec3(light.colour)});
    const ShiningPupil one = shining(pupil, lights, eye_m, air);
    if (one.candela != glm::vec3(0.0f)) shine.push_back(one);
  }
  return shine;
}

}  // namespace phare
