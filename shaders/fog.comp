#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_COMPUTE
#include "fog.h"
#include "precipitation.h"
#include "lib/beam.glsl"
#include "lib/fog.glsl"
#ifdef PHARE_AIR_SHADOWS
#define PHARE_SHADOW_SET 2
#include "lib/shadow_map.glsl"
layout(constant_id = kSpecShadowMaps) const uint shadow_maps = 0;
#define PHARE_MAP_OF(I) (shadow_maps >> (4 * I) & 15u)
#endif

// Light that fog scatters into the rays of the grid, summed slice by slice from the eye. Of each lamp a slice is taken at points that lie
// evenly in the angle at the lamp (equiangular sampling, Kulla and Fajardo 2012), more of them the more of it the slice takes: the way
// through near a lamp is short in metres and long in light. There ds/r² = d(angle)/aside.

const float kGauss = 0.28867513;       // of the two points of a step, on either side of its middle
const float kNarrow = 0.25;           // of the widest step: one point is enough
// Where light comes toward the eye and goes on nearly as it came, most of it is scattered, within the few degrees of its beam's own figure:
// steps there begin at this share of the widest, and are longer by this share of the angle from there.
const float kFirst = 0.125, kGrows = 0.5;
const float kRest = 0.01;  // of the widest: no step of less is left over
const float kNowhere_deg = 1000.0;  // in place of the angle at a lamp up to which its vehicle's body hides a ray, on both sides
const float kFogMost_cdm2 = 65000.0;  // what half floats hold

layout(local_size_x = 64) in;
layout(std430, set = 1, binding = 0) buffer Cells { uint cell_nodes[]; };
layout(set = 1, binding = 1) uniform samplerBuffer phase;
layout(set = 1, binding = 2) uniform samplerBuffer fog_places;
layout(constant_id = kSpecFogSteps) const uint least_steps = 1;
layout(constant_id = kSpecFogWidest) const float widest_deg = 10.0;
layout(constant_id = kSpecFogAdd) const uint add = 0;

// 1/sr, between a lamp's light going on as it came (0) and coming back (pi), `way_m` from the eye: what is drawn drop by drop is not in it.
float phase_at(float angle_deg, float way_m) {
  float at = angle_deg * (float(kFogPhaseSteps) / 180.0);
  float step = min(floor(at), float(kFogPhaseSteps) - 1.0);
  vec4 ends = texelFetch(phase, int(step));
  vec2 all_particles = mix(ends.xz, ends.yw, at - step);
  float drawn = way_m < kDropsFrom_m ? 0.0 : dot(frame.fog.drawn_share.xyz, vec3(lessThan(vec3(way_m), frame.fog.drawn_to_m.xyz)));
  return all_particles.x - drawn * all_particles.y;
}

#ifdef PHARE_AIR_SHADOWS
// How much of the air's way between two angles at the lamp its light reaches, by as many places on the way: even in metres, for a tangent takes
// longer than the rest. `eye`, `ray`: as the map has the eye, and a metre of the ray.
float reaching_air(uint lamp, uint map, vec3 eye, vec3 ray, float along_m, float aside_m, float from_deg, float over_deg) {
  float from_m = along_m + aside_m * tan(radians(from_deg)), to_m = along_m + aside_m * tan(radians(from_deg + over_deg));
  float reaching = 0.0;
  for (uint i = 0u; i < shadow_taps; ++i) {
    vec3 at = eye + ray * mix(from_m, to_m, (float(i) + 0.5) / float(shadow_taps));
    ShadowPlace place = shadow_seek(at, map, frame.shadows[lamp].zoom.x, 1u);
    reaching += texelFetch(shadow_depths, place.index).r > place.nearer ? 0.0 : 1.0;
  }
  return reaching / float(shadow_taps);
}

#define RAY_IN_MAP(I) \
  vec3 eye_in_map_##I, ray_in_map_##I; \
  if (PHARE_MAP_OF(I) != 0u) { \
    GpuShadow to = frame.shadows[I]; \
    eye_in_map_##I = vec3(to.u.w, to.v.w, to.w.w); \
    ray_in_map_##I = vec3(dot(to.u.xyz, direction), dot(to.v.xyz, direction), dot(to.w.xyz, direction)); \
  }
#define SHADE_AIR(I, FROM_DEG, OVER_DEG) \
  if (PHARE_MAP_OF(I) != 0u && cd > 0.0) \
    cd *= reaching_air(I, PHARE_MAP_OF(I) - 1u, eye_in_map_##I, ray_in_map_##I, along_##I, d_##I, FROM_DEG, OVER_DEG);
#else
#define RAY_IN_MAP(I)
#define SHADE_AIR(I, FROM_DEG, OVER_DEG)
#endif

void main() {
  int columns = int(fog_grid & 0xffffu), rows = int(fog_grid >> 16u);
  int index = int(gl_GlobalInvocationID.x);
  if (index >= columns * rows) return;
  int column = index % columns, row = index / columns;
  vec3 direction = normalize(frame.fog.ray.xyz + frame.fog.ray_right.xyz * texelFetch(fog_places, column).x +
                             frame.fog.ray_down.xyz * texelFetch(fog_places, row).y);
  int node = row * (columns + 1) + column, slice_cells = (rows + 1) * (columns + 1);

#define RAY_OF_LAMP(I)                                                                                                              \
  vec3 lamp_##I = frame.lamps[I].position.xyz, aside_##I = cross(direction, lamp_##I);                                            \
  float along_##I = dot(direction, lamp_##I), d2_##I = max(dot(aside_##I, aside_##I), 1e-4), d_##I = sqrt(d2_##I); \
  float angle_##I = atan2_deg(-along_##I, d_##I); \
  float hidden_##I = d_##I < frame.lamps[I].row_c.w ? degrees(acos(d_##I / frame.lamps[I].row_c.w)) : -kNowhere_deg; \
  vec3 turned_##I = vec3(dot(frame.lamps[I].row_a.xyz, direction), dot(frame.lamps[I].row_b.xyz, direction), dot(frame.lamps[I].row_c.xyz, direction)); \
  vec3 place_##I = vec3(dot(frame.lamps[I].row_a.xyz, lamp_##I), dot(frame.lamps[I].row_b.xyz, lamp_##I), dot(frame.lamps[I].row_c.xyz, lamp_##I)); \
  TableShape shape_##I = PHARE_SHAPE(I); \
  RAY_IN_MAP(I)
  PHARE_EACH_LAMP(RAY_OF_LAMP)

  float sum = 0.0;
  for (uint slice = 0u; slice < fog_slices; ++slice) {
    float before = sum, end = float(slice + 1u);
    float to = frame.fog.air.z * end / max(float(fog_slices) - end, 1e-4 * float(fog_slices));
#define SCATTER(I)                                                                                                                     \
  if (lamp_count > I) {                                                                                                                \
    float after = atan2_deg(to - along_##I, d_##I), most = (after - angle_##I) / float(least_steps), lamp_sum = 0.0;                     \
    bool second = false;                                                                                                               \
    while (angle_##I < after) {                                                                                                        \
      if (angle_##I >= -hidden_##I && angle_##I < hidden_##I) {                                                                        \
        angle_##I = min(hidden_##I, after);                                                                                            \
        continue;                                                                                                                      \
      }                                                                                                                                \
      float stop = angle_##I < -hidden_##I ? min(-hidden_##I, after) : after;                                                          \
      float step_deg = min(min(most, widest_deg), kFirst * widest_deg + kGrows * (90.0 + angle_##I));                                  \
      if (angle_##I + step_deg > stop - kRest * widest_deg) step_deg = stop - angle_##I;                                               \
      bool narrow = step_deg < kNarrow * widest_deg;                                                                                   \
      float at_deg = angle_##I + step_deg * (narrow ? 0.5 : second ? 0.5 + kGauss : 0.5 - kGauss);                                     \
      float at = radians(at_deg), past = d_##I * tan(at), r = d_##I / cos(at);                                                         \
      float cd = light_at_##I(shape_##I, turned_##I * (along_##I + past) - place_##I, 0.0).cd;                                         \
      SHADE_AIR(I, angle_##I + (second ? 0.5 * step_deg : 0.0), narrow ? step_deg : 0.5 * step_deg)                                    \
      lamp_sum += (narrow ? step_deg : 0.5 * step_deg) * cd * phase_at(90.0 + at_deg, along_##I + past) * fog_left(r + along_##I + past); \
      if (narrow || second) angle_##I = step_deg < stop - angle_##I ? angle_##I + step_deg : stop;                                     \
      second = !narrow && !second;                                                                                                     \
    }                                                                                                                                  \
    sum += lamp_sum * (radians(1.0) / d_##I);                                                                                          \
    angle_##I = after;                                                                                                                 \
  }
    PHARE_EACH_LAMP(SCATTER)
    int first = 4 * (int(slice) * slice_cells + node);  // of the cell to the upper left of this node
    vec2 light = vec2(before, sum) * frame.fog.air.y;
    if (add != 0u) light += unpackHalf2x16(cell_nodes[first + 3]);
    uint ends = packHalf2x16(min(light, vec2(kFogMost_cdm2)));
    cell_nodes[first + 3] = ends;
    cell_nodes[first + 4 + 2] = ends;
    cell_nodes[first + 4 * (columns + 1) + 1] = ends;
    cell_nodes[first + 4 * (columns + 2)] = ends;
  }
}
