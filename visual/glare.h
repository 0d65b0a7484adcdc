// Lamps that shine into the eye, as the light that they scatter in it is drawn from. Pure: no device.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "visual/photometry/table/air.h"
#include "visual/photometry/table/veil.h"
#include "visual/view.h"

namespace phare {

/// A lamp as the eye has it; what stands between them has been looked for.
struct GlaringLamp {
  glm::dvec3 place_m{0.0};  ///< of the lamp in the world
  double eye_lx = 0.0;      ///< at the eye, on a plane that faces the lamp
  glm::vec3 colour{1.0f};   ///< linear sRGB, luminance 1
};

/// A lamp of so many candela toward an eye elsewhere, through that air.
GlaringLamp glaring_lamp(const glm::dvec3& lamp_m, double candela, const glm::vec3& colour, const glm::dvec3& eye_m,
                         const Air& air);

/// More are left out, those whose veil is weakest in the view. None comes or goes at once: the last kDimmedLamps are
/// dimmed, to nothing as they come to the strongest that is left out.
inline constexpr std::size_t kMostGlaringLamps = 12, kDimmedLamps = 4;

/// Least angle between a source and what a view sees, degrees: 0 where it is in view. Never more than it is.
double least_angle_deg(const ViewGeometry& view, const glm::dvec3& place_m);

/// Those whose veil changes the view's picture somewhere by half a step of the display's 8 bits or more, that with the
/// strongest veil first. `display_per_cdm2`: exposure; near black it is what the display shows.
std::vector<GlaringLamp> glare_seen(const ViewGeometry& view, std::span<const GlaringLamp> sources,
                                    const Viewer& viewer, double display_per_cdm2);

}  // namespace phare
