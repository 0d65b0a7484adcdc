#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_COMPUTE
#include "fog.h"
#include "lib/beam.glsl"
#include "lib/fog.glsl"

// Light that fog scatters into the rays of the grid, summed slice by slice from the eye. Of each lamp a slice is taken at points that lie
// evenly in the angle at the lamp (equiangular sampling, Kulla and Fajardo 2012): the way through near it is short in metres and long in
// light. There ds/r² = d(angle)/aside.

layout(local_size_x = 64) in;
layout(std430, set = 1, binding = 0) buffer Cells { float cell_nodes[]; };
layout(set = 1, binding = 1) uniform samplerBuffer phase;
layout(constant_id = kSpecFogSamples) const uint samples = 1;
layout(constant_id = kSpecFogAdd) const uint add = 0;

// 1/sr, between a lamp's light going on as it came (0) and coming back (pi).
float phase_at(float angle_deg) {
  float at = angle_deg * (float(kFogPhaseSteps) / 180.0);
  float step = min(floor(at), float(kFogPhaseSteps) - 1.0);
  vec2 ends = texelFetch(phase, int(step)).xy;
  return mix(ends.x, ends.y, at - step);
}

void main() {
  int columns = int(fog_grid & 0xffffu), rows = int(fog_grid >> 16u);
  int index = int(gl_GlobalInvocationID.x);
  if (index >= columns * rows) return;
  int column = index % columns, row = index / columns;
  // Down the view, from the row as fog_light() has it.
  vec4 close = frame.fog.rows;
  float first_close = close.z * close.x, last_close = first_close + close.w * (close.y - close.x), down = float(row);
  float share = down < first_close ? down / close.z : down < last_close ? close.x + (down - first_close) / close.w : close.y + (down - last_close) / close.z;
  vec3 direction = normalize(frame.fog.ray.xyz + frame.fog.ray_right.xyz * (float(column) / float(columns - 1)) + frame.fog.ray_down.xyz * share);
  int node = row * (columns + 1) + column, slice_cells = (rows + 1) * (columns + 1);

#define RAY_OF_LAMP(I)                                                                                                              \
  vec3 lamp_##I = frame.lamps[I].position.xyz, aside_##I = cross(direction, lamp_##I);                                            \
  float along_##I = dot(direction, lamp_##I), d2_##I = max(dot(aside_##I, aside_##I), 1e-4), d_##I = sqrt(d2_##I); \
  float r_##I = sqrt(d2_##I + along_##I * along_##I), angle_##I = atan2_deg(-along_##I, d_##I); \
  vec3 turned_##I = vec3(dot(frame.lamps[I].row_a.xyz, direction), dot(frame.lamps[I].row_b.xyz, direction), dot(frame.lamps[I].row_c.xyz, direction)); \
  vec3 place_##I = vec3(dot(frame.lamps[I].row_a.xyz, lamp_##I), dot(frame.lamps[I].row_b.xyz, lamp_##I), dot(frame.lamps[I].row_c.xyz, lamp_##I));
  PHARE_EACH_LAMP(RAY_OF_LAMP)

  float sum = 0.0, from = 0.0;
  for (uint slice = 0u; slice <= fog_slices; ++slice) {
    for (uint k = 0u; k < samples && slice > 0u; ++k) {
      float end = float(slice - 1u) + float(k + 1u) / float(samples);
      float to = frame.fog.air.z * end / max(float(fog_slices) - end, 1e-4 * float(fog_slices));
#define SCATTER(I)                                                                                                                     \
  if (lamp_count > I) {                                                                                                                \
    float a = from - along_##I, b = to - along_##I, rb = sqrt(d2_##I + b * b), after = atan2_deg(b, d_##I);                            \
    float middle = (a * rb + b * r_##I) / (r_##I + rb);                                                                                \
    float way = sqrt(d2_##I + middle * middle) + along_##I + middle;                                                                   \
    float cd = lamp_light(cells[I % kTables], guides[I % kTables], filtered[I % kFilters], PHARE_SHAPE(I),                             \
                          turned_##I * (along_##I + middle) - place_##I, 0.0, frame.lamps[I].colour.w).cd;                             \
    sum += cd * radians(after - angle_##I) / d_##I * phase_at(90.0 + 0.5 * (angle_##I + after)) * fog_left(way);                       \
    r_##I = rb;                                                                                                                        \
    angle_##I = after;                                                                                                                 \
  }
      PHARE_EACH_LAMP(SCATTER)
      from = to;
    }
    float light = sum * frame.fog.air.y / fog_nearness(direction, from);
    int first = int(slice) * slice_cells + node;  // of the cell to the upper left of this node
    if (add != 0u) light += cell_nodes[4 * first + 3];
    cell_nodes[4 * first + 3] = light;
    cell_nodes[4 * (first + 1) + 2] = light;
    cell_nodes[4 * (first + columns + 1) + 1] = light;
    cell_nodes[4 * (first + columns + 2)] = light;
  }
}
