// What the vertex stage hands to lamps.frag. What is the same for the whole draw goes as flat varyings too: on a software device
// they cost a pixel nothing, while each uniform read costs as much as ten multiplications.
#ifndef PHARE_SURFACE_VARYINGS
#define PHARE_SURFACE_VARYINGS
#include "lib/lamp_bindings.glsl"
#include "lib/snow.h"
#include "lib/wet.h"

layout(constant_id = kSpecWet) const uint wet_ground = 0;
layout(constant_id = kSpecSnow) const uint snow_lies = 0;

#ifndef PHARE_COMPUTE
#ifdef PHARE_VERTEX
#define PHARE_VARYING out
#else
#define PHARE_VARYING in
#endif

layout(location = 0) PHARE_VARYING vec3 point;            // relative to the eye, m
layout(location = 1) PHARE_VARYING vec3 point_normal;
layout(location = 2) flat PHARE_VARYING vec3 detail_from_point;  // to the world position modulo 1024 m, for surface detail
layout(location = 3) flat PHARE_VARYING vec4 reflectance; // rho/pi, exposed where the display is written; w as in GpuMaterial
layout(location = 4) flat PHARE_VARYING vec3 light_colour;  // of the lamps, where all have one
layout(location = 5) flat PHARE_VARYING vec3 ambient_lx;  // half of what the whole sky gives a level surface
#ifdef PHARE_FIXED
layout(location = 16) PHARE_VARYING vec4 fixed_light;  // of what does not change: rgb lx with what the surface sends out itself, lx
#endif
layout(location = 6) PHARE_VARYING vec3 in_lamp[PHARE_LAMPS];  // the point in each lamp's frame, rows a, b, c

// n times the way from the eye to each lamp, n being point_normal; by vertex (kSpecMethod) what each lamp gives there: lx, or cos(q)/r².
#if PHARE_LAMPS == 2
layout(location = 8) PHARE_VARYING vec2 facing[1];
#define PHARE_FACING(I) facing[0][I]
#else
layout(location = 6 + PHARE_LAMPS) PHARE_VARYING vec4 facing[PHARE_LAMPS / 4];
#define PHARE_FACING(I) facing[I / 4][I % 4]
#endif

#endif

#ifdef PHARE_SHADOWS
layout(constant_id = kSpecShadowMaps) const uint shadow_maps = 0;

// As GpuShadow has it, not divided yet.
vec3 shadow_place(uint lamp, vec3 from_eye) {
  vec4 p = vec4(from_eye, 1.0);
  return vec3(dot(frame.shadows[lamp].u, p), dot(frame.shadows[lamp].v, p), dot(frame.shadows[lamp].w, p));
}
#if PHARE_LAMPS != 8
layout(location = 7 + PHARE_LAMPS) PHARE_VARYING vec3 in_shadow[PHARE_LAMPS];
#endif
#endif

#ifdef PHARE_VERTEX
layout(constant_id = 2) const uint retro = 0;
layout(constant_id = 3) const uint output_kind = 0;

// What goes back to the lamp is kept over what the surface reflects (GpuMaterial), which water has made darker. `marking_left`: what of a
// marking's own stays.
vec4 wetted(vec4 dry, float marking_left) {
  vec3 rho = wet_reflectance(dry.rgb);
  if (retro != kRetroMarking && retro != kRetroFacets) return vec4(rho, dry.w);
  float green_left = max(rho.g, 1e-6);  // of black ground too something is divided by
  return vec4(rho, dry.w * (retro == kRetroMarking ? marking_left : kFacetsLeft) * dry.g / green_left);
}

// `index`: the material's.
void pass_light(vec4 material, uint index) {
  const float pi = 3.14159265;
  if (wet_ground != 0u) {
    vec4 of_wet = materials[kMaxMaterials - 1u - index].reflectance;  // GpuMaterial
    material = wetted(material, of_wet.w < 0.0 ? of_wet.x : kMarkingLeft);
  }
  if (snow_lies != kSnowNone) {
    vec4 covered = snowed(material, snow_share(normalize(point_normal).z, frame.ground.x), snow_lies == kSnowOnMarking);
    material = retro == kRetroFacets ? covered : vec4(covered.rgb, material.w);
  }
  reflectance = vec4(material.rgb / pi, material.w);
  if (output_kind == kOutputDisplay || output_kind == kOutputClipping) reflectance.rgb *= frame.exposure.rgb;
  light_colour = frame.lamps[0].colour.rgb;
  ambient_lx = frame.sky.rgb * (0.5 * pi);
#define PHARE_POINT_IN(I)                                                                                       \
  if (lamp_count > I) {                                                                                         \
    vec3 d = point - frame.lamps[I].position.xyz;                                                               \
    in_lamp[I] = vec3(dot(frame.lamps[I].row_a.xyz, d), dot(frame.lamps[I].row_b.xyz, d), dot(frame.lamps[I].row_c.xyz, d)); \
    PHARE_FACING(I) = dot(frame.lamps[I].position.xyz, point_normal);                                           \
  }
  PHARE_EACH_LAMP(PHARE_POINT_IN)
#if defined(PHARE_SHADOWS) && PHARE_LAMPS != 8
#define PHARE_SHADOW_OF(I) \
  if ((shadow_maps >> (4 * I) & 15u) != 0u) in_shadow[I] = shadow_place(I, point);
  PHARE_EACH_LAMP(PHARE_SHADOW_OF)
#endif
}
#endif
#endif
