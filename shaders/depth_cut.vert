#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/lamp_bindings.glsl"

// As depth.vert, of surfaces with holes.
layout(location = 0) in vec3 position_m;
layout(location = 3) in vec2 corner_uv;
layout(location = 4) in vec4 corner_colour;

layout(location = 0) out vec2 uv;
layout(location = 1) out float opacity;

invariant gl_Position;

void main() {
  vec3 point = placed(position_m);
  uv = corner_uv;
  opacity = corner_colour.a;
  gl_Position = clip_from_eye() * vec4(point, 1.0);
}
