// Intensity of a beam image and illuminance by one lamp: E = I(v)·cos(q)/r² (Lecocq et al. 1999, eq. 1).
#ifndef PHARE_BEAM
#define PHARE_BEAM
#include "lib/angles.h"
#include "lib/surface_varyings.glsl"

// An angle as the table has it: the multiple of 45° that is nearest, and the rest in degrees. What lies beyond the table's last angle is a turn less.
vec2 table_angle(float y, float x, float last_deg) {
  vec2 octants = atan2_octants(y, x);
  float rest_deg = degrees(octants.y);
  return vec2(octants.x * 45.0 + rest_deg > last_deg ? octants.x - 8.0 : octants.x, rest_deg);
}

// Node before an angle (x) and the way to the next one, 0..1 (y). A guide bin holds at most one node: its angle from the same multiple of 45°, its
// index, and nodes per degree on either side. Index and fraction stay apart: their sum would keep only 1e-4 of a node's width in float32.
vec2 node_before(sampler2D guide, uint first_bin, uint bins_in_octant, vec2 angle, float first_octant, float bins_per_deg) {
  uint bin = uint(clamp((angle.y + 22.5) * bins_per_deg, 0.0, float(bins_in_octant - 1)));
  uint at = first_bin + uint(max(angle.x - first_octant, 0.0)) * bins_in_octant + bin;
  vec4 g = texelFetch(guide, ivec2(at & (kGuideRow - 1), at / kGuideRow), 0);
  float past_deg = angle.y - g.x;
  return past_deg < 0.0 ? vec2(g.y - 1.0, 1.0 + past_deg * g.z) : vec2(g.y, past_deg * g.w);
}

// Where a lamp's table was last looked up, and what its value was multiplied by since: its table of colour lies on the same nodes.
vec2 looked_up_at, looked_up_part;
float looked_up_factor;

// Bilinear between the four nodes that a gather at `coordinate` finds, weights in float32.
float between(sampler2D table, vec2 coordinate, vec2 part) {
  looked_up_at = coordinate;
  looked_up_part = part;
  vec4 cd = textureGather(table, coordinate);
  return mix(mix(cd.w, cd.z, part.x), mix(cd.x, cd.y, part.x), part.y);
}

// The same for a flat screen: a projection in place of angles. E on the screen is bilinear there, and I = E·D²·(1 + t²)^1.5.
float screen_intensity(sampler2D table, sampler2D guide, GpuLamp lamp, uint lookup, vec3 p, vec4 nodes, vec4 coordinates) {
  vec2 at = p.yz * (1.0 / p.x);
  float s = 1.0 + dot(at, at);
  float value;
  bool lit = p.x > 0.0;
  // The screen's rim belongs to it, and float32 misses it by a little: what is nearer than that counts as within.
  if (lookup == kLookupFilterScreen) {
    lit = lit && all(lessThan(abs(at - clamp(at, nodes.xz, nodes.yw)), vec2(1e-6)));
    looked_up_at = at * coordinates.xy + coordinates.zw;
    value = textureLod(table, looked_up_at, 0.0).r;
  } else if (lookup == kLookupScreenGuide) {
    at *= nodes.xy;
    vec2 within = clamp(at, lamp.range.xz, lamp.range.yw);
    lit = lit && all(lessThan(abs(at - within), vec2(2e-5)));
    vec2 u = node_before(guide, 0, lamp.guide.y, vec2(0.0, within.x), 0.0, lamp.bins.x);
    vec2 v = node_before(guide, lamp.guide.x, lamp.guide.z, vec2(0.0, within.y), 0.0, lamp.bins.y);
    value = between(table, (vec2(u.x, v.x) + 1.0) / vec2(textureSize(table, 0)), vec2(u.y, v.y));
  } else {
    at *= nodes.xy;
    vec2 within = clamp(at, lamp.within.xz, lamp.within.yw);
    lit = lit && all(lessThan(abs(at - within), vec2(1e-3)));
    vec2 node = floor(within);
    value = between(table, node * coordinates.xy + coordinates.zw, within - node);
  }
  looked_up_factor = s * sqrt(s);
  return lit ? value * looked_up_factor : 0.0;
}

// In what the texture holds (candela, unless scaled) toward p, given in the lamp's frame; bilinear on the table's nodes, dark outside. `h`: length of p without its third component.
float intensity(sampler2D table, sampler2D guide, GpuLamp lamp, uint lookup, vec3 p, float h, float inverse_coarse, vec4 nodes, vec4 coordinates) {
  if (lookup == kLookupScreen || lookup == kLookupScreenGuide || lookup == kLookupFilterScreen)
    return screen_intensity(table, guide, lamp, lookup, p, nodes, coordinates);
  if (lookup == kLookupGuide) {
    vec2 first = table_angle(p.y, p.x, lamp.range.y), second = table_angle(p.z, h, lamp.range.w);
    vec2 angles = vec2(first.x, second.x) * 45.0 + vec2(first.y, second.y);
    bool lit = all(greaterThanEqual(angles, lamp.range.xz)) && all(lessThanEqual(angles, lamp.range.yw));
    vec2 u = node_before(guide, 0, lamp.guide.y, first, lamp.bins.z, lamp.bins.x);
    vec2 v = node_before(guide, lamp.guide.x, lamp.guide.z, second, lamp.bins.w, lamp.bins.y);
    return lit ? between(table, (vec2(u.x, v.x) + 1.0) / vec2(textureSize(table, 0)), vec2(u.y, v.y)) : 0.0;
  }
  if (lookup == kLookupFilter || lookup == kLookupFilterAhead) {
    vec2 angles;
    if (lookup == kLookupFilterAhead) angles = vec2(atan2_forward_rad(p.y, p.x), atan2_forward_rad(p.z, h));
    else {
      angles = radians(vec2(atan2_deg(p.y, p.x), atan2_deg(p.z, h)));
      angles.x += angles.x < nodes.x ? radians(360.0) : 0.0;
    }
    bool lit = all(greaterThanEqual(angles, nodes.xz)) && all(lessThanEqual(angles, nodes.yw));
    if (lookup == kLookupFilterAhead) lit = lit && p.x > 0.0;
    looked_up_at = angles * coordinates.xy + coordinates.zw;
    float filtered = textureLod(table, looked_up_at, 0.0).r;
    return lit ? filtered : 0.0;
  }
  vec2 node, part;
  bool lit;
  if (lookup == kLookupTurn) {
    vec2 first = atan2_octants(p.y, p.x), second = atan2_octants(h, -p.z);
    vec2 past = vec2(first.y, second.y) * nodes.xy;
    node = vec2(first.x, second.x) * nodes.zw + floor(past);
    part = past - floor(past);
    // The limits belong to the table, and float32 misses them by up to 1e-4 of a node: what is nearer than that counts as within.
    vec2 beyond = node + part - clamp(node + part, lamp.within.xz, lamp.within.yw);
    lit = all(lessThan(abs(beyond), vec2(1e-3)));
    if (beyond.x != 0.0) part.x = 0.0;
    if (beyond.y != 0.0) part.y = 0.0;
    node = clamp(node, lamp.within.xz, lamp.within.yw);
  } else {
    // In nodes from the one at 0°: next to the cut-off the numbers are small and the parts exact.
    vec2 at = vec2(atan2_forward_rad(p.y, p.x), atan2_forward_rad(p.z, h)) * nodes.xy;
    vec2 fine = clamp(at, -nodes.zw, nodes.zw);
    at = fine + (at - fine) * inverse_coarse;
    lit = p.x > 0.0;
    if (lookup == kLookupAhead) lit = lit && at.x >= lamp.within.x && at.x <= lamp.within.y && at.y >= lamp.within.z && at.y <= lamp.within.w;
    node = floor(at);
    part = at - node;
  }
  float cd = between(table, node * coordinates.xy + coordinates.zw, part);
  return lit ? cd : 0.0;
}

struct LampLight {
  float illuminance_lx;  // on the surface
  float normal_lx;       // on a plane facing the lamp
  float cos_incidence;
  float cd;
};

layout(constant_id = 5) const uint lookups = 0;

// By a lamp at `place` (w: inverse of its coarse step); `level`: n·point. The rows of a lamp's frame are orthonormal, so p is as long as the way.
LampLight lamp_light(sampler2D table, sampler2D guide, GpuLamp lamp, uint lookup, vec3 p, vec4 place, vec4 nodes, vec4 coordinates, vec3 n, float level) {
  float h2 = p.x * p.x + p.y * p.y;
  float r2 = h2 + p.z * p.z;
  bool filtered = (lookup & kLookupKind) >= kLookupFilter;
  looked_up_factor = 1.0;
  float cd = intensity(table, guide, lamp, filtered ? lookup : lookup & kLookupKind, p, sqrt(h2), place.w, nodes, coordinates);
  if (filtered) cd *= place.w;
  else if ((lookup & kLookupScaled) != 0) cd *= lamp.colour.w;
  float inverse_r = r2 > 0.0 ? inversesqrt(r2) : 0.0;
  LampLight light;
  light.cd = cd;
  light.cos_incidence = max(dot(place.xyz, n) - level, 0.0) * inverse_r;
  light.normal_lx = r2 > 0.0 ? cd * (inverse_r * inverse_r) : 0.0;
  light.illuminance_lx = light.normal_lx * light.cos_incidence;
  return light;
}

// Linear Rec. 709 of the light that was looked up last, luminance 1: red and blue from their own table, green is what luminance leaves.
vec3 lamp_tint(sampler2D tint, uint kind, vec4 scale, float cd) {
  vec2 red_blue;
  if (kind >= kLookupFilter) {
    red_blue = textureLod(tint, looked_up_at, 0.0).rg;
  } else {
    vec4 red = textureGather(tint, looked_up_at, 0), blue = textureGather(tint, looked_up_at, 1);
    vec4 low = mix(vec4(red.w, blue.w, red.x, blue.x), vec4(red.z, blue.z, red.y, blue.y), looked_up_part.x);
    red_blue = mix(low.xy, low.zw, looked_up_part.y);
  }
  if (cd <= 0.0) return vec3(1.0);
  red_blue *= scale.xz * (looked_up_factor / cd);
  return max(vec3(red_blue.x, (1.0 - 0.2126 * red_blue.x - 0.0722 * red_blue.y) / 0.7152, red_blue.y), 0.0);
}

// Right after PHARE_LAMP_LIGHT(I).
#define PHARE_LAMP_TINT(I, LIGHT) lamp_tint(tints[I], (lookups >> (4 * I)) & kLookupKind, frame.lamps[I].colour, LIGHT.cd)

#define PHARE_LAMP_LIGHT(I)                                                                                                    \
  lamp_light(candela[I], guides[I], frame.lamps[I], (lookups >> (4 * I)) & 15, in_lamp[I], PHARE_LAMP_POSITION(I), PHARE_LAMP_NODES(I), \
             PHARE_LAMP_COORDINATES(I), n, level)
#endif
