#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/lamp_bindings.glsl"
#include "lib/tone.h"

layout(constant_id = 3) const uint output_kind = 0;
layout(location = 0) in vec2 ndc;
layout(location = 0) out vec4 result;

// A clear night sky, dim, brighter toward the horizon by the longer way through the air.
void main() {
  mat4 turn = mat4(frame.view_from_clip[0], frame.view_from_clip[1], frame.view_from_clip[2], frame.view_from_clip[3]);
  vec3 direction = normalize((turn * vec4(ndc, 1.0, 1.0)).xyz);
  float horizon = exp(-6.0 * max(direction.z, 0.0));
  vec3 luminance = frame.sky.rgb * mix(1.0, frame.sky.w, horizon);
  if (output_kind == kOutputHdr) result = vec4(luminance, 0.0);
  else if (output_kind == kOutputFalseColour) result = vec4(0.0, 0.0, 0.01, 1.0);
  else result = vec4(tone_curve(luminance * frame.exposure.rgb), 1.0);
}
