// Noise for the detail of surfaces, from a texel buffer: a software device reads one texel of four corners far faster than it filters
// an image, and finds the level of detail once for all layers of a surface (visual/passes/grain.h).
#ifndef PHARE_GRAIN
#define PHARE_GRAIN
layout(set = 0, binding = 4) uniform samplerBuffer grain;
layout(constant_id = 7) const uint grain_first_level = 0;

const int kGrainSize = 512, kGrainLevels = 10;
const uint kGrainFine = 0, kGrainSoft = 1;  // chippings; patches

// What a pixel covers across its longer side, m²; of ground as the map has it, for so its grain lies.
float grain_footprint(vec2 p) {
  vec2 across = dFdx(p), down = dFdy(p);
  return intBitsToFloat(max(floatBitsToInt(dot(across, across)), floatBitsToInt(dot(down, down))));
}
float grain_footprint(vec3 p) {
  vec3 across = dFdx(p), down = dFdy(p);
  return intBitsToFloat(max(floatBitsToInt(dot(across, across)), floatBitsToInt(dot(down, down))));
}

// Mean 0.5. `at` in tiles; `tiles_per_m` says how many of them lie in a metre. Whole powers of two are exponents: to shift them is a
// tenth of the work of logarithm, product and quotient.
float grain_at(uint layer, vec2 at, float tiles_per_m, float footprint_m2) {
  // The level whose texel is nearest to the pixel, by ratio: of 2^log2_size texels, kGrainLevels - 1 less floor(log2(texels across the pixel) + 0.5).
  const float texels = tiles_per_m * float(kGrainSize);
  int log2_size = kGrainLevels + 63 - (floatBitsToInt(footprint_m2 * (4.0 * texels * texels)) >> 24);
  const int finest = kGrainLevels - 1 - int(grain_first_level);
  log2_size = min(max(log2_size, 0), finest);
  float size = intBitsToFloat((log2_size << 23) + 0x3f800000);
  vec2 texel = at * size - 0.5;
  vec2 whole = floor(texel), part = texel - whole;
  // A level of n by n texels begins at n²: its first row is row n of all.
  int texels_across = int(size);
  ivec2 cell = ivec2(whole) & (texels_across - 1);
  vec4 corners = texelFetch(grain, ((texels_across | cell.y) << log2_size) + cell.x + int(layer) * (2 << 2 * finest));
  vec2 rows = mix(corners.xz, corners.yw, part.x);
  return mix(rows.x, rows.y, part.y);
}
#endif
