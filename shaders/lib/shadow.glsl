// How much of a lamp's light reaches a point past what stands in its beam: 0 none, 1 all. Shadow maps (Williams 1978) hold the far sides of
// things, so what faces the lamp never shadows itself, road at grazing light included (visual/passes/shadows.h).
#ifndef PHARE_SHADOW
#define PHARE_SHADOW
#ifdef PHARE_LEAN
#include "lib/lean_varyings.glsl"
#else
#include "lib/surface_varyings.glsl"
#endif
#include "lib/opening.h"

layout(set = 1, binding = 0) uniform samplerBuffer shadow_depths;  // all maps, one after the other, rows from the top; by rays trees (lamps.h)
layout(constant_id = kSpecShadowWidth) const uint shadow_width = 1;
layout(constant_id = kSpecShadowHeight) const uint shadow_height = 1;
layout(constant_id = kSpecShadowTaps) const uint shadow_taps = 1;

// What is nearer than the point by less than this, relatively, does not shadow it (25 mm at 50 m): float32 rounds depths of the map and of
// the point apart.
const float kShadowBias = 1.0005;

// `at`: as GpuShadow has it, not divided yet. The outermost texels hold nothing, so beyond the map all is lit.
float reaching(vec3 at, uint map) {
  float inverse_w = 1.0 / max(at.z, 1e-3);
  float nearer = kShadowNear_m * inverse_w * kShadowBias;
  vec2 middle = 0.5 * vec2(float(shadow_width), float(shadow_height));
  vec2 from_middle = at.xy * inverse_w, large = from_middle * kShadowZoom;
  bool close = all(lessThan(abs(large), middle - 1.0));
  // Half a texel up: below the line where a slope meets the valley behind it a lamp looks into the ground, where there is no far side.
  vec2 texel = middle + (close ? large : from_middle) - vec2(0.0, 0.5);
  int row = int(shadow_width), first = int((2 * map + (close ? 1 : 0)) * shadow_width * shadow_height);
  if (shadow_taps == 1) {
    ivec2 nearest = ivec2(min(max(texel, vec2(0.0)), 2.0 * middle - 1.0));
    return texelFetch(shadow_depths, first + nearest.y * row + nearest.x).r > nearer ? 0.0 : 1.0;
  }
  // The four texels around the point, each lit or not, weighted by how near it is.
  texel = min(max(texel - 0.5, vec2(0.0)), 2.0 * middle - 2.0);
  vec2 corner = floor(texel), part = texel - corner;
  int index = first + int(corner.y) * row + int(corner.x);
  vec4 depths = vec4(texelFetch(shadow_depths, index).r, texelFetch(shadow_depths, index + 1).r, texelFetch(shadow_depths, index + row).r,
                     texelFetch(shadow_depths, index + row + 1).r);
  vec4 lit = vec4(lessThanEqual(depths, vec4(nearer)));
  vec2 rows = mix(lit.xz, lit.yw, part.x);
  return mix(rows.x, rows.y, part.y);
}

// Whether the tree from texel `at` to `end` has a triangle on the ray between two distances (Möller and Trumbore 1997). Triangles are larger
// by a millionth, so that no ray slips through between two of them.
bool tree_blocks(int at, int end, vec3 from, vec3 along, float nearest, float farthest) {
  const float slack = 1e-6;
  vec3 inverse = 1.0 / mix(along, vec3(1e-12), lessThan(abs(along), vec3(1e-12)));
  while (at < end) {
    vec4 low = texelFetch(shadow_depths, at), high = texelFetch(shadow_depths, at + 1);
    vec3 a = (low.xyz - from) * inverse, b = (high.xyz - from) * inverse, first = min(a, b), last = max(a, b);
    if (max(max(first.x, first.y), max(first.z, nearest)) > min(min(last.x, last.y), min(last.z, farthest))) {
      at = int(low.w);
      continue;
    }
    at += 2;
    for (int left = int(high.w); left > 0; --left, at += 3) {
      vec3 ab = texelFetch(shadow_depths, at + 1).xyz, ac = texelFetch(shadow_depths, at + 2).xyz;
      vec3 p = cross(along, ac), s = from - texelFetch(shadow_depths, at).xyz, q = cross(s, ab);
      float inverse_determinant = 1.0 / dot(ab, p);  // of a triangle seen along its plane: infinite or none, and nothing below holds
      float u = dot(s, p) * inverse_determinant, v = dot(along, q) * inverse_determinant, met = dot(ac, q) * inverse_determinant;
      if (u >= -slack && v >= -slack && u + v <= 1.0 + slack && met > nearest && met < farthest) return true;
    }
  }
  return false;
}

bool ray_blocked(vec3 from, vec3 to, float carried_by) {
  vec3 way = to - from;
  float inverse_length = inversesqrt(dot(way, way)), most = 1.0 / inverse_length;
  vec3 along = way * inverse_length;
  // The surface that the point lies on, as occluder() has it (visual/scene/ray_hit.h); far away as much as float32 rounds.
  float nearest = max(1e-3, 2e-5 * most), farthest = most - 1e-3;
  vec4 head = texelFetch(shadow_depths, int(kRayHead));
  if (tree_blocks(int(head.y), int(head.z), from, along, nearest, farthest)) return true;
  for (int i = 0; i < int(head.x); ++i) {
    if (float(i + 1) == carried_by) continue;
    int mover = int(kRayMovers) + i * int(kRayMoverTexels);
    vec4 x = texelFetch(shadow_depths, mover), y = texelFetch(shadow_depths, mover + 1), z = texelFetch(shadow_depths, mover + 2);
    vec4 tree = texelFetch(shadow_depths, mover + 3), place = vec4(from, 1.0);
    if (tree_blocks(int(tree.x), int(tree.y), vec3(dot(x, place), dot(y, place), dot(z, place)),
                    vec3(dot(x.xyz, along), dot(y.xyz, along), dot(z.xyz, along)), nearest, farthest)) return true;
  }
  return false;
}

// `at`: the point where the trees have it; of more rays than one each goes to another place of the lamp's opening, all to equal shares of it.
float reaching_by_rays(vec3 at, uint lamp, uint map) {
  vec3 middle = frame.lamps[lamp].position.xyz + vec3(frame.shadows[lamp].u.w, frame.shadows[lamp].v.w, frame.shadows[lamp].w.w);
  vec4 left = texelFetch(shadow_depths, 2 * int(map)), up = texelFetch(shadow_depths, 2 * int(map) + 1);
  uint rays = shadow_taps - kTapsOfRays;
  if (rays == 1) return ray_blocked(at, middle, left.w) ? 0.0 : 1.0;
  uint through = 0;
  for (uint i = 0; i < rays; ++i) {
    vec2 place = opening_place(i, rays, up.w > 0.0);
    if (!ray_blocked(at, middle + left.xyz * place.x + up.xyz * place.y, left.w)) ++through;
  }
  return float(through) / float(rays);
}

#if PHARE_LAMPS == 8
// Eight more varyings are more than every device has.
#define PHARE_SHADOW_AT(I) shadow_place(I, point)
#else
#define PHARE_SHADOW_AT(I) in_shadow[I]
#endif

#define PHARE_REACHING(I) \
  ((shadow_maps >> (4 * I) & 15u) == 0u ? 1.0                                                                          \
   : shadow_taps > kTapsOfRays ? reaching_by_rays(PHARE_SHADOW_AT(I), I, (shadow_maps >> (4 * I) & 15u) - 1u) \
                               : reaching(PHARE_SHADOW_AT(I), (shadow_maps >> (4 * I) & 15u) - 1u))
#endif
