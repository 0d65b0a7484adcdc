// Test points of the headlamp rules, and their check on a table. Directions are the rule's: azimuth H right positive
// and elevation V up positive, degrees, from the lamp as mounted.
#pragma once

#include <glm/mat3x3.hpp>
#include <span>
#include <string>
#include <vector>

#include "visual/photometry/intensity_table.h"

namespace phare {

/// Where a row applies. kLine and kPolygon use the points as corners; kBelow: V at most that of the two points, H
/// between them.
enum class RowShape { kPoints, kLine, kPolygon, kBelow, kSum, kPeak };

struct HV {
  double h_deg = 0.0;
  double v_deg = 0.0;
};

inline constexpr double kNoMinimum = 0.0;
inline constexpr double kNoMaximum = 1e30;

struct RegulationRow {
  std::string id;
  RowShape shape = RowShape::kPoints;
  std::vector<HV> at;
  double min_cd = kNoMinimum;
  double max_cd = kNoMaximum;
  double min_of_peak_01 = 0.0;  ///< at least this share of the table's highest intensity
  double max_of_first = 0.0;    ///< at most this factor times the intensity at `reference`; 0 = no such limit
  HV reference;
};

/// UN R149 01 series, passing beam class C, right-hand traffic (Table 6). Mirror H for left-hand traffic.
std::span<const RegulationRow> r149_passing_class_c();
/// UN R149 01 series, driving beam class B and class A (Table 5).
std::span<const RegulationRow> r149_driving_class_b();
std::span<const RegulationRow> r149_driving_class_a();
/// FMVSS 108 Table XVIII, upper beam UB2.
std::span<const RegulationRow> fmvss108_upper_ub2();

struct RowResult {
  std::string id;
  double lowest_cd = 0.0;  ///< over the row's points; of a sum, the sum
  double highest_cd = 0.0;
  double min_cd = kNoMinimum;
  double max_cd = kNoMaximum;
  bool passed = false;
};

/// Evaluates rows on a table mounted by `car_from_lamp`. Lines and areas are sampled every 0.05°. `mirrored`: left-hand
/// traffic.
std::vector<RowResult> check_rows(const IntensityTable& table, const glm::dmat3& car_from_lamp,
                                  std::span<const RegulationRow> rows, bool mirrored = false);

/// The cut-off on a vertical scan at `h_deg`: G = max of log10 E(b) - log10 E(b + 0.1°) in steps of 0.05°, and the
/// elevation b + 0.05° in the middle of the steepest 0.1° (UN R149 §4.13.2, annex on cut-off quality).
struct Cutoff {
  double sharpness_g = 0.0;
  double elevation_deg = 0.0;
};
Cutoff find_cutoff(const IntensityTable& table, const glm::dmat3& car_from_lamp, double h_deg, double from_v_deg = -2.5,
                   double to_v_deg = 1.5);

}  // namespace phare
