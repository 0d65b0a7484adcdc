// Contract of the fog pass: what computes the grid of scattered light (fog.comp), and the sky through fog (fog_sky.frag).
#ifndef PHARE_SHADERS_FOG_H
#define PHARE_SHADERS_FOG_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

const uint kFogGroup = 64u;  // rays that are computed together

// Specialization constants of fog.comp, after those of the tables it shares with lamps.frag, and of fog_sky.frag.
const uint kSpecFogSteps = 2u;   // of a slice, for each lamp, at least
const uint kSpecFogAdd = 4u;     // 1: to what the grid holds already
const uint kSpecFogWidest = 5u;  // degrees at the lamp of a step, at most
const uint kSpecFogSky = 6u;     // 1: some of the sky comes through

// Texels of two numbers: of the grid's column and row k, where they lie across and down the view, 0 to 1; after these of the picture's
// column and row k of pixels, where in the grid they lie, in columns and rows.
const int kFogMostNodes = 340;

// The phase function at even angles from 0° to 180°.
const uint kFogPhaseSteps = 1440u;

PHARE_SHADER_END
#endif
