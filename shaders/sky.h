// Contract of the sky, which the lit pass draws before everything else: a dome in bands of elevation, no depth.
#ifndef PHARE_SHADERS_SKY_H
#define PHARE_SHADERS_SKY_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

const uint kSpecSkyOutput = 0u;  // as kSpecOutput of lamps.h

struct SkyConstants {
  vec4 clip_from_eye[4];  // columns
};

/// Luminance in cd/m² of a clear night sky, `sine` of the elevation: brighter toward the horizon by the longer way through the air.
/// `zenith`: cd/m² there; w: factor at the horizon. Chosen by eye; below the horizon as at it.
PHARE_INLINE vec3 sky_luminance(vec4 zenith, float sine) {
  return vec3(zenith.x, zenith.y, zenith.z) * (1.0f + (zenith.w - 1.0f) * exp(-6.0f * max(sine, 0.0f)));
}

PHARE_SHADER_END
#endif
