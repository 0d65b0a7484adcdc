// Contract of the lamp pass (and of the depth and measure passes, which share its layout): bindings, constants, structs.
// Compiled by the shaders and by visual/lit_scene.cpp, which asserts sizes and offsets.
#ifndef PHARE_SHADERS_LAMPS_H
#define PHARE_SHADERS_LAMPS_H
#include "lib/portable.h"
#include "sizes.h"

PHARE_SHADER_BEGIN

const uint kMaxMaterials = 1024u;  // 16 KiB, the uniform buffer that every device has
const uint kMaxSheetings = 128u;   // 12 KiB
const uint kMirroredLamps = 8u;    // street lamps that wet ground mirrors toward the eye (PHARE_FIXED)

// Specialization constants of lamps.frag
const uint kSpecLampCount = 0u;
const uint kSpecSurface = 1u;   // procedural detail: 0 plain, 1 asphalt, 2 grass, 3 paint, 4 foliage
const uint kSpecRetro = 2u;     // how the material sends light back to where it came from, below
const uint kSpecOutput = 3u;    // what a texel means, below
const uint kSpecLampBase = 4u;  // measure: first of four lamps
const uint kSpecColours = 5u;   // 0: all light has one colour; bit 0: lamps differ in colour; bit 8 + i: lamp i has a table of colour
const uint kSpecSides = 6u;     // 2: both sides of a surface are seen
const uint kSpecGrain = 7u;     // first level of the grain that is there
// Shadows (lib/shadow.glsl): four bits a lamp, 0 none, else one more than its map; size of a map in texels; texels read for one point.
const uint kSpecShadowMaps = 8u;
const uint kSpecShadowWidth = 9u;
const uint kSpecShadowHeight = 10u;
const uint kSpecShadowTaps = 11u;  // above kTapsOfRays: no maps, so many rays to the lamp
const uint kSpecMethod = 12u;
// Fog (lib/fog.glsl): 1 where lamps shine in it; columns and 65536 times the rows of its grid; slices.
const uint kSpecFogLamps = 13u;
const uint kSpecFogGrid = 14u;
const uint kSpecFogSlices = 15u;
const uint kSpecTables = 16u;   // kSpecPerTable constants a lamp: the members of its TableShape, below
const uint kSpecPerTable = 22u;
const uint kSpecMoves = kSpecTables + kSpecPerTable * kMaxLamps + 1u;  // 1: of what moves, whose light is one for the whole mesh (PHARE_FIXED)
const uint kSpecSnow = kSpecTables + kSpecPerTable * kMaxLamps + 3u;  // whether snow lies on what looks up, below
const uint kSpecWet = kSpecTables + kSpecPerTable * kMaxLamps;  // 1: there is water on the ground
const uint kSpecBent = kSpecSnow + 1u;  // 1: its normals lean from its planes, so planes that are turned away from a lamp may seem lit

// Where illuminance is computed (config/desk.h, Method).
const uint kMethodFragment = 0u;    // at every pixel
const uint kMethodVertex = 1u;      // at the vertices, interpolated
const uint kMethodVertex1998 = 2u;  // cos(q)/r² at the vertices, interpolated; times the beam by pixel, in 255 steps of its peak
const uint kMethodReference = 3u;   // at every pixel, in float64 (lib/reference.glsl)

// Values of kSpecSnow.
const uint kSnowNone = 0u;
const uint kSnowLies = 1u;
const uint kSnowOnMarking = 2u;  // whose beads are drawn as facets

const uint kRetroNone = 0u;
const uint kRetroSheeting = 1u;  // R_A by a table of its own
const uint kRetroMarking = 2u;   // R_L by its class
const uint kRetroFacets = 3u;    // rough ground
const uint kRetroGrooves = 5u;   // Oren and Nayar in place of Lambert; 4 is of the processor alone

// How the node before a direction is found. Even: nodes a step apart, from a phase; where wanted a fine step about 0° and a coarse one
// beyond. "Ahead" is for tables with no first angle beyond 90°; what lies at 90° or behind counts as dark.
const uint kLookupAhead = 0u;   // even
const uint kLookupDecimals = 1u;  // even, then rounded to so many decimals: which node is before is computed
const uint kLookupRounded = 2u; // even but for rounding of any kind: where a node really lies stands in the guide, an entry a node
const uint kLookupTurn = 3u;    // even, first angle 0° to 360°, second from its pole (type C: C and gamma), no coarse step
const uint kLookupGuide = 4u;   // any nodes, found through the guide
const uint kLookupScreen = 5u;  // nodes evenly on a flat screen, found by projection: no angle is computed
const uint kLookupScreenGuide = 6u;   // any nodes on a flat screen, found through the guide
const uint kLookupFilter = 7u;        // texels evenly over the range, weights by the texture filter
const uint kLookupFilterAhead = 8u;   // the same for tables that look ahead
const uint kLookupFilterScreen = 9u;  // the same on a flat screen
const uint kLookupKind = 15u;         // mask of these
const uint kLookupScaled = 16u;       // the table is not in candela
const uint kLookupEdge = 32u;         // light at the table's edge: directions have to be compared with it; else dark nodes end it
const uint kLookupNarrow = 64u;       // of first, and twice that of second: no node beyond kNarrowReach_deg
// Only a display's 8 bits are written: angles by fewer terms, and of nodes rounded to decimals the cell where they lay
// before, whose function goes on past its nodes by half a last decimal. Set for the lit pass, by the output and not by
// the table.
const uint kLookupShown = 256u;
const uint kLookupCoarse = 512u;  // ahead, even: a coarse step beyond the fine ones
const uint kLookupLast = 1024u;   // decimals: the last is so small a part of a step that kLookupShown leaves it out
const uint kLookupOfFrame = 2048u;  // all but `lookup` is read from the frame (GpuShape): for many lights, and slower
const uint kLookupAsFirst = 4096u;  // the same, of the first lamp

const uint kOutputDisplay = 0u;      // the display's signal (sRGB), tone curve applied here
const uint kOutputHdr = 1u;          // cd/m² and illuminance in alpha
const uint kOutputFalseColour = 2u;  // illuminance by colour with isolux lines
const uint kOutputMeasure = 3u;      // lx of lamps base..base+3
const uint kOutputAudit = 4u;        // position and illuminance; normal and illuminance
const uint kOutputClipping = 5u;     // as the display, with stripes where it clips
const uint kOutputDifference = 6u;   // of two designs by colour: lux of B less those of A
const uint kOutputRatio = 7u;        // B over A

// The shape of a lamp's table, constants of the pipeline where it can be: on a software device a uniform read costs a
// pixel as much as ten multiplications, and a varying costs each vertex. Of first in x, of second in y.
struct TableShape {
  uint lookup;   // kind and bits, above
  vec2 per;      // even: nodes per radian (screen: per tangent); guide: bins per degree; filter: texture coordinates per radian (tangent)
  vec2 phase;    // even: node k lies k + phase steps from 0°; guide: lowest multiple of 45°; filter: offset of the coordinate
  vec2 fine;     // even: fine nodes on either side of 0° (turn: nodes in 45°); decimals: what a step is over a whole number of units; guide: bins in 45°
  float coarse;  // even: fine steps in a coarse one, inverted; guide, rounded: entry where the guide of second begins
  vec4 range;    // first and last, of first, then of second; even: nodes from 0°; guide: degrees; filter: radians (tangents)
  vec4 reach;    // ahead: tangents of half the angles beyond which there is only darkness, as range; screen guide: x, y degrees per tangent
  vec2 cells;    // cells in a row, and the index of the cell of node (0, 0)
  // Decimals: before it was rounded to whole units of the last decimal, node k lay k·fine + from units beside a whole number of them.
  vec2 from;
  vec2 unit;  // in steps
};
// A cell is one texel, the four nodes (k, j), (k + 1, j), (k, j + 1), (k + 1, j + 1), row by row: as many cells as
// nodes and one row and column before them; beyond the table's edge the nodes are dark. Of nodes rounded to decimals,
// in place of them what the cell's bilinear function comes to where they lay before. The guide: shaders/lib/beam.glsl.

const float kNarrowReach_deg = 46.0;  // half angles of narrow tables take a short polynomial (lib/angles.h)

// One lamp position. Directions are rows: dot(row, d) is a component in the frame of the lamp's table,
// first angle = atan2(b, a), second angle = atan2(c, hypot(a, b)):
//   type A: a forward, b right, c up;  type B: a forward, b up, c right (first is V);  type C: a c0, b c90, c -g0 (second is gamma - 90; kLookupTurn: gamma).
// A flat screen: a forward, b right, c up; first = b/a, second = c/a, tangents; its table holds what is bilinear there, candela / (1 + first² + second²)^1.5.
struct GpuLamp {
  vec4 position;     // xyz relative to the eye, m; w: the beam's peak, cd
  vec4 row_a;        // w: the square of the way from the eye, m²
  vec4 row_b;        // w: 1 of a lamp of B where two designs are compared, else 0
  vec4 row_c;        // w: air nearer to the lamp does not shine (lib/fog.glsl), m
  vec4 colour;       // rgb, luminance 1 (with a table of colour: r and b what its texels are multiplied by); w: candela of 1.0 in the table
};

// A TableShape without its lookup, for pipelines that serve tables of any shape.
struct GpuShape {
  vec4 range;
  vec4 reach;
  vec4 per_phase;
  vec4 fine_cells;
  vec4 from_unit;
  vec4 coarse;  // in x
};

// How a point relative to the eye falls on a lamp's shadow map: (dot(u, p), dot(v, p)) / dot(w, p) in texels to the
// right of the middle and below it, dot(w, p) the distance along the lamp's axis in m; p as (x, y, z, 1). A map is two
// pictures of one size, one after the other: all that casts shadows, then the middle zoom.x times as large, where the
// beam is bright and the road far away; one number for all maps of a view. zoom.y: -1 in a mirror, else 1.
struct GpuShadow {
  vec4 u;
  vec4 v;
  vec4 w;
  vec4 zoom;
};

// Light scattered in fog (lib/fog.glsl): of rays through the nodes of a grid over the view, to the ends of slices. Slices end where
// k = slices·s/(s + reach) is whole, s being the way along the ray; the last one never ends.
struct GpuFog {
  vec4 air;        // x: extinction in powers of two, 1/m; y: what is scattered, 1/m; z: reach of the slices, m; w: share of the sky that comes through
  vec4 colour;     // rgb of the scattered light, w the luminance of fog under the sky alone over theirs; exposed where the display is written
  vec4 ray;        // through the upper left corner, from the eye, any length; its changes across and down the view
  vec4 ray_right;
  vec4 ray_down;
  // Of what rain or snow scatter, drawn drop by drop instead: shares x, y, z of it nearer to the eye than so many m.
  vec4 drawn_to_m;
  vec4 drawn_share;
};

struct GpuFrame {
  vec4 clip_from_eye[4];    // columns; "eye" is the world turned to the eye's place, not its direction
  vec4 exposure;            // rgb: 1/(cd/m²), with the balance of the eye's adaptation
  vec4 sky;                 // rgb zenith cd/m², w: factor at the horizon
  vec4 isolux_lx[kMaxIsoluxLevels / 4u];  // of false colour; beyond the last level one that nothing reaches
  GpuLamp lamps[kMaxLamps];
  GpuShadow shadows[kMaxLamps];  // of each lamp; read where kSpecShadowMaps has one
  GpuFog fog;                    // read where the air is not clear
  vec4 size_px;                  // x, y: of the view's part of the picture; z: of a pixel in its middle the solid angle, sr. Read by drops
  vec4 mirrored_at[kMirroredLamps];  // street lamps over wet ground, relative to the eye, m
  vec4 mirrored_cd[kMirroredLamps];  // rgb: of each toward where it is mirrored
  GpuShape shapes[kMaxLamps];        // of each lamp's table; read where its lookup has kLookupOfFrame
  vec4 ground;                       // x: share of level ground that snow covers; y: width of the slopes of the water on it
};

// Shadows by rays: the buffer holds, four floats a texel, two texels a lamp (half its opening to the left, w: one more than which mover carries
// it; half of it up, w: 1 round), then one (x: how many movers), and from kRayMovers on four a mover: rows that take a place into its
// mesh, and where its tree begins and ends, x and y; last the tree of what stands, where the last texel of the head says: y and z. Of a tree
// (RayTree::texels) a box is two texels, what it ends with and how many triangles of three texels follow in the fourth floats. The fourth float
// of a triangle is where its holes are told, or 0: two texels with its first corner's place in the texture and how far from there the others
// are, then where the texture's opacities begin: one texel with its width and height, the opacity below which there is nothing, in 255ths, and
// how it is wrapped (across + 4 * down + 16 where nearest; TextureWrap), then three opacities a float. GpuShadow then takes a point relative to
// the eye to where the trees have it.
const uint kTapsOfRays = 64u;
const uint kTapsWithHoles = 64u;  // besides, where something has holes
const uint kLensRays = 16u;  // over an opening: an edge has as many steps; bits of a uint
const uint kRayHead = 30u;
const uint kRayMovers = 31u;
const uint kRayMoverTexels = 4u;

// Depth of a map is this over the distance along the axis: what is nearer than it casts no shadow.
const float kShadowNear_m = 0.05f;

struct GpuMaterial {
  // rgb rho; w, sheeting and grooves: which of the sheetings; marking: R_L at the 30 m geometry without what rho gives there,
  // facets: what they send back at a share of 1, in cd/(lx·m²), by which luminance follows from rho/pi: times pi over
  // rho's luminance under illuminant A. Of a marking with an R_L of its own when wet there is, as many places from the
  // last as it is from the first, in x what stays of its w on wet ground, and -1 in w.
  vec4 reflectance;
};

// ln of R_A in cd/(lx·m²), scaled like R_L above: a row for each observation angle, x to w for entrance angles (lib/retro.h).
// Of grooves, the first two rows: their terms (grooves_beside()), dry and wet.
struct GpuSheeting {
  vec4 row[6];
};

// Push constants of one draw.
struct GpuDraw {
  vec4 origin;         // of the batch, relative to the eye, m; w, by method "reference": the draw's first index, as bits
  vec4 detail_origin;  // of the batch modulo 1024 m, so that detail stays put in float32; w, likewise: its first vertex
  vec4 turn[3];        // rows that turn what moves into the world; of what stands those of no turn; w: what the origin
                       // leaves, m
};

PHARE_SHADER_END
#endif
