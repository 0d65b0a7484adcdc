#version 460
#extension GL_GOOGLE_include_directive : require
#include "eyeshine.h"

// A square about a pupil, two triangles.

layout(push_constant) uniform Draw { GpuPupil pupil; };

void main() {
  const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
  vec2 aside = corners[gl_VertexIndex] * pupil.place.w * 2.0 / pupil.size.xy;
  gl_Position = vec4(pupil.clip.xy + aside * pupil.clip.w, pupil.clip.zw);
}
