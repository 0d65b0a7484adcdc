// Noise for the detail of surfaces, from a texel buffer: a software device reads one texel of four corners far faster than it filters
// an image, and finds the level of detail once for all layers of a surface (visual/passes/grain.h).
#ifndef PHARE_GRAIN
#define PHARE_GRAIN
layout(set = 0, binding = 4) uniform samplerBuffer grain;
layout(constant_id = 7) const uint grain_first_level = 0;

const int kGrainSize = 512, kGrainLevels = 10;
const uint kGrainFine = 0, kGrainSoft = 1;  // chippings; patches

// Room for a level of a layer and all after it, in texels: a quarter for each next, and half of it unused, so that it takes a shift to find one.
int grain_layer(int level) {
  return 2 * kGrainSize * kGrainSize >> 2 * level;
}

// What a pixel covers across its longer side, m².
float grain_footprint(vec3 p) {
  vec3 across = dFdx(p), down = dFdy(p);
  return max(dot(across, across), dot(down, down));
}

// Mean 0.5. `at` in tiles; `tiles_per_m` says how many of them lie in a metre. Whole powers of two are exponents: to shift them is a tenth of the
// work of logarithm, product and quotient.
float grain_at(uint layer, vec2 at, float tiles_per_m, float footprint_m2) {
  // The level whose texel is nearest to the pixel, by ratio: floor(log2(texels across the pixel) + 0.5).
  float texels = tiles_per_m * float(kGrainSize);
  int level = (floatBitsToInt(footprint_m2 * (2.0 * texels * texels)) >> 23) - 127 >> 1;
  level = min(max(level, int(grain_first_level)), kGrainLevels - 1);
  int log2_size = kGrainLevels - 1 - level;
  int begin = int(layer) * grain_layer(int(grain_first_level)) + grain_layer(int(grain_first_level)) - grain_layer(level);
  int last = (1 << log2_size) - 1;
  vec2 texel = at * intBitsToFloat(127 + log2_size << 23) - 0.5;
  vec2 whole = floor(texel), part = texel - whole;
  ivec2 cell = ivec2(whole) & last;
  vec4 corners = texelFetch(grain, begin + (cell.y << log2_size) + cell.x);
  vec2 rows = mix(corners.xz, corners.yw, part.x);
  return mix(rows.x, rows.y, part.y);
}
#endif
