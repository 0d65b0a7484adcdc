// Contract of the glare pass: the HDR image with what lamps scatter in the eye, to the display. In place of the tone-mapping pass.
#ifndef PHARE_SHADERS_GLARE_H
#define PHARE_SHADERS_GLARE_H
#include "lib/portable.h"
PHARE_SHADER_BEGIN
const uint kGlareInput = 0u;   // binding: hdr_cdm2
const uint kGlareSources = 1u;  // binding: GpuGlare
const uint kMostGlareLamps = 12u;  // as many as there are varyings for on every device
const uint kSpecGlareLamps = 0u;  // specialization constant: lamps that are summed; those beyond what there is are dark

struct GpuGlareLamp {
  vec4 toward;  // xyz from the eye, unit
  vec4 eye_lx;  // rgb: illuminance at the eye times the colour of the light
};
struct GpuGlare {
  vec4 exposure;  // rgb: 1/(cd/m²), with the balance of the eye's adaptation
  vec4 terms;     // xyz: of lib/veil.h
  vec4 ahead;     // a pixel's direction, any length: ahead + x·right + y·down, x and y as in clip space
  vec4 right;
  vec4 down;
  GpuGlareLamp lamps[kMostGlareLamps];
};
PHARE_SHADER_END
#endif
