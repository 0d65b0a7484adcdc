// How much of a lamp's light reaches a point past what stands in its beam: 0 none, 1 all. Shadow maps (Williams 1978) hold the far sides of
// things, so what faces the lamp never shadows itself, road at grazing light included (visual/passes/shadows.h).
#ifndef PHARE_SHADOW
#define PHARE_SHADOW
#ifdef PHARE_LEAN
#include "lib/lean_varyings.glsl"
#else
#include "lib/surface_varyings.glsl"
#endif

layout(set = 1, binding = 0) uniform samplerBuffer shadow_depths;  // all maps, one after the other, rows from the top; by rays trees (lamps.h)
layout(constant_id = kSpecShadowWidth) const uint shadow_width = 1;
layout(constant_id = kSpecShadowHeight) const uint shadow_height = 1;
layout(constant_id = kSpecShadowTaps) const uint shadow_taps = 1;

// What is nearer than the point by less than this, relatively, does not shadow it (25 mm at 50 m): float32 rounds depths of the map and of
// the point apart.
const float kShadowBias = 1.0005;

layout(constant_id = kSpecBent) const uint bent = 0;

// Of a pixel's plane, away from the lamp while the eye sees it: a far side itself, at the depth that stands in the map.
bool turned_away(vec3 at, float side) {
  return dot(cross(dFdx(at), dFdy(at)), at) * side <= 0.0;
}

// Where a point lies in a map, and what stands there. Found and read for all lamps before any light is summed, as tables are (beam.glsl).
struct ShadowPlace {
  int index;     // of the texel, or of the first of four
  vec2 part;     // between the four
  float nearer;  // what is nearer than this shadows it, as the map has depths
  bool away;
  vec4 depths;
};

// `at`: as GpuShadow has it, not divided yet. The outermost texels hold nothing, so beyond the map all is lit.
ShadowPlace shadow_seek(vec3 at, uint map, vec2 zoom) {
  ShadowPlace place;
  place.away = bent != 0u && turned_away(at, zoom.y);
  float inverse_w = 1.0 / max(at.z, 1e-3);
  place.nearer = kShadowNear_m * inverse_w * kShadowBias;
  vec2 middle = 0.5 * vec2(float(shadow_width), float(shadow_height));
  vec2 from_middle = at.xy * inverse_w, large = from_middle * zoom.x;
  bool close = all(lessThan(abs(large), middle - 1.0));
  // Half a texel up: below the line where a slope meets the valley behind it a lamp looks into the ground, where there is no far side.
  vec2 texel = middle + (close ? large : from_middle) - vec2(0.0, 0.5);
  int row = int(shadow_width), first = int((2 * map + (close ? 1 : 0)) * shadow_width * shadow_height);
  place.part = vec2(0.0);
  if (shadow_taps == 1) {
    texel = min(max(texel, vec2(0.0)), 2.0 * middle - 1.0);
  } else {
    texel = min(max(texel - 0.5, vec2(0.0)), 2.0 * middle - 2.0);
    place.part = texel - floor(texel);
  }
  ivec2 corner = ivec2(texel);
  place.index = first + corner.y * row + corner.x;
  return place;
}

void shadow_read(inout ShadowPlace place) {
  int row = int(shadow_width);
  place.depths = vec4(texelFetch(shadow_depths, place.index).r);
  if (shadow_taps == 1) return;
  place.depths.y = texelFetch(shadow_depths, place.index + 1).r;
  place.depths.z = texelFetch(shadow_depths, place.index + row).r;
  place.depths.w = texelFetch(shadow_depths, place.index + row + 1).r;
}

// The four texels around the point, each lit or not, weighted by how near it is.
float shadow_reaching(ShadowPlace place) {
  if (place.away) return 0.0;
  if (shadow_taps == 1) return place.depths.x > place.nearer ? 0.0 : 1.0;
  vec4 lit = vec4(lessThanEqual(place.depths, vec4(place.nearer)));
  vec2 rows = mix(lit.xz, lit.yw, place.part.x);
  return mix(rows.x, rows.y, place.part.y);
}

#include "lib/shadow_rays.glsl"

#if PHARE_LAMPS == 8
// Eight more varyings are more than every device has.
#define PHARE_SHADOW_AT(I) shadow_place(I, point)
#else
#define PHARE_SHADOW_AT(I) in_shadow[I]
#endif

#ifdef PHARE_ALIKE
#define PHARE_SHADOW_ZOOM(I) vec2(to_second.w, frame.shadows[I].zoom.y)
#else
#define PHARE_SHADOW_ZOOM(I) frame.shadows[I].zoom.xy
#endif

#define PHARE_MAP_OF(I) (shadow_maps >> (4 * I) & 15u)
#define PHARE_BY_MAP(I) (PHARE_MAP_OF(I) != 0u && shadow_taps <= kTapsOfRays)
#define PHARE_SEEK_SHADOW(I)  \
  ShadowPlace shadow_of_##I; \
  if (PHARE_BY_MAP(I)) shadow_of_##I = shadow_seek(PHARE_SHADOW_AT(I), PHARE_MAP_OF(I) - 1u, PHARE_SHADOW_ZOOM(I));
#define PHARE_READ_SHADOW(I) \
  if (PHARE_BY_MAP(I)) shadow_read(shadow_of_##I);
#define PHARE_REACHING(I)                       \
  (PHARE_MAP_OF(I) == 0u ? 1.0                  \
   : PHARE_BY_MAP(I) ? shadow_reaching(shadow_of_##I) \
                     : reaching_by_rays(PHARE_SHADOW_AT(I), I, PHARE_MAP_OF(I) - 1u))
#endif
