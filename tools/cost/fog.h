// What the levels of the fog effect are off by: pixels of a black wall in fog, so that all their light is the air's,
// against float64 line of sight by line of sight.
#pragma once

#include <span>
#include <vector>

#include "visual/photometry/table/intensity_table.h"
#include "visual/renderer.h"

namespace phare::cost {

struct FogErrors {
  std::vector<double> differences{};  ///< found − float64 relative to float64, where there is 1 % of the brightest
  double misplaced = 0.0;             ///< Σ|found − float64| / Σ float64 of all
};

/// Of every level of the effect, off first, which finds no light at all. Loads a scene of its own.
std::vector<FogErrors> fog_errors(Renderer& renderer, const IntensityTable& table, const Air& air, PictureSize size,
                                  int step_px);

}  // namespace phare::cost
