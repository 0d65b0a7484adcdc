#version 460
#extension GL_GOOGLE_include_directive : require
#include "windscreen.h"

// Two triangles about a place on the glass that has a drop now. Drops are of many sizes and no circles: water that has run together. The large
// ones run over the glass, drawn out, their head before and a tail behind.

layout(set = 0, binding = 0) uniform sampler2D drop_light;
layout(push_constant) uniform Draw { GpuScreen draw; };
layout(location = 0) flat out vec4 light;
layout(location = 1) out vec2 from_middle;
layout(location = 2) flat out vec4 lobes;
layout(location = 3) flat out float taper;

void main() {
  const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
  uint number = uint(gl_VertexIndex) / 6u;
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // seen by nobody
  from_middle = vec2(0.0);
  light = lobes = vec4(0.0);
  taper = 0.0;
  vec2 place = screen_place(number);
  vec2 since = since_wiped(0.5 + 0.5 * place.x / kGlassAside_m, draw.wiper.x, draw.wiper.y, draw.wiper.z);
  uint turn = screen_hash(number + kScreenPlaces * uint(int(since.y) + 2));
  if (screen_random(turn) >= share_with_drops(since.x, draw.water.x)) return;
  float area = drop_area(screen_random(turn + 1u)), opacity = draw.water.y;
  bool runs = area > kRunsFrom_area && draw.wind.x != 0.0;
  if (runs) {
    // It appears where it lay, runs, and thins out.
    float way_01 = fract(draw.wind.z / kRunsFor_s + screen_random(turn + 2u));
    place.y += draw.wind.x * kRuns_mps * kRunsFor_s * (way_01 - 0.5);
    place.x += 0.003 * sin(25.0 * way_01 + float(number));
    opacity *= min(10.0 * min(way_01, 1.0 - way_01), 1.0) / 0.9;
  }
  vec4 clip = draw.clip_from_glass[0] * place.x + draw.clip_from_glass[1] * place.y + draw.clip_from_glass[2] * kGlass_m + draw.clip_from_glass[3];
  if (clip.w <= 0.0) return;
  // Along: up the glass, and outward with the air.
  vec2 axis = normalize(vec2(0.6 * place.x * draw.wind.y + 0.3 * (screen_random(turn + 8u) - 0.5), 1.0));
  float drawn_out = exp(runs ? 0.8 : 0.05 + draw.wind.y * screen_random(turn + 3u) + 0.15 * (area - 1.0));
  taper = (runs ? 0.6 : 0.25) * (draw.wind.x < 0.0 ? -1.0 : 1.0);
  vec4 turned = vec4(screen_random(turn + 4u), screen_random(turn + 5u), screen_random(turn + 6u), screen_random(turn + 7u)) * 2.0 - 1.0;
  lobes = turned * (kMostOfLobes / sqrt(8.0) * (runs ? 0.5 : 1.0));
  from_middle = corners[gl_VertexIndex % 6] * (1.0 + kMostOfLobes) * vec2(1.0 + 0.35 * abs(taper), 1.0);
  light = vec4(texelFetch(drop_light, ivec2(number % kScreenColumns, number / kScreenColumns), 0).rgb, min(opacity, 1.0));
  vec2 along = normalize((draw.clip_from_glass[0].xy * axis.x + draw.clip_from_glass[1].xy * axis.y) * draw.area.zw);
  float radius_px = draw.water.z * sqrt(area);
  vec2 from_px = (vec2(-along.y, along.x) * (from_middle.x / drawn_out) + along * (from_middle.y * drawn_out)) * radius_px;
  gl_Position = vec4(clip.xy / clip.w + from_px * 2.0 / draw.area.zw, 0.5, 1.0);
}
