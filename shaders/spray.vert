#version 460
#extension GL_GOOGLE_include_directive : require
#define PHARE_COMPUTE
#include "spray.h"
#include "lib/beam.glsl"
#include "lib/fog.glsl"

// A puff an instance: a square that faces the eye in its middle, in strips one above the other. Light is that in the
// middle of each edge.

layout(push_constant) uniform Draw { GpuSpray draw; };
layout(location = 0) out vec3 luminance;
layout(location = 1) out vec2 aside;
layout(location = 2) flat out vec4 puff;
layout(location = 3) out vec3 point;
layout(location = 4) flat out vec4 behind;
layout(location = 5) flat out vec4 tail[2];

void main() {
  luminance = vec3(0.0);
  aside = vec2(0.0);
  puff = vec4(1.0, 1.0, 0.0, 0.0);
  point = vec3(1.0, 0.0, 0.0);
  behind = vec4(normalize(draw.trail[1].xyz - draw.trail[0].xyz) * draw.light.z, draw.light.x);
  tail[0] = draw.tail[0];
  tail[1] = draw.tail[1];
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // seen by nobody
  uint i = draw.trail[2].w != 0.0 ? uint(gl_InstanceIndex) : kSprayPuffs - 1u - uint(gl_InstanceIndex);
  SprayPuff one = spray_puff(draw, i);
  float d2 = dot(one.middle, one.middle), radius2 = one.radius_m * one.radius_m;
  if (one.scatters_m2 <= 0.0 || d2 <= radius2) return;

  // Where.
  float d = sqrt(d2), half_m = one.radius_m * d / sqrt(d2 - radius2);  // of a ball as it is seen
  vec3 toward = one.middle / d, right = normalize(vec3(toward.y, -toward.x, 0.0)), up = cross(right, toward);
  uint vertex = uint(gl_VertexIndex);
  aside = half_m * vec2((vertex & 1u) == 0u ? -1.0 : 1.0, 2.0 * float(vertex >> 1u) / float(kSprayRows) - 1.0);
  puff = vec4(d2, radius2, one.scatters_m2 / radius2, fog_left(d));
  point = one.middle + aside.x * right + aside.y * up;
  gl_Position = clip_from_eye() * vec4(point, 1.0);

  // Its light, over what it would send if each drop of it sent all that it scatters to the eye.
  vec3 at = one.middle + aside.y * up;
  float r = length(at), g = draw.light.x;
  vec3 lx = vec3(0.0);
#define LIGHT_SPRAY(I)                                                                                                \
  if (lamp_count > I) {                                                                                               \
    vec3 way = at - frame.lamps[I].position.xyz;                                                                      \
    vec3 in_table = vec3(dot(frame.lamps[I].row_a.xyz, way), dot(frame.lamps[I].row_b.xyz, way),                      \
                         dot(frame.lamps[I].row_c.xyz, way));                                                         \
    LampLight lamp = PHARE_LIGHT_AT(I, in_table, 0.0);                                                                \
    float phase = spray_phase(g, -dot(way, at) * lamp.per_m / r);                                                     \
    float facing_lx = lamp.cd * min(lamp.per_m * lamp.per_m, 1e4) * fog_left(lamp.distance_m);                        \
    lx += frame.lamps[I].colour.rgb * (facing_lx * phase);                                                            \
  }
  PHARE_EACH_LAMP(LIGHT_SPRAY)
  luminance = lx * fog_left(r);
}
