#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_COMPUTE
#include "precipitation.h"
#include "lib/beam.glsl"
#include "lib/fog.glsl"

// Two vertices a drop: the ends of the way that it goes past the eye while that sums light. Where a drop is follows from its number and the
// time alone. Of its light the lens sees I/r², wherever the drop is along its streak; drawn is that over the solid angle of the line.

layout(constant_id = kSpecDropsSnow) const uint snow = 0;
layout(constant_id = kSpecDropsStrict) const uint strict_lines = 0;
layout(push_constant) uniform Draw { GpuDrops draw; };
layout(location = 0) flat out vec3 luminance;

// A number for a number: Fibonacci hashing, twice.
uint scattered(uint n) {
  n = (n ^ (n >> 16)) * 0x9e3779b1u;
  n = (n ^ (n >> 15)) * 0x9e3779b1u;
  return n ^ (n >> 16);
}
float random_01(inout uint seed) {
  seed = scattered(seed + 0x632be5abu);
  return float(seed >> 8) * (1.0 / 16777216.0);
}

float fall_mps(float mm) {
  if (snow != 0u) return 1.0;
  return mm >= 0.5 ? 9.65 - 10.3 * exp(-0.6 * mm) : (9.65 - 10.3 * exp(-0.3)) * 2.0 * mm;
}

void main() {
  luminance = vec3(0.0);
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // seen by nobody
  uint number = uint(gl_VertexIndex) >> 1;
  int at = float(number) < draw.drops[0].z ? 0 : float(number) < draw.drops[1].z ? 1 : 2;
  vec4 place = draw.place[at], drops = draw.drops[at];

  // Which drop, and where it is now.
  uint seed = number;
  vec3 unit = vec3(random_01(seed), random_01(seed), random_01(seed));
  float mm = drops.x - log(1.0 - random_01(seed) * (1.0 - drops.y)) / draw.light.x;
  float turns = max(floor(fall_mps(mm) * kDropsPeriod_s / place.w + 0.5), 0.0);  // whole cubes a period
  unit.z -= turns * (draw.motion.w / kDropsPeriod_s);
  mat4 clip = clip_from_eye();
  vec3 ahead = vec3(clip[0].w, clip[1].w, clip[2].w);
  vec3 middle = (fract(unit - place.xyz + 0.5) - 0.5) * place.w + ahead * (0.5 * place.w);
  float r2 = dot(middle, middle), r = sqrt(r2), along = dot(ahead, middle);
  if (r < kDropsFrom_m || r > drops.w || along < 0.1) return;

  // Its streak.
  vec3 half_way = -0.5 * (vec3(0.0, 0.0, turns * place.w / kDropsPeriod_s * draw.light.w) + draw.motion.xyz);
  vec4 from = clip * vec4(middle - half_way, 1.0), to = clip * vec4(middle + half_way, 1.0);
  if (from.w < 0.05 || to.w < 0.05) return;
  vec2 size_px = frame.size_px.xy, way_px = 0.5 * size_px * (to.xy / to.w - from.xy / from.w);
  float length_px = length(way_px);
  if (length_px < 1.0) {  // a pixel at least
    vec4 centre = 0.5 * (from + to);
    vec2 least = length_px > 1e-3 ? way_px / length_px : vec2(0.0, 1.0);
    way_px = least;
    length_px = 1.0;
    from = centre - vec4(least / size_px * centre.w, 0.0, 0.0);
    to = centre + vec4(least / size_px * centre.w, 0.0, 0.0);
  }
  float width = strict_lines != 0u ? 1.0 : max(abs(way_px.x), abs(way_px.y)) / length_px;
  float cosine = along / r;
  float line_sr = length_px * width * frame.size_px.z * cosine * cosine * cosine;

  // Its light.
  float area_m2 = draw.light.y * mm * mm, g = draw.light.z;
  vec3 candela = vec3(0.0);
#define LIGHT_DROP(I)                                                                                                                     \
  if (lamp_count > I) {                                                                                                                   \
    vec3 way = middle - frame.lamps[I].position.xyz;                                                                                      \
    vec3 in_table = vec3(dot(frame.lamps[I].row_a.xyz, way), dot(frame.lamps[I].row_b.xyz, way), dot(frame.lamps[I].row_c.xyz, way));     \
    LampLight lamp = PHARE_LIGHT_AT(I, in_table, 0.0);                                                                                    \
    float turn = -dot(way, middle) * lamp.per_m / r, s = 1.0 + g * g - 2.0 * g * turn;                                                    \
    float phase = (1.0 - g * g) / (4.0 * radians(180.0) * s * sqrt(s));                                                                   \
    candela += frame.lamps[I].colour.rgb * (lamp.cd * min(lamp.per_m * lamp.per_m, 1e4) * phase * fog_left(lamp.distance_m));             \
  }
  PHARE_EACH_LAMP(LIGHT_DROP)
  luminance = candela * (area_m2 * fog_left(r) / (r2 * line_sr));
  gl_Position = (gl_VertexIndex & 1) == 0 ? from : to;
}
