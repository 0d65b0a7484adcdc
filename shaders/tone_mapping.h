// Contract of the tone-mapping pass: reads the HDR image, writes display-linear colour.
#ifndef PHARE_SHADERS_TONE_MAPPING_H
#define PHARE_SHADERS_TONE_MAPPING_H
#include "lib/portable.h"
PHARE_SHADER_BEGIN
const uint kToneInput = 0u;  // binding: hdr_cdm2
struct ToneConstants {
  vec4 exposure;  // rgb: 1/(cd/m²), with the balance of the eye's adaptation
};
PHARE_SHADER_END
#endif
