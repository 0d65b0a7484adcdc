#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/lamp_bindings.glsl"

layout(location = 0) in vec3 position_m;

invariant gl_Position;

void main() {
  vec3 point = placed(position_m);
  gl_Position = clip_from_eye() * vec4(point, 1.0);
}
