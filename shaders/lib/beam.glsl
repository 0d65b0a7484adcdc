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

// Bilinear between the four nodes that a gather at `coordinate` finds, weights in float32.
float between(sampler2D table, vec2 coordinate, vec2 part) {
  vec4 cd = textureGather(table, coordinate);
  return mix(mix(cd.w, cd.z, part.x), mix(cd.x, cd.y, part.x), part.y);
}

// cd toward p, given in the lamp's frame; bilinear on the table's nodes, dark outside. `h`: length of p without its third component.
float intensity_cd(sampler2D table, sampler2D guide, GpuLamp lamp, uint lookup, vec3 p, float h, float inverse_coarse, vec4 nodes, vec4 coordinates) {
  if (lookup == kLookupGuide) {
    float first = atan2_deg(p.y, p.x);
    float second = atan2_deg(p.z, h);
    first += first < lamp.range.x ? 360.0 : 0.0;  // type C runs from 0 to 360
    bool lit = first <= lamp.range.y && second >= lamp.range.z && second <= lamp.range.w;
    vec2 u = node_before(guide, 0, (first - lamp.range.x) * lamp.bins_per_deg.x, lamp.bins_per_deg.z, first);
    vec2 v = node_before(guide, lamp.guide.x, (second - lamp.range.z) * lamp.bins_per_deg.y, lamp.bins_per_deg.w, second);
    return lit ? between(table, (vec2(u.x, v.x) + 1.0) / vec2(textureSize(table, 0)), vec2(u.y, v.y)) : 0.0;
  }
  // In nodes from the one at 0°: next to the cut-off the numbers are small and the parts exact.
  vec2 at;
  bool lit;
  if (lookup == kLookupTurn) {
    at = vec2(radians(atan2_deg(p.y, p.x)), atan2_forward_rad(p.z, h)) * nodes.xy;
    at.x += at.x < 0.0 ? lamp.within.w : 0.0;  // a whole turn
    // The poles are nodes, and float32 misses them by up to 1e-4 of a node: what is nearer than that to the edge counts as within.
    vec2 inside = vec2(min(at.x, lamp.within.x), clamp(at.y, lamp.within.y, lamp.within.z));
    lit = all(lessThan(abs(at - inside), vec2(1e-3)));
    at = inside;
  } else {
    at = vec2(atan2_forward_rad(p.y, p.x), atan2_forward_rad(p.z, h)) * nodes.xy;
    vec2 fine = clamp(at, -nodes.zw, nodes.zw);
    at = fine + (at - fine) * inverse_coarse;
    lit = p.x > 0.0;
    if (lookup == kLookupAhead) lit = lit && at.x >= lamp.within.x && at.x <= lamp.within.y && at.y >= lamp.within.z && at.y <= lamp.within.w;
  }
  vec2 node = floor(at);
  float cd = between(table, node * coordinates.xy + coordinates.zw, at - node);
  return lit ? cd : 0.0;
}

struct LampLight {
  float illuminance_lx;  // on the surface
  float normal_lx;       // on a plane facing the lamp
  float cos_incidence;
};

layout(constant_id = 5) const uint lookups = 0;

// By a lamp at `place` (w: inverse of its coarse step); `level`: n·point. The rows of a lamp's frame are orthonormal, so p is as long as the way.
LampLight lamp_light(sampler2D table, sampler2D guide, GpuLamp lamp, uint lookup, vec3 p, vec4 place, vec4 nodes, vec4 coordinates, vec3 n, float level) {
  float h2 = p.x * p.x + p.y * p.y;
  float r2 = h2 + p.z * p.z;
  float cd = intensity_cd(table, guide, lamp, lookup, p, sqrt(h2), place.w, nodes, coordinates);
  float inverse_r = r2 > 0.0 ? inversesqrt(r2) : 0.0;
  LampLight light;
  light.cos_incidence = max(dot(place.xyz, n) - level, 0.0) * inverse_r;
  light.normal_lx = r2 > 0.0 ? cd * (inverse_r * inverse_r) : 0.0;
  light.illuminance_lx = light.normal_lx * light.cos_incidence;
  return light;
}

#define PHARE_LAMP_LIGHT(I)                                                                                                    \
  lamp_light(candela[I], guides[I], frame.lamps[I], (lookups >> (2 * I)) & 3, in_lamp[I], PHARE_LAMP_POSITION(I), PHARE_LAMP_NODES(I), \
             PHARE_LAMP_COORDINATES(I), n, level)
#endif
