// Light that is scattered in the eye, over illuminance at the eye: the CIE general disability glare equation (CIE 146:2002,
// visual/photometry/table/veil.h) for a pixel.
#ifndef PHARE_SHADERS_LIB_VEIL_H
#define PHARE_SHADERS_LIB_VEIL_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

/// 1/sr, of an angle whose chord (the way between the unit vectors) squared is given. `terms`: of 1/angle², 1/angle and 1 of the
/// equation, as age and iris make them; angles in degrees. Nearer than 0.1° as at 0.1°. Of float64 at most 2e-3 off, at 0.1°, where a
/// float32 direction is a ten-thousandth of the angle; beyond 1° 1e-4, beyond 70° 1 %.
PHARE_INLINE float veil_per_sr(vec3 terms, float chord2) {
  const float deg2 = 3282.80635f;  // (180/pi)²
  // (2 asin(c/2))² = c² + c⁴/12 + c⁶/90 + c⁸/560 + c¹⁰/3150 + c¹²/16632
  float angle2 = chord2 * deg2 * (1.0f + chord2 * (1.0f / 12.0f + chord2 * (1.0f / 90.0f + chord2 * (1.0f / 560.0f +
                 chord2 * (1.0f / 3150.0f + chord2 * (1.0f / 16632.0f))))));
  float per_deg = 1.0f / sqrt(max(angle2, 0.01f));
  return ((10.0f * per_deg + terms.x) * per_deg + terms.y) * per_deg + terms.z;
}

PHARE_SHADER_END
#endif
