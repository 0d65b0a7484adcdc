// Luminance of linear Rec. 709 (ITU-R BT.709-6, 3.2).
#ifndef PHARE_SHADERS_LIB_LUMINANCE_H
#define PHARE_SHADERS_LIB_LUMINANCE_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

PHARE_INLINE float luminance_of(vec3 rgb) {
  return dot(rgb, vec3(0.2126f, 0.7152f, 0.0722f));
}

/// The colour of luminance 1 with this red and blue: green is what luminance leaves.
PHARE_INLINE vec3 colour_of_red_blue(vec2 red_blue) {
  return max(vec3(red_blue.x, (1.0f - 0.2126f * red_blue.x - 0.0722f * red_blue.y) / 0.7152f, red_blue.y), vec3(0.0f));
}

PHARE_SHADER_END
#endif
