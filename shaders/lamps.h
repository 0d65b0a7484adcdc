// Contract of the lamp pass (and of the depth and measure passes, which share its layout): bindings, constants, structs.
// Compiled by the shaders and by visual/passes/lamps.cpp, which asserts sizes and offsets.
#ifndef PHARE_SHADERS_LAMPS_H
#define PHARE_SHADERS_LAMPS_H
#include "lib/portable.h"
#include "sizes.h"

PHARE_SHADER_BEGIN

const uint kMaxMaterials = 1024u;  // 16 KiB, the uniform buffer that every device has
const uint kMaxSheetings = 128u;   // 12 KiB
const uint kGuideRow = 1024u;      // bins in a row of the guide image

// Specialization constants of lamps.frag
const uint kSpecLampCount = 0u;
const uint kSpecSurface = 1u;   // procedural detail: 0 plain, 1 asphalt, 2 grass, 3 paint, 4 foliage
const uint kSpecRetro = 2u;     // how the material sends light back to where it came from, below
const uint kSpecOutput = 3u;    // what a texel means, below
const uint kSpecLampBase = 4u;  // measure: first of four lamps
const uint kSpecLookups = 5u;   // how each lamp's table is looked up, four bits a lamp, below
const uint kSpecColours = 6u;   // 0: all light has one colour; bit 0: lamps differ in colour; bit 8 + i: lamp i has a table of colour
const uint kSpecSides = 7u;     // 2: both sides of a surface are seen
const uint kSpecGrain = 8u;     // first level of the grain that is there

const uint kRetroNone = 0u;
const uint kRetroSheeting = 1u;  // R_A by a table of its own
const uint kRetroMarking = 2u;   // R_L by its class

// Even: nodes at multiples of a fine step about 0°, of a coarse one beyond. The first two are for tables that look ahead: no first
// angle beyond 90°, and what lies at 90° or behind counts as dark.
const uint kLookupDark = 0u;   // even, ahead, and dark at the table's edge: no need to look whether a direction is within
const uint kLookupAhead = 1u;  // even, ahead
const uint kLookupTurn = 2u;   // even, first angle 0° to 360°, second from its pole (type C: C and gamma), no coarse step
const uint kLookupGuide = 3u;  // any nodes, found through the guide image
const uint kLookupScreen = 4u; // nodes evenly on a flat screen, found by projection: no angle is computed
const uint kLookupScreenGuide = 5u;  // any nodes on a flat screen, found through the guide image
const uint kLookupFilter = 6u; // texels evenly over the range, weights by the texture filter
const uint kLookupFilterAhead = 7u;  // the same for tables that look ahead
const uint kLookupKind = 7u;   // mask of these
const uint kLookupScaled = 8u; // the texture is not in candela; what a filter weighs always is scaled, so there this bit says
const uint kLookupFilterScreen = 14u;  // the same on a flat screen

const uint kOutputDisplay = 0u;      // display-linear colour, tone curve applied here
const uint kOutputHdr = 1u;          // cd/m² and illuminance in alpha
const uint kOutputFalseColour = 2u;  // illuminance by colour with isolux lines
const uint kOutputMeasure = 3u;      // lx of lamps base..base+3
const uint kOutputAudit = 4u;        // position and illuminance; normal and illuminance

// One lamp position, or what a frame's shaders need of it. Directions are rows: dot(row, d) is a component in the frame of the lamp's table,
// first angle = atan2(b, a), second angle = atan2(c, hypot(a, b)):
//   type A: a forward, b right, c up;  type B: a forward, b up, c right (first is V);  type C: a c0, b c90, c -g0 (second is gamma - 90; kLookupTurn: gamma).
// A flat screen: a forward, b right, c up; first = b/a, second = c/a, tangents; its texture holds what is bilinear there, candela / (1 + first² + second²)^1.5.
struct GpuLamp {
  vec4 position;     // xyz relative to the eye, m; w even: fine steps in a coarse one, inverted; filter: candela of 1.0 in the texture
  vec4 row_a;
  vec4 row_b;
  vec4 row_c;
  vec4 colour;       // rgb, luminance 1 (with a table of colour: r and b what its texels are multiplied by); w: candela of 1.0 in the texture (again, where position has no room for it)
  vec4 nodes;        // filter: as range, in radians or tangents; screen: nodes per unit of tangent (guide: a scale), of first, of second; even: fine nodes per radian of first, of second; fine nodes on either side of 0° (turn: in 45°), of first, of second
  vec4 coordinates;  // even: image coordinate of the gather about a node (filter: of an angle in radians, or a tangent): factors, then offsets, of first and of second
  vec4 within;       // even: first and last node from 0°, of first; of second
  vec4 range;        // guide: first min, max; second min, max; degrees (screen: tangents times their scale)
  vec4 bins;         // guide: bins per degree, of first and of second; lowest multiple of 45°, of first and of second
  uvec4 guide;       // bin where the guide of second begins; bins in 45°, of first and of second
};

struct GpuFrame {
  vec4 clip_from_eye[4];    // columns; "eye" is the world turned to the eye's place, not its direction
  vec4 exposure;            // rgb: 1/(cd/m²), with the balance of the eye's adaptation
  vec4 sky;                 // rgb zenith cd/m², w: factor at the horizon
  vec4 isolux_lx[kMaxIsoluxLevels / 4u];  // of false colour; beyond the last level one that nothing reaches
  GpuLamp lamps[kMaxLamps];
};

struct GpuMaterial {
  // rgb rho; w, sheeting: which of the sheetings; marking: R_L at the 30 m geometry without what rho gives there, in cd/(lx·m²), by
  // which luminance follows from rho/pi: times pi over rho's luminance under illuminant A
  vec4 reflectance;
};

// ln of R_A in cd/(lx·m²), scaled like R_L above: a row for each observation angle, x to w for entrance angles (lib/retro.h).
struct GpuSheeting {
  vec4 row[6];
};

// Push constants of one draw.
struct GpuDraw {
  vec4 origin;         // of the batch, relative to the eye, m
  vec4 detail_origin;  // of the batch modulo 1024 m, so that detail stays put in float32
};

PHARE_SHADER_END
#endif
