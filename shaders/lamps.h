// Contract of the lamp pass (and of the depth and measure passes, which share its layout): bindings, constants, structs.
// Compiled by the shaders and by visual/passes/lamps.cpp, which asserts sizes and offsets.
#ifndef PHARE_SHADERS_LAMPS_H
#define PHARE_SHADERS_LAMPS_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

const uint kMaxLamps = 8u;
const uint kMaxMaterials = 1024u;  // 16 KiB, the uniform buffer that every device has
const uint kGuideRow = 1024u;      // bins in a row of the guide image

// Specialization constants of lamps.frag
const uint kSpecLampCount = 0u;
const uint kSpecSurface = 1u;   // procedural detail: 0 plain, 1 asphalt, 2 grass, 3 paint, 4 foliage
const uint kSpecRetro = 2u;     // 1: the material sends light back to where it came from
const uint kSpecOutput = 3u;    // what a texel means, below
const uint kSpecLampBase = 4u;  // measure: first of four lamps
const uint kSpecLookups = 5u;   // how each lamp's table is looked up, four bits a lamp, below
const uint kSpecColours = 6u;   // 1: lamps differ in colour
const uint kSpecSides = 7u;     // 2: both sides of a surface are seen
const uint kSpecGrain = 8u;     // first level of the grain that is there

// Even: nodes at multiples of a fine step about 0°, of a coarse one beyond. The first two are for tables that look ahead: no first
// angle beyond 90°, and what lies at 90° or behind counts as dark.
const uint kLookupDark = 0u;   // even, ahead, and dark at the table's edge: no need to look whether a direction is within
const uint kLookupAhead = 1u;  // even, ahead
const uint kLookupTurn = 2u;   // even, first angle 0° to 360°, second from its pole (type C: C and gamma), no coarse step
const uint kLookupGuide = 3u;  // any nodes, found through the guide image
const uint kLookupFilter = 4u; // texels evenly over the range, weights by the texture filter
const uint kLookupFilterAhead = 5u;  // the same for tables that look ahead
const uint kLookupKind = 7u;   // mask of these
const uint kLookupScaled = 8u; // the texture is not in candela

const uint kOutputDisplay = 0u;      // display-linear colour, tone curve applied here
const uint kOutputHdr = 1u;          // cd/m² and illuminance in alpha
const uint kOutputFalseColour = 2u;  // illuminance by colour with isolux lines
const uint kOutputMeasure = 3u;      // lx of lamps base..base+3
const uint kOutputAudit = 4u;        // position and illuminance; normal and illuminance

// One lamp position, or what a frame's shaders need of it. Directions are rows: dot(row, d) is a component in the frame of the lamp's table,
// first angle = atan2(b, a), second angle = atan2(c, hypot(a, b)):
//   type A: a forward, b right, c up;  type B: a forward, b up, c right (first is V);  type C: a c0, b c90, c -g0 (second is gamma - 90; kLookupTurn: gamma).
struct GpuLamp {
  vec4 position;     // xyz relative to the eye, m; w even: fine steps in a coarse one, inverted; filter: candela of 1.0 in the texture
  vec4 row_a;
  vec4 row_b;
  vec4 row_c;
  vec4 colour;       // rgb, luminance 1; w: candela of 1.0 in the texture (again, where position has no room for it)
  vec4 nodes;        // filter: as range, in radians; even: fine nodes per radian of first, of second; fine nodes on either side of 0° (turn: in 45°), of first, of second
  vec4 coordinates;  // even: image coordinate of the gather about a node (filter: of an angle in radians): factors, then offsets, of first and of second
  vec4 within;       // even: first and last node from 0°, of first; of second
  vec4 range;        // guide: first min, max; second min, max; degrees
  vec4 bins;         // guide: bins per degree, of first and of second; lowest multiple of 45°, of first and of second
  uvec4 guide;       // bin where the guide of second begins; bins in 45°, of first and of second
};

struct GpuFrame {
  vec4 clip_from_eye[4];    // columns; "eye" is the world turned to the eye's place, not its direction
  vec4 exposure;            // rgb: 1/(cd/m²), with the balance of the eye's adaptation
  vec4 sky;                 // rgb zenith cd/m², w: factor at the horizon
  GpuLamp lamps[kMaxLamps];
};

struct GpuMaterial {
  vec4 reflectance;  // rgb rho, w: R_A in cd/(lx·m²)
};

// Push constants of one draw.
struct GpuDraw {
  vec4 origin;         // of the batch, relative to the eye, m
  vec4 detail_origin;  // of the batch modulo 1024 m, so that detail stays put in float32
};

PHARE_SHADER_END
#endif
