// The scale of two designs compared by colour, in stills and in the picture: shaders/lib/tone.h has its equations.
#pragma once

#include <utility>
#include <vector>

#include "visual/image/canvas.h"

namespace phare {

/// kDifference: B less A in lux, from -30 to 30, logarithmic beyond 1. kRatio: B over A from 1/8 to 8, logarithmic;
/// where neither has 0.1 lx it is dark.
enum class VersusScale { kDifference, kRatio };

/// Where a value lies, from -1 (A brighter) to 1.
double versus_share(double value, VersusScale scale);
/// The colour there, and of a value: of lux, or of a ratio.
Colour versus_colour_at(double share);
Colour versus_colour(double value, VersusScale scale);
/// What is written beside it.
std::vector<std::pair<double, const char*>> versus_marks(VersusScale scale);

/// Where neither of two has as much, their ratio is not told.
double versus_dark_lx();

}  // namespace phare
