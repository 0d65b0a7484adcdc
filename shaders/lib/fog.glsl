// What fog makes of light on its way to the eye: it takes some, and adds what it scatters (visual/passes/fog.h). The light scattered into a
// ray lies in a grid over the view, computed by fog.comp: a cell is one texel, of its four rays (row by row) each with the light up to where
// its slice begins and up to where it ends, as half floats, so that a pixel reads once. Its columns and rows lie close together where light
// changes fast; where a pixel lies between them says a texel for each of the picture's columns and rows.
#ifndef PHARE_FOG_LIB
#define PHARE_FOG_LIB
#include "fog.h"
#include "lib/lamp_bindings.glsl"

layout(constant_id = kSpecFogLamps) const uint fog_lamps = 0;
layout(constant_id = kSpecFogGrid) const uint fog_grid = 0x20002;
layout(constant_id = kSpecFogSlices) const uint fog_slices = 1;

// PHARE_FOG_FLAT: two lamps at most, and what all pixels share comes as flat varyings.
#ifdef PHARE_FOG_FLAT
#include "lib/fog_flat.glsl"
#define PHARE_FOG_AIR fog_air
#define PHARE_FOG_COLOUR fog_colour
#else
#define PHARE_FOG_AIR frame.fog.air
#define PHARE_FOG_COLOUR frame.fog.colour
#endif

// What is left over a way in m.
float fog_left(float way_m) { return exp2(PHARE_FOG_AIR.x * -way_m); }

#ifndef PHARE_COMPUTE
layout(set = 2, binding = 0) uniform usamplerBuffer fog_cells;
layout(set = 2, binding = 1) uniform samplerBuffer fog_places;  // as fog.h has them

// The four rays about a pixel, in a slice. `part`: the way of the pixel between them.
uvec4 fog_cell(vec2 pixel, int slice, out vec2 part) {
  int columns = int(fog_grid & 0xffffu), rows = int(fog_grid >> 16u);
  vec2 at = vec2(texelFetch(fog_places, kFogMostNodes + int(pixel.x)).x, texelFetch(fog_places, kFogMostNodes + int(pixel.y)).y);
  vec2 node = floor(at);
  part = at - node;
  return texelFetch(fog_cells, (slice * (rows + 1) + int(node.y) + 1) * (columns + 1) + int(node.x) + 1);
}

// cd/m² (of colour 1) that lamps give the fog between the eye and a point of this pixel.
float fog_light(float s, vec2 pixel) {
  if (fog_lamps == 0u) return 0.0;
  float at = s / (s + PHARE_FOG_AIR.z) * (float(fog_slices) - 1e-3), slice = floor(at);
  vec2 part;
  uvec4 four = fog_cell(pixel, int(slice), part);
  vec2 above = mix(unpackHalf2x16(four.x), unpackHalf2x16(four.y), part.x);
  vec2 below = mix(unpackHalf2x16(four.z), unpackHalf2x16(four.w), part.x);
  vec2 ends = mix(above, below, part.y);
  return mix(ends.x, ends.y, at - slice);
}

// The same to where nothing comes from beyond.
float fog_light_to_end(vec2 pixel) {
  if (fog_lamps == 0u) return 0.0;
  vec2 part;
  uvec4 four = fog_cell(pixel, int(fog_slices) - 1, part);
  float above = mix(unpackHalf2x16(four.x).y, unpackHalf2x16(four.y).y, part.x);
  float below = mix(unpackHalf2x16(four.z).y, unpackHalf2x16(four.w).y, part.x);
  return mix(above, below, part.y);
}

vec3 through_fog(vec3 light, vec3 point, vec2 pixel) {
  float s2 = dot(point, point), s = s2 * inversesqrt(s2);
  float left = fog_left(s);
  return light * left + PHARE_FOG_COLOUR.rgb * (PHARE_FOG_COLOUR.w * (1.0 - left) + fog_light(s, pixel));
}

#define PHARE_THROUGH_FOG(LIGHT) fog_left(LIGHT.distance_m)
#endif
#endif
