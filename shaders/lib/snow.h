// Ground and things under snow. What looks up is covered, with the reflectance of snow that has lain; covered ground is as rough as it was, so
// that it sends the own lamps' light back as upright facets (lib/retro.h) of snow's own reflectance, and beads of markings lie below. Left out:
// snow's own peak of light sent back, its glints, patches, depth.
#ifndef PHARE_SNOW_LIB
#define PHARE_SNOW_LIB
#include "lib/retro.h"

PHARE_SHADER_BEGIN

// As "snow" of config/materials/surfaces.toml: chosen, said to be 0.8 to 0.9 fresh and 0.5 to 0.7 old; from memory.
const vec3 kSnow = vec3(0.80f, 0.82f, 0.85f);

// Share of a surface that is covered. `up`: z of its unit normal; `cover`: share of level ground. Steeper than 45° less lies, steeper than 70°
// none: chosen.
PHARE_INLINE float snow_share(float up, float cover) {
  return cover * clamp((up - 0.342f) / (0.707f - 0.342f), 0.0f, 1.0f);
}

// A material (as GpuMaterial: rho, and over rho/pi what facets or beads send back) so far covered. `marking`: its beads become facets of the same
// strength in the 30 m geometry, for it is drawn as facets where snow lies.
PHARE_INLINE vec4 snowed(vec4 bare, float share, bool marking) {
  vec3 rho = mix(vec3(bare), kSnow, share);
  float strength = marking ? bare.w / kFacetsAt30m : bare.w;
  return vec4(rho, (strength * bare.y * (1.0f - share) + kSnow.y * share) / max(rho.y, 1e-6f));
}

PHARE_SHADER_END
#endif
