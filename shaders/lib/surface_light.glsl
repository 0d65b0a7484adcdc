// What a surface does with light beside Lambert's law: detail of its reflectance, and what it sends back to where light came from.
#ifndef PHARE_SURFACE_LIGHT
#define PHARE_SURFACE_LIGHT
#include "lib/beam.glsl"
#include "lib/grain.glsl"
#include "lib/retro.h"

layout(constant_id = kSpecSurface) const uint surface = 0;
#ifndef PHARE_VERTEX
layout(constant_id = kSpecRetro) const uint retro = 0;
#endif

// Reflectance detail: one grain at several sizes, all whole tiles in the 1024 m after which `detail` repeats; coarser levels take away
// what a pixel cannot resolve. Mean factor 1, so that the reflectance of the material holds. The factor of green and blue in x, of red over
// theirs in y.
vec2 surface_detail(vec3 point, vec3 detail_from_point) {
  if (surface == 0) return vec2(1.0);
  vec3 detail = point + detail_from_point;
  float footprint = surface == 4 ? grain_footprint(point) : grain_footprint(point.xy);
#define GRAIN(LAYER, AT, TILES) grain_at(LAYER, (AT) * ((TILES) / 1024.0), (TILES) / 1024.0, footprint)
  if (surface == 1)  // asphalt: chippings, patches of binder, darker wheel tracks of the world scale
    return vec2(0.35 + 0.7 * GRAIN(kGrainFine, detail.xy, 614.0) + 0.6 * GRAIN(kGrainSoft, detail.yx, 46.0), 1.0);
  if (surface == 2) {  // grass: tufts
    float tufts = GRAIN(kGrainSoft, detail.xy, 317.0);
    return vec2(0.35 + 0.7 * tufts + 0.6 * GRAIN(kGrainFine, detail.yx, 1024.0), 0.85 + 0.3 * tufts);
  }
  if (surface == 3)  // paint: worn
    return vec2(0.8 + 0.3 * GRAIN(kGrainFine, detail.xy, 922.0), 1.0);
  if (surface == 4)  // foliage
    return vec2(0.3 + 1.4 * grain_at(kGrainFine, detail.xz * (461.0 / 1024.0) + detail.y * (276.0 / 1024.0), 537.0 / 1024.0, footprint), 1.0);
  return vec2(1.0);
}

// Which of their rows: lean shaders know no water.
#ifdef PHARE_LEAN
#define PHARE_GROOVES_ROW 0u
#else
#define PHARE_GROOVES_ROW wet_ground
#endif

// Luminance over illuminance facing the lamp, as rho/pi has it; n looks to the side that is seen, `level` is its part of the way from the eye.
// Retroreflected light keeps the tint of the material and not its darkness. `strength`: w of GpuMaterial; `eye_lamp2`: the square of the way from
// the eye to the lamp, m².
float sent_back(uint lamp, LampLight light, vec3 point, vec3 n, float level, float strength, float eye_lamp2) {
  float eye2 = dot(point, point), inverse_eye = inversesqrt(eye2), cos_seen = -level * inverse_eye;
  // By the law of cosines: how far the lamp is from the eye is one number for the lamp.
  float cos_between = (eye2 + light.distance_m * light.distance_m - eye_lamp2) * (0.5 * inverse_eye) * light.per_m;
  if (retro == kRetroFacets) return strength * facets_share(light.cos_incidence, cos_seen, cos_between);
  if (light.cos_incidence <= 0.0) return 0.0;
  if (retro == kRetroGrooves) return grooves_beside(sheetings[uint(strength)].row[PHARE_GROOVES_ROW], light.cos_incidence, cos_seen, cos_between);
  vec3 toward_lamp = frame.lamps[lamp].position.xyz - point;
  float observation_deg = between_deg(toward_lamp, -point);
  if (retro == kRetroMarking) return marking_sent_back(strength, observation_deg, light.cos_incidence, cos_seen, cos_between);
  // R_A is per area of the sheeting: luminance is R_A·E over the cosine of the eye's angle. At grazing angles nothing is left of R_A.
  SheetingRow at = sheeting_row(observation_deg);
  uint index = uint(strength);
  return sheeting_between(sheetings[index].row[at.before], sheetings[index].row[at.before + 1], at.part, between_deg(toward_lamp, n)) / max(cos_seen, 0.1);
}
#endif
