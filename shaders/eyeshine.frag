#version 460
#extension GL_GOOGLE_include_directive : require
#include "eyeshine.h"
#include "lamps.h"
#include "lib/tone.h"

layout(constant_id = kSpecEyeshineOutput) const uint output_kind = 0;
layout(push_constant) uniform Draw { GpuPupil pupil; };
layout(location = 0) out vec4 result;

void main() {
  vec3 light = pupil.light.rgb * eyeshine_share(gl_FragCoord.xy - pupil.place.xy, pupil.place.z);
  result = output_kind == kOutputHdr ? vec4(min(light, kHalfMost), 0.0) : vec4(srgb_encoded(tone_curve(light)), 1.0);
}
