// Intensity of a beam image and illuminance by one lamp: E = I(v)·cos(q)/r² (Lecocq et al. 1999, eq. 1).
#ifndef PHARE_BEAM
#define PHARE_BEAM
#include "lib/angles.h"
#include "lib/surface_varyings.glsl"

// Node before an angle (x) and the way to the next one, 0..1 (y). A guide bin holds at most one node: its angle, its index, and nodes
// per degree on either side. Index and fraction stay apart: their sum would keep only 1e-4 of a node's width in float32.
vec2 node_before(sampler2D guide, uint first_bin, float bin, float last_bin, float angle_deg) {
  uint at = first_bin + uint(clamp(bin, 0.0, last_bin));
  vec4 g = texelFetch(guide, ivec2(at & (kGuideRow - 1), at / kGuideRow), 0);
  float past_deg = angle_deg - g.x;
  return past_deg < 0.0 ? vec2(g.y - 1.0, 1.0 + past_deg * g.z) : vec2(g.y, past_deg * g.w);
}

// Bilinear between the four nodes about a cell, weights in float32.
float in_cell(sampler2D table, vec2 cell, vec2 part) {
  vec4 cd = textureGather(table, (cell + 1.0) / vec2(textureSize(table, 0)));
  return mix(mix(cd.w, cd.z, part.x), mix(cd.x, cd.y, part.x), part.y);
}

// cd toward p, given in the lamp's frame; bilinear on the table's nodes, dark outside.
float intensity_cd(sampler2D table, sampler2D guide, GpuLamp lamp, uint lookup, vec3 p, float first_per_deg, vec4 grid) {
  float first = atan2_deg(p.y, p.x);
  float second = atan2_deg(p.z, sqrt(p.x * p.x + p.y * p.y));
  vec2 cell, part;
  bool lit;
  if (lookup == kLookupGuide) {
    first += first < lamp.range.x ? 360.0 : 0.0;  // type C runs from 0 to 360
    lit = first <= lamp.range.y && second >= lamp.range.z && second <= lamp.range.w;
    vec2 u = node_before(guide, 0, (first - lamp.range.x) * lamp.bins_per_deg.x, lamp.bins_per_deg.z, first);
    vec2 v = node_before(guide, lamp.guide.x, (second - lamp.range.z) * lamp.bins_per_deg.y, lamp.bins_per_deg.w, second);
    cell = vec2(u.x, v.x);
    part = vec2(u.y, v.y);
  } else {
    // In nodes from the one at 0°: next to the cut-off the numbers are small and the parts exact.
    vec2 first_places = from_one_number(grid.y), second_places = from_one_number(grid.z);
    vec2 before = vec2(first_places.x, second_places.x), fine = vec2(first_places.y, second_places.y);
    vec2 at = vec2(first * first_per_deg, second * grid.x);
    if (lookup == kLookupEvenTurn) at.x += at.x < 0.0 ? 360.0 * first_per_deg : 0.0;
    else {
      vec2 inner = clamp(at, -fine, fine);
      at = inner + (at - inner) / from_one_number(grid.w);
    }
    vec2 node = floor(at);
    part = at - node;
    cell = node + before;
    vec2 last = vec2(textureSize(table, 0)) - 2.0 - before;
    lit = at.x >= -before.x && at.x <= last.x && at.y >= -before.y && at.y <= last.y;
  }
  return lit ? in_cell(table, cell, part) : 0.0;
}

struct LampLight {
  float illuminance_lx;  // on the surface
  float normal_lx;       // on a plane facing the lamp
  float cos_incidence;
  vec3 toward_lamp;      // unit
};

LampLight lamp_light(float cd, vec3 lamp_position, vec3 p, vec3 n) {
  vec3 d = p - lamp_position;
  float r2 = dot(d, d);
  float inv_r2 = r2 > 0.0 ? 1.0 / r2 : 0.0;
  LampLight light;
  light.toward_lamp = d * -sqrt(inv_r2);
  light.cos_incidence = max(dot(light.toward_lamp, n), 0.0);
  light.normal_lx = cd * inv_r2;
  light.illuminance_lx = light.normal_lx * light.cos_incidence;
  return light;
}

layout(constant_id = 5) const uint lookups = 0;
#define PHARE_LAMP_LIGHT(I) \
  lamp_light(intensity_cd(candela[I], guides[I], frame.lamps[I], (lookups >> (2 * I)) & 3, in_lamp[I], lamp_place[I].w, lamp_grid[I]), lamp_place[I].xyz, point, n)
#endif
