#version 460
#extension GL_GOOGLE_include_directive : require
#include "lamps.h"
#include "lib/tone.h"

layout(constant_id = 3) const uint output_kind = 0;
layout(location = 0) in vec3 ray;
layout(location = 1) flat in vec3 exposure;
layout(location = 2) flat in vec4 sky;  // zenith cd/m², factor at the horizon
layout(location = 0) out vec4 result;

// A clear night sky, dim, brighter toward the horizon by the longer way through the air.
void main() {
  float horizon = exp(-6.0 * max(normalize(ray).z, 0.0));
  vec3 luminance = sky.rgb * mix(1.0, sky.a, horizon);
  if (output_kind == kOutputHdr) result = vec4(luminance, 0.0);
  else if (output_kind == kOutputFalseColour) result = vec4(0.0, 0.0, 0.01, 1.0);
  else result = vec4(tone_curve(luminance * exposure), 1.0);
}
