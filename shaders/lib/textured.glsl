// Textures and colours of a surface at every pixel: texture coordinates and a colour from the corners, and what they make of reflectance,
// light of its own, and holes. Only in what is compiled with PHARE_TEXTURED; PHARE_LAMPS is 2 or 8 then.
#ifndef PHARE_TEXTURED_LIB
#define PHARE_TEXTURED_LIB
#include "textured.h"

layout(constant_id = kSpecLook) const uint look = 0;

// Behind what surface_varyings.glsl and fog_flat.glsl take.
#if PHARE_LAMPS == 2
#define PHARE_LOOK_LOCATION 13
#elif defined(PHARE_FIXED)
#define PHARE_LOOK_LOCATION 17
#else
#define PHARE_LOOK_LOCATION 16
#endif
#ifdef PHARE_FIXED
#define PHARE_LOOK_INPUT 6
#else
#define PHARE_LOOK_INPUT 3
#endif

#ifdef PHARE_VERTEX
layout(location = PHARE_LOOK_INPUT) in vec2 corner_uv;
layout(location = PHARE_LOOK_INPUT + 1) in vec4 corner_colour;
layout(location = PHARE_LOOK_LOCATION) out vec2 look_uv;
layout(location = PHARE_LOOK_LOCATION + 1) out vec4 look_colour;

#ifdef PHARE_RELIEF
layout(location = PHARE_LOOK_INPUT + 2) in vec4 corner_tangent;
layout(location = PHARE_LOOK_LOCATION + 2) out vec4 look_tangent;
#ifdef PHARE_FIXED
// Beside others, for a device may hand 80 numbers and no more.
layout(location = PHARE_LOOK_LOCATION, component = 2) out vec2 fixed_way_xy;
layout(location = 0, component = 3) out float fixed_way_z;
#endif
#endif

void pass_look() {
  look_uv = corner_uv;
  look_colour = corner_colour;
#ifdef PHARE_RELIEF
  look_tangent = vec4(turned(corner_tangent.xyz), corner_tangent.w);
#endif
}
#else
layout(location = PHARE_LOOK_LOCATION) in vec2 look_uv;
layout(location = PHARE_LOOK_LOCATION + 1) in vec4 look_colour;
layout(set = PHARE_TEXTURE_SET, binding = 0) uniform sampler2DArray look_texels;
#ifdef PHARE_RELIEF
layout(std140, set = PHARE_TEXTURE_SET, binding = 1) uniform Look { GpuLook look_of; GpuRelief relief_of; };
#else
layout(std140, set = PHARE_TEXTURE_SET, binding = 1) uniform Look { GpuLook look_of; };
#endif

vec3 seen_rho, seen_emitted_cdm2;

// First of all, where every pixel is there: the level of detail comes from the neighbours.
void see_texture() {
  vec4 texel = vec4(1.0);
  if ((look & kLookBase) != 0) texel = texture(look_texels, vec3(look_uv, float(kBaseLayer)));
  if ((look & kLookColours) != 0) texel *= look_colour;
  vec4 base = look_of.base * texel;
  seen_rho = base.rgb;
  seen_emitted_cdm2 = look_of.emitted.rgb;
  if ((look & kLookEmissive) != 0) seen_emitted_cdm2 *= texture(look_texels, vec3(look_uv, float(kEmissiveLayer))).rgb;
  if ((look & kLookUnlit) != 0) seen_emitted_cdm2 *= texel.rgb;
  if ((look & kLookCut) != 0 && base.a < look_of.emitted.w) discard;
}
#endif
#endif
