// Illuminance at the vertices, for the methods that interpolate it (kSpecMethod): each lamp's goes to the fragments in the place of the way
// to the lamp.
#ifndef PHARE_BY_VERTEX
#define PHARE_BY_VERTEX
#include "lib/beam.glsl"

layout(constant_id = kSpecMethod) const uint method = 0;
layout(constant_id = kSpecSides) const uint sides = 1;

// After pass_light().
void light_vertices() {
  float unit = inversesqrt(dot(point_normal, point_normal));
  float level = dot(point_normal, point) * unit;
  if (sides == 2 && level > 0.0) {  // the side that the eye sees
    unit = -unit;
    level = -level;
  }
#define LIGHT_VERTEX(I)                                                                          \
  if (lamp_count > I) {                                                                          \
    if (method == kMethodVertex1998) {                                                           \
      float r2 = max(dot(in_lamp[I], in_lamp[I]), 1e-12);                                        \
      PHARE_FACING(I) = max(PHARE_FACING(I) * unit - level, 0.0) * inversesqrt(r2) / r2;         \
    } else {                                                                                     \
      PHARE_FACING(I) = PHARE_LAMP_LIGHT(I).illuminance_lx;                                      \
    }                                                                                            \
  }
  PHARE_EACH_LAMP(LIGHT_VERTEX)
}
#endif
