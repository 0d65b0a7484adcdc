// A lamp's shadow map at a point, wherever the point is: where it falls on the map (lamps.h, GpuShadow), and whether something stands before it.
#ifndef PHARE_SHADOW_MAP
#define PHARE_SHADOW_MAP

#ifndef PHARE_SHADOW_SET
#define PHARE_SHADOW_SET 1
#endif
layout(set = PHARE_SHADOW_SET, binding = 0) uniform samplerBuffer shadow_depths;  // all maps, one after the other, rows from the top; by rays trees (lamps.h)
layout(constant_id = kSpecShadowWidth) const uint shadow_width = 1;
layout(constant_id = kSpecShadowHeight) const uint shadow_height = 1;
layout(constant_id = kSpecShadowTaps) const uint shadow_taps = 1;

// What is nearer than the point by less than this, relatively, does not shadow it (25 mm at 50 m): float32 rounds depths of the map and of
// the point apart.
const float kShadowBias = 1.0005;

// Where a point lies in a map, and what stands there. Found and read for all lamps before any light is summed, as tables are (beam.glsl).
struct ShadowPlace {
  int index;     // of the texel, or of the first of four
  vec2 part;     // between the four
  float nearer;  // what is nearer than this shadows it, as the map has depths
  bool away;
  vec4 depths;
};

// `at`: as GpuShadow has it, not divided yet; `zoom`: of its second picture; `taps`: texels that are read. The outermost texels hold nothing, so
// beyond the map all is lit.
ShadowPlace shadow_seek(vec3 at, uint map, float zoom, uint taps) {
  ShadowPlace place;
  place.away = false;
  float inverse_w = 1.0 / max(at.z, 1e-3);
  place.nearer = kShadowNear_m * inverse_w * kShadowBias;
  vec2 middle = 0.5 * vec2(float(shadow_width), float(shadow_height));
  vec2 from_middle = at.xy * inverse_w, large = from_middle * zoom;
  bool close = all(lessThan(abs(large), middle - 1.0));
  // Half a texel up: below the line where a slope meets the valley behind it a lamp looks into the ground, where there is no far side.
  vec2 texel = middle + (close ? large : from_middle) - vec2(0.0, 0.5);
  int row = int(shadow_width), first = int((2 * map + (close ? 1 : 0)) * shadow_width * shadow_height);
  place.part = vec2(0.0);
  if (taps == 1) {
    texel = min(max(texel, vec2(0.0)), 2.0 * middle - 1.0);
  } else {
    texel = min(max(texel - 0.5, vec2(0.0)), 2.0 * middle - 2.0);
    place.part = texel - floor(texel);
  }
  ivec2 corner = ivec2(texel);
  place.index = first + corner.y * row + corner.x;
  return place;
}

void shadow_read(inout ShadowPlace place) {
  int row = int(shadow_width);
  place.depths = vec4(texelFetch(shadow_depths, place.index).r);
  if (shadow_taps == 1) return;
  place.depths.y = texelFetch(shadow_depths, place.index + 1).r;
  place.depths.z = texelFetch(shadow_depths, place.index + row).r;
  place.depths.w = texelFetch(shadow_depths, place.index + row + 1).r;
}

// The four texels around the point, each lit or not, weighted by how near it is.
float shadow_reaching(ShadowPlace place) {
  if (place.away) return 0.0;
  if (shadow_taps == 1) return place.depths.x > place.nearer ? 0.0 : 1.0;
  vec4 lit = vec4(lessThanEqual(place.depths, vec4(place.nearer)));
  vec2 rows = mix(lit.xz, lit.yw, place.part.x);
  return mix(rows.x, rows.y, place.part.y);
}
#endif
