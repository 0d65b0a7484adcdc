// How much of a lamp's light reaches a point past what stands in its beam: 0 none, 1 all. Shadow maps (Williams 1978) hold the far sides of
// things, so what faces the lamp never shadows itself, road at grazing light included (visual/passes/shadows.h).
#ifndef PHARE_SHADOW
#define PHARE_SHADOW
#ifdef PHARE_LEAN
#include "lib/lean_varyings.glsl"
#else
#include "lib/surface_varyings.glsl"
#endif

#include "lib/shadow_map.glsl"

layout(constant_id = kSpecBent) const uint bent = 0;

// Of a pixel's plane, away from the lamp while the eye sees it: a far side itself, at the depth that stands in the map.
bool turned_away(vec3 at, float side) {
  return dot(cross(dFdx(at), dFdy(at)), at) * side <= 0.0;
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
  if (PHARE_BY_MAP(I)) { \
    vec2 zoom = PHARE_SHADOW_ZOOM(I); \
    shadow_of_##I = shadow_seek(PHARE_SHADOW_AT(I), PHARE_MAP_OF(I) - 1u, zoom.x, shadow_taps); \
    shadow_of_##I.away = bent != 0u && turned_away(PHARE_SHADOW_AT(I), zoom.y); \
  }
#define PHARE_READ_SHADOW(I) \
  if (PHARE_BY_MAP(I)) shadow_read(shadow_of_##I);
#define PHARE_REACHING(I)                       \
  (PHARE_MAP_OF(I) == 0u ? 1.0                  \
   : PHARE_BY_MAP(I) ? shadow_reaching(shadow_of_##I) \
                     : reaching_by_rays(PHARE_SHADOW_AT(I), I, PHARE_MAP_OF(I) - 1u))
#endif
