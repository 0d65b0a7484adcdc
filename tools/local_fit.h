// Smooth value and slope of samples taken at uneven times.
#pragma once

#include <span>

namespace phare {

struct FittedValue {
  double value = 0.0;
  double slope = 0.0;  ///< per second
};

/// Parabola through the samples within `half_window_s` of `t_s`, by least squares with tricube weights (Cleveland 1979,
/// local regression). Times ascend. Where fewer than four samples lie in the window it is widened to the nearest four;
/// one sample gives its value and no slope. A parabola is not carried far from its samples: over a gap, wider than the
/// window and three times the spacing on both its sides, a cubic by the values and slopes there (Hermite) goes; beyond
/// the ends by more than the half window the value there stays.
FittedValue local_fit(std::span<const double> times_s, std::span<const double> values, double t_s,
                      double half_window_s);

}  // namespace phare
