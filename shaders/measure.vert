#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_VERTEX
#include "lib/surface_varyings.glsl"

// Points to be measured, one pixel each: point i lands on pixel (i mod width, i / width).
layout(location = 0) in vec3 position_m;  // relative to the eye
layout(location = 1) in vec3 normal;

void main() {
  point = position_m;
  point_normal = normal;
  detail_from_point = vec3(0.0);
  uint width = uint(draw.origin.x);
  vec2 pixel = vec2(gl_VertexIndex % width, gl_VertexIndex / width) + 0.5;
  gl_Position = vec4(pixel / draw.origin.xy * 2.0 - 1.0, 0.5, 1.0);
  gl_PointSize = 1.0;
  pass_light(vec4(0.0), 0u);
}
