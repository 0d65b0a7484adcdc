#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/tone.h"
#include "tone_mapping.h"

layout(set = 0, binding = 0) uniform sampler2D hdr_cdm2;
layout(push_constant) uniform Constants { ToneConstants constants; };
layout(location = 0) out vec4 result;

void main() {
  vec3 luminance = held_by_half(texelFetch(hdr_cdm2, ivec2(gl_FragCoord.xy), 0).rgb);
  result = vec4(srgb_encoded(tone_curve(luminance * constants.exposure.rgb)) + dither(gl_FragCoord.xy), 1.0);
}
