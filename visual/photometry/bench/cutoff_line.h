// The cut-off as a line over H: where it kinks, and by how much one is to be moved to lie on another.
#pragma once

#include <vector>

#include "visual/photometry/bench/cutoff.h"

namespace phare {

/// Elevation of the inflection of log E at each H where a vertical scan finds a cut-off. H ascending, degrees.
struct CutoffLine {
  std::vector<double> h_deg, v_deg;
};
CutoffLine cutoff_line(const IntensityHv& intensity, double from_h_deg, double to_h_deg, double step_deg);

/// Where a line turns from its lower part into the rise: the foot. Both UN beams (15°, or 45° to a shoulder) and SAE
/// ones (a step) are a straight line plus a ramp; the place and length of the ramp that explain the line best win.
struct Kink {
  bool found = false;
  bool to_right = true;   ///< the side on which the cut-off is higher
  double h_deg = 0.0;     ///< the foot
  double rise_deg = 0.0;  ///< angle of the ramp against the horizontal
};
/// The kink within ±4° of H = 0. Judged in windows that go with the place looked at, so a beam turned sideways has its
/// kink turned by the same, to about 0.01° where the table's rows are 0.05° apart.
Kink find_kink(const IntensityHv& intensity);
/// The same where the scans from -kKinkScan_deg to +kKinkScan_deg in steps of kKinkScanStep_deg (or more of them) are
/// at hand already.
inline constexpr double kKinkScan_deg = 7.0, kKinkScanStep_deg = 0.25;
Kink find_kink(const IntensityHv& intensity, const CutoffLine& coarse);

/// What is added to B's H and V to lay its line on A's.
struct LineShift {
  double right_deg = 0.0, up_deg = 0.0;
  bool right_known = false;  ///< false: both lines are straight, and slide along each other; right_deg is 0
  double apart_deg = 0.0;    ///< mean distance that is left
};
/// Least mean distance within 5° of `a_kink_h_deg`, sideways within `reach_deg` of `start_right_deg`.
LineShift align_lines(const CutoffLine& a, const CutoffLine& b, double a_kink_h_deg, double start_right_deg,
                      double reach_deg);

/// B turned by yaw and pitch until its cut-off lies on A's.
struct CutoffAlignment {
  bool aligned = false;
  double right_deg = 0.0, up_deg = 0.0;  ///< B is turned by this
  bool right_known = false;
  bool other_side = false;  ///< one rises to the left, the other to the right: only their kinks are laid together
  double apart_deg = 0.0;   ///< mean distance of the two lines then
  double up_open_deg = 0.0, right_open_deg = 0.0;  ///< what the coarser table's rows leave open of the turn
};
CutoffAlignment align_cutoffs(const IntensityTable& a, const IntensityTable& b, const CutoffShape& shape_a,
                              const CutoffShape& shape_b);

}  // namespace phare
