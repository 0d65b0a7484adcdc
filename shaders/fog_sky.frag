#version 460
#extension GL_GOOGLE_include_directive : require
#include "fog.h"
#include "lib/fog.glsl"
#include "lib/tone.h"
#include "sky.h"

layout(constant_id = 3) const uint output_kind = 0;
layout(constant_id = kSpecFogSky) const uint sky_seen = 0;
layout(location = 0) in vec3 ray;
layout(location = 0) out vec4 result;

void main() {
  const float far_m = 1e5;
  vec3 direction = ray * inversesqrt(dot(ray, ray));
  float fog = fog_light(direction, far_m, gl_FragCoord.xy);
  float seen = sky_seen != 0u ? frame.fog.air.w : 0.0;
  vec3 light = PHARE_FOG_COLOUR.rgb * (PHARE_FOG_COLOUR.w * (1.0 - seen) + fog);
  if (sky_seen != 0u) {
    vec3 sky = sky_luminance(frame.sky, direction.z) * frame.fog.air.w;
    light += output_kind == kOutputHdr ? sky : sky * frame.exposure.rgb;
  }
  result = output_kind == kOutputHdr ? vec4(light, 0.0) : vec4(srgb_encoded(tone_curve(light)), 1.0);
}
