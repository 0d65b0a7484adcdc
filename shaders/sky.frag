#version 460
#extension GL_GOOGLE_include_directive : require
#include "lamps.h"
#include "lib/tone.h"
#include "sky.h"

layout(constant_id = kSpecSkyOutput) const uint output_kind = 0;
#ifdef PHARE_FLAT
layout(location = 0) flat in vec3 colour;
#else
layout(location = 0) in vec3 colour;
#endif
layout(location = 0) out vec4 result;

void main() {
  float alpha = output_kind == kOutputHdr ? 0.0 : 1.0;  // no illuminance where there is no surface
#ifdef PHARE_FLAT
  result = vec4(colour, alpha);
#else
  result = vec4(output_kind == kOutputHdr ? colour : colour + dither(gl_FragCoord.xy), alpha);
#endif
}
