#version 460
#extension GL_GOOGLE_include_directive : require
#include "lamps.h"
#include "lib/tone.h"
#include "sky.h"

layout(constant_id = kSpecSkyOutput) const uint output_kind = 0;
layout(location = 0) in vec3 colour;
layout(location = 0) out vec4 result;

void main() {
  if (output_kind == kOutputHdr)
    result = vec4(colour, 0.0);  // no illuminance where there is no surface
  else
    result = vec4(colour + dither(gl_FragCoord.xy), 1.0);
}
