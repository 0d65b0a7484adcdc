#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/tone.h"
#include "windscreen.h"

// A texel a place on the glass: the light of a drop there, the mean of the picture about it, and of lamps that shine into the eye.

const float kMostSampled_cdm2 = 300.0;

layout(set = 0, binding = 0) uniform sampler2D picture;
layout(push_constant) uniform Draw { GpuScreenLight draw; };
layout(location = 0) out vec4 result;

void main() {
  uint number = uint(gl_FragCoord.y) * kScreenColumns + uint(gl_FragCoord.x);
  vec2 place = screen_place(number);
  vec4 clip = draw.clip_from_glass[0] * place.x + draw.clip_from_glass[1] * place.y + draw.clip_from_glass[2] * kGlass_m + draw.clip_from_glass[3];
  vec2 middle = draw.area.xy + draw.area.zw * (0.5 + 0.5 * clip.xy / clip.w);
  vec3 sum = vec3(0.0);
  float turn = 6.2831853 * screen_random(3u * number + 3u);
  for (uint i = 0u; i < kScreenTaps; ++i) {
    // Evenly over the disc: sunflower.
    float share = sqrt((float(i) + 0.5) / float(kScreenTaps)), way = share * draw.reach.x, angle = turn + 2.3999632 * float(i);
    vec2 at = clamp(middle + way * vec2(cos(angle), sin(angle)), draw.area.xy, draw.area.xy + draw.area.zw - 1.0);
    // What is brighter is small, and met by few samples of few drops.
    vec3 seen = held_by_half(texelFetch(picture, ivec2(at), 0).rgb);
    seen *= min(1.0, kMostSampled_cdm2 / max(luminance_of(seen), 1e-6));
    sum += drop_bends(share) * seen;
  }
  vec3 light = sum / float(kScreenTaps);
  for (int i = 0; i < 2; ++i) {
    vec2 red_blue = unpackHalf2x16(floatBitsToUint(draw.lamps[i].w));
    light += colour_of_red_blue(red_blue) * (drop_bends(distance(draw.lamps[i].xy, middle) / draw.reach.x) * draw.lamps[i].z / draw.reach.y);
  }
  result = vec4(light, 1.0);
}
