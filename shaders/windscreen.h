// Contract of rain on the windscreen (visual/windscreen.h): what is drawn of it, and the pure functions that both sides have.
#ifndef PHARE_SHADERS_WINDSCREEN_H
#define PHARE_SHADERS_WINDSCREEN_H
#include "lib/portable.h"

PHARE_SHADER_BEGIN

// Places on the glass where drops lie, a texel each of the image of their light.
const uint kScreenColumns = 128u, kScreenRows = 96u;
const uint kScreenPlaces = kScreenColumns * kScreenRows;

// The glass: so far ahead of the eye, and so much of it to either side and up and down, m. Fixed to the car; chosen.
const float kGlass_m = 0.75f, kGlassAside_m = 0.75f, kGlassUp_m = 0.45f;

// What the light of a drop is summed over: samples of the picture within this angle of it.
const uint kScreenTaps = 32u;
const float kDropBends_deg = 15.0f;

// Push constants of windscreen_light.frag, with two lamps that shine into the eye; xy: where in the target, px; z: lx at the eye; w: red and blue of
// its colour of luminance 1, as half floats.
struct GpuScreenLight {
  vec4 clip_from_glass[4];  // columns; glass: left, up, ahead of the eye, m
  vec4 lamps[2];
  vec4 reach;               // x: of the angle a drop bends light by, px; y: cone of that angle, sr
  vec4 area;                // xy: of the view in the target, px; zw: its size
};

// Push constants of windscreen.vert and windscreen.frag.
struct GpuScreen {
  vec4 clip_from_glass[4];
  vec4 wiper;               // x: time, s; y: from stroke to stroke, s, 0: it stands; z: a stroke, s
  vec4 water;               // x: of the places that get a drop, share a second; y: opacity of a place; z: its radius, px
  vec4 area;                // as above
  vec4 wind;                // x: which way large drops run, 1 up the glass, -1 down; y: how far all are drawn out; z: time, s, of drops that run
};

// A number for a number: Fibonacci hashing, twice.
PHARE_INLINE uint screen_hash(uint n) {
  n = (n ^ (n >> 16)) * 0x9e3779b1u;
  n = (n ^ (n >> 15)) * 0x9e3779b1u;
  return n ^ (n >> 16);
}
PHARE_INLINE float screen_random(uint seed) {
  return float(screen_hash(seed) >> 8) * (1.0f / 16777216.0f);
}

// Where a place lies: left and up of where the eye looks, m on the glass.
PHARE_INLINE vec2 screen_place(uint number) {
  return vec2((2.0f * screen_random(3u * number + 1u) - 1.0f) * kGlassAside_m, (2.0f * screen_random(3u * number + 2u) - 1.0f) * kGlassUp_m);
}

// Time since the blade has passed, s, and in y how many strokes before. `left_01`: from the right edge, where it rests, to the left one. It goes
// there in one stroke and back in the next. Of a wiper that stands: for ever.
PHARE_INLINE vec2 since_wiped(float left_01, float time_s, float period_s, float stroke_s) {
  if (period_s <= 0.0f) return vec2(1e6f, 0.0f);
  float cycle = floor(time_s / period_s), within = time_s - cycle * period_s;
  float there = stroke_s * left_01, back = stroke_s * (2.0f - left_01);
  if (within >= back) return vec2(within - back, 2.0f * cycle + 1.0f);
  if (within >= there) return vec2(within - there, 2.0f * cycle);
  return vec2(within + period_s - back, 2.0f * cycle - 1.0f);
}

// Of what a drop bends by a share (0 to 1) of its widest angle, over the mean of all: less the more, chosen. Its mean over the disc is 1.
PHARE_INLINE float drop_bends(float share) {
  return 2.0f * max(1.0f - share * share, 0.0f);
}

// Of all places, the share with a drop so long after the blade: as many as come at first, then on what is bare.
PHARE_INLINE float share_with_drops(float since_s, float per_s) {
  return 1.0f - exp(-per_s * since_s);
}

// Opacity of a place from its middle (0) to its rim (1): the image of a drop in an eye that looks far away. Its mean is 2/3.
PHARE_INLINE float screen_disc(float from_middle) {
  float square = min(from_middle * from_middle, 1.0f);
  return 1.0f - square * square;
}

// Of drops that have run together: what one covers, over the mean of all; `uniform_01`: 0 to below 1. Its mean is 1 to 1 %.
PHARE_INLINE float drop_area(float uniform_01) {
  return 0.45f + 0.55f * min(-log(max(1.0f - uniform_01, 1e-6f)), 5.0f);
}
// Larger ones run.
const float kRunsFrom_area = 1.6f;
const float kRunsFor_s = 3.0f, kRuns_mps = 0.03f;  // until another one lies in its place; by and by

// Where within a drop, 0 its middle, 1 its outline: `at` across and along it, over its half axes. It is wider at the end that is behind, by
// `taper`, and its outline is lobed: `lobes` of twice and three times the angle. Neither changes what it covers, to second order of `lobes`.
PHARE_INLINE float within_drop(vec2 at, float taper, vec4 lobes) {
  float across = at.x / max(1.0f - taper * at.y, 0.1f), along = at.y;
  float square = across * across + along * along, inverse = 1.0f / sqrt(max(square, 1e-8f));
  float c = across * inverse, s = along * inverse;
  float lobe = lobes.x * (c * c - s * s) + lobes.y * 2.0f * c * s + lobes.z * c * (c * c - 3.0f * s * s) + lobes.w * s * (3.0f * c * c - s * s);
  return sqrt(square) / (1.0f + lobe);
}
const float kMostOfLobes = 0.2f;  // of both kinds together

PHARE_SHADER_END
#endif
