#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/lamp_bindings.glsl"

layout(location = 0) in vec3 position_m;  // relative to the batch's origin
layout(location = 1) in vec3 normal;
layout(location = 2) in uint material_index;
layout(location = 0) out vec3 point;      // relative to the eye, m
layout(location = 1) out vec3 point_normal;
layout(location = 2) out vec3 detail;     // world position modulo 1024 m
layout(location = 3) flat out uint material;

invariant gl_Position;  // the depth pass and the lamp pass must agree to the bit

void main() {
  point = position_m + draw.origin.xyz;
  point_normal = normal;
  material = material_index;
  detail = position_m + draw.detail_origin.xyz;
  gl_Position = clip_from_eye() * vec4(point, 1.0);
}
