// Surfaces by glTF 2.0, appendix B: a diffuse body under a clear layer of index 1.5, or metal, both with microfacets by Trowbridge and Reitz
// (GGX) of width alpha = roughness² and the shadowing of Smith; Fresnel by Schlick. And what a texture of normals leaves of light.
#ifndef PHARE_GLOSS_LIB
#define PHARE_GLOSS_LIB
#include "lib/portable.h"
#include "lib/wet.h"

PHARE_SHADER_BEGIN

const float kClearLayer = 0.04f;  // mirrored by it of light that meets it square: ((1.5 - 1)/(1.5 + 1))²

// A lamp is a point here, and a smoother surface would mirror it as one: 0.02 is 1.1° wide, a lens of 10 cm seen from 5 m.
const float kLeastAlpha = 0.02f;

// alpha of a roughness, where facets that a level of detail has no room for have slopes of this mean square.
PHARE_INLINE float facets_alpha(float roughness, float slopes) {
  float own = roughness * roughness;
  return min(sqrt(max(own * own + slopes, kLeastAlpha * kLeastAlpha)), 1.0f);
}

// Of a mean normal of length r: what its facets' slopes are, squared and averaged.
PHARE_INLINE float slopes_in(float r) {
  return 2.0f * (1.0f - r) / max(r, 0.1f);
}

// Schlick's share of what is not mirrored square on. `against`: cosine of the half way between lamp and eye against either.
PHARE_INLINE float schlick(float against) {
  float part = max(1.0f - against, 0.0f), square = part * part;
  return square * square * part;
}

// A texture's facets have no shadows: those that face a low lamp are lit as if nothing stood before them, those behind are dark, and on the average
// there would be more light than falls on the surface. Smith's function for Gaussian slopes is what is left: with it the mean over a surface is that
// of the surface itself. Rational form of Walter et al. (2007), 0.35 % off. `slopes`: their mean square, alpha², of textures as NormalLevel has them; `cosine`: of the lamp over
// the surface.
PHARE_INLINE float lit_of_facets(float slopes, float cosine) {
  float up = cosine / sqrt(max((1.0f - cosine * cosine) * slopes, 1e-12f));
  if (up >= 1.6f) return 1.0f;
  return (3.535f + 2.181f * up) * up / (1.0f + (2.276f + 2.577f * up) * up);
}

PHARE_SHADER_END
#endif
