// What animals' eyes send back of the car's own lamps to an eye that sees them: lamps by their tables in float64,
// behind what stands or moves in their light.
#pragma once

#include <vector>

#include "visual/eyeshine.h"
#include "visual/process/lamps.h"

namespace phare {

/// Farther ones are left out: at 300 m a high beam of 100,000 cd gives a pixel 0.3 cd/m².
inline constexpr double kEyeshineTo_m = 300.0;

std::vector<ShiningPupil> eyeshine_of(const Lamps& lamps, const VehicleState& car, const Pupils& pupils,
                                      const World& world, const glm::dvec3& eye_m, const Air& air);

}  // namespace phare
