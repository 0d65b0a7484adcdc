// Intensity of a beam image and illuminance by one lamp: E = I(v)·cos(q)/r² (Lecocq et al. 1999, eq. 1).
#ifndef PHARE_BEAM
#define PHARE_BEAM
#include "lib/angles.h"
#include "lib/luminance.h"
#ifdef PHARE_LEAN
#include "lib/lean_varyings.glsl"
#else
#include "lib/surface_varyings.glsl"
#endif
#include "lib/table_shapes.glsl"

// An angle as the table has it: the multiple of 45° that is nearest, and the rest in degrees. What lies beyond the table's last angle is a turn less.
vec2 table_angle(float y, float x, float last_deg) {
  vec2 octants = atan2_octants(y, x);
  float rest_deg = degrees(octants.y);
  return vec2(octants.x * 45.0 + rest_deg > last_deg ? octants.x - 8.0 : octants.x, rest_deg);
}

// Node before an angle (x) and the way to the next one, 0..1 (y). A guide bin holds at most one node: its angle from the same multiple of 45°, its
// index, and nodes per degree on either side. Index and fraction stay apart: their sum would keep only 1e-4 of a node's width in float32.
vec2 node_before(samplerBuffer guide, float first_bin, float bins_in_octant, vec2 angle, float first_octant, float last_octant, float bins_per_deg) {
  float octant = min(max(angle.x, first_octant), last_octant) - first_octant;
  float bin = floor(min(max((angle.y + 22.5) * bins_per_deg, 0.0), bins_in_octant - 1.0));
  vec4 g = texelFetch(guide, int(first_bin + octant * bins_in_octant + bin));
  float past_deg = angle.y - g.x;
  return past_deg < 0.0 ? vec2(g.y - 1.0, 1.0 + past_deg * g.z) : vec2(g.y, past_deg * g.w);
}

// The same for nodes that are even but for rounding: an entry a node, in steps. The nearest node by count is never more than one beside the true one.
vec2 rounded_before(samplerBuffer guide, float entry_of_0, float at) {
  float nearest = floor(at + 0.5);
  vec4 g = texelFetch(guide, int(entry_of_0 + nearest));
  float past = at - nearest - g.x;
  return past < 0.0 ? vec2(nearest - 1.0, 1.0 + past * g.z) : vec2(nearest, past * g.w);
}

// The node before, of nodes that were rounded to so many decimals: the one nearest by count is rounded again, and may have gone past `at`.
vec2 decimals_before(TableShape shape, vec2 at) {
  vec2 units = roundEven(at) * shape.fine + shape.from;
  vec2 over = units - roundEven(units);  // it lies that much before where it would without rounding
  return floor(at + over * shape.unit);
}

// A table's value and where it was found: its table of colour lies on the same nodes.
struct Found {
  float value;   // as the table has it
  float factor;  // candela are this times the value (without the table's scale)
  vec2 part;     // between the nodes of the cell; filter: the texture coordinate
  int cell;
};

float in_cell(vec4 nodes, vec2 part) {
  vec2 low_high = mix(nodes.xz, nodes.yw, part.x);
  return mix(low_high.x, low_high.y, part.y);
}

Found found_in_cell(samplerBuffer table, TableShape shape, vec2 node, vec2 part, bool lit) {
  int cell = int(node.y * shape.cells.x + (node.x + shape.cells.y));
  float value = in_cell(texelFetch(table, cell), part);
  return Found(lit ? value : 0.0, 1.0, part, cell);
}

Found found_by_filter(sampler2D table, TableShape shape, vec2 at, bool lit) {
  vec2 coordinate = at * shape.per + shape.phase;
  float value = textureLod(table, coordinate, 0.0).r;
  return Found(lit ? value : 0.0, 1.0, coordinate, 0);
}

bool within(vec2 at, vec4 range) {
  return all(greaterThanEqual(at, range.xz)) && all(lessThanEqual(at, range.yw));
}

// A flat screen: a projection in place of angles. E on the screen is bilinear there, and I = E·D²·(1 + t²)^1.5.
Found on_screen(samplerBuffer table, samplerBuffer guide, sampler2D image, TableShape shape, uint kind, vec3 p) {
  vec2 at = p.yz * (1.0 / p.x);
  float s = 1.0 + dot(at, at);
  bool lit = p.x > 0.0;
  // The screen's rim belongs to it, and float32 misses it by a little: what is nearer than that counts as within.
  if (kind == kLookupScreen) at = at * shape.per - shape.phase;
  if (kind == kLookupScreenGuide) at *= shape.reach.xy;
  vec2 inside = min(max(at, shape.range.xz), shape.range.yw);
  lit = lit && all(lessThan(abs(at - inside), vec2(kind == kLookupScreen ? 1e-3 : kind == kLookupScreenGuide ? 2e-5 : 1e-6)));
  Found found;
  if (kind == kLookupFilterScreen) {
    found = found_by_filter(image, shape, inside, lit);
  } else if (kind == kLookupScreenGuide) {
    vec2 u = node_before(guide, 0.0, shape.fine.x, vec2(0.0, inside.x), 0.0, 0.0, shape.per.x);
    vec2 v = node_before(guide, shape.coarse, shape.fine.y, vec2(0.0, inside.y), 0.0, 0.0, shape.per.y);
    found = found_in_cell(table, shape, vec2(u.x, v.x), vec2(u.y, v.y), lit);
  } else {
    vec2 node = floor(inside);
    found = found_in_cell(table, shape, node, inside - node, lit);
  }
  found.factor = s * sqrt(s);
  return found;
}

// Half an angle over its tangent, of the axis whose bit is kLookupNarrow or twice that.
float half_angle(TableShape shape, uint narrow, float t2) {
  if ((shape.lookup & kLookupShown) != 0) return (shape.lookup & narrow) != 0 ? atan_over_t_shown(t2) : atan_over_t_wide_shown(t2);
  return (shape.lookup & narrow) != 0 ? atan_over_t(t2) : atan_over_t_wide(t2);
}

// What lies ahead, by tangents of half the angles: side over hypotenuse and the other side. Three divisions, for one of a common product would
// wait for both roots and four products.
Found ahead(samplerBuffer table, samplerBuffer guide, TableShape shape, uint kind, vec2 half_tangent) {
  // Beyond its reach the table is dark; held there, every cell that is read is one of it.
  vec2 t = min(max(half_tangent, shape.reach.xz), shape.reach.yw);
  vec2 t2 = t * t;
  vec2 angle = 2.0 * t * vec2(half_angle(shape, kLookupNarrow, t2.x), half_angle(shape, 2 * kLookupNarrow, t2.y));
  // In nodes from one next to 0°: beside the cut-off the numbers are small and the parts exact.
  vec2 at = angle * shape.per - shape.phase;
  bool lit = true;
  if (kind == kLookupRounded) {
    vec2 u = rounded_before(guide, -shape.range.x, at.x);
    vec2 v = rounded_before(guide, shape.coarse - shape.range.z, at.y);
    vec2 node = vec2(u.x, v.x), part = vec2(u.y, v.y);
    if ((shape.lookup & kLookupEdge) != 0) lit = within(node + part, shape.range);
    return found_in_cell(table, shape, node, part, lit);
  }
  if (kind == kLookupDecimals) {
    if ((shape.lookup & kLookupEdge) != 0) lit = within(at, shape.range);
    vec2 node = (shape.lookup & kLookupShown) != 0 ? floor(at) : decimals_before(shape, at);
    Found found = found_in_cell(table, shape, node, at - node, lit);
    found.value = max(found.value, 0.0);  // the cell's corners may lie beyond its nodes, darker than dark
    return found;
  }
  if (shape.coarse != 1.0) {
    vec2 fine = min(max(at, -shape.fine), shape.fine);
    at = fine + (at - fine) * shape.coarse;
  }
  if ((shape.lookup & kLookupEdge) != 0) lit = within(at, shape.range);
  vec2 node = floor(at);
  return found_in_cell(table, shape, node, at - node, lit);
}

// All round: type C.
Found around(samplerBuffer table, TableShape shape, vec3 p, float h) {
  vec2 first = atan2_octants(p.y, p.x), second = atan2_octants(h, -p.z);
  vec2 past = vec2(first.y, second.y) * shape.per;
  vec2 node = vec2(first.x, second.x) * shape.fine + floor(past);
  vec2 part = past - floor(past);
  // The limits belong to the table, and float32 misses them by up to 1e-4 of a node: what is nearer than that counts as within.
  vec2 beyond = node + part - min(max(node + part, shape.range.xz), shape.range.yw);
  bool lit = all(lessThan(abs(beyond), vec2(1e-3)));
  if (beyond.x != 0.0) part.x = 0.0;
  if (beyond.y != 0.0) part.y = 0.0;
  node = min(max(node, shape.range.xz), shape.range.yw);
  return found_in_cell(table, shape, node, part, lit);
}

Found guided(samplerBuffer table, samplerBuffer guide, TableShape shape, vec3 p, float h) {
  vec2 first = table_angle(p.y, p.x, shape.range.y), second = table_angle(p.z, h, shape.range.w);
  bool lit = within(vec2(first.x, second.x) * 45.0 + vec2(first.y, second.y), shape.range);
  vec2 u = node_before(guide, 0.0, shape.fine.x, first, shape.phase.x, floor((shape.range.y + 22.5) / 45.0), shape.per.x);
  vec2 v = node_before(guide, shape.coarse, shape.fine.y, second, shape.phase.y, floor((shape.range.w + 22.5) / 45.0), shape.per.y);
  // Directions outside the table may have any bin: they read its first cell.
  if (!lit) u.x = v.x = -1.0;
  return found_in_cell(table, shape, vec2(u.x, v.x), vec2(u.y, v.y), lit);
}

Found by_filter(sampler2D image, TableShape shape, uint kind, vec3 p, float h) {
  vec2 angles;
  bool lit = true;
  if (kind == kLookupFilterAhead) {
    angles = vec2(atan2_forward_rad(p.y, p.x), atan2_forward_rad(p.z, h));
    lit = p.x > 0.0;
  } else {
    angles = radians(vec2(atan2_deg(p.y, p.x), atan2_deg(p.z, h)));
    angles.x += angles.x < shape.range.x ? radians(360.0) : 0.0;
  }
  return found_by_filter(image, shape, angles, lit && within(angles, shape.range));
}

struct LampLight {
  float illuminance_lx;  // on the surface
  float normal_lx;       // on a plane facing the lamp
  float cos_incidence;
  float cd;
  float distance_m;
  float per_m;  // its inverse
};

// Where the lamp before was found in its table.
Found last_found;

// By a lamp from which the point is at `p`, in the frame of its table; `toward`: the part of the way to the lamp along the surface's normal. The rows of
// a lamp's frame are orthonormal, so p is as long as the way.
LampLight lamp_light(samplerBuffer table, samplerBuffer guide, sampler2D image, TableShape shape, vec3 p, float toward, float scale_cd) {
  uint kind = shape.lookup & kLookupKind;
  float h2 = p.x * p.x + p.y * p.y;
  float r2 = h2 + p.z * p.z;
  float h = sqrt(h2), inverse_r, distance_m;
  Found found;
  if (kind <= kLookupRounded) {
    distance_m = sqrt(r2);
    inverse_r = p.x > 0.0 ? 1.0 / distance_m : 0.0;  // beside the lamp and behind it: no light
    found = ahead(table, guide, shape, kind, vec2(p.y / max(h + p.x, 1e-30), p.z / max(distance_m + h, 1e-30)));
  } else {
    inverse_r = r2 > 0.0 ? inversesqrt(r2) : 0.0;
    distance_m = r2 * inverse_r;
    if (kind == kLookupTurn) found = around(table, shape, p, h);
    else if (kind == kLookupGuide) found = guided(table, guide, shape, p, h);
    else if (kind == kLookupFilter || kind == kLookupFilterAhead) found = by_filter(image, shape, kind, p, h);
    else found = on_screen(table, guide, image, shape, kind, p);
  }
  float cd = found.value;
  if (kind == kLookupScreen || kind == kLookupScreenGuide || kind == kLookupFilterScreen) cd = cd > 0.0 ? cd * found.factor : 0.0;
  if ((shape.lookup & kLookupScaled) != 0) cd *= scale_cd;
  last_found = found;
  LampLight light;
  light.cd = cd;
  light.distance_m = distance_m;
  light.per_m = inverse_r;
  light.cos_incidence = max(toward, 0.0) * inverse_r;
  light.normal_lx = cd * (inverse_r * inverse_r);
  light.illuminance_lx = light.normal_lx * light.cos_incidence;
  return light;
}

// Linear Rec. 709 of the light that was looked up last, luminance 1: red and blue from their own table, green is what luminance leaves.
vec3 lamp_tint(samplerBuffer tint, sampler2D image, TableShape shape, vec4 scale, float cd) {
  vec2 red_blue;
  if ((shape.lookup & kLookupKind) >= kLookupFilter) red_blue = textureLod(image, last_found.part, 0.0).rg;
  else
    red_blue = vec2(in_cell(texelFetch(tint, 2 * last_found.cell), last_found.part),
                    in_cell(texelFetch(tint, 2 * last_found.cell + 1), last_found.part));
  if (cd <= 0.0) return vec3(1.0);
  red_blue *= scale.xz * (last_found.factor / cd);
  return colour_of_red_blue(red_blue);
}

// Right after PHARE_LAMP_LIGHT(I).
#define PHARE_LAMP_TINT(I, LIGHT) lamp_tint(tints[I % kTables], filtered_tints[I % kFilters], PHARE_SHAPE(I), frame.lamps[I].colour, LIGHT.cd)

// `PLACE`: the point in the lamp's frame; `TOWARD`: as lamp_light has it.
#define PHARE_LIGHT_AT(I, PLACE, TOWARD) \
  lamp_light(cells[I % kTables], guides[I % kTables], filtered[I % kFilters], PHARE_SHAPE(I), PLACE, TOWARD, frame.lamps[I].colour.w)
#define PHARE_LAMP_LIGHT(I) PHARE_LIGHT_AT(I, in_lamp[I], PHARE_FACING(I) * unit - level)
#endif
