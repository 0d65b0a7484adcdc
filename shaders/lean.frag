#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_LEAN
#include "lib/beam.glsl"
#include "lib/surface_light.glsl"
#ifdef PHARE_SHADOWS
#include "lib/shadow.glsl"
#else
#define PHARE_SEEK_SHADOW(I)
#define PHARE_READ_SHADOW(I)
#define PHARE_REACHING(I) 1.0
#endif
#include "lib/tone.h"

// What lamps.frag does, where at most two lamps of one colour light dry surfaces in clear air: the same light with fewer words between the
// stages and no work that such a surface does not call for.

layout(constant_id = kSpecOutput) const uint output_kind = 0;
layout(constant_id = kSpecSides) const uint sides = 1;

layout(location = 0) out vec4 result;
layout(location = 1) out vec4 result_normal;

void main() {
#ifdef PHARE_FLAT
  float side = sides == 2 && !gl_FrontFacing ? -1.0 : 1.0;
  vec2 toward = vec2(lit.w, unlit.w) * side;
#ifndef PHARE_PLAIN
  vec3 n = plane_normal.xyz * side;
  float level = plane_normal.w * side;
#endif
#else
  float unit = inversesqrt(dot(plane_normal.xyz, plane_normal.xyz));
  if (sides == 2) unit = gl_FrontFacing ? unit : -unit;
  vec3 n = plane_normal.xyz * unit;
  float level = dot(n, place.xyz);
  vec2 toward = vec2(in_first.w, place.w) * unit - level;
#endif

  // In what a diffuse surface needs to be as bright, lx.
  float total_lx = 0.0, sent_lx = 0.0;
#ifdef PHARE_FLAT
#define EYE_LAMP2(I) frame.lamps[I].row_a.w
#else
#define EYE_LAMP2(I) (I == 0 ? lit.w : unlit.w)
#endif
#define TOWARD(I) (I == 0 ? toward.x : toward.y)
#define SEEK(I)      \
  Sought sought_##I; \
  if (lamp_count > I) sought_##I = PHARE_SEEK_AT(I, I == 0 ? in_first.xyz : PHARE_IN_SECOND);
  PHARE_EACH_LAMP(SEEK)
#ifdef PHARE_PLAIN
#define SENT_BACK(I) 0.0
#else
#define SENT_BACK(I) sent_back_##I
#define SEND_BACK(I)          \
  float sent_back_##I = 0.0; \
  if (retro != 0 && lamp_count > I) sent_back_##I = sent_back(I, aimed(sought_##I.way, TOWARD(I)), place.xyz, n, level, detail.w, EYE_LAMP2(I));
  PHARE_EACH_LAMP(SEND_BACK)
#endif
  PHARE_EACH_LAMP(PHARE_SEEK_SHADOW)
  PHARE_EACH_LAMP(PHARE_READ_SHADOW)
  PHARE_EACH_LAMP(PHARE_READ_LAMP)
#define LIGHT(I)                                                      \
  if (lamp_count > I) {                                               \
    LampLight light = sought_light_##I(sought_##I, TOWARD(I));        \
    float reach = PHARE_REACHING(I);                                  \
    total_lx += light.illuminance_lx * reach;                         \
    if (retro != 0) sent_lx += light.normal_lx * reach * SENT_BACK(I); \
  }
  PHARE_EACH_LAMP(LIGHT)

#ifndef PHARE_PLAIN
  if (output_kind == kOutputAudit) {
    result = vec4(place.xyz, total_lx);
    result_normal = vec4(n, float(lamp_count));
    return;
  }
#endif
  vec3 light = lit.rgb * (total_lx + sent_lx);
#ifdef PHARE_PLAIN
  light += unlit.rgb;
#else
#ifdef PHARE_FLAT
  light += sides == 1 ? unlit.rgb : unlit.rgb * (1.0 + n.z);
#else
  light += unlit.rgb * (1.0 + n.z);
#endif
  if (surface != 0) {
    vec2 factor = surface_detail(place.xyz, detail.xyz);
    light *= factor.x;
    light.r *= factor.y;
  }
#endif
  if (output_kind == kOutputClipping) {
    result = vec4(srgb_encoded(clipping_marked(tone_curve(light), gl_FragCoord.xy)), 1.0);
    return;
  }
  result = output_kind == kOutputHdr ? min(vec4(light, total_lx), kHalfMost) : vec4(srgb_encoded(tone_curve(light)), 1.0);
}
