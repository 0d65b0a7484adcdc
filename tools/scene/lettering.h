// Letters of signs as strokes on a grid of one by one, from the lower left corner; drawn by us, of no typeface.
#pragma once

#include <array>
#include <vector>

namespace phare::scene {

using LetterStroke = std::array<double, 4>;  ///< x, y of its two ends

/// Capitals and digits that our signs have; of others, as of a blank, none.
const std::vector<LetterStroke>& strokes_of(char letter);

}  // namespace phare::scene
