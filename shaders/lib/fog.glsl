// What fog makes of light on its way to the eye: it takes some, and adds what it scatters (visual/passes/fog.h). The light scattered into a
// ray lies in a grid over the view, computed for each frame by fog.comp: cells of four rays, a texel each, one slice after the other. It is
// held as a multiple of fog_nearness(), which has its peaks near lamps, so that what is interpolated is smooth.
#ifndef PHARE_FOG_LIB
#define PHARE_FOG_LIB
#include "lib/lamp_bindings.glsl"

layout(constant_id = kSpecFogLamps) const uint fog_lamps = 0;
layout(constant_id = kSpecFogGrid) const uint fog_grid = 0x20002;
layout(constant_id = kSpecFogSlices) const uint fog_slices = 1;

// PHARE_FOG_FLAT: two lamps at most, and what all pixels share comes as flat varyings.
#ifdef PHARE_FOG_FLAT
#include "lib/fog_flat.glsl"
#define PHARE_FOG_EXTINCTION fog_air.x
#define PHARE_FOG_REACH fog_air.y
#define PHARE_FOG_COLUMN fog_air.zw
#define PHARE_FOG_ROW fog_rows.xyz
#define PHARE_FOG_CLOSE vec2(fog_rows.w, fog_lamp_0.w)
#define PHARE_FOG_COLOUR fog_colour
#define PHARE_FOG_LAMP(I) (I == 0 ? fog_lamp_0.xyz : fog_lamp_1)
#else
#define PHARE_FOG_EXTINCTION frame.fog.air.x
#define PHARE_FOG_REACH frame.fog.air.z
#define PHARE_FOG_COLUMN frame.fog.to_column.xy
#define PHARE_FOG_ROW frame.fog.to_row.xyz
#define PHARE_FOG_CLOSE frame.fog.to_column.zw
#define PHARE_FOG_COLOUR frame.fog.colour
#define PHARE_FOG_LAMP(I) frame.fog.lamps[I].xyz
#endif

// Of the sum over the lamps one over the distance (no less than 1 cm) from them to a ray of length s, in 1/m.
float fog_nearness(vec3 direction, float s) {
  float sum = 0.0;
#define PHARE_NEAR_LAMP(I)                                                  \
  if (fog_lamps > I) {                                                      \
    vec3 lamp = PHARE_FOG_LAMP(I);                                          \
    vec3 aside = lamp - direction * min(max(dot(lamp, direction), 0.0), s); \
    sum += inversesqrt(max(dot(aside, aside), 1e-4));                       \
  }
  PHARE_NEAR_LAMP(0) PHARE_NEAR_LAMP(1)
#ifndef PHARE_FOG_FLAT
  PHARE_NEAR_LAMP(2) PHARE_NEAR_LAMP(3) PHARE_NEAR_LAMP(4) PHARE_NEAR_LAMP(5) PHARE_NEAR_LAMP(6) PHARE_NEAR_LAMP(7)
#endif
  return sum;
}

// What is left over a way in m.
float fog_left(float way_m) { return exp2(PHARE_FOG_EXTINCTION * -way_m); }

#ifndef PHARE_COMPUTE
layout(set = 2, binding = 0) uniform samplerBuffer fog_cells;

// cd/m² (of colour 1) that lamps give the fog between the eye and a point of this pixel.
float fog_light(vec3 direction, float s, vec2 pixel) {
  if (fog_lamps == 0u) return 0.0;
  int columns = int(fog_grid & 0xffffu), rows = int(fog_grid >> 16u);
  float column = pixel.x * PHARE_FOG_COLUMN.x + PHARE_FOG_COLUMN.y;
  float row = pixel.y * PHARE_FOG_ROW.x + PHARE_FOG_ROW.y + PHARE_FOG_ROW.z * min(max(pixel.y, PHARE_FOG_CLOSE.x), PHARE_FOG_CLOSE.y);
  vec3 at = vec3(column, row, min(s / (s + PHARE_FOG_REACH) * float(fog_slices), float(fog_slices) - 1e-3));
  vec3 node = floor(at), part = at - node;
  int cell = (int(node.z) * (rows + 1) + int(node.y) + 1) * (columns + 1) + int(node.x) + 1;
  vec4 four = mix(texelFetch(fog_cells, cell), texelFetch(fog_cells, cell + (rows + 1) * (columns + 1)), part.z);
  vec2 sides = mix(four.xz, four.yw, part.x);
  return mix(sides.x, sides.y, part.y) * fog_nearness(direction, s);
}

vec3 through_fog(vec3 light, vec3 point, vec2 pixel) {
  float s2 = dot(point, point), per_s = inversesqrt(s2), s = s2 * per_s;
  float left = fog_left(s);
  return light * left + PHARE_FOG_COLOUR.rgb * (PHARE_FOG_COLOUR.w * (1.0 - left) + fog_light(point * per_s, s, pixel));
}

#define PHARE_THROUGH_FOG(I) fog_left(length(in_lamp[I]))
#endif
#endif
