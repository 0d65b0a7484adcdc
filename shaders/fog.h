// Contract of the fog pass: what computes the grid of scattered light (fog.comp), and the sky through fog (fog_sky.frag).
#ifndef PHARE_SHADERS_FOG_H
#define PHARE_SHADERS_FOG_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

const uint kFogGroup = 64u;  // columns that are computed together

// Specialization constants of fog.comp, after those of the tables it shares with lamps.frag, and of fog_sky.frag.
const uint kSpecFogSamples = 2u;  // points of a slice, for each lamp
const uint kSpecFogAdd = 4u;      // 1: to what the grid holds already
const uint kSpecFogSky = 5u;      // 1: some of the sky comes through

// The phase function at even angles from 0° to 180°.
const uint kFogPhaseSteps = 1440u;

PHARE_SHADER_END
#endif
