#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_FOG_FLAT
#include "fog.h"
#include "lib/fog.glsl"
#include "lib/tone.h"
#include "sky.h"

layout(constant_id = kSpecOutput) const uint output_kind = 0;
layout(constant_id = kSpecFogSky) const uint sky_seen = 0;
layout(location = 0) in vec3 ray;
layout(location = 0) out vec4 result;

void main() {
  float seen = sky_seen != 0u ? fog_air.w : 0.0;
  vec3 light = fog_colour.rgb * (fog_colour.w * (1.0 - seen) + fog_light_to_end(gl_FragCoord.xy));
  if (sky_seen != 0u) {
    vec3 sky = sky_luminance(frame.sky, ray.z * inversesqrt(dot(ray, ray))) * fog_air.w;
    light += output_kind == kOutputHdr ? sky : sky * frame.exposure.rgb;
  }
  result = output_kind == kOutputHdr ? vec4(min(light, kHalfMost), 0.0) : vec4(srgb_encoded(tone_curve(light)) + dither(gl_FragCoord.xy), 1.0);
}
