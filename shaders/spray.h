// Contract of the spray behind vehicles (spray.vert, spray.frag): one draw a vehicle, and the cloud itself, which is
// what its puffs are.
#ifndef PHARE_SHADERS_SPRAY_H
#define PHARE_SHADERS_SPRAY_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

const uint kSprayPuffs = 64u;  // of a vehicle, by turns of its left and right wheels
const uint kSprayRows = 16u;   // strips of a puff as it is drawn: light is computed at their edges
const uint kSprayVertices = 2u * (kSprayRows + 1u);
const uint kSprayLives = 3u;  // the oldest puff has so many lives: 5 % of the first are left, and none at its end
const uint kSprayNumbers = 1u << 20u;  // puffs are counted up to this, which a float holds

// Push constants. Places are relative to the eye, m.
struct GpuSpray {
  vec4 trail[3];  // xyz: between the wheels on the road, now, half the oldest puff's age ago and all of it; w: of the
                  // youngest puff the age, s; its number; 1: it is the farthest one
  vec4 left;      // xyz: of the vehicle; w: half its track, m
  vec4 puff;      // x: what one scatters as it is thrown up, m²; y: its radius then, m; z: it grows by, m/s; w: a life, s
  vec4 light;     // x: g; y: from puff to puff, s; z: of a tail lamp straight behind, cd
  vec4 tail[2];   // xyz: of the tail lamps; w: red and blue of their light, whose luminance is 1
};

// What wraps the eye and its lamps is left out: none of it to here, all of it from there on. Chosen.
const float kSprayNone_m = 6.0f, kSprayAll_m = 12.0f;

struct SprayPuff {
  vec3 middle;        // relative to the eye, m
  float radius_m;     // nothing of it lies beyond
  float scatters_m2;  // all of it together
};

// Like what falls (precipitation.vert): a number for a number.
PHARE_INLINE uint spray_scattered(uint n) {
  n = (n ^ (n >> 16u)) * 0x9e3779b1u;
  n = (n ^ (n >> 15u)) * 0x9e3779b1u;
  return n ^ (n >> 16u);
}
PHARE_INLINE float spray_random_01(uint seed) { return float(spray_scattered(seed) >> 8u) * (1.0f / 16777216.0f); }

PHARE_INLINE float spray_part(float from, float to, float at) {
  float x = clamp((at - from) / (to - from), 0.0f, 1.0f);
  return x * x * (3.0f - 2.0f * x);
}

// The puff that was thrown up as the `i`-th before now; near the eye less of it, and none.
PHARE_INLINE SprayPuff spray_puff(GpuSpray spray, uint i) {
  float age_s = spray.trail[0].w + float(i) * spray.light.y, all_s = float(kSprayLives) * spray.puff.w;
  float t = min(age_s / all_s, 1.0f);
  uint number = (uint(spray.trail[1].w) + kSprayNumbers - i) % kSprayNumbers, seed = 4u * number;
  SprayPuff puff;
  puff.radius_m = spray.puff.y + spray.puff.z * age_s;
  float side = (number & 1u) == 0u ? spray.left.w : -spray.left.w;
  float aside_m = side + (spray_random_01(seed) - 0.5f) * puff.radius_m;
  float up_m = (0.6f + 0.2f * (spray_random_01(seed + 1u) - 0.5f)) * puff.radius_m;
  vec3 now = vec3(spray.trail[0]), half_ago = vec3(spray.trail[1]), ago = vec3(spray.trail[2]);
  vec3 road = (1.0f - t) * (1.0f - 2.0f * t) * now + 4.0f * t * (1.0f - t) * half_ago + t * (2.0f * t - 1.0f) * ago;
  puff.middle = road + aside_m * vec3(spray.left) + vec3(0.0f, 0.0f, up_m);
  float begins = spray_part(0.0f, 0.1f, age_s), ends = 1.0f - spray_part(0.8f, 1.0f, t);
  float of_mean = 0.5f + spray_random_01(seed + 2u);
  float before_eye = spray_part(kSprayNone_m, kSprayAll_m, length(puff.middle));
  puff.scatters_m2 = spray.puff.x * exp(-age_s / spray.puff.w) * of_mean * begins * ends * before_eye;
  return puff;
}

// Of a puff (1 - r²/R²)² dense: what lies on a line that passes its middle at b, times its radius squared over what it
// scatters. The integral over the disc is 1.
PHARE_INLINE float spray_column(float b2_of_radius2) {
  float c2 = max(1.0f - b2_of_radius2, 0.0f);
  return 3.5f / 3.14159265f * c2 * c2 * sqrt(c2);
}

// Henyey and Greenstein's, 1/sr; `turn`: cosine of the angle by which light is turned.
PHARE_INLINE float spray_phase(float g, float turn) {
  float s = 1.0f + g * g - 2.0f * g * turn;
  return (1.0f - g * g) / (4.0f * 3.14159265f * s * sqrt(s));
}

// Light of a tail lamp is that of so far aside at the least: along a line of sight one value stands for a puff.
const float kSprayNearest_m = 0.3f;

PHARE_SHADER_END
#endif
