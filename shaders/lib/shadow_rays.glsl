// Shadows by rays: whether a triangle of the scene stands between a point and a lamp, or how much of the lamp's opening is hidden. Computes as
// occluder() (visual/scene/ray_hit.h) does, in float32; where things stand in the buffer: lamps.h. Included by shadow.glsl, whose buffer it reads.
#ifndef PHARE_SHADERS_LIB_SHADOW_RAYS_GLSL
#define PHARE_SHADERS_LIB_SHADOW_RAYS_GLSL
#include "lib/opening.h"

// A software device takes its time for a branch that nothing goes into.
#define kHolesInRays (shadow_taps > kTapsOfRays + kTapsWithHoles)

int wrapped(int i, int size, uint how) {
  if (how == 2u) return clamp(i, 0, size - 1);
  int period = how == 1u ? 2 * size : size;
  int at = i - period * int(floor(float(i) / float(period)));
  at = at < 0 ? at + period : at >= period ? at - period : at;
  return at < size ? at : period - 1 - at;
}

// Of a texture whose opacities begin at texel `holes`, 0 to 255.
float opacity_at(int holes, ivec2 size, uint how, ivec2 at) {
  int i = wrapped(at.y, size.y, how >> 2 & 3u) * size.x + wrapped(at.x, size.x, how & 3u);
  uint three = uint(texelFetch(shadow_depths, holes + 1 + i / 12)[i / 3 % 4]);
  return float(three >> (8 * (i % 3)) & 255u);
}

// Whether a triangle has a hole where shares `u` and `v` of its sides meet; `told`: where its holes are told. As through_hole() of
// visual/scene/ray_hit.cpp.
bool through_hole(int told, float u, float v) {
  vec4 first = texelFetch(shadow_depths, told), last = texelFetch(shadow_depths, told + 1);
  int holes = int(last.z);
  vec4 of = texelFetch(shadow_depths, holes);
  ivec2 size = ivec2(of.xy);
  uint how = uint(of.w);
  vec2 at = (first.xy + u * first.zw + v * last.xy) * of.xy - 0.5;
  if (how >= 16u) return opacity_at(holes, size, how, ivec2(floor(at + 0.5))) < of.z;
  ivec2 low = ivec2(floor(at));
  vec2 part = at - floor(at);
  float above = mix(opacity_at(holes, size, how, low), opacity_at(holes, size, how, low + ivec2(1, 0)), part.x);
  float below = mix(opacity_at(holes, size, how, low + ivec2(0, 1)), opacity_at(holes, size, how, low + ivec2(1, 1)), part.x);
  return mix(above, below, part.y) < of.z;
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
      vec4 corner = texelFetch(shadow_depths, at);
      vec3 p = cross(along, ac), s = from - corner.xyz, q = cross(s, ab);
      float inverse_determinant = 1.0 / dot(ab, p);  // of a triangle seen along its plane: infinite or none, and nothing below holds
      float u = dot(s, p) * inverse_determinant, v = dot(along, q) * inverse_determinant, met = dot(ac, q) * inverse_determinant;
      if (u >= -slack && v >= -slack && u + v <= 1.0 + slack && met > nearest && met < farthest &&
          (!kHolesInRays || corner.w == 0.0 || !through_hole(int(corner.w), u, v)))
        return true;
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

vec2 opening_places[kLensRays];

// Most of what a quantity that is linear in the ray is away from that of the middle: places are within 1 each way.
float spread(vec3 of) {
  return abs(of.y) + abs(of.z);
}

// The same of all rays to the lamp's opening at once: which of `hidden`, a bit a ray, a triangle stands before besides. A ray goes from `from` by
// `middle` and its place's parts of `left` and `up`: on each axis by between `slowest` and `fastest`. Determinants are linear in the ray, so a
// triangle is worked out once.
uint tree_hides(int at, int end, vec3 from, vec3 middle, vec3 left, vec3 up, float nearest, float farthest, uint hidden) {
  const float slack = 1e-6;
  const uint all = (1u << kLensRays) - 1u;
  vec3 wide = abs(left) + abs(up);
  vec3 fastest = middle + wide, slowest = middle - wide;
  vec3 by_fastest = 1.0 / mix(fastest, vec3(1e-12), lessThan(abs(fastest), vec3(1e-12)));
  vec3 by_slowest = 1.0 / mix(slowest, vec3(1e-12), lessThan(abs(slowest), vec3(1e-12)));
  bvec3 up_low = greaterThan(by_fastest, vec3(0.0)), down_high = lessThan(by_slowest, vec3(0.0));
  const vec3 never = vec3(3e38);
  while (at < end && hidden != all) {
    vec4 low = texelFetch(shadow_depths, at), high = texelFetch(shadow_depths, at + 1);
    vec3 a = (low.xyz - from) * by_fastest, b = (high.xyz - from) * by_slowest;
    vec3 first = max(mix(-never, a, up_low), mix(-never, b, down_high)), last = min(mix(a, never, up_low), mix(b, never, down_high));
    if (max(max(first.x, first.y), max(first.z, nearest)) > min(min(last.x, last.y), min(last.z, farthest))) {
      at = int(low.w);
      continue;
    }
    at += 2;
    for (int leaf = int(high.w); leaf > 0; --leaf, at += 3) {
      vec4 corner = texelFetch(shadow_depths, at);
      vec3 ab = texelFetch(shadow_depths, at + 1).xyz, ac = texelFetch(shadow_depths, at + 2).xyz, s = from - corner.xyz;
      vec3 of_determinant = cross(ac, ab), of_u = cross(ac, s), of_v = cross(s, ab);
      float meets = dot(ac, of_v);
      vec3 determinants = vec3(dot(of_determinant, middle), dot(of_determinant, left), dot(of_determinant, up));
      vec3 us = vec3(dot(of_u, middle), dot(of_u, left), dot(of_u, up)), vs = vec3(dot(of_v, middle), dot(of_v, left), dot(of_v, up));
      // Where no ray goes along its plane, most triangles are left out for all rays at once.
      float way = sign(determinants.x), least = abs(determinants.x) - spread(determinants), most = abs(determinants.x) + spread(determinants);
      vec3 rest = determinants - us - vs;
      if (least > 0.0 && (way * us.x + spread(us) < -slack * most || way * vs.x + spread(vs) < -slack * most ||
                          way * rest.x + spread(rest) < -slack * most || way * meets <= nearest * least || way * meets >= farthest * most))
        continue;
      for (uint i = 0; i < kLensRays; ++i) {
        vec3 ray = vec3(1.0, opening_places[i]);
        float inverse_determinant = 1.0 / dot(determinants, ray);
        float u = dot(us, ray) * inverse_determinant, v = dot(vs, ray) * inverse_determinant, met = meets * inverse_determinant;
        if (u >= -slack && v >= -slack && u + v <= 1.0 + slack && met > nearest && met < farthest && (hidden >> i & 1u) == 0u &&
            (!kHolesInRays || corner.w == 0.0 || !through_hole(int(corner.w), u, v)))
          hidden |= 1u << i;
      }
    }
  }
  return hidden;
}

// Share of the opening that is seen, of places that stand for equal shares of it.
float opening_seen(vec3 from, vec3 to, vec4 left, vec4 up) {
  for (uint i = 0; i < kLensRays; ++i) opening_places[i] = opening_place(i, kLensRays, up.w > 0.0);
  vec3 middle = to - from;
  float inverse_length = inversesqrt(dot(middle, middle));
  float nearest = max(1e-3 * inverse_length, 2e-5), farthest = 1.0 - 1e-3 * inverse_length;
  vec4 head = texelFetch(shadow_depths, int(kRayHead));
  uint hidden = tree_hides(int(head.y), int(head.z), from, middle, left.xyz, up.xyz, nearest, farthest, 0u);
  for (int i = 0; i < int(head.x); ++i) {
    if (float(i + 1) == left.w) continue;
    int mover = int(kRayMovers) + i * int(kRayMoverTexels);
    vec4 x = texelFetch(shadow_depths, mover), y = texelFetch(shadow_depths, mover + 1), z = texelFetch(shadow_depths, mover + 2);
    vec4 tree = texelFetch(shadow_depths, mover + 3);
    mat3 turn = transpose(mat3(x.xyz, y.xyz, z.xyz));
    hidden = tree_hides(int(tree.x), int(tree.y), turn * from + vec3(x.w, y.w, z.w), turn * middle, turn * left.xyz, turn * up.xyz, nearest,
                        farthest, hidden);
  }
  return 1.0 - float(bitCount(hidden)) / float(kLensRays);
}

// `at`: the point where the trees have it; by kLensRays rays the lamp is as large as it is, by one it is a point.
float reaching_by_rays(vec3 at, uint lamp, uint map) {
  vec3 middle = frame.lamps[lamp].position.xyz + vec3(frame.shadows[lamp].u.w, frame.shadows[lamp].v.w, frame.shadows[lamp].w.w);
  vec4 left = texelFetch(shadow_depths, 2 * int(map)), up = texelFetch(shadow_depths, 2 * int(map) + 1);
  if ((shadow_taps - kTapsOfRays) % kTapsWithHoles == 1) return ray_blocked(at, middle, left.w) ? 0.0 : 1.0;
  return opening_seen(at, middle, left, up);
}
#endif
