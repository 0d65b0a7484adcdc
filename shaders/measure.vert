#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/lamp_bindings.glsl"

// Points to be measured, one pixel each: point i lands on pixel (i mod width, i / width).
layout(location = 0) in vec3 position_m;  // relative to the eye
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 point;
layout(location = 1) out vec3 point_normal;
layout(location = 2) out vec3 detail;
layout(location = 3) flat out uint material;

void main() {
  point = position_m;
  point_normal = normal;
  detail = vec3(0.0);
  material = 0;
  uint width = uint(draw.origin.x);
  vec2 pixel = vec2(gl_VertexIndex % width, gl_VertexIndex / width) + 0.5;
  gl_Position = vec4(pixel / draw.origin.xy * 2.0 - 1.0, 0.5, 1.0);
  gl_PointSize = 1.0;
}
