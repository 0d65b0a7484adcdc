// Light sent back to where it came from: R_A of sheeting over observation and entrance angle, R_L of markings over
// observation angle. Tables, classes and their sources: visual/scene/retro.h, docs/light.md.
#ifndef PHARE_SHADERS_LIB_RETRO_H
#define PHARE_SHADERS_LIB_RETRO_H
#include "lib/angles.h"

PHARE_SHADER_BEGIN

/// Between two directions of any length, degrees.
PHARE_INLINE float between_deg(vec3 a, vec3 b) {
  return atan2_deg(length(cross(a, b)), dot(a, b));
}

/// R_L of a marking at an observation angle (eye, marking, lamp), as a multiple of that in the 30 m geometry of EN 1436
/// (1.05°): exp(-(angle - 1.05°)/1.6°). The standard says nothing about other angles; this fall of glass beads is one
/// that another night road renderer assumes, and no measurement of ours: chosen. 15, 50, 100 m: 0.52, 1.30, 1.58.
PHARE_INLINE float marking_share(float observation_deg) {
  return exp((1.05f - observation_deg) / 1.6f);
}

/// Beads that light only grazes hide behind each other: all of R_L down to 0.002 (0.65 m high, 325 m away), then less. Chosen.
PHARE_INLINE float marking_reached(float cos_incidence) {
  return min(cos_incidence * 500.0f, 1.0f);
}

/// Rough ground as upright facets (stones, tufts) of one reflectance, beside the flat surface: what light at a low angle finds in its way
/// and the eye, looking the same way, sees of it. Luminance over facing illuminance is rho/pi times this:
///   (l·v - (n·l)(n·v)) · min(1, (n·l)/(n·v)),   l toward the lamp, v toward the eye, n up, unit vectors.
/// First factor: facets that face the lamp, as the eye's azimuth sees them (nothing against the light). Second: where the lamp is lower
/// than the eye, each facet shades the foot of the next, and light is on elevation over elevation of what is seen. So along a road the ratio
/// stays where flat Lambert falls with the lamp's elevation. It is the term B of Oren and Nayar (1994, eq. 30) without their bound on it.
PHARE_INLINE float facets_share(float cos_incidence, float cos_seen, float cos_between) {
  return max(cos_between - cos_incidence * cos_seen, 0.0f) * min(cos_incidence * (1.0f / max(cos_seen, 1e-6f)), 1.0f);
}

/// That of the 30 m geometry: light at 1.2412°, eye at 2.2906° above the ground.
const float kFacetsAt30m = 0.5414125f;
/// Of the lamp in that geometry (EN 1436), 0.65 m high and 30 m away: cosine of its light's incidence on the ground.
const float kCosIncidenceAt30m = 0.02166158f;

/// What a marking sends back, in units of `whole`: R_L in the 30 m geometry without the diffuse part, over rho/pi. Its paint lies on rough
/// ground and is as rough, so a part is facets of its own rho, at most half of R_L (chosen); beads send the rest.
PHARE_INLINE float marking_sent_back(float whole, float observation_deg, float cos_incidence, float cos_seen, float cos_between) {
  float facets = min(whole * (0.5f / kFacetsAt30m), 1.0f);
  float beads = whole - facets * kFacetsAt30m;
  return beads * marking_share(observation_deg) * marking_reached(cos_incidence) +
         facets * facets_share(cos_incidence, cos_seen, cos_between);
}

/// The angle from the normal over 90°, by its cosine from 0 to 1 (Abramowitz and Stegun 4.4.46: 2e-8 rad). GLSL's acos is off by 1e-4 on Mesa.
PHARE_INLINE float angle_over_90(float c) {
  float c2 = c * c, c4 = c2 * c2;
  float low = (1.5707963050f - 0.2145988016f * c) + c2 * (0.0889789874f - 0.0501743046f * c);
  float high = (0.0308918810f - 0.0170881256f * c) + c2 * (0.0066700901f - 0.0012624911f * c);
  return sqrt(1.0f - c) * (low + c4 * high) * 0.63661977237f;
}

/// Oren and Nayar (1994), eq. 30 in full, less Lambert's part: luminance over facing illuminance is rho/pi times this and times what flat Lambert
/// has, cos_incidence. `terms`, of the slopes' variance s: C1 - 1 = -s/2/(s + 0.33); 0.45·s/(s + 0.09); 0.125·s/(s + 0.09); of light between
/// facets 0.17·rho·s/(s + 0.13). A coloured surface has one rho there (visual/scene/retro.h). cos(azimuth)·sin(larger)·tan(smaller) of theirs is
/// what cos_between has beyond the product of the other two, over the cosine of the smaller angle. For wide slopes and grazing light toward the
/// eye the equation is below nothing: there is none then. Checked against float64 in tests/visual/rough_surface_test.cpp.
PHARE_INLINE float grooves_beside(vec4 terms, float cos_incidence, float cos_seen, float cos_between) {
  // Those of sight are the same for all lamps.
  float lit = clamp(cos_incidence, 0.0f, 1.0f), seen = clamp(cos_seen, 0.0f, 1.0f);
  float sin_lit = sqrt(1.0f - lit * lit), sin_seen = sqrt(1.0f - seen * seen);
  float part_lit = angle_over_90(lit), part_seen = angle_over_90(seen);
  bool from_above = lit > seen;
  float cosine = max(lit, seen), sum = lit + seen;
  float smaller = min(part_lit, part_seen), sin_smaller = from_above ? sin_lit : sin_seen;
  float smaller2 = smaller * smaller, both = part_lit * part_seen;
  float beyond = cos_between - lit * seen;
  float azimuth = clamp(beyond / max(sin_lit * sin_seen, 1e-6f), -1.0f, 1.0f);  // its cosine
  float along = terms.y * (beyond - min(azimuth, 0.0f) * (smaller2 * smaller) * sin_smaller);
  float across = terms.z * (1.0f - abs(azimuth)) * (both * both) * (sin_lit + sin_seen);
  float direct = (along * sum + across * cosine) / max(cosine * sum, 1e-9f);
  return lit * max(terms.x + direct + terms.w * (1.0f - azimuth * smaller2), -1.0f);
}

/// Rows of a sheeting's table: observation angles 0.2°, 0.33°, 0.5°, 1°, 1.5°, 2°.
const uint kSheetingRows = 6u;

/// The row before an observation angle, and the way to the next in the angle's logarithm. Below 0.2° as at 0.2°; beyond
/// 2° the last slope goes on (way above 1). Both chosen: classes end there.
struct SheetingRow {
  uint before;
  float part;
};
PHARE_INLINE SheetingRow sheeting_row(float observation_deg) {
  float x = log(max(observation_deg, 0.2f));
  SheetingRow row;
  row.before = 0u;
  row.part = (x + 1.6094379f) * 1.9969036f;
  if (x >= -1.1086626f) { row.before = 1u; row.part = (x + 1.1086626f) * 2.4066494f; }
  if (x >= -0.6931472f) { row.before = 2u; row.part = (x + 0.6931472f) * 1.4426950f; }
  if (x >= 0.0f) { row.before = 3u; row.part = x * 2.4663035f; }
  if (x >= 0.4054651f) { row.before = 4u; row.part = (x - 0.4054651f) * 3.4760595f; }
  return row;
}

/// R_A between two rows of logarithms; x to w: at entrance angles 5°, 20°, 30°, 40°. Logarithm over logarithm of the
/// observation angle, linear over the entrance angle. Head-on as at 5°; from 40° on falling to nothing at 75°: chosen.
PHARE_INLINE float sheeting_between(vec4 ln_before, vec4 ln_after, float part, float entrance_deg) {
  vec4 at = exp(ln_before + (ln_after - ln_before) * part);
  float b = entrance_deg;
  if (b >= 40.0f) return at.w * max(75.0f - b, 0.0f) / 35.0f;
  if (b >= 30.0f) return mix(at.z, at.w, (b - 30.0f) / 10.0f);
  if (b >= 20.0f) return mix(at.y, at.z, (b - 20.0f) / 10.0f);
  return mix(at.x, at.y, max(b - 5.0f, 0.0f) / 15.0f);
}

PHARE_SHADER_END
#endif
