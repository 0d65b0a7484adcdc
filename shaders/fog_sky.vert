#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_VERTEX
#include "lib/fog_flat.glsl"

layout(location = 0) out vec3 ray;

// One triangle over all that no surface covers. Rays are linear over the picture, so the view's own corners give them.
void main() {
  vec2 ndc = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  ray = frame.fog.ray.xyz + frame.fog.ray_right.xyz * (0.5 * ndc.x + 0.5) +
        frame.fog.ray_down.xyz * (0.5 * ndc.y + 0.5);
  pass_fog();
  gl_Position = vec4(ndc, 0.0, 1.0);
}
