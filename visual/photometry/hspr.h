// HSPR, the headlamp safety performance rating (GTB CE-5815): ranges, widths, flux, glare and points of a pair of
// lamps. Written from the method as the field notes §5.4 have it; no copy of CE-5815 was at hand.
#pragma once

#include <string>
#include <vector>

#include "config/result.h"
#include "visual/photometry/intensity_table.h"

namespace phare {

/// One lamp of the pair. The method's frame: origin on the ground between the lamps, x right, y up, z ahead, metres.
struct HsprLamp {
  const IntensityTable* table = nullptr;
  double x_m = 0.0;  ///< right positive
  double y_m = 0.65;
  double aim_up_deg = 0.0;
};

struct HsprRow {
  std::string id;  ///< "A", "B", ... as in the method
  std::string what;
  std::string unit;  ///< "m", "lm" or "" (glare)
  double value = 0.0;
  double one_point = 0.0, two_points = 0.0;  ///< values that give 1 and 2 points; equal: none known
  double points = 0.0;
  double weight = 0.0;
  std::string chosen{};  ///< what the notes leave open here and Phare chose; empty: nothing
};

struct HsprResult {
  std::vector<HsprRow> rows;
  double weighted = 0.0;           ///< sum of weight × points of the rows whose scale is known
  double worst = 0.0, best = 0.0;  ///< the method's scale for the whole beam
  double on_scale_01 = 0.0;        ///< where the weighted points lie from worst (0) to best (1); may lie outside
  bool complete = true;            ///< false: some row's scale is not known and it is left out of the sum
};

/// Vertical-plane illuminance at a point, lux: E = Σ (I/d²)·(Δz/d).
double hspr_illuminance_lx(const std::vector<HsprLamp>& lamps, double x_m, double y_m, double z_m);

enum class HsprBeam { kFind, kLow, kHigh };

/// Which beam the lamps have, and their aims: the cut-off 1 % down (the method's 0.57°), a driving beam as filed.
/// Refused: a passing beam beside another kind, one for left-hand traffic, and with kFind a flat cut-off, which is
/// neither. The error names the table.
Result<HsprBeam> hspr_beam(std::vector<HsprLamp>& lamps, HsprBeam asked);

HsprResult hspr_low_beam(const std::vector<HsprLamp>& lamps);
/// Ranges, widths and flux; one- and two-point values of the high beam were not at hand, so no points.
HsprResult hspr_high_beam(const std::vector<HsprLamp>& lamps);

}  // namespace phare
