#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_VERTEX
#include "lib/lamp_bindings.glsl"
#ifdef PHARE_FOG_FLAT
#include "lib/fog_flat.glsl"
#endif

layout(location = 0) out vec3 ray;

// One triangle over all that no surface covers. Rays are linear over the picture, so the grid's own corners give them.
void main() {
  vec2 ndc = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  ray = frame.fog.ray.xyz + frame.fog.ray_right.xyz * (0.5 * ndc.x + 0.5) +
        frame.fog.ray_down.xyz * (0.5 * ndc.y + 0.5);
#ifdef PHARE_FOG_FLAT
  pass_fog();
#endif
  gl_Position = vec4(ndc, 0.0, 1.0);
}
