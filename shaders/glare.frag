#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/glare_varyings.glsl"
#include "lib/tone.h"
#include "lib/veil.h"

layout(set = 0, binding = 0) uniform sampler2D hdr_cdm2;
layout(location = 0) out vec4 result;

void main() {
  vec3 luminance = held_by_half(texelFetch(hdr_cdm2, ivec2(gl_FragCoord.xy), 0).rgb);
  vec3 toward_pixel = way * inversesqrt(dot(way, way));
  for (uint i = 0u; i < lamps; ++i) {
    vec3 apart = toward[i] - toward_pixel;
    float chord2 = dot(apart, apart);
    luminance += eye_lx[i] * (veil_per_sr(terms, chord2) * max(1.0 - 0.5 * chord2, 0.0));  // on a plane across the line of sight
  }
  result = vec4(srgb_encoded(tone_curve(luminance * exposure)) + dither(gl_FragCoord.xy), 1.0);
}
