// Eyeshine: the light of the lamps that animals' eyes send back to where it came from (tapetum lucidum), as a view
// draws it. Pure: no device. A pupil is smaller than a pixel from 15 m on, so it is no surface of the picture but a
// light: so many candela toward the eye, spread over the pixels that its image covers.
//
// Model: luminance of the pupil by its class in visual/scene/retro.h (unconfirmed), times its area as seen; the light
// of each lamp behind what hides it and through the air on both ways. Left out: the light of others' lamps, which goes
// back to them, and of street lamps; that what is behind the pupil's pixel is covered: the brighter of both is drawn.
// Checked by tests/visual/eyeshine_test.cpp.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "visual/photometry/table/air.h"
#include "visual/scene/pupils.h"
#include "visual/view.h"

namespace phare {

/// A pupil as the eye of a view has it.
struct ShiningPupil {
  glm::dvec3 place_m{0.0};
  glm::vec3 candela{0.0f};  ///< toward the eye, linear sRGB whose luminance is candela; through the air
  double area_m2 = 0.0;     ///< as the eye sees it
};

/// A lamp's light at a pupil, with nothing and no air in the way.
struct LightOnPupil {
  glm::dvec3 lamp_m{0.0};
  double candela = 0.0;     ///< toward the pupil
  glm::vec3 colour{1.0f};   ///< linear sRGB, luminance 1
};

/// What a pupil sends toward an eye of these lights, what is hidden already left out.
ShiningPupil shining(const Pupil& pupil, std::span<const LightOnPupil> lights, const glm::dvec3& eye_m, const Air& air);

/// As it is drawn in a picture: `size_px` of the whole view.
struct PupilInPicture {
  glm::dvec3 from_eye_m{0.0};
  glm::vec3 sum_cdm2{0.0f};  ///< of all its pixels
  double radius_px = 0.0;    ///< of a round one of this area
};

/// More are left out, the weakest first.
inline constexpr std::size_t kMostPupils = 64;

/// Those in view whose brightest pixel changes the picture by half a step of the display's 8 bits or more next to
/// black, brightest first. `display_per_cdm2`: exposure.
std::vector<PupilInPicture> pupils_seen(const ViewGeometry& view, double width_px, double height_px,
                                        std::span<const ShiningPupil> pupils, double display_per_cdm2);

}  // namespace phare
