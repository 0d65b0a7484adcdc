#version 460
#extension GL_GOOGLE_include_directive : require
#include "sky.h"

layout(push_constant) uniform Push { SkyConstants sky; };
layout(location = 0) in vec3 direction;
layout(location = 1) in vec3 vertex_colour;
#ifdef PHARE_FLAT
layout(location = 0) flat out vec3 colour;
#else
layout(location = 0) out vec3 colour;
#endif

// At infinity.
void main() {
  colour = vertex_colour;
  mat4 clip = mat4(sky.clip_from_eye[0], sky.clip_from_eye[1], sky.clip_from_eye[2], sky.clip_from_eye[3]);
  gl_Position = clip * vec4(direction, 0.0);
}
