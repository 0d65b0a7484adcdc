// Wet ground: darker, for light is caught under the film of water, and with the mirror that the film is.
//
// Body: Lekner and Dorf (1988): the film lets 1 - r_e in, holds r_i of what comes back from below: a' = (1 - r_e)(1 - r_i)·a/(1 - r_i·a), water
// n 1.333, r_e 0.066 of diffuse light from outside, r_i = 1 - (1 - r_e)/n². Mirror: microfacets by the distribution of Trowbridge and Reitz (GGX,
// Walter et al. 2007) with the shadowing of Smith in the form of Heitz (2014), Fresnel's equations for light that is not polarised.
#ifndef PHARE_WET_LIB
#define PHARE_WET_LIB
#include "lib/portable.h"

PHARE_SHADER_BEGIN

const float kWater = 1.333f;
const float kHeldFromOutside = 0.066f;
const float kHeldFromBelow = 1.0f - (1.0f - kHeldFromOutside) / (kWater * kWater);

// Of headlamps' light sent back to them, what of it is left under water (docs/effects.md: of markings with ordinary beads; of rough ground).
const float kMarkingLeft = 0.12f;
const float kFacetsLeft = 0.15f;

PHARE_INLINE vec3 wet_reflectance(vec3 dry) {
  return dry * ((1.0f - kHeldFromOutside) * (1.0f - kHeldFromBelow)) / (vec3(1.0f) - dry * kHeldFromBelow);
}

// Of light that meets the face of water at an angle of this cosine, the share that is mirrored.
PHARE_INLINE float mirrored_by_water(float cosine) {
  float g = sqrt(kWater * kWater - 1.0f + cosine * cosine);
  float a = (g - cosine) / (g + cosine), b = (cosine * (g + cosine) - 1.0f) / (cosine * (g - cosine) + 1.0f);
  return 0.5f * a * a * (1.0f + b * b);
}

// Luminance over illuminance, 1/sr, of microfacets that mirror all. Cosines as water_lobe has them.
PHARE_INLINE float facets_lobe(float alpha, float lamp, float eye, float half_way) {
  float a2 = alpha * alpha, slope = half_way * half_way * (a2 - 1.0f) + 1.0f;
  float facets = a2 / (3.14159265f * slope * slope);
  return facets * (0.5f / max(lamp * sqrt(eye * eye * (1.0f - a2) + a2) + eye * sqrt(lamp * lamp * (1.0f - a2) + a2), 1e-6f));
}

// Luminance over illuminance, 1/sr, of the film's mirror. `alpha`: width of its slopes. Cosines: of the lamp and of the eye over the ground, of
// the half way between both over the ground, and of either against it.
PHARE_INLINE float water_lobe(float alpha, float lamp, float eye, float half_way, float against) {
  return facets_lobe(alpha, lamp, eye, half_way) * mirrored_by_water(against);
}

PHARE_SHADER_END
#endif
