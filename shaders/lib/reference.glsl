// Light of a lamp in float64 (method "reference"): the place of the pixel, the angles in the lamp's frame, bilinear between the table's own
// nodes, E = I·cos(q)/r². Float64 too is where the pixel lies: its ray through the plane of its triangle, of the vertices as they are stored.
#ifndef PHARE_REFERENCE_LIGHT
#define PHARE_REFERENCE_LIGHT
#include "lib/angles64.h"
#include "lib/beam.glsl"
#include "reference.h"

layout(std430, set = kReferenceSet, binding = 0) readonly buffer ReferenceView { double view_words[]; };
layout(std430, set = kReferenceSet, binding = 1) readonly buffer ReferenceTables { double table_words[]; };
layout(std430, set = kReferenceSet, binding = 2) readonly buffer ReferenceVertices { float vertex_words[]; };
layout(std430, set = kReferenceSet, binding = 3) readonly buffer ReferenceIndices { uint index_words[]; };
layout(std430, set = kReferenceSet, binding = 4) readonly buffer ReferencePoints { double point_words[]; };

// Relative to the eye, m; unit normal to the side that is seen.
dvec3 reference_point, reference_normal;
// Candela times red and blue where the last lamp was looked up.
vec2 reference_red_blue;

dvec3 of_view(uint at) { return dvec3(view_words[at], view_words[at + 1], view_words[at + 2]); }
dvec3 of_vertex(uint at) { return dvec3(vertex_words[at], vertex_words[at + 1], vertex_words[at + 2]); }
dvec3 turned_64(dvec3 v) {
  return dvec3(dot(dvec3(draw.turn[0].xyz), v), dot(dvec3(draw.turn[1].xyz), v), dot(dvec3(draw.turn[2].xyz), v));
}
dvec3 unit_64(dvec3 v) { return v / sqrt_64(dot(v, v)); }

void place_measured() {
  uint at = uint(gl_PrimitiveID) * kReferencePointWords;
  reference_point = dvec3(point_words[at], point_words[at + 1], point_words[at + 2]);
  reference_normal = dvec3(point_words[at + 3], point_words[at + 4], point_words[at + 5]);
}

// `side`: -1 where the back of a surface is seen.
void place_pixel(double side) {
  uint first_index = floatBitsToUint(draw.origin.w) + 3u * uint(gl_PrimitiveID), first_vertex = floatBitsToUint(draw.detail_origin.w);
  dvec3 origin = dvec3(draw.origin.xyz) + dvec3(draw.turn[0].w, draw.turn[1].w, draw.turn[2].w);
  dvec3 corner[3], normal[3];
  for (uint i = 0u; i < 3u; ++i) {
    uint at = (index_words[first_index + i] + first_vertex) * kReferenceVertexWords;
    corner[i] = turned_64(of_vertex(at)) + origin;
    normal[i] = turned_64(of_vertex(at + 3u));
  }
  // The pixel's ray, a line through two points in homogeneous coordinates: at the near plane and at the far end of clip space.
  dmat4 eye_from_clip;
  for (uint i = 0u; i < 4u; ++i)
    eye_from_clip[i] = dvec4(of_view(kReferenceEyeFromClip + 4u * i), view_words[kReferenceEyeFromClip + 4u * i + 3u]);
  dvec2 clip = (dvec2(gl_FragCoord.xy) - dvec2(view_words[kReferenceArea], view_words[kReferenceArea + 1u])) /
               dvec2(view_words[kReferenceArea + 2u], view_words[kReferenceArea + 3u]) * 2.0lf - 1.0lf;
  dvec4 near = eye_from_clip * dvec4(clip, 1.0lf, 1.0lf), far = eye_from_clip * dvec4(clip, 0.0lf, 1.0lf);
  dvec3 across = cross(corner[1] - corner[0], corner[2] - corner[0]);
  dvec4 plane = dvec4(across, -dot(across, corner[0]));
  double near_off = dot(plane, near), far_off = dot(plane, far);
  dvec4 hit = near * far_off - far * near_off;
  reference_point = hit.xyz / hit.w;
  // Barycentric coordinates.
  double area2 = dot(across, across);
  dvec3 from_first = reference_point - corner[0];
  double b = dot(cross(from_first, corner[2] - corner[0]), across) / area2, c = dot(cross(corner[1] - corner[0], from_first), across) / area2;
  reference_normal = side * unit_64(normal[0] * (1.0lf - b - c) + normal[1] * b + normal[2] * c);
}

// Node before x, of at least two.
uint node_before_64(uint first, uint count, double x) {
  uint low = 0u, high = count - 1u;
  while (high - low > 1u) {
    uint middle = (low + high) / 2u;
    if (table_words[first + middle] <= x) low = middle;
    else high = middle;
  }
  return low;
}

// The node before x on an axis, and the way to the next one; false beyond its ends. A direction on the rim may miss it by roundings: it is on it.
bool place_on_axis(uint first, uint count, double x, out uint node, out double part) {
  double within = clamp(x, table_words[first], table_words[first + count - 1u]);
  node = node_before_64(first, count, within);
  double low = table_words[first + node], high = table_words[first + node + 1u];
  part = (within - low) / (high - low);
  return abs(x - within) <= 1e-12lf;
}

double bilinear_64(uint first, uint columns, uvec2 node, dvec2 part) {
  uint at = first + node.y * columns + node.x;
  double low = table_words[at] * (1.0lf - part.x) + table_words[at + 1u] * part.x;
  double high = table_words[at + columns] * (1.0lf - part.x) + table_words[at + columns + 1u] * part.x;
  return low * (1.0lf - part.y) + high * part.y;
}

// Candela towards p, in the frame of the lamp's table.
double candela_64(uint table, dvec3 p) {
  uint columns = uint(table_words[table]), rows = uint(table_words[table + 1u]), kind = uint(table_words[table + 2u]);
  dvec2 at;
  double factor = 1.0lf;
  if (kind == kReferenceScreen) {
    if (!(p.x > 0.0lf)) return 0.0lf;
    at = p.yz / p.x;
    double s = 1.0lf + dot(at, at);
    factor = s * sqrt_64(s);
  } else {
    double h = sqrt_64(p.x * p.x + p.y * p.y);
    at.x = atan2_deg_64(p.y, p.x);
    at.y = kind == kReferenceTurn ? atan2_deg_64(h, -p.z) : atan2_deg_64(p.z, h);
    if (kind == kReferenceTurn && at.x < 0.0lf) at.x += 360.0lf;
  }
  uint first = table + kReferenceHeadWords, values = first + columns + rows;
  uvec2 node;
  dvec2 part;
  double part_of_first, part_of_second;
  bool lit = place_on_axis(first, columns, at.x, node.x, part_of_first);
  lit = place_on_axis(first + columns, rows, at.y, node.y, part_of_second) && lit;
  if (!lit) return 0.0lf;
  part = dvec2(part_of_first, part_of_second);
  if (table_words[table + 3u] != 0.0lf) {
    uint red = values + columns * rows;
    reference_red_blue = vec2(factor * bilinear_64(red, columns, node, part), factor * bilinear_64(red + columns * rows, columns, node, part));
  }
  return factor * bilinear_64(values, columns, node, part);
}

LampLight reference_light(uint lamp) {
  uint at = lamp * kReferenceLampWords;
  dvec3 way = of_view(at) - reference_point;
  double r2 = dot(way, way), toward = dot(way, reference_normal);
  LampLight light = LampLight(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  if (!(r2 > 0.0lf)) return light;
  double r = sqrt_64(r2), cos_incidence = max(toward, 0.0lf) / r;
  double cd = candela_64(uint(view_words[at + kReferenceTableAt]), -dvec3(dot(of_view(at + 3u), way), dot(of_view(at + 6u), way), dot(of_view(at + 9u), way)));
  light.cd = float(cd);
  light.distance_m = float(r);
  light.per_m = float(1.0lf / r);
  light.cos_incidence = float(cos_incidence);
  light.normal_lx = float(cd / r2);
  light.illuminance_lx = float(cd / r2 * cos_incidence);
  return light;
}

vec3 reference_tint(float cd) {
  if (cd <= 0.0) return vec3(1.0);
  vec2 red_blue = reference_red_blue / cd;
  return colour_of_red_blue(red_blue);
}

#undef PHARE_SEEK_LAMP
#undef PHARE_READ_LAMP
#undef PHARE_AIMED
#undef PHARE_SOUGHT_LIGHT
#undef PHARE_LAMP_TINT
#define PHARE_SEEK_LAMP(I)
#define PHARE_READ_LAMP(I)
#define PHARE_AIMED(I) LampLight(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
#define PHARE_SOUGHT_LIGHT(I) reference_light(I)
#define PHARE_LAMP_TINT(I, LIGHT) reference_tint(LIGHT.cd)
#endif
