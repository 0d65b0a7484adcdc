// Our own sample headlamps: smooth formulas with the shape and levels of real beams, sampled to LM-63-2019 type A
// tables. They are no product of anyone. Passing beams have the kink of their cut-off at H = V = 0 of the file, as
// lamps lie on a goniometer aimed by their cut-off: mount them 0.57° (1 %) down. Driving beams have their peak at HV of
// the file.
#pragma once

#include <string>
#include <vector>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

enum class SampleKind { kLowRight, kLowLeft, kHigh, kFog, kCornering, kBicycle, kSegment };

struct SampleLamp {
  std::string file;  ///< "low_rht.ies", "matrix/r1_c01.ies"
  SampleKind kind = SampleKind::kLowRight;
  std::string description;         ///< one line, for the file's keywords
  std::vector<std::string> rules;  ///< rulebooks of config/rules that it passes
  IntensityTable table;            ///< as rounded in the file
};

/// The lamps `phare-make-lamps` writes: low_rht, low_lht, high, fog, cornering_left, cornering_right, led_low_rht,
/// led_low_lht, led_high, bicycle.
std::vector<SampleLamp> sample_lamps();

inline constexpr int kMatrixRows = 3;
inline constexpr int kMatrixColumns = 12;

/// The segments of a matrix driving beam, kMatrixRows × kMatrixColumns, row by row from below, each row from left to
/// right. Their sum passes UN R149 driving beam class B. Each is dark outside its own few degrees.
std::vector<SampleLamp> matrix_segments();

/// The mounting the sample lamps are meant for: pitch of -1 %, rad.
double sample_pitch_rad();

/// Keywords of a sample lamp's file; sentences of the description become one keyword line each.
LampHeader sample_header(const std::string& file, const std::string& description, const IntensityTable& table);

/// Field 12 of the samples' files: computed, not measured.
inline constexpr const char* kSampleGeneration = "1.00010";

/// Five digits: finer than any photometer, and the files stay small.
double rounded_cd(double cd);

}  // namespace phare
