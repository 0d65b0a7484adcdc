// Pictures with figures on them: the 25 m wall and the frame of the bird's eye.
#pragma once

#include "visual/image/canvas.h"
#include "visual/process/lamps.h"
#include "visual/image/versus_scale.h"

namespace phare {

/// A wall 25 m before the lamps, seen squarely: low beam of all lamps of a design, aimed as mounted, car level. False
/// colour by illuminance (lx on the wall), isolux lines, H-V grid in degrees (azimuth, then elevation, LM-63 type A)
/// about the point of the wall at mounting height straight before the car, ±20° x ±8°. Float64 from the native tables
/// on the CPU.
Image8 wall_picture(const Lamps& lamps, std::size_t design);

/// Illuminance (alpha of `seen`, lx, kBirdsEyePicture seen by birds_eye_camera) in false colour with isolux lines,
/// with axes in metres, legend and `caption`.
Image8 birds_eye_picture(const ImageF& seen, const std::string& caption);

/// Where B is brighter it is red to yellow, where A is, blue to light blue; with the scale beside it. Of two pictures
/// of the same size whose alpha is the illuminance.
Image8 versus_picture(const ImageF& a, const ImageF& b, VersusScale scale, const std::string& caption);
}  // namespace phare
