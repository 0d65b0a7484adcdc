#version 460
#extension GL_GOOGLE_include_directive : require
#include "windscreen.h"

// Two triangles about a place on the glass that has a drop now.

layout(set = 0, binding = 0) uniform sampler2D drop_light;
layout(push_constant) uniform Draw { GpuScreen draw; };
layout(location = 0) flat out vec4 light;
layout(location = 1) out vec2 from_middle;

void main() {
  const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
  uint number = uint(gl_VertexIndex) / 6u;
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // seen by nobody
  from_middle = vec2(0.0);
  light = vec4(0.0);
  vec2 place = screen_place(number);
  vec2 since = since_wiped(0.5 + 0.5 * place.x / kGlassAside_m, draw.wiper.x, draw.wiper.y, draw.wiper.z);
  uint turn = screen_hash(number + kScreenPlaces * uint(int(since.y) + 2));
  if (screen_random(turn) >= share_with_drops(since.x, draw.water.x)) return;
  vec4 clip = draw.clip_from_glass[0] * place.x + draw.clip_from_glass[1] * place.y + draw.clip_from_glass[2] * kGlass_m + draw.clip_from_glass[3];
  if (clip.w <= 0.0) return;
  from_middle = corners[gl_VertexIndex % 6];
  light = vec4(texelFetch(drop_light, ivec2(number % kScreenColumns, number / kScreenColumns), 0).rgb, draw.water.y);
  gl_Position = vec4(clip.xy / clip.w + from_middle * draw.water.z * 2.0 / draw.area.zw, 0.5, 1.0);
}
