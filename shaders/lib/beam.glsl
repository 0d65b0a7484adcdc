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

// Where a direction lies in a table: its table of colour lies on the same nodes.
struct Found {
  bool lit;      // within the table
  float factor;  // candela are this times the value (without the table's scale)
  vec2 part;     // between the nodes of the cell; filter: the texture coordinate
  int cell;
};

float in_cell(vec4 nodes, vec2 part) {
  vec2 low_high = mix(nodes.xz, nodes.yw, part.x);
  return mix(low_high.x, low_high.y, part.y);
}

Found found_in_cell(TableShape shape, vec2 node, vec2 part, bool lit) {
  return Found(lit, 1.0, part, int(node.y * shape.cells.x + (node.x + shape.cells.y)));
}

Found found_by_filter(TableShape shape, vec2 at, bool lit) {
  return Found(lit, 1.0, at * shape.per + shape.phase, 0);
}

bool within(vec2 at, vec4 range) {
  return all(greaterThanEqual(at, range.xz)) && all(lessThanEqual(at, range.yw));
}

// A flat screen: a projection in place of angles. E on the screen is bilinear there, and I = E·D²·(1 + t²)^1.5.
float screen_factor(vec3 p) {
  vec2 at = p.yz * (1.0 / p.x);
  float s = 1.0 + dot(at, at);
  return s * sqrt(s);
}

// The screen's rim belongs to it, and float32 misses it by a little: what is nearer to it than `rim` counts as within.
bool on_screen(vec3 p, vec2 at, vec2 inside, float rim) {
  return p.x > 0.0 && all(lessThan(abs(at - inside), vec2(rim)));
}

#ifdef PHARE_FILTERED
Found filtered_screen(TableShape shape, vec3 p) {
  vec2 at = p.yz * (1.0 / p.x), inside = min(max(at, shape.range.xz), shape.range.yw);
  return found_by_filter(shape, inside, on_screen(p, at, inside, 1e-6));
}

Found filtered_ahead(TableShape shape, vec3 p, float h) {
  vec2 angles = vec2(atan2_forward_rad(p.y, p.x), atan2_forward_rad(p.z, h));
  return found_by_filter(shape, angles, p.x > 0.0 && within(angles, shape.range));
}

Found filtered_round(TableShape shape, vec3 p, float h) {
  vec2 angles = radians(vec2(atan2_deg(p.y, p.x), atan2_deg(p.z, h)));
  angles.x += angles.x < shape.range.x ? radians(360.0) : 0.0;
  return found_by_filter(shape, angles, within(angles, shape.range));
}
#else
Found on_even_screen(TableShape shape, vec3 p) {
  vec2 at = p.yz * (1.0 / p.x) * shape.per - shape.phase;
  vec2 inside = min(max(at, shape.range.xz), shape.range.yw), node = floor(inside);
  return found_in_cell(shape, node, inside - node, on_screen(p, at, inside, 1e-3));
}

Found on_guided_screen(samplerBuffer guide, TableShape shape, vec3 p) {
  vec2 at = p.yz * (1.0 / p.x) * shape.reach.xy;
  vec2 inside = min(max(at, shape.range.xz), shape.range.yw);
  vec2 u = node_before(guide, 0.0, shape.fine.x, vec2(0.0, inside.x), 0.0, 0.0, shape.per.x);
  vec2 v = node_before(guide, shape.coarse, shape.fine.y, vec2(0.0, inside.y), 0.0, 0.0, shape.per.y);
  return found_in_cell(shape, vec2(u.x, v.x), vec2(u.y, v.y), on_screen(p, at, inside, 2e-5));
}

// Half an angle over its tangent, of the axis whose bit is kLookupNarrow or twice that.
float half_angle(TableShape shape, uint narrow, float t2) {
  if ((shape.lookup & kLookupShown) != 0) return (shape.lookup & narrow) != 0 ? atan_over_t_shown(t2) : atan_over_t_wide_shown(t2);
  return (shape.lookup & narrow) != 0 ? atan_over_t(t2) : atan_over_t_wide(t2);
}

// What lies ahead, by tangents of half the angles: side over hypotenuse and the other side. In nodes from one next to 0°: beside the cut-off the
// numbers are small and the parts exact.
vec2 ahead_at(TableShape shape, vec2 half_tangent) {
  // Beyond its reach the table is dark; held there, every cell that is read is one of it.
  vec2 t = min(max(half_tangent, shape.reach.xz), shape.reach.yw);
  vec2 t2 = t * t;
  vec2 angle = 2.0 * t * vec2(half_angle(shape, kLookupNarrow, t2.x), half_angle(shape, 2 * kLookupNarrow, t2.y));
  return angle * shape.per - shape.phase;
}

bool within_edge(TableShape shape, vec2 at) {
  return (shape.lookup & kLookupEdge) == 0 || within(at, shape.range);
}

Found ahead_even(TableShape shape, vec2 half_tangent) {
  vec2 at = ahead_at(shape, half_tangent);
  if ((shape.lookup & kLookupCoarse) != 0) {
    vec2 fine = min(max(at, -shape.fine), shape.fine);
    at = fine + (at - fine) * shape.coarse;
  }
  vec2 node = floor(at);
  return found_in_cell(shape, node, at - node, within_edge(shape, at));
}

Found ahead_decimals(TableShape shape, vec2 half_tangent) {
  vec2 at = ahead_at(shape, half_tangent);
  vec2 node = (shape.lookup & kLookupShown) != 0 ? floor(at) : decimals_before(shape, at);
  return found_in_cell(shape, node, at - node, within_edge(shape, at));
}

Found ahead_rounded(samplerBuffer guide, TableShape shape, vec2 half_tangent) {
  vec2 at = ahead_at(shape, half_tangent);
  vec2 u = rounded_before(guide, -shape.range.x, at.x);
  vec2 v = rounded_before(guide, shape.coarse - shape.range.z, at.y);
  vec2 node = vec2(u.x, v.x), part = vec2(u.y, v.y);
  return found_in_cell(shape, node, part, within_edge(shape, node + part));
}

// All round: type C.
Found around(TableShape shape, vec3 p, float h) {
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
  return found_in_cell(shape, node, part, lit);
}

Found guided(samplerBuffer guide, TableShape shape, vec3 p, float h) {
  vec2 first = table_angle(p.y, p.x, shape.range.y), second = table_angle(p.z, h, shape.range.w);
  bool lit = within(vec2(first.x, second.x) * 45.0 + vec2(first.y, second.y), shape.range);
  vec2 u = node_before(guide, 0.0, shape.fine.x, first, shape.phase.x, floor((shape.range.y + 22.5) / 45.0), shape.per.x);
  vec2 v = node_before(guide, shape.coarse, shape.fine.y, second, shape.phase.y, floor((shape.range.w + 22.5) / 45.0), shape.per.y);
  // Directions outside the table may have any bin: they read its first cell.
  if (!lit) u.x = v.x = -1.0;
  return found_in_cell(shape, vec2(u.x, v.x), vec2(u.y, v.y), lit);
}
#endif

struct LampLight {
  float illuminance_lx;  // on the surface
  float normal_lx;       // on a plane facing the lamp
  float cos_incidence;
  float cd;
  float distance_m;
  float per_m;  // its inverse
};

// From a lamp to a point, in the frame of its table: p.
struct LampWay {
  float h;  // hypot(p.x, p.y)
  float distance_m;
  float per_m;        // its inverse; 0 where the lamp sends no light
  vec2 half_tangent;  // of the angles, ahead
};

// Three divisions, for one of a common product would wait for both roots and four products.
LampWay way_ahead(vec3 p) {
  float h2 = p.x * p.x + p.y * p.y;
  float h = sqrt(h2), distance_m = sqrt(h2 + p.z * p.z);
  // Beside the lamp and behind it: no light.
  return LampWay(h, distance_m, p.x > 0.0 ? 1.0 / distance_m : 0.0, vec2(p.y / max(h + p.x, 1e-30), p.z / max(distance_m + h, 1e-30)));
}

LampWay way_round(vec3 p) {
  float h2 = p.x * p.x + p.y * p.y;
  float r2 = h2 + p.z * p.z;
  float per_m = r2 > 0.0 ? inversesqrt(r2) : 0.0;
  return LampWay(sqrt(h2), r2 * per_m, per_m, vec2(0.0));
}

// Where a lamp is seen from a point, where that lies in its table, and what stands there.
struct Sought {
  LampWay way;
  Found found;
  vec4 nodes;  // of the cell; filter: the value in x
};

// Where the lamp before was found in its table.
Found last_found;

// What hangs on where the lamp is alone; no light yet. `toward`: the part of the way to the lamp along the surface's normal. The rows of a lamp's
// frame are orthonormal, so p is as long as the way.
LampLight aimed(LampWay way, float toward) {
  LampLight light;
  light.distance_m = way.distance_m;
  light.per_m = way.per_m;
  light.cos_incidence = max(toward, 0.0) * way.per_m;
  light.cd = light.normal_lx = light.illuminance_lx = 0.0;
  return light;
}

LampLight light_of(Sought sought, float cd, float toward) {
  last_found = sought.found;
  LampLight light = aimed(sought.way, toward);
  light.cd = cd;
  light.normal_lx = cd * (light.per_m * light.per_m);
  light.illuminance_lx = light.normal_lx * light.cos_incidence;
  return light;
}

// A lamp's light at p in the frame of its table: functions a lamp, so that its lookup is a constant of the pipeline wherever it decides, and
// what it does not call for is gone before a device compiles it. In three steps: where to read, by roots, quotients and polynomials each of which
// waits for the one before; reading; light. Who asks for several lamps takes each step for all of them before the next for any, and on a software
// device one lamp is computed while another waits.
#define PHARE_KIND(I) (lookup_##I & kLookupKind)
#define PHARE_FIND(I, KIND, FOUND) if (PHARE_KIND(I) == KIND) sought.found = FOUND;
#ifdef PHARE_FILTERED
#define PHARE_IS_AHEAD(I) false
#define PHARE_IS_SCREEN(I) (PHARE_KIND(I) == kLookupFilterScreen)
#define PHARE_FIND_ONE(I)                                                           \
  PHARE_FIND(I, kLookupFilterAhead, filtered_ahead(shape, p, sought.way.h))         \
  PHARE_FIND(I, kLookupFilter, filtered_round(shape, p, sought.way.h))              \
  PHARE_FIND(I, kLookupFilterScreen, filtered_screen(shape, p))
#define PHARE_NODES(I, FOUND) textureLod(filtered[I % kFilters], FOUND.part, 0.0)
#define PHARE_VALUE(SOUGHT) SOUGHT.nodes.x
#else
#define PHARE_IS_AHEAD(I) (PHARE_KIND(I) <= kLookupRounded)
#define PHARE_IS_SCREEN(I) (PHARE_KIND(I) == kLookupScreen || PHARE_KIND(I) == kLookupScreenGuide)
#define PHARE_FIND_ONE(I)                                                                                    \
  PHARE_FIND(I, kLookupAhead, ahead_even(shape, sought.way.half_tangent))                                    \
  PHARE_FIND(I, kLookupDecimals, ahead_decimals(shape, sought.way.half_tangent))                             \
  PHARE_FIND(I, kLookupRounded, ahead_rounded(guides[I % kTables], shape, sought.way.half_tangent))          \
  PHARE_FIND(I, kLookupTurn, around(shape, p, sought.way.h))                                                 \
  PHARE_FIND(I, kLookupGuide, guided(guides[I % kTables], shape, p, sought.way.h))                           \
  PHARE_FIND(I, kLookupScreen, on_even_screen(shape, p))                                                     \
  PHARE_FIND(I, kLookupScreenGuide, on_guided_screen(guides[I % kTables], shape, p))
#define PHARE_NODES(I, FOUND) texelFetch(cells[I % kTables], FOUND.cell)
#define PHARE_VALUE(SOUGHT) in_cell(SOUGHT.nodes, SOUGHT.found.part)
#endif
#define PHARE_LIGHT_OF_LAMP(I)                                                                                               \
  Sought seek_##I(TableShape shape, vec3 p) {                                                                                \
    Sought sought;                                                                                                           \
    if (PHARE_IS_AHEAD(I)) sought.way = way_ahead(p);                                                                        \
    else sought.way = way_round(p);                                                                                          \
    sought.found = Found(false, 1.0, vec2(0.0), 0);                                                                          \
    PHARE_FIND_ONE(I)                                                                                                        \
    if (PHARE_IS_SCREEN(I)) sought.found.factor = screen_factor(p);                                                          \
    return sought;                                                                                                           \
  }                                                                                                                          \
  void read_##I(inout Sought sought) { sought.nodes = PHARE_NODES(I, sought.found); }                                        \
  LampLight sought_light_##I(Sought sought, float toward) {                                                                  \
    float cd = PHARE_VALUE(sought);                                                                                          \
    cd = sought.found.lit ? cd : 0.0;                                                                                        \
    if (PHARE_KIND(I) == kLookupDecimals) cd = max(cd, 0.0); /* a cell's corners may lie beyond its nodes, darker than dark */ \
    if (PHARE_IS_SCREEN(I)) cd = cd > 0.0 ? cd * sought.found.factor : 0.0;                                                  \
    if ((lookup_##I & kLookupScaled) != 0) cd *= frame.lamps[I].colour.w;                                                    \
    return light_of(sought, cd, toward);                                                                                     \
  }                                                                                                                          \
  LampLight light_at_##I(TableShape shape, vec3 p, float toward) {                                                           \
    Sought sought = seek_##I(shape, p);                                                                                      \
    read_##I(sought);                                                                                                        \
    return sought_light_##I(sought, toward);                                                                                 \
  }
PHARE_EACH_LAMP(PHARE_LIGHT_OF_LAMP)

// Linear Rec. 709 of the light that was looked up last, luminance 1: red and blue from their own table, green is what luminance leaves.
vec3 tint_of(vec2 red_blue, vec4 scale, float cd) {
  if (cd <= 0.0) return vec3(1.0);
  red_blue *= scale.xz * (last_found.factor / cd);
  return colour_of_red_blue(red_blue);
}

#ifdef PHARE_FILTERED
vec2 found_tint(sampler2D image) {
  return textureLod(image, last_found.part, 0.0).rg;
}
#define PHARE_FOUND_TINT(I) found_tint(filtered_tints[I % kFilters])
#else
vec2 found_tint(samplerBuffer tint) {
  return vec2(in_cell(texelFetch(tint, 2 * last_found.cell), last_found.part), in_cell(texelFetch(tint, 2 * last_found.cell + 1), last_found.part));
}
#define PHARE_FOUND_TINT(I) found_tint(tints[I % kTables])
#endif

// Right after the lamp's light.
#define PHARE_LAMP_TINT(I, LIGHT) tint_of(PHARE_FOUND_TINT(I), frame.lamps[I].colour, LIGHT.cd)

// `PLACE`: the point in the lamp's frame.
#define PHARE_SEEK_AT(I, PLACE) seek_##I(PHARE_SHAPE(I), PLACE)
#define PHARE_LIGHT_AT(I, PLACE, TOWARD) light_at_##I(PHARE_SHAPE(I), PLACE, TOWARD)
#define PHARE_LAMP_LIGHT(I) PHARE_LIGHT_AT(I, in_lamp[I], PHARE_FACING(I) * unit - level)

// Of each lamp of a surface, one after the other.
#define PHARE_SEEK_LAMP(I) \
  Sought sought_##I;       \
  if (lamp_count > I) sought_##I = PHARE_SEEK_AT(I, in_lamp[I]);
#define PHARE_READ_LAMP(I) \
  if (lamp_count > I) read_##I(sought_##I);
#define PHARE_AIMED(I) aimed(sought_##I.way, PHARE_FACING(I) * unit - level)
#define PHARE_SOUGHT_LIGHT(I) sought_light_##I(sought_##I, PHARE_FACING(I) * unit - level)
#endif
