// What the vertex stage hands to lamps.frag. What is the same for the whole draw goes as flat varyings too: on a software device
// they cost a pixel nothing, while each uniform read costs as much as ten multiplications.
#ifndef PHARE_SURFACE_VARYINGS
#define PHARE_SURFACE_VARYINGS
#include "lib/lamp_bindings.glsl"

// Compiled for 2, 4 and 8 lamps (PHARE_LAMPS): varyings that nobody reads still cost each vertex. Loops over lamps are written out,
// so that every index is a constant and the lamps a frame has not leave no trace.
#if PHARE_LAMPS == 2
#define PHARE_EACH_LAMP(DO) DO(0) DO(1)
#elif PHARE_LAMPS == 4
#define PHARE_EACH_LAMP(DO) DO(0) DO(1) DO(2) DO(3)
#else
#define PHARE_EACH_LAMP(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#endif

#ifdef PHARE_VERTEX
#define PHARE_VARYING out
#else
#define PHARE_VARYING in
#endif

layout(location = 0) PHARE_VARYING vec3 point;              // relative to the eye, m
layout(location = 1) PHARE_VARYING vec3 point_normal;
layout(location = 2) PHARE_VARYING vec3 detail;             // world position modulo 1024 m
layout(location = 3) flat PHARE_VARYING vec4 reflectance;   // of the material: rho, R_A
layout(location = 4) flat PHARE_VARYING vec3 exposure;
layout(location = 5) flat PHARE_VARYING vec4 common_light;  // colour of the lamps where all have one, zenith luminance
layout(location = 6) PHARE_VARYING vec3 in_lamp[PHARE_LAMPS];       // the point in each lamp's frame, rows a, b, c
layout(location = 6 + PHARE_LAMPS) flat PHARE_VARYING vec4 lamp_place[PHARE_LAMPS];  // position relative to the eye; fine nodes per degree of first
layout(location = 6 + 2 * PHARE_LAMPS) flat PHARE_VARYING vec4 lamp_grid[PHARE_LAMPS];   // the same of second; places of first, of second; coarse steps, in one number

// Two whole numbers below kMaxNodes in one float, exactly. Varyings are few.
float in_one_number(vec2 n) { return n.x * float(kMaxNodes) + n.y; }
vec2 from_one_number(float n) {
  float high = floor(n / float(kMaxNodes));
  return vec2(high, n - high * float(kMaxNodes));
}

#ifdef PHARE_VERTEX
void pass_light() {
  exposure = frame.exposure.rgb;
  common_light = vec4(frame.lamps[0].colour.rgb, frame.sky.g);
#define PHARE_PASS(I)                                                                        \
  if (lamp_count > I) {                                                                      \
    vec3 d = point - frame.lamps[I].position.xyz;                                            \
    in_lamp[I] = vec3(dot(frame.lamps[I].row_a.xyz, d), dot(frame.lamps[I].row_b.xyz, d), dot(frame.lamps[I].row_c.xyz, d)); \
    lamp_place[I] = vec4(frame.lamps[I].position.xyz, frame.lamps[I].grid.x);                \
    lamp_grid[I] = vec4(frame.lamps[I].grid.yzw, in_one_number(frame.lamps[I].coarse.xy));   \
  }
  PHARE_EACH_LAMP(PHARE_PASS)
}
#endif
#endif
