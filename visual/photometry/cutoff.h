// The cut-off of a passing beam: where it lies, how sharp, how straight, and on which side it rises.
#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "visual/photometry/intensity_table.h"

namespace phare {

/// What stands behind an intensity: lit nodes; a node of exactly 0, towards which log E has no meaning; no data at all.
enum class Evidence { kLit, kDark, kNone };

/// Intensity in cd toward azimuth H (right positive) and elevation V (up positive), degrees, of a mounted lamp.
struct IntensityHv : std::function<double(double h_deg, double v_deg)> {
  using std::function<double(double, double)>::function;
  std::function<Evidence(double h_deg, double v_deg)> evidence;  ///< empty: kLit where there is light, else kDark
};

/// Of a direction in the lamp frame. A table that reaches 90° to both sides covers what lies behind it, too: kDark.
Evidence evidence_of(const IntensityTable& table, const glm::dvec3& direction);

/// A table mounted by `car_from_lamp`, times `scale`. The table must outlive the function.
IntensityHv mounted_intensity(const IntensityTable& table, const glm::dmat3& car_from_lamp, double scale = 1.0);

/// The cut-off on a vertical scan. Source: UN R112 annex 9 / R149 annex 5 as in the field notes §5.1.
struct Cutoff {
  bool found = false;          ///< false: nothing like a cut-off on this scan (G below 0.05, or `at_edge`)
  bool at_edge = false;        ///< the light falls steepest where the data end: the inflection may lie outside them
  double sharpness_g = 0.0;    ///< max of log10 E(b) - log10 E(b + 0.1°) in steps of 0.05°
  double elevation_deg = 0.0;  ///< inflection of log10 E: the middle of the steepest 0.1°, to about 0.005°
};

/// Scans at `h_deg` between two elevations. Light below 2 % of the scan's highest is no cut-off, however steep; nor is
/// the end of the table. The step to nodes of exactly 0 counts only where the lit ones show no cut-off.
Cutoff find_cutoff(const IntensityHv& intensity, double h_deg, double from_v_deg = -4.0, double to_v_deg = 3.0);

/// What the cut-off says about the lamp.
enum class CutoffSide { kNone, kFlat, kRisesRight, kRisesLeft };

struct CutoffShape {
  CutoffSide side = CutoffSide::kNone;  ///< rises right: for right-hand traffic
  double flat_v_deg = 0.0;              ///< elevation of the flat part
  double rise_deg = 0.0;                ///< angle of the rising part against the horizontal, about 15 or 45
  double kink_h_deg = 0.0;              ///< where flat and rising part meet, by find_kink; 0 where there is no kink
  double sharpness_g = 0.0;             ///< on the flat side at 2.5° from the kink's side of V-V
};
CutoffShape cutoff_shape(const IntensityHv& intensity);

}  // namespace phare
