// Contract of the sky, which the lit pass draws before everything else: a dome of vertex colours, no depth.
#ifndef PHARE_SHADERS_SKY_H
#define PHARE_SHADERS_SKY_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

// The sky changes with elevation alone, slowly: colours at the corners of 20 rings and 32 sectors, blended between, are within 0.6 % of
// the formula (tests/visual/sky_test.cpp), a fifth of a step of the display. A pixel of it costs a fifth of what the formula costs.
const uint kSkyRings = 20u;
const uint kSkySectors = 32u;

const uint kSpecSkyOutput = 0u;  // as kSpecOutput of lamps.h

struct SkyConstants {
  vec4 clip_from_eye[4];  // columns
  vec4 zenith;            // rgb: cd/m² at the zenith; w: factor at the horizon
  vec4 exposure;          // rgb: 1/(cd/m²), with the balance of the eye's adaptation
};

/// Luminance in cd/m² of a clear night sky, `sine` of the elevation: brighter toward the horizon by the longer way through the air.
/// Chosen by eye; below the horizon as at it.
PHARE_INLINE vec3 sky_luminance(vec4 zenith, float sine) {
  return vec3(zenith.x, zenith.y, zenith.z) * (1.0f + (zenith.w - 1.0f) * exp(-6.0f * max(sine, 0.0f)));
}

/// Sine of the elevation of a ring's edge: closer to one another at the horizon, where the sky changes fastest.
PHARE_INLINE float sky_ring_sine(uint ring) {
  float share = float(ring) / float(kSkyRings);
  return share * share;
}

PHARE_SHADER_END
#endif
