#version 460
#extension GL_GOOGLE_include_directive : require
#ifdef PHARE_REFERENCE
#include "lib/reference.glsl"
#define PHARE_POINT vec3(reference_point)
#define PHARE_NORMAL vec3(reference_normal)
#else
#include "lib/beam.glsl"
#define PHARE_POINT point
#define PHARE_NORMAL n
#endif
#ifdef PHARE_FOG
#include "lib/fog.glsl"
#else
#define PHARE_THROUGH_FOG(LIGHT) 1.0
#endif
#include "lib/surface_light.glsl"
#ifdef PHARE_SHADOWS
#include "lib/shadow.glsl"
#else
#define PHARE_SEEK_SHADOW(I)
#define PHARE_READ_SHADOW(I)
#define PHARE_REACHING(I) 1.0
#endif
#include "lib/tone.h"
#ifdef PHARE_TEXTURED
#include "lib/textured.glsl"
#endif
#ifdef PHARE_RELIEF
#include "lib/relief.glsl"
#else
#define PHARE_LIGHT_RELIEF(I)
#endif

layout(constant_id = 3) const uint output_kind = 0;
layout(constant_id = 4) const uint lamp_base = 0;
layout(constant_id = kSpecColours) const uint colours = 0;
layout(constant_id = kSpecSides) const uint sides = 1;
layout(constant_id = kSpecMethod) const uint method = 0;

layout(location = 0) out vec4 result;
layout(location = 1) out vec4 result_normal;

// Luminance of the film on wet ground over the lamp's illuminance.
float mirrored(uint lamp, LampLight light, vec3 n, float level) {
  float inverse_eye = inversesqrt(dot(point, point)), cos_seen = -level * inverse_eye;
  if (light.cos_incidence <= 0.0 || cos_seen <= 0.0) return 0.0;
  vec3 toward_lamp = (frame.lamps[lamp].position.xyz - point) * light.per_m, toward_eye = point * -inverse_eye;
  vec3 half_way = normalize(toward_lamp + toward_eye);
  return water_lobe(frame.ground.y, light.cos_incidence, cos_seen, dot(half_way, n), dot(half_way, toward_eye));
}

#ifdef PHARE_FIXED
// Luminance of the film under a street lamp, whose light on the ground itself is in fixed_light.
vec3 street_lamp_mirrored(uint i, vec3 n, float level) {
  vec3 to_lamp = frame.mirrored_at[i].xyz - point;
  float per_m = inversesqrt(dot(to_lamp, to_lamp)), inverse_eye = inversesqrt(dot(point, point));
  float cos_lamp = max(dot(to_lamp, n) * per_m, 0.0), cos_seen = max(-level * inverse_eye, 1e-4);
  vec3 toward_lamp = to_lamp * per_m, toward_eye = point * -inverse_eye, half_way = normalize(toward_lamp + toward_eye);
  float lobe = water_lobe(frame.ground.y, cos_lamp, cos_seen, dot(half_way, n), dot(half_way, toward_eye));
  return frame.mirrored_cd[i].rgb * (per_m * per_m * cos_lamp * lobe);
}
#endif

// Light of a lamp whose illuminance comes interpolated from the vertices.
LampLight from_vertices(uint lamp, float lx, float cd, vec3 n, float level) {
  vec3 to_lamp = frame.lamps[lamp].position.xyz - point;
  float r2 = dot(to_lamp, to_lamp), inverse_r = inversesqrt(r2);
  LampLight light;
  light.cd = cd;
  light.distance_m = r2 * inverse_r;
  light.per_m = inverse_r;
  light.illuminance_lx = lx;
  light.cos_incidence = max(dot(frame.lamps[lamp].position.xyz, n) - level, 0.0) * inverse_r;
  light.normal_lx = lx / max(light.cos_incidence, 0.01);
  return light;
}

// The paper's texture and frame buffer hold F = I/Imax in 8 bits.
float in_8_bits(float cd, float peak_cd) {
  return floor(cd * (255.0 / peak_cd) + 0.5) * (peak_cd / 255.0);
}

void main() {
#ifdef PHARE_TEXTURED
  see_texture();
#endif
  float unit = inversesqrt(dot(point_normal, point_normal));
  if (sides == 2) unit = gl_FrontFacing ? unit : -unit;
  vec3 n = point_normal * unit;
  float level = dot(n, point);
#ifdef PHARE_RELIEF
  see_relief(n, unit < 0.0);
#define PHARE_LIGHT_RELIEF(I) light_relief(I, light, colour, wet_ground == 0u);
#endif
#ifdef PHARE_REFERENCE
  if (output_kind == kOutputMeasure) place_measured();
  else place_pixel(unit < 0.0 ? -1.0lf : 1.0lf);
#endif

  PHARE_EACH_LAMP(PHARE_SEEK_LAMP)
  // What the surface sends back and water mirrors, over the lamp's light: by the method "fragment" known before tables are read.
#define SEND_BACK_OF(I, LIGHT)                                                                                  \
  if (wet_ground != 0u) mirrored_##I = mirrored(I, LIGHT, n, level);                                            \
  if (retro != 0) sent_back_##I = sent_back(I, LIGHT, point, n, level, reflectance.w, frame.lamps[I].row_a.w);
#define SEND_BACK(I)                                  \
  float sent_back_##I = 0.0, mirrored_##I = 0.0;      \
  if (lamp_count > I && method == kMethodFragment) {  \
    LampLight from = PHARE_AIMED(I);                  \
    SEND_BACK_OF(I, from)                             \
  }
  PHARE_EACH_LAMP(SEND_BACK)
  PHARE_EACH_LAMP(PHARE_SEEK_SHADOW)
  PHARE_EACH_LAMP(PHARE_READ_SHADOW)
  PHARE_EACH_LAMP(PHARE_READ_LAMP)
  if (output_kind == kOutputMeasure) {
    vec4 lx = vec4(0.0);
#define MEASURE(I) \
  if (I / 4 == lamp_base / 4) {                  \
    if (lamp_count > I) lx[I % 4] = PHARE_SOUGHT_LIGHT(I).illuminance_lx * PHARE_REACHING(I); \
  }
    PHARE_EACH_LAMP(MEASURE)
    result = lx;
    return;
  }

  float total_lx = 0.0, of_b_lx = 0.0;
  vec3 coloured_lx = vec3(0.0);
  vec3 film = vec3(0.0);  // cd/m² that water on the ground mirrors
  vec3 retro_lx = vec3(0.0);  // what a diffuse surface would need to be as bright
#define LIGHT(I)                                                                                           \
  if (lamp_count > I) {                                                                                    \
    LampLight light;                                                                                       \
    if (method != kMethodVertex) light = PHARE_SOUGHT_LIGHT(I);                                            \
    if (method == kMethodVertex) light = from_vertices(I, PHARE_FACING(I), 0.0, n, level);                 \
    if (method == kMethodVertex1998) {                                                                     \
      float cd = in_8_bits(light.cd, frame.lamps[I].position.w);                                           \
      light = from_vertices(I, PHARE_FACING(I) * cd, light.cd, n, level);                                  \
    }                                                                                                      \
    vec3 colour = light_colour;                                                                            \
    float reach = PHARE_REACHING(I) * PHARE_THROUGH_FOG(light);                                                                   \
    light.illuminance_lx *= reach;                                                                         \
    light.normal_lx *= reach;                                                                              \
    if (colours != 0) colour = frame.lamps[I].colour.rgb;                                                  \
    if ((colours >> (8 + I) & 1) != 0) colour = method == kMethodVertex ? vec3(1.0) : PHARE_LAMP_TINT(I, light); \
    total_lx += light.illuminance_lx;                                                                      \
    if (output_kind == kOutputDifference || output_kind == kOutputRatio)                                   \
      of_b_lx += light.illuminance_lx * frame.lamps[I].row_b.w;                                            \
    if (colours != 0) coloured_lx += light.illuminance_lx * colour;                                        \
    PHARE_LIGHT_RELIEF(I)                                                                                  \
    if (method != kMethodFragment) {                                                                       \
      SEND_BACK_OF(I, light)                                                                               \
    }                                                                                                      \
    if (wet_ground != 0u) film += colour * (light.illuminance_lx * mirrored_##I);                          \
    if (retro != 0) retro_lx += colour * (light.normal_lx * sent_back_##I);                                \
  }
  PHARE_EACH_LAMP(LIGHT)
  if (colours == 0) coloured_lx = total_lx * light_colour;
#ifdef PHARE_RELIEF
  coloured_lx = relief_lx;
#define PHARE_SKY_NORMAL relief_n
#else
#define PHARE_SKY_NORMAL n
#endif

  if (output_kind == kOutputAudit) {
    result = vec4(PHARE_POINT, total_lx);
    result_normal = vec4(PHARE_NORMAL, float(lamp_count));
    return;
  }
#ifdef PHARE_FIXED
  if (output_kind != kOutputDifference && output_kind != kOutputRatio) total_lx += fixed_light.w;
#ifdef PHARE_RELIEF
  coloured_lx += fixed_light.rgb * relief_of_fixed(n);
#else
  coloured_lx += fixed_light.rgb;
#endif
  if (wet_ground != 0u) {
#define STREET_LAMP(I) film += street_lamp_mirrored(I, n, level);
    STREET_LAMP(0) STREET_LAMP(1) STREET_LAMP(2) STREET_LAMP(3) STREET_LAMP(4) STREET_LAMP(5) STREET_LAMP(6) STREET_LAMP(7)
  }
#endif
  if (output_kind == kOutputFalseColour) {
    // Isolux lines, one pixel wide by the screen gradient of E. Where light ends between two pixels, at the edge of a shadow or of a surface, there
    // is no line: it would be drawn in those groups of pixels alone that the edge goes through, in dashes.
    vec3 colour = false_colour(total_lx);
    float width = max(fwidth(total_lx), 1e-6);
    float smooth_here = 1.0 - smoothstep(0.4, 0.8, width / max(total_lx, 1e-6));
    float line = 0.0;
    for (uint i = 0u; i < kMaxIsoluxLevels; ++i)
      line = max(line, 1.0 - smoothstep(0.6, 1.4, abs(total_lx - frame.isolux_lx[i / 4u][i % 4u]) / width));
    result = vec4(srgb_encoded(mix(colour, vec3(1.0), 0.7 * line * smooth_here)), 1.0);
    return;
  }

  if (output_kind == kOutputDifference || output_kind == kOutputRatio) {
    float of_a_lx = total_lx - of_b_lx;
    float share = output_kind == kOutputDifference ? difference_share(of_b_lx - of_a_lx) : ratio_share(max(of_b_lx, 1e-3) / max(of_a_lx, 1e-3));
    if (output_kind == kOutputRatio && max(of_a_lx, of_b_lx) < kVersusDark_lx) share = 0.0;
    result = vec4(versus_signal(share), 1.0);
    return;
  }

#ifdef PHARE_TEXTURED
  vec3 shown = output_kind == kOutputHdr ? vec3(1.0) : frame.exposure.rgb;
  vec3 rho = (wet_ground != 0u ? wet_reflectance(seen_rho) : seen_rho) * (shown / 3.14159265);
  if (snow_lies != kSnowNone) rho = mix(rho, kSnow * (shown / 3.14159265), snow_share(n.z, frame.ground.x));
  bool detailed = (look & kLookBase) == 0;  // a picture has details of its own
#else
  vec3 rho = reflectance.rgb;
  const bool detailed = true;
#endif
  if (detailed) {
    vec2 detail = surface_detail(point, detail_from_point);
    // Under snow the ground's grain is smoothed: a fifth of it is left, chosen.
    if (snow_lies != kSnowNone) detail = mix(detail, vec2(1.0), 0.8 * snow_share(n.z, frame.ground.x));
    rho *= detail.x;
    rho.r *= detail.y;
  }
  vec3 light = rho * (coloured_lx + ambient_lx * (1.0 + PHARE_SKY_NORMAL.z));  // the sky's half dome, unoccluded
  if (retro != 0) light += retro_lx * rho;
  if (wet_ground != 0u) light += output_kind == kOutputHdr ? film : film * frame.exposure.rgb;
#ifdef PHARE_RELIEF
  if ((look & kLookRough) != 0) light += output_kind == kOutputHdr ? relief_mirrored : relief_mirrored * frame.exposure.rgb;
#endif
#ifdef PHARE_TEXTURED
  if ((look & kLookEmits) != 0) light += seen_emitted_cdm2 * shown;
#endif
#ifdef PHARE_FOG
  light = through_fog(light, point, gl_FragCoord.xy);
#endif
  if (output_kind == kOutputClipping) {
    result = vec4(srgb_encoded(clipping_marked(tone_curve(light), gl_FragCoord.xy)), 1.0);
    return;
  }
#ifdef PHARE_FOG
  float between_steps = dither(gl_FragCoord.xy);  // what lies in fog changes slowly
#else
  const float between_steps = 0.0;
#endif
  result = output_kind == kOutputHdr ? min(vec4(light, total_lx), kHalfMost) : vec4(srgb_encoded(tone_curve(light)) + between_steps, 1.0);
}
