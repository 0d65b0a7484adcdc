#ifndef PHARE_LAMP_BINDINGS
#define PHARE_LAMP_BINDINGS
#include "lamps.h"
layout(constant_id = 0) const uint lamp_count = 0;

layout(std140, set = 0, binding = 0) uniform Frame { GpuFrame frame; };
// Tables are images and not storage buffers: a software device gathers texels for eight pixels at once, buffer words one by one.
layout(set = 0, binding = 1) uniform sampler2D guides[kMaxLamps];
layout(set = 0, binding = 2) uniform sampler2D candela[kMaxLamps];
layout(std140, set = 0, binding = 3) uniform Materials { GpuMaterial materials[kMaxMaterials]; };
layout(std140, set = 0, binding = 5) uniform Sheetings { GpuSheeting sheetings[kMaxSheetings]; };
layout(set = 0, binding = 6) uniform sampler2D tints[kMaxLamps];  // candela weighted by red and by blue, of lamps with light of several colours
layout(push_constant) uniform Draw { GpuDraw draw; };

mat4 clip_from_eye() {
  return mat4(frame.clip_from_eye[0], frame.clip_from_eye[1], frame.clip_from_eye[2], frame.clip_from_eye[3]);
}
#endif
