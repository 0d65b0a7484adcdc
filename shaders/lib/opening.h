// Places on a lamp's luminous opening, for shadows with soft edges.
#ifndef PHARE_SHADERS_LIB_OPENING_H
#define PHARE_SHADERS_LIB_OPENING_H
#include "portable.h"

PHARE_SHADER_BEGIN

// The i-th of `count` places that stand for equal shares of an opening, in halves of its width and height from the middle; round: an ellipse.
// A lattice by the golden ratio (a rectangle), bent to a spiral (an ellipse: Vogel 1979): no two lie on one line along or across, so an edge
// that moves over the opening meets them one by one.
PHARE_INLINE vec2 opening_place(uint i, uint count, bool round) {
  const float golden = 0.61803399f;
  float along = (float(i) + 0.5f) / float(count), across = float(i) * golden;
  across -= floor(across);
  if (!round) return vec2(2.0f * along - 1.0f, 2.0f * across - 1.0f);
  float turn = 6.28318531f * across, radius = sqrt(along);
  return vec2(radius * cos(turn), radius * sin(turn));
}

PHARE_SHADER_END
#endif
