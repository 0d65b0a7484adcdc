// Luminance of asphalt under lamps above it, from what its vertices keep of an r-table: FixedRoad
// (visual/fixed_light.h), of which visual/photometry/table/road_lobes.h has the theory.
#ifndef PHARE_ROAD_LIB
#define PHARE_ROAD_LIB
#include "lib/portable.h"

#ifdef __cplusplus
#include <glm/packing.hpp>
namespace phare::shader {
using glm::inversesqrt;
using glm::unpackHalf2x16;
}  // namespace phare::shader
#endif

PHARE_SHADER_BEGIN

const uint kRoadStreaks = 7u;       // of the strongest lamps at a vertex
const float kStreakUnit = 16.0f;    // so that half floats hold the sharpest
const float kNoStreak = 60000.0f;

// A table is of an eye 1° above the road, and stands for 0.5° to 1.5° (CIE 144). Nearer to the eye less and less of
// it: microfacets with slopes of 0.3 and a refractive index of 1.5 have, for a lamp 14° above the road, 0.77, 0.52 and
// 0.14 of their streak at 3.4°, 7° and 20°.
const float kSeenBelow = 0.0262f;  // sine of 1.5°
const float kSeenFall = 0.157f;

PHARE_INLINE float by_the_table(float sin_seen) {
  return exp(-max(sin_seen - kSeenBelow, 0.0f) / kSeenFall);
}

// (x, y): toward the lamp along the ground, as long as the streak is sharp over its peak; z: one over the peak. `way`:
// of sight along the ground, length 1.
PHARE_INLINE float streak(vec3 lamp, vec2 way) {
  vec2 toward = vec2(lamp.x, lamp.y);
  return 1.0f / (kStreakUnit * (lamp.z + max(sqrt(dot(toward, toward)) - dot(toward, way), 0.0f)));
}

// Times what a diffuse surface would have. Half floats, of each pair the low one first: mean, along x, along y, then
// x, y, z of each streak.
PHARE_INLINE float of_the_table(uvec4 a, uvec4 b, uvec4 c, vec2 way) {
  vec2 p0 = unpackHalf2x16(a.x), p1 = unpackHalf2x16(a.y), p2 = unpackHalf2x16(a.z), p3 = unpackHalf2x16(a.w);
  vec2 p4 = unpackHalf2x16(b.x), p5 = unpackHalf2x16(b.y), p6 = unpackHalf2x16(b.z), p7 = unpackHalf2x16(b.w);
  vec2 p8 = unpackHalf2x16(c.x), p9 = unpackHalf2x16(c.y), p10 = unpackHalf2x16(c.z), p11 = unpackHalf2x16(c.w);
  float sum = p0.x + p0.y * way.x + p1.x * way.y;
  sum += streak(vec3(p1.y, p2.x, p2.y), way) + streak(vec3(p3.x, p3.y, p4.x), way);
  sum += streak(vec3(p4.y, p5.x, p5.y), way) + streak(vec3(p6.x, p6.y, p7.x), way);
  sum += streak(vec3(p7.y, p8.x, p8.y), way) + streak(vec3(p9.x, p9.y, p10.x), way);
  return max(sum + streak(vec3(p10.y, p11.x, p11.y), way), 0.0f);
}

// The same for what is seen at `point`, relative to the eye, with the surface's normal.
PHARE_INLINE float road_over_diffuse(uvec4 a, uvec4 b, uvec4 c, vec3 point, vec3 normal) {
  vec2 along = vec2(point.x, point.y);
  vec2 way = along * inversesqrt(max(dot(along, along), 1e-12f));
  float sin_seen = -dot(normal, point) * inversesqrt(max(dot(point, point), 1e-12f));
  return mix(1.0f, of_the_table(a, b, c, way), by_the_table(sin_seen));
}

PHARE_SHADER_END
#endif
