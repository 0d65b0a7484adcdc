// What lean.vert hands to lean.frag: two lamps at most, of one colour, on dry surfaces in clear air, as nearly all of a night drive is. As few
// slots as may be, for on a software device each costs every vertex, and every component that is not flat costs every pixel.
//   PHARE_FLAT   of triangles whose normal is that of their plane: how far a lamp stands before it is one number a triangle
//   PHARE_PLAIN  flat, and nothing depends on the place or the side seen: no detail, nothing sent back
//   PHARE_ALIKE  both lamps' tables have the same axes: a point in the second's frame is that in the first's, shifted
#ifndef PHARE_LEAN_VARYINGS
#define PHARE_LEAN_VARYINGS
#include "lib/lamp_bindings.glsl"

#ifdef PHARE_VERTEX
#define PHARE_VARYING out
#else
#define PHARE_VARYING in
#endif
#ifdef PHARE_FLAT
#define PHARE_ONE_A_PLANE flat
#else
#define PHARE_ONE_A_PLANE
#endif

layout(location = 0) PHARE_VARYING vec4 in_first;  // the point in the first lamp's frame, rows a, b, c; w, not flat: n times the way from eye to lamp
#ifdef PHARE_ALIKE
layout(location = 1) flat PHARE_VARYING vec4 to_second;  // what to add for the second's frame; w: as zoom.x of GpuShadow, which all of a view share
#define PHARE_IN_SECOND (in_first.xyz + to_second.xyz)
#else
layout(location = 1) PHARE_VARYING vec3 in_second;
#define PHARE_IN_SECOND in_second
#endif
// rho/pi, exposed where the display is written, times the light's colour; times the sky's light on an upright surface, half of that on a level
// one (of a plane with one side: as it lies). w, of the first lamp and of the second: how far it stands before the plane; not flat: the square of
// the way from the eye to it, m² (a uniform costs every pixel as much as ten multiplications).
layout(location = 2) flat PHARE_VARYING vec4 lit;
layout(location = 3) flat PHARE_VARYING vec4 unlit;
#ifndef PHARE_PLAIN
layout(location = 4) PHARE_VARYING vec4 place;                           // relative to the eye, m; w, not flat: as in_first, of the second
layout(location = 5) PHARE_ONE_A_PLANE PHARE_VARYING vec4 plane_normal;  // any length; flat: of length 1, and its part of the way from the eye
layout(location = 6) flat PHARE_VARYING vec4 detail;                     // to the world position modulo 1024 m; w as in GpuMaterial
#endif

#ifdef PHARE_SHADOWS
layout(constant_id = kSpecShadowMaps) const uint shadow_maps = 0;
layout(location = 7) PHARE_VARYING vec3 in_shadow[2];
#endif
#endif
