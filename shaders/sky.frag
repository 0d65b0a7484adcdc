#version 460
#extension GL_GOOGLE_include_directive : require
#include "lamps.h"
#include "sky.h"

layout(constant_id = kSpecSkyOutput) const uint output_kind = 0;
#ifdef PHARE_FLAT
layout(location = 0) flat in vec3 colour;
#else
layout(location = 0) in vec3 colour;
#endif
layout(location = 0) out vec4 result;

void main() {
  result = vec4(colour, output_kind == kOutputHdr ? 0.0 : 1.0);  // no illuminance where there is no surface
}
