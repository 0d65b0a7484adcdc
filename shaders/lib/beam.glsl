// Intensity of a beam image and illuminance by one lamp: E = I(v)·cos(q)/r² (Lecocq et al. 1999, eq. 1).
#ifndef PHARE_BEAM
#define PHARE_BEAM
#include "lib/angles.h"
#include "lib/lamp_bindings.glsl"

// Fractional node index of an angle. A guide bin holds at most one node: its angle, its index, and nodes per degree on either side.
float node_index(uint guide, float bin, float last_bin, float angle_deg) {
  vec4 g = guides[guide + uint(clamp(bin, 0.0, last_bin))];
  return g.y + (angle_deg - g.x) * (angle_deg < g.x ? g.z : g.w);
}

// cd toward d (any length), bilinear on the table's own nodes, dark outside.
float intensity_cd(GpuLamp lamp, vec3 d) {
  float a = dot(lamp.row_a.xyz, d);
  float b = dot(lamp.row_b.xyz, d);
  float c = dot(lamp.row_c.xyz, d);
  float first = atan2_deg(b, a);
  float second = atan2_deg(c, sqrt(a * a + b * b));
  first += first < lamp.range.x ? 360.0 : 0.0;  // type C runs from 0 to 360
  bool lit = first <= lamp.range.y && second >= lamp.range.z && second <= lamp.range.w;
  float u = node_index(lamp.table.x, (first - lamp.range.x) * lamp.bins_per_deg.x, lamp.bins_per_deg.z, first);
  float v = node_index(lamp.table.y, (second - lamp.range.z) * lamp.bins_per_deg.y, lamp.bins_per_deg.w, second);
  float row = float(lamp.table.w);
  float i = floor(u);
  float j = floor(v);
  uint at = lamp.table.z + uint(j * row + i);
  at = lit ? at : lamp.table.z;
  float low = mix(candela[at], candela[at + 1], u - i);
  float high = mix(candela[at + lamp.table.w], candela[at + lamp.table.w + 1], u - i);
  return lit ? mix(low, high, v - j) : 0.0;
}

struct LampLight {
  float illuminance_lx;  // on the surface
  float normal_lx;       // on a plane facing the lamp
  float cos_incidence;
  vec3 toward_lamp;      // unit
};

LampLight lamp_light(uint index, vec3 p, vec3 n) {
  vec3 d = p - frame.lamps[index].position.xyz;
  float r2 = dot(d, d);
  float inv_r = r2 > 0.0 ? 1.0 / sqrt(r2) : 0.0;
  LampLight light;
  light.toward_lamp = d * -inv_r;
  light.cos_incidence = max(dot(light.toward_lamp, n), 0.0);
  light.normal_lx = r2 > 0.0 ? intensity_cd(frame.lamps[index], d) / r2 : 0.0;
  light.illuminance_lx = light.normal_lx * light.cos_incidence;
  return light;
}
#endif
