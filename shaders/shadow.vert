#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/lamp_bindings.glsl"

layout(location = 0) in vec3 corner_m;  // forward, left, up from the lamp

// What casts shadows, as the lamp sees it; the draw's origin says how large.
void main() {
  gl_Position = vec4(-corner_m.yz * draw.origin.xy, kShadowNear_m, corner_m.x);
}
