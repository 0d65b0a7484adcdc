// Noise for the detail of surfaces, from a texel buffer: a software device reads one texel of four corners far faster than it filters
// an image, and finds the level of detail once for all layers of a surface (visual/passes/grain.h).
#ifndef PHARE_GRAIN
#define PHARE_GRAIN
layout(set = 0, binding = 4) uniform samplerBuffer grain;
layout(constant_id = 7) const uint grain_first_level = 0;

const int kGrainSize = 512;
const uint kGrainFine = 0, kGrainSoft = 1;  // chippings; patches

// log2 of the metres that a pixel covers across its longer side.
float grain_footprint(vec3 p) {
  vec3 across = dFdx(p), down = dFdy(p);
  return 0.5 * log2(max(max(dot(across, across), dot(down, down)), 1e-12));
}

// Mean 0.5. `at` in tiles; `tiles_per_m` says how many of them lie in a metre.
float grain_at(uint layer, vec2 at, float tiles_per_m, float footprint) {
  int level = int(clamp(footprint + log2(tiles_per_m * float(kGrainSize)) + 0.5, float(grain_first_level), 9.0));
  int size = kGrainSize >> level, first = kGrainSize >> grain_first_level;
  // Levels before this one have (4/3)(first² - size²) texels in each layer.
  int begin = (first * first - size * size) / 3 * 8 + int(layer) * size * size;
  vec2 texel = at * float(size) - 0.5;
  vec2 whole = floor(texel), part = texel - whole;
  ivec2 cell = ivec2(whole) & (size - 1);
  vec4 corners = texelFetch(grain, begin + cell.y * size + cell.x);
  vec2 rows = mix(corners.xz, corners.yw, part.x);
  return mix(rows.x, rows.y, part.y);
}
#endif
