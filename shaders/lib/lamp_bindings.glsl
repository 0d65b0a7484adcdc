#ifndef PHARE_LAMP_BINDINGS
#define PHARE_LAMP_BINDINGS
#include "lamps.h"
layout(std140, set = 0, binding = 0) uniform Frame { GpuFrame frame; };
layout(std430, set = 0, binding = 1) readonly buffer Guides { vec4 guides[]; };
layout(std430, set = 0, binding = 2) readonly buffer Candela { float candela[]; };
layout(std430, set = 0, binding = 3) readonly buffer Materials { GpuMaterial materials[]; };
layout(set = 0, binding = 4) uniform sampler2D grain;
layout(push_constant) uniform Draw { GpuDraw draw; };

mat4 clip_from_eye() {
  return mat4(frame.clip_from_eye[0], frame.clip_from_eye[1], frame.clip_from_eye[2], frame.clip_from_eye[3]);
}
#endif
