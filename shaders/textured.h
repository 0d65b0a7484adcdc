// Contract of surfaces that look otherwise at every pixel (visual/gpu/surface_textures.h): what lamps.frag, compiled with PHARE_TEXTURED, reads
// beside all else. Everything else is drawn by shaders that know nothing of it.
#ifndef PHARE_SHADERS_TEXTURED_H
#define PHARE_SHADERS_TEXTURED_H
#include "lamps.h"

PHARE_SHADER_BEGIN

// Specialization constant: what a material has of it, bits below.
const uint kSpecLook = kSpecMoves + 1u;

const uint kLookBase = 1u;      // a texture of reflectance and opacity
const uint kLookEmissive = 2u;  // one of what it emits
const uint kLookEmits = 4u;     // it emits light
const uint kLookCut = 8u;       // where opacity is less than a limit, there is nothing
const uint kLookColours = 16u;  // the corners have colours
const uint kLookUnlit = 32u;    // it emits by the texture of reflectance and the corners' colours
// Only in what is compiled with PHARE_RELIEF (lib/relief.glsl).
const uint kLookNormal = 64u;   // a texture of normals
const uint kLookRough = 128u;   // one of roughness and metal
const uint kLookRelief = kLookNormal | kLookRough;

// Of a material; its textures are the layers of one image, both of them sRGB.
const uint kBaseLayer = 0u;
const uint kEmissiveLayer = 1u;

struct GpuLook {
  vec4 base;     // rho, linear Rec. 709, and opacity: times texture and corners' colour
  vec4 emitted;  // cd/m², by Rec. 709; w: least opacity of what is there
};

// Behind it, of a material with kLookRelief. Textures are as visual/scene/relief.h has them.
struct GpuRelief {
  vec4 factors;  // x, y: roughness and metal, times the texture's
};

PHARE_SHADER_END
#endif
