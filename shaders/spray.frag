#version 460
#extension GL_GOOGLE_include_directive : require
#include "spray.h"

layout(location = 0) in vec3 luminance;  // of spray through which nothing is seen, by all but the tail lamps
layout(location = 1) in vec2 aside;      // from the puff's middle, in the plane that faces the eye there, m
layout(location = 2) flat in vec4 puff;  // distance² and radius², m²; what it scatters over that; what the air leaves
layout(location = 3) in vec3 point;      // in that plane, from the eye, m
layout(location = 4) flat in vec4 behind;  // the way that tail lamps shine, times cd; g
layout(location = 5) flat in vec4 tail[2];  // where they are; w: red and blue of their light, whose luminance is 1
layout(location = 0) out vec4 result;

// By a lamp next to which light changes much within a puff: at every pixel, and as if it were kSprayNearest_m aside.
float by_tail_lamp(vec3 lamp) {
  vec3 way = point - lamp;
  float per_m = inversesqrt(dot(way, way) + kSprayNearest_m * kSprayNearest_m);
  float turn = -dot(way, point) * per_m * inversesqrt(dot(point, point));
  return max(dot(way, behind.xyz), 0.0) * per_m * per_m * per_m * spray_phase(behind.w, turn);
}

void main() {
  float w2 = dot(aside, aside), b2 = w2 * puff.x / (puff.x + w2);  // by which the line of sight passes the middle
  float red = tail[0].w, blue = tail[1].w, green = (1.0 - 0.2126 * red - 0.0722 * blue) / 0.7152;
  float by_tail = puff.w * (by_tail_lamp(tail[0].xyz) + by_tail_lamp(tail[1].xyz));
  vec3 light = luminance + vec3(red, max(green, 0.0), blue) * by_tail;
  result = vec4(light, 1.0 - exp(-puff.z * spray_column(b2 / puff.y)));
}
