// Our own sample headlamps: smooth formulas with the shape and levels of real beams, sampled to LM-63-2019 type A
// tables. They are no product of anyone. Passing beams have the kink of their cut-off at H = V = 0 of the file, as
// lamps lie on a goniometer aimed by their cut-off: mount them 0.57° (1 %) down. Driving beams have their peak at HV of
// the file.
#pragma once

#include <string>
#include <vector>

#include "visual/photometry/intensity_table.h"

namespace phare {

enum class SampleKind { kLowRight, kLowLeft, kHigh, kFog };

struct SampleLamp {
  std::string file;  ///< "low_rht.ies"
  SampleKind kind = SampleKind::kLowRight;
  std::string description;  ///< one line, for the file's keywords
  IntensityTable table;     ///< as rounded in the file
};

/// The lamps `phare-make-lamps` writes: low_rht, low_lht, high, fog, led_low_rht, led_low_lht, led_high.
std::vector<SampleLamp> sample_lamps();

/// The mounting the sample lamps are meant for: pitch of -1 %, rad.
double sample_pitch_rad();

/// The LM-63-2019 file of a sample lamp.
std::string lm63_text(const SampleLamp& lamp);

}  // namespace phare
