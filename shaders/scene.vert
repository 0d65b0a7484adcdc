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

invariant gl_Position;  // the depth pass and the lamp pass must agree to the bit

void main() {
  point = turned(position_m) + draw.origin.xyz;
  point_normal = turned(normal);
  detail_from_point = draw.detail_origin.xyz - draw.origin.xyz;
  gl_Position = clip_from_eye() * vec4(point, 1.0);
  pass_light(materials[material_index].reflectance);
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
