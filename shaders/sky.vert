#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/lamp_bindings.glsl"

layout(location = 0) out vec3 ray;  // eye-relative, not normalized
layout(location = 1) flat out vec3 exposure;
layout(location = 2) flat out vec4 sky;

// One triangle that covers the screen, at the far plane (reversed depth: 0).
void main() {
  vec2 ndc = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  mat4 turn = mat4(frame.view_from_clip[0], frame.view_from_clip[1], frame.view_from_clip[2], frame.view_from_clip[3]);
  ray = (turn * vec4(ndc, 1.0, 1.0)).xyz;
  exposure = frame.exposure.rgb;
  sky = frame.sky;
  gl_Position = vec4(ndc, 0.0, 1.0);
}
