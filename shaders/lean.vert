#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_VERTEX
#define PHARE_LEAN
#include "lib/lean_varyings.glsl"

layout(constant_id = kSpecOutput) const uint output_kind = 0;
layout(constant_id = kSpecSides) const uint sides = 1;

layout(location = 0) in vec3 position_m;  // relative to the batch's origin
layout(location = 1) in vec3 normal;
layout(location = 2) in uint material_index;

invariant gl_Position;  // the depth pass and the lit pass must agree to the bit

vec3 in_frame(uint lamp, vec3 d) {
  return vec3(dot(frame.lamps[lamp].row_a.xyz, d), dot(frame.lamps[lamp].row_b.xyz, d), dot(frame.lamps[lamp].row_c.xyz, d));
}

void main() {
  const float pi = 3.14159265;
  vec3 point = placed(position_m), n = turned(normal);
  gl_Position = clip_from_eye() * vec4(point, 1.0);
  vec4 material = materials[material_index].reflectance;
  vec3 reflected = material.rgb / pi;
  if (output_kind == kOutputDisplay || output_kind == kOutputClipping) reflected *= frame.exposure.rgb;
  lit = vec4(reflected * frame.lamps[0].colour.rgb, 0.0);
  unlit = vec4(reflected * frame.sky.rgb * (0.5 * pi), 0.0);
  vec3 first = frame.lamps[0].position.xyz, second = frame.lamps[1].position.xyz;
  in_first = vec4(in_frame(0, point - first), 0.0);
#ifdef PHARE_ALIKE
  to_second = vec4(in_frame(0, first - second), 1.0);
#else
  in_second = in_frame(1, point - second);
#endif
#ifdef PHARE_FLAT
  n = normalize(n);
  lit.w = dot(n, first - point);
  unlit.w = dot(n, second - point);
  if (sides == 1) unlit.rgb *= 1.0 + n.z;
#ifndef PHARE_PLAIN
  place = vec4(point, 0.0);
  plane_normal = vec4(n, dot(n, point));
#endif
#else
  lit.w = frame.lamps[0].row_a.w;
  unlit.w = frame.lamps[1].row_a.w;
  in_first.w = dot(n, first);
  place = vec4(point, dot(n, second));
  plane_normal = vec4(n, 0.0);
#endif
#ifndef PHARE_PLAIN
  detail = vec4(draw.detail_origin.xyz - draw.origin.xyz, material.w);
#endif
#ifdef PHARE_SHADOWS
#ifdef PHARE_ALIKE
  to_second.w = frame.shadows[shadow_maps % 16u != 0u ? 0 : 1].zoom.x;
#endif
#define PHARE_SHADOW_OF(I)                                                                                                           \
  if ((shadow_maps >> (4 * I) & 15u) != 0u)                                                                                          \
    in_shadow[I] = vec3(dot(frame.shadows[I].u, vec4(point, 1.0)), dot(frame.shadows[I].v, vec4(point, 1.0)), dot(frame.shadows[I].w, vec4(point, 1.0)));
  PHARE_EACH_LAMP(PHARE_SHADOW_OF)
#endif
}
