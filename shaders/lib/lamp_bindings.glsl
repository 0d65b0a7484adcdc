#ifndef PHARE_LAMP_BINDINGS
#define PHARE_LAMP_BINDINGS
#include "lamps.h"
layout(constant_id = 0) const uint lamp_count = 0;

// Compiled for 2, 4 and 8 lamps (PHARE_LAMPS): varyings that nobody reads still cost each vertex. Loops over lamps are written out,
// so that every index is a constant and the lamps a frame has not leave no trace.
#if PHARE_LAMPS == 2
#define PHARE_EACH_LAMP(DO) DO(0) DO(1)
#elif PHARE_LAMPS == 4
#define PHARE_EACH_LAMP(DO) DO(0) DO(1) DO(2) DO(3)
#else
#define PHARE_EACH_LAMP(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#endif

layout(std140, set = 0, binding = 0) uniform Frame { GpuFrame frame; };
// Compiled for beams that the texture filter weighs (PHARE_FILTERED) or for tables: of what the other needs one descriptor stays. All of
// both would be 41 sampled images and texel buffers; lavapipe of Mesa 22.3 keeps room for 32 when it resolves samples, and writes beyond.
#ifdef PHARE_FILTERED
const uint kTables = 1u, kFilters = kMaxLamps;
#else
const uint kTables = kMaxLamps, kFilters = 1u;
#endif
// Tables are texel buffers, a cell of four nodes a texel: a software device reads that for eight pixels in one go, words of a storage
// buffer one by one, and an image takes a level of detail for each.
layout(set = 0, binding = 1) uniform samplerBuffer guides[kTables];
layout(set = 0, binding = 2) uniform samplerBuffer cells[kTables];
layout(std140, set = 0, binding = 3) uniform Materials { GpuMaterial materials[kMaxMaterials]; };
layout(std140, set = 0, binding = 5) uniform Sheetings { GpuSheeting sheetings[kMaxSheetings]; };
// Candela weighted by red and by blue, of lamps with light of several colours: two texels a cell.
layout(set = 0, binding = 6) uniform samplerBuffer tints[kTables];
// The same for levels that the texture filter weighs.
layout(set = 0, binding = 7) uniform sampler2D filtered[kFilters];
layout(set = 0, binding = 8) uniform sampler2D filtered_tints[kFilters];
#ifndef PHARE_COMPUTE
layout(push_constant) uniform Draw { GpuDraw draw; };
vec3 turned(vec3 v) {
  return vec3(dot(draw.turn[0].xyz, v), dot(draw.turn[1].xyz, v), dot(draw.turn[2].xyz, v));
}
// Relative to the eye. The sum is exact where both are on the grid of places (config/base/conventions.h), and the rest is the same for all that stands.
vec3 placed(vec3 position_m) {
  return turned(position_m) + draw.origin.xyz + vec3(draw.turn[0].w, draw.turn[1].w, draw.turn[2].w);
}
#endif

mat4 clip_from_eye() {
  return mat4(frame.clip_from_eye[0], frame.clip_from_eye[1], frame.clip_from_eye[2], frame.clip_from_eye[3]);
}
#endif
