#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/lamp_bindings.glsl"

// As shadow.vert, of surfaces with holes.
layout(location = 0) in vec3 corner_m;
layout(location = 1) in vec2 corner_uv;

layout(location = 0) out vec2 uv;
layout(location = 1) out float opacity;

void main() {
  uv = corner_uv;
  opacity = 1.0;
  gl_Position = vec4(-corner_m.yz * draw.origin.xy, kShadowNear_m, corner_m.x);
}
