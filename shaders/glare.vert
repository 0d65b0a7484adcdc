#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_VERTEX
#include "lib/glare_varyings.glsl"

// One triangle that covers the screen, with all that a pixel reads.
void main() {
  vec2 ndc = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  gl_Position = vec4(ndc, 0.0, 1.0);
  way = glare.ahead.xyz + ndc.x * glare.right.xyz + ndc.y * glare.down.xyz;
  exposure = glare.exposure.rgb;
  terms = glare.terms.xyz;
  for (uint i = 0u; i < lamps; ++i) {
    toward[i] = glare.lamps[i].toward.xyz;
    eye_lx[i] = glare.lamps[i].eye_lx.rgb;
  }
}
