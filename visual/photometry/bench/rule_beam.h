// A beam as a rulebook looks at it: one lamp, or half the sum of both sides' lamps, each aimed by itself, mirrored for
// left-hand traffic; and what its tables know and how well.
#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "visual/photometry/bench/cutoff.h"
#include "visual/photometry/bench/rulebook.h"
#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// H and V are those of the rule (right-hand traffic), degrees. The tables must outlive the beam.
class RuleBeam {
 public:
  struct Value {
    double cd = 0.0;
    bool known = true;  ///< false: some lamp's table has no data there
  };
  struct Node {
    HV at;
    Value value;
  };

  RuleBeam(std::span<const IntensityTable* const> tables, bool mirrored);

  std::size_t lamps() const { return tables_.size(); }
  /// Turned by this (right, up) from how the file has it, in the frame of the rule.
  HV aim(std::size_t lamp = 0) const { return aims_[lamp]; }
  void set_aim(std::size_t lamp, HV aim);
  /// All lamps by this on top of their aims.
  void turn(HV by);

  Value at(double h_deg, double v_deg) const;
  /// What interpolation and digits leave open, cd; infinite where there is no data.
  double resolution_cd(HV p) const;
  /// At a node: what may stand higher in the cells about it, cd.
  double peak_resolution_cd(HV node) const;
  /// Every node of the tables. Made when first asked for.
  const std::vector<Node>& nodes();
  Node peak();
  double flux_lm() const;
  /// Do the tables reach 89° to all four sides?
  bool covers_the_front() const;
  /// For scans; the beam must outlive it.
  IntensityHv intensity() const;

  /// What a table's rows leave open of the sharpness at a cut-off of its own lamp. Rows no wider apart than the 0.1° of
  /// G resolve it as well as both of its samples are known. Wider ones say only that the light falls from one row to
  /// the next: all of it within 0.1° at the most, evenly at the least.
  struct SharpnessRange {
    double lowest_g = 0.0, highest_g = 0.0;
    double row_step_deg = 0.0;  ///< to this the inflection is known
  };
  SharpnessRange sharpness_range(std::size_t lamp, double h_deg, const Cutoff& cutoff) const;

 private:
  glm::dvec3 in_lamp(std::size_t lamp, double h_deg, double v_deg) const;

  std::span<const IntensityTable* const> tables_;
  bool mirrored_;
  std::vector<HV> aims_;
  std::vector<glm::dmat3> car_from_lamp_;
  std::vector<Node> nodes_;
  std::optional<Node> peak_;
};

/// What bilinear interpolation and the digits of the file leave open at these angles of the table, cd: the second
/// differences of the neighbouring nodes over 8 (the bound of linear interpolation), scaled to where between the nodes,
/// and half a unit of the last digit. Infinite outside the table.
double interpolation_error_cd(const IntensityTable& table, TableAngles angles);

}  // namespace phare
