// The one step that leaves photometric units: luminance to display. Fixed exposure, fixed curve, so that two beams compare.
#ifndef PHARE_SHADERS_LIB_TONE_H
#define PHARE_SHADERS_LIB_TONE_H
#include "lib/luminance.h"

PHARE_SHADER_BEGIN

/// Exposed luminance (1 = middle of the curve) to display-linear; above 1 the display clips. Reinhard et al. 2002, eq. 4, with white at 12,
/// applied to luminance so that colours keep their hue.
PHARE_INLINE vec3 tone_curve(vec3 exposed) {
  const float per_white_squared = 1.0f / (12.0f * 12.0f);
  float y = luminance_of(exposed);
  float scale = (1.0f + y * per_white_squared) / (1.0f + y);
  return exposed * scale;
}

/// What a half float holds. Where a light beyond that is written, some devices hold the most there is and some
/// infinity, of which tone_curve() is no number.
const float kHalfMost = 65504.0f;

/// Light read from half floats.
PHARE_INLINE vec3 held_by_half(vec3 light) {
  return min(light, vec3(kHalfMost));
}

/// What the display clips, in stripes of 4 pixels: red where a channel is above 1, blue where all are below half a step of 8 bits.
PHARE_INLINE vec3 clipping_marked(vec3 linear, vec2 pixel) {
  const float half_step = 0.5f / 255.0f / 12.92f;
  float most = max(max(linear.x, linear.y), linear.z);
  bool stripe = mod(pixel.x + pixel.y, 8.0f) < 4.0f;
  if (most > 1.0f) return stripe ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f);
  if (most < half_step) return stripe ? vec3(0.0f, 0.0f, 0.3f) : vec3(0.0f);
  return linear;
}

/// Illuminance in lx as colour, display-linear: dark blue below 0.3 lx over cyan, green, yellow, red to white above 200 lx, by log E.
PHARE_INLINE vec3 false_colour(float illuminance_lx) {
  float t = clamp((log2(max(illuminance_lx, 1e-4f)) - log2(0.3f)) / (log2(200.0f) - log2(0.3f)), 0.0f, 1.0f) * 5.0f;
  vec3 colour = mix(vec3(0.0f, 0.0f, 0.02f), vec3(0.01f, 0.02f, 0.35f), min(t, 1.0f));
  colour = mix(colour, vec3(0.0f, 0.42f, 0.55f), clamp(t - 1.0f, 0.0f, 1.0f));
  colour = mix(colour, vec3(0.05f, 0.55f, 0.06f), clamp(t - 2.0f, 0.0f, 1.0f));
  colour = mix(colour, vec3(0.85f, 0.65f, 0.02f), clamp(t - 3.0f, 0.0f, 1.0f));
  return mix(colour, vec3(0.8f, 0.05f, 0.02f), clamp(t - 4.0f, 0.0f, 1.0f));
}

/// Where neither of two designs has as much, their ratio is not told.
const float kVersusDark_lx = 0.1f;

/// Where B less A lies on a scale from -1 (A has 30 lx more) to 1: even to 1 lx, a third of the way, then by decades.
PHARE_INLINE float difference_share(float lx) {
  float size = abs(lx);
  float share = size <= 1.0f ? size / 3.0f : 1.0f / 3.0f + 2.0f / 3.0f * log(size) / log(30.0f);
  return lx < 0.0f ? -min(share, 1.0f) : min(share, 1.0f);
}

/// The same of B over A, -1 at an eighth and 1 at eight times.
PHARE_INLINE float ratio_share(float ratio) {
  return clamp(log2(ratio) / 3.0f, -1.0f, 1.0f);
}

/// Its colour, as the display's signal: black in the middle, over red to yellow where B is brighter, over blue to light blue where A is.
PHARE_INLINE vec3 versus_signal(float share) {
  float size = abs(share), first = min(2.0f * size, 1.0f);
  float light = clamp(2.0f * size - 1.0f, 0.0f, 1.0f);  // the second half of the way goes to the light colour
  if (share >= 0.0f) return vec3(first, light, 0.5f * light);
  return clamp(vec3(0.6f * light, 0.35f * (first + 1.6f * light), first), 0.0f, 1.0f);
}

/// Display-linear to the sRGB signal (IEC 61966-2-1), 0 to 1 each, by a polynomial in the square root: within 0.2 steps of 8 bits. In the
/// shader, because a target that encodes has a software device decode, blend and encode every block that is drawn.
PHARE_INLINE vec3 srgb_encoded(vec3 linear) {
  vec3 x = min(linear, vec3(1.0f));
  // Even and odd powers of the root apart: only the last product waits for it.
  vec3 even = x * (-0.944860861f + x * -0.309571806f) - 0.0370046662f;
  vec3 curve = even + sqrt(x) * (1.44789933f + x * 0.842791033f);
  return vec3(x.x < 0.0031308f ? 12.92f * x.x : curve.x, x.y < 0.0031308f ? 12.92f * x.y : curve.y,
              x.z < 0.0031308f ? 12.92f * x.z : curve.z);
}

/// To be added to a signal before it is rounded to 8 bits, by the pixel's place: between two steps neighbours take the
/// one and the other by turns, so that a slow gradient shows no bands. Within half a step; what is a step stays. The
/// sequence R2 (Roberts 2018) over rows and columns, in which places near each other differ most.
PHARE_INLINE float dither(vec2 pixel) {
  float turn = 0.75487767f * pixel.x + 0.56984029f * pixel.y;
  return (turn - floor(turn)) * (0.998f / 255.0f) - 0.499f / 255.0f;
}

PHARE_SHADER_END
#endif
