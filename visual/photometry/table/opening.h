// What light leaves a lamp through: its luminous opening as seen from ahead, for shadows with soft edges. From the
// sizes that a photometry file states (LM-63-2019 §5.11: width, length, height, negative where round; EULUMDAT lines 16
// to 18: the luminous area).
#pragma once

#include <optional>
#include <string>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// Across the lamp's optical axis, about its middle.
struct LampOpening {
  /// Chosen, for the files that state none, as most of headlamps do: a lens of 70 mm. Not from a source.
  double width_m = 0.07, height_m = 0.07;
  bool round = true;  ///< an ellipse; else a rectangle

  friend bool operator==(const LampOpening&, const LampOpening&) = default;
};

/// Larger than this no lamp of a car is, and a size is taken for one in other units; m.
inline constexpr double kLargestOpening_m = 2.0;

/// What the table's file states; nothing: no size (all 0), or one above kLargestOpening_m.
/// A file measures along its own axes. LM-63: length along photometric horizontal, height along photometric zero, width
/// across both. So ahead of the lamp are, from left to right and upward: type A width and height, type B width and
/// length, type C with gamma 0 ahead length and width (C 0 to the right), with gamma 90 ahead width and height. EULUMDAT
/// has its length along C 90. Where one of the two is 0 the third stands for it (many give width and length of the face,
/// whatever the type); of a round one the other.
std::optional<LampOpening> stated_opening(const IntensityTable& table);

/// "60 x 40 mm", "round, 70 mm"; and whether the file says so or it was chosen.
std::string opening_text(const IntensityTable& table);

}  // namespace phare
