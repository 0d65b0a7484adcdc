#version 460
#extension GL_GOOGLE_include_directive : require
#include "textured.h"

layout(constant_id = kSpecLook) const uint look = 0;
layout(location = 0) in vec2 uv;
layout(location = 1) in float opacity;
layout(set = 3, binding = 0) uniform sampler2DArray look_texels;
layout(std140, set = 3, binding = 1) uniform Look { GpuLook look_of; };

// Holes of surfaces, in the picture's depth and in shadows.
void main() {
  float there = look_of.base.a;
  if ((look & kLookBase) != 0) there *= texture(look_texels, vec3(uv, float(kBaseLayer))).a;
  if ((look & kLookColours) != 0) there *= opacity;
  if (there < look_of.emitted.w) discard;
}
