// Angles of a direction, in degrees, exact to float32. GLSL's own atan may be off by 4096 ulp (Vulkan 1.3, precision of
// operations), and is off by 1e-3 degrees on Mesa: across a cut-off that is 1 % of the intensity.
#ifndef PHARE_SHADERS_LIB_ANGLES_H
#define PHARE_SHADERS_LIB_ANGLES_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

/// atan(t)/t as a polynomial in t² on |t| <= tan(23.25°), by Remez' exchange: relative error 2.6e-8. Summed in pairs (Estrin), here and below: each
/// product waits for fewer before it.
PHARE_INLINE float atan_over_t(float t2) {
  float t4 = t2 * t2;
  return (0.99999997475f - 0.33332636093f * t2) + t4 * ((0.19968968278f - 0.13794350462f * t2) + t4 * 0.078012419352f);
}

/// The same on |t| <= tan(45.2°): relative error 1.7e-8.
PHARE_INLINE float atan_over_t_wide(float t2) {
  float t4 = t2 * t2, t8 = t4 * t4;
  float low = (0.99999998333f - 0.33333052624f * t2) + t4 * (0.19992135804f - 0.141993945f * t2);
  float high = (0.10622763338f - 0.07462433148f * t2) + t4 * (0.042160741098f - 0.015720140604f * t2);
  return low + t8 * (high + t8 * 0.0027573844275f);
}

/// Those for a picture of 8 bits (kLookupShown), by fewer terms: relative errors 2.2e-5 and 3.1e-5.
PHARE_INLINE float atan_over_t_shown(float t2) {
  return 0.99997792f + t2 * (0.16617217f * t2 - 0.33111655f);
}
PHARE_INLINE float atan_over_t_wide_shown(float t2) {
  float t4 = t2 * t2;
  return (0.9999685f - 0.33163783f * t2) + t4 * ((0.18483804f - 0.09122433f * t2) + t4 * 0.02346401f);
}

/// atan2(|y|, |x|): the nearest multiple of 45° in x, 0 to 2, and the rest in y, radians within ±22.5°. (0, 0) gives 0.
PHARE_INLINE vec2 quadrant_octants(float y, float x) {
  float ax = abs(x);
  float ay = abs(y);
  float low = min(ax, ay);
  float high = max(ax, ay);
  // Above 22.5° turn by 45°: tan(a - 45°) = (low - high) / (low + high).
  bool turned = low > 0.41421356f * high;
  float numerator = turned ? low - high : low;
  float denominator = turned ? low + high : high;
  float t = denominator > 0.0f ? numerator / denominator : 0.0f;
  vec2 angle = vec2(turned ? 1.0f : 0.0f, t * atan_over_t(t * t));
  return ay > ax ? vec2(2.0f - angle.x, -angle.y) : angle;
}

/// atan2(y, x) in degrees, -180..180. (0, 0) gives 0. Error below 3e-7 of the angle for float32 inputs.
PHARE_INLINE float atan2_deg(float y, float x) {
  vec2 octants = quadrant_octants(y, x);
  float angle = octants.x * 45.0f + octants.y * 57.295779513f;
  angle = x < 0.0f ? 180.0f - angle : angle;
  return y < 0.0f ? -angle : angle;
}

/// atan2(y, x) from 0° to 360°: the nearest multiple of 45° in x, 0 to 8, and the rest in y, radians within ±22.5°. Apart they keep every angle
/// as exactly as a small one: error of the rest below 3e-7 of it and 6e-8 rad.
PHARE_INLINE vec2 atan2_octants(float y, float x) {
  vec2 angle = quadrant_octants(y, x);
  angle = x < 0.0f ? vec2(4.0f - angle.x, -angle.y) : angle;
  return y < 0.0f ? vec2(8.0f - angle.x, -angle.y) : angle;
}

/// atan2(y, x) in radians for x > 0, as above.
PHARE_INLINE float atan2_forward_rad(float y, float x) {
  float ay = abs(y);
  bool turned = min(ay, x) > 0.41421356f * max(ay, x);
  float numerator = turned ? ay - x : min(ay, x);
  float t = numerator / (turned ? ay + x : max(ay, x));
  float angle = t * atan_over_t(t * t);
  // turned: 45° + atan((y - x)/(y + x)), for either order of y and x. Else beyond 45°: 90° - atan(x/y).
  float beyond = ay > x ? 1.5707963268f - angle : angle;
  angle = turned ? angle + 0.7853981634f : beyond;
  return y < 0.0f ? -angle : angle;
}

PHARE_SHADER_END
#endif
