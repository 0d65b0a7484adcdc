// Contract of the drops and flakes that are drawn one by one (precipitation.vert): what its draw is told.
#ifndef PHARE_SHADERS_PRECIPITATION_H
#define PHARE_SHADERS_PRECIPITATION_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

// Specialization constants, beside those of the tables it shares with lamps.frag.
const uint kSpecDropsSnow = 2u;    // 1: flakes, which all fall alike
const uint kSpecDropsStrict = 4u;  // 1: a line is as wide across its own direction; 0: across the nearer axis

// Speeds are whole cubes in this time, so that a drive of any length counts time from its last multiple. A power of two.
const float kDropsPeriod_s = 64.0f;
// Nearer to the eye is the inside of the car.
const float kDropsFrom_m = 1.0f;

// Classes by size (visual/photometry/table/precipitation.h), the smallest drops first. Push constants.
struct GpuDrops {
  vec4 place[3];  // xyz: of the middle of the class's cube in the world, in cubes, 0 to 1; w: its edge, m
  vec4 drops[3];  // x: least diameter, mm; y: exp(-slope·(most - least)); z: number of the first drop after it; w: drawn so far from the eye, m
  vec4 motion;    // xyz: of the eye in the time of a streak, m; w: time since the last period, s
  vec4 light;     // x: slope, 1/mm; y: area that a particle of 1 mm meets, m²; z: g; w: of a streak the time, s
};

PHARE_SHADER_END
#endif
