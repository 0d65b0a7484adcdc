#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_VERTEX
#include "lib/surface_varyings.glsl"
#ifdef PHARE_FOG_FLAT
#include "lib/fog_flat.glsl"
#endif
#ifdef PHARE_LIT_BY_VERTEX
#include "lib/by_vertex.glsl"
#endif
#ifdef PHARE_TEXTURED
#include "lib/textured.glsl"
#endif

layout(location = 0) in vec3 position_m;  // relative to the batch's origin
layout(location = 1) in vec3 normal;
layout(location = 2) in uint material_index;

#ifdef PHARE_FIXED
layout(location = 3) in vec4 light_here;   // as FixedVertex, or FixedProbe of what moves
layout(location = 4) in float sky_share;
layout(location = 5) in vec3 light_way;    // of what moves
layout(constant_id = kSpecMoves) const uint moves = 0;
#ifdef PHARE_RELIEF
layout(location = 11) in vec3 light_from;  // as FixedWay
#endif
#endif
#ifdef PHARE_ROAD
#include "lib/road.h"
layout(location = 12) in uvec4 road_a;  // as FixedRoad
layout(location = 13) in uvec4 road_b;
layout(location = 14) in uvec4 road_c;
#endif

invariant gl_Position;  // the depth pass and the lamp pass must agree to the bit

void main() {
  point = placed(position_m);
  point_normal = turned(normal);
  detail_from_point = draw.detail_origin.xyz - draw.origin.xyz;
  gl_Position = clip_from_eye() * vec4(point, 1.0);
  pass_light(materials[material_index].reflectance, material_index);
#ifdef PHARE_FIXED
  fixed_light = moves == 0 ? light_here : light_here * max(0.25 + dot(light_way, normalize(point_normal)), 0.0);
  ambient_lx *= sky_share;
#ifdef PHARE_RELIEF
  vec3 from = moves == 0 ? light_from : vec3(0.0);
  fixed_way_xy = from.xy;
  fixed_way_z = from.z;
#endif
#ifdef PHARE_ROAD
  fixed_light.rgb *= road_over_diffuse(road_a, road_b, road_c, point, normalize(point_normal));
#endif
#endif
#ifdef PHARE_FOG_FLAT
  pass_fog();
#endif
#ifdef PHARE_LIT_BY_VERTEX
  light_vertices();
#endif
#ifdef PHARE_TEXTURED
  pass_look();
#endif
}
