// Contract of the method "reference" (lamps.frag compiled with PHARE_REFERENCE): what its storage buffers hold, all float64.
// Compiled by the shader and by visual/reference_light.cpp.
#ifndef PHARE_SHADERS_REFERENCE_H
#define PHARE_SHADERS_REFERENCE_H
#include "lamps.h"

PHARE_SHADER_BEGIN

const uint kReferenceSet = 3u;

// Of a view with a set of lamps, words from the first:
const uint kReferenceLampWords = 16u;    // of each lamp: position relative to the eye, m (3); rows a, b, c as GpuLamp (9); where its table begins
const uint kReferenceTableAt = 12u;      // the last of these
const uint kReferenceEyeFromClip = 128u; // 16: the inverse of clip_from_eye, column by column
const uint kReferenceArea = 144u;        // 4: left, top, width, height of the view in pixels
const uint kReferenceViewWords = 160u;

// Of a table: the number of its first and second nodes, its kind, 1 where it has colours; then the nodes (degrees; of a
// screen tangents), its values [second][first] (candela; of a screen over (1 + first² + second²)^1.5), and where it has
// colours the values times red, then those times blue. First and second are those of GpuLamp.
const uint kReferenceHeadWords = 4u;
const uint kReferenceAngles = 0u;
const uint kReferenceTurn = 1u;    // type C: C from 0° to 360° and gamma from its pole
const uint kReferenceScreen = 2u;

// Of a point that is measured: position relative to the eye, m, and its unit normal.
const uint kReferencePointWords = 6u;

// Of a vertex of the scene (GpuVertex), float32.
const uint kReferenceVertexWords = 7u;

PHARE_SHADER_END
#endif
