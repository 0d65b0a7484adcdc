// The cut-off of a passing beam: where it lies, how sharp, how straight, and on which side it rises.
#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// What stands behind an intensity: lit nodes; a node of exactly 0, towards which log E has no meaning; no data at all.
enum class Evidence { kLit, kDark, kNone };

/// Intensity in cd toward azimuth H (right positive) and elevation V (up positive), degrees, of a mounted lamp.
struct IntensityHv : std::function<double(double h_deg, double v_deg)> {
  using std::function<double(double, double)>::function;
  std::function<Evidence(double h_deg, double v_deg)> evidence;  ///< empty: kLit where there is light, else kDark
  std::function<std::size_t(double h_deg, double v_deg)> row;    ///< between which rows that is; empty: not known
};

/// A number that is the same as long as a vertical scan stays between two rows of the table (type C: in one cell).
std::size_t row_of(const IntensityTable& table, const glm::dvec3& direction);

/// Of a direction in the lamp frame. A table that reaches 90° to both sides covers what lies behind it, too: kDark.
Evidence evidence_of(const IntensityTable& table, const glm::dvec3& direction);

/// A table mounted by `car_from_lamp`, times `scale`. The table must outlive the function.
IntensityHv mounted_intensity(const IntensityTable& table, const glm::dmat3& car_from_lamp, double scale = 1.0);

/// The cut-off on a vertical scan. Source: UN R112 annex 9 / R149 annex 5 as in the field notes §5.1.
struct Cutoff {
  bool found = false;          ///< false: nothing like a cut-off on this scan (G below 0.05, or `at_edge`)
  bool at_edge = false;        ///< the light falls steepest where the data end: the inflection may lie outside them
  double sharpness_g = 0.0;    ///< max of log10 E(b) - log10 E(b + 0.1°) in steps of 0.05°
  double elevation_deg = 0.0;  ///< inflection of log10 E: the middle of the steepest 0.1°, by the values
                               ///< at the rows where they are known; to about 0.01° on rows up to 0.1° apart
};

/// Scans at `h_deg` between two elevations. Light below 2 % of the scan's highest is no cut-off, however steep; nor is
/// the end of the table. The step to nodes of exactly 0 counts only where the lit ones show no cut-off.
Cutoff find_cutoff(const IntensityHv& intensity, double h_deg, double from_v_deg = -4.0, double to_v_deg = 3.0);

/// The same beam with left and right turned round.
IntensityHv mirrored_intensity(const IntensityHv& intensity);

/// What the cut-off says about the lamp. Only a side that rises tells the side of traffic; any other is an assumption.
enum class CutoffSide { kNone, kFlat, kRisesRight, kRisesLeft };

/// How the cut-off runs. kFlat: level to both sides; kSymmetric: its ends fall to both sides, as fog lamps' do;
/// kElbow: flat, then rising all the way (15° of UN beams); kZ: a slant of about 45° to a shoulder; kStep: steeper
/// than that, as of projectors and SAE beams; kDoubleStep: two such steps with a level part between.
enum class CutoffForm { kNone, kFlat, kSymmetric, kElbow, kZ, kStep, kDoubleStep };

/// "none", "flat", "symmetric", "elbow", "Z", "step", "double step".
std::string form_name(CutoffForm form);

/// One rise of the cut-off, from its foot to its head.
struct CutoffStep {
  double foot_h_deg = 0.0, head_h_deg = 0.0;  ///< head farther to the rising side
  double height_deg = 0.0;
};

struct CutoffShape {
  CutoffSide side = CutoffSide::kNone;  ///< rises right: for right-hand traffic
  double flat_v_deg = 0.0;              ///< elevation of the flat part, at 2.5° from the kink
  double rise_deg = 0.0;                ///< angle of the rising part against the horizontal
  double kink_h_deg = 0.0;              ///< where flat and rising part meet, by find_kink; 0 where there is no kink
  double sharpness_g = 0.0;             ///< on the flat side at 2.5° from the kink
  CutoffForm form = CutoffForm::kNone;
  double upper_v_deg = 0.0;       ///< elevation 2.5° beyond the kink, on the rising side; without a kink flat_v_deg
  std::vector<CutoffStep> steps;  ///< steep rises, from the flat part outward; none of an elbow

  /// Does the beam itself say for which side of the road it is? If not, whoever names a side assumes it.
  bool tells_side() const { return side == CutoffSide::kRisesRight || side == CutoffSide::kRisesLeft; }
};

/// For which side of the road a beam is: "by the cut-off", or "assumed: …" with the reason (flat, symmetric, none).
std::string side_source(const CutoffShape& shape);

/// That reason alone, of a shape that does not tell its side.
std::string why_no_side(const CutoffShape& shape);

/// A mirrored beam has the mirrored shape, to the bit where the table's own nodes are mirrored to the bit.
CutoffShape cutoff_shape(const IntensityHv& intensity);

}  // namespace phare
