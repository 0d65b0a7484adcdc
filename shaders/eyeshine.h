// Contract of the eyeshine draw: one pupil (visual/eyeshine.h, visual/passes/eyeshine.h).
#ifndef PHARE_SHADERS_EYESHINE_H
#define PHARE_SHADERS_EYESHINE_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

const uint kSpecEyeshineOutput = 0u;  // as kSpecOutput: cd/m², or what the display shows

// Narrower discs are spread over the four pixels about their middle, so that one that moves does not flicker.
const float kEyeshineDisc_px = 0.75f;

// Push constants.
struct GpuPupil {
  vec4 clip;   // of its middle, a little nearer to the eye than it is
  vec4 place;  // xy: of its middle in the target, px; z: radius, px; w: of the square that is drawn the half side, px
  vec4 light;  // rgb: of all its pixels together, cd/m², exposed where the display's signal is written
  vec4 size;   // xy: of the view, px
};

// Share of the sum that a pixel gets whose middle is so far away. Both sum to 1 over all pixels; a disc, read in
// the middles of pixels, within 8 %.
PHARE_INLINE float eyeshine_share(vec2 away_px, float radius_px) {
  if (radius_px < kEyeshineDisc_px)
    return max(1.0f - abs(away_px.x), 0.0f) * max(1.0f - abs(away_px.y), 0.0f);
  float cover = clamp(radius_px + 0.5f - length(away_px), 0.0f, 1.0f);
  return cover / (3.14159265f * (radius_px * radius_px + 1.0f / 12.0f));
}

PHARE_SHADER_END
#endif
