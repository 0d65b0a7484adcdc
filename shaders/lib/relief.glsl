// Normals, roughness and metal of a surface at every pixel (visual/scene/relief.h, lib/gloss.h). Lux stays that of the surface itself: a texture
// says what its light looks like, not how much there is. Only in what is compiled with PHARE_RELIEF.
#ifndef PHARE_RELIEF_LIB
#define PHARE_RELIEF_LIB
#include "lib/gloss.h"
#include "lib/textured.glsl"

layout(location = PHARE_LOOK_LOCATION + 2) in vec4 look_tangent;
#ifdef PHARE_FIXED
layout(location = PHARE_LOOK_LOCATION, component = 2) in vec2 fixed_way_xy;  // as FixedWay (visual/fixed_light.h)
layout(location = 0, component = 3) in float fixed_way_z;
#endif
layout(set = PHARE_TEXTURE_SET, binding = 2) uniform sampler2D normal_texels;
layout(set = PHARE_TEXTURE_SET, binding = 3) uniform sampler2D rough_texels;

// The mean normal of what a pixel shows, no longer than 1, and its direction; slopes of the facets that it does show, as lit_of_facets takes them; alpha of the
// mirror, and metal.
vec3 relief_mean, relief_n;
float relief_slopes = 0.0, relief_alpha = 1.0, relief_metal = 0.0;
vec3 relief_lx = vec3(0.0);     // diffuse light of what is coloured by rho
vec3 relief_mirrored = vec3(0.0);  // cd/m²

// Where every pixel is there. `n`: the surface's own, on the side that is seen.
void see_relief(vec3 n, bool from_behind) {
  relief_mean = relief_n = n;
  float hidden = 0.0;
  if ((look & kLookNormal) != 0) {
    vec4 texel = texture(normal_texels, look_uv);
    float r = 1.0 - texel.w;
    vec3 at = vec3(texel.xy, sqrt(max(r * r - dot(texel.xy, texel.xy), 0.0)));
    vec3 front = from_behind ? -n : n;
    vec3 along = look_tangent.xyz - front * dot(front, look_tangent.xyz);
    along *= inversesqrt(max(dot(along, along), 1e-12));
    vec3 up = cross(front, along) * (look_tangent.w < 0.0 ? -1.0 : 1.0);
    relief_mean = at.x * along + at.y * up + at.z * front;
    if (from_behind) relief_mean = -relief_mean;  // glTF 2.0, 3.9.6
    relief_n = normalize(relief_mean);
    hidden = slopes_in(r);
    relief_slopes = texel.z;
  }
  if ((look & kLookRough) != 0) {
    vec2 rough_metal = texture(rough_texels, look_uv).gb * relief_of.factors.xy;
    relief_alpha = facets_alpha(rough_metal.x, hidden);
    relief_metal = rough_metal.y;
  }
}

// Adds a lamp's light, of which shadow and fog have taken their part.
void light_relief(uint lamp, LampLight light, vec3 colour, bool dry) {
  if (light.illuminance_lx <= 0.0) return;
  vec3 toward_lamp = (frame.lamps[lamp].position.xyz - point) * light.per_m;
  float lit = lit_of_facets(relief_slopes, light.cos_incidence);
  vec3 lx = colour * (light.normal_lx * max(dot(relief_mean, toward_lamp), 0.0) * lit);
  float below = 1.0;
  if ((look & kLookRough) != 0 && dry) {
    vec3 toward_eye = point * -inversesqrt(dot(point, point)), half_way = normalize(toward_lamp + toward_eye);
    float against = max(dot(half_way, toward_eye), 0.0), rise = schlick(against);
    float cos_lamp = max(dot(relief_n, toward_lamp), 0.0), cos_seen = max(dot(relief_n, toward_eye), 1e-3);
    float lobe = facets_lobe(relief_alpha, cos_lamp, cos_seen, max(dot(half_way, relief_n), 0.0));
    float layer = kClearLayer + (1.0 - kClearLayer) * rise;
    vec3 mirror = mix(vec3(layer), seen_rho + (1.0 - seen_rho) * rise, relief_metal);
    relief_mirrored += lx * mirror * lobe;
    below = (1.0 - layer) * (1.0 - relief_metal);
  }
  relief_lx += lx * below;
}

#ifdef PHARE_FIXED
// What facets make of light that does not change, which comes from one side on the whole: as of one lamp there. On a
// plane dot(n, way) is 1; on what is curved corners have ways of their own normals.
float relief_of_fixed(vec3 n) {
  vec3 way = vec3(fixed_way_xy, fixed_way_z);
  float facing = dot(n, way);
  if (facing <= 0.0) return 1.0;
  float lit = lit_of_facets(relief_slopes, facing * inversesqrt(dot(way, way)));
  return max(dot(relief_mean, way), 0.0) / facing * lit;
}
#endif
#endif
