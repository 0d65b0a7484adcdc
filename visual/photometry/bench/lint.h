// What an engineer should know about a photometry file before believing it: graded findings.
#pragma once

#include <string>
#include <vector>

#include "visual/photometry/bench/cutoff.h"
#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// kInfo: worth knowing; kWarning: look before you use it; kError: not usable as it is.
enum class Grade { kInfo, kWarning, kError };

struct Finding {
  Grade grade = Grade::kInfo;
  std::string id;     ///< "flux", "left-hand-traffic", ...: stable, for machines
  std::string place;  ///< file:line where there is one
  std::string text;
};

struct LampReport {
  double flux_lm = 0.0;
  double expected_flux_lm = 0.0;  ///< what the header promises of the luminaire; 0: nothing
  double peak_cd = 0.0;
  TableAngles peak;  ///< type A and B: the table's own H and V; type C: azimuth and elevation
  CutoffShape cutoff;
  double step_h_deg = 0.0, step_v_deg = 0.0;  ///< widest steps within 5° by 2° of the peak
  std::vector<Finding> findings;
};

/// Looks at a table as it was read. Takes some milliseconds.
LampReport lint_lamp(const IntensityTable& table);

std::string grade_name(Grade grade);
std::string type_name(const IntensityTable& table);  ///< "A", "B", "C" or "screen"

}  // namespace phare
