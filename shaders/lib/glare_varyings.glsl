// What the vertex stage hands to glare.frag. What is the same for the whole picture goes as flat varyings: on a software device they cost
// a pixel nothing, while each uniform read costs as much as ten multiplications.
#include "glare.h"
#ifdef PHARE_VERTEX
#define PHARE_VARYING out
layout(set = 0, binding = 1) uniform Sources { GpuGlare glare; };
#else
#define PHARE_VARYING in
#endif

// A constant and not a number of the buffer: a software device compiles a shader anew for each value that a loop depends on.
layout(constant_id = kSpecGlareLamps) const uint lamps = kMostGlareLamps;

layout(location = 0) PHARE_VARYING vec3 way;    // from the eye, any length
layout(location = 1) flat PHARE_VARYING vec3 exposure;
layout(location = 2) flat PHARE_VARYING vec3 terms;
layout(location = 3) flat PHARE_VARYING vec3 toward[kMostGlareLamps];
layout(location = 3 + kMostGlareLamps) flat PHARE_VARYING vec3 eye_lx[kMostGlareLamps];
