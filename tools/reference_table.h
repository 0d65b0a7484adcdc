// Tables of a photometry reference set (manifest.json beside them): which lamps shine, where the points lie, what each
// of the set's photometry files must give there. For phare measure --table.
#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/rig.h"
#include "visual/photometry/readers/points_file.h"

namespace phare {

/// What one column of a table asks for.
struct ReferenceCase {
  std::string column;             ///< "E", "E[low_B]"; of 0_intensity the file's key
  std::vector<LampConfig> lamps;  ///< aim as in the manifest
  std::vector<PointRow> points;
  std::vector<double> expected_lx;
  double dim_lx = 0.01;  ///< relative errors count where more is expected; 0: everywhere
};

/// Knows 0_intensity (candela as lux at 1 m), a_road_flat_<beam>, b_wall25_<beam> and c_plates, with a case
/// for every file of the beam in whatever format, and j_hard, with one for every lamp and place. Error with file:line
/// when a table or the manifest is malformed.
Result<std::vector<ReferenceCase>> read_reference_table(const std::filesystem::path& table);

/// How far measured values are from a case.
struct ReferenceErrors {
  /// In a case whose dim_lx is 0 what is dark has to be, and no relative error counts, below what a rounding of a
  /// float32 direction (6e-8) takes out of the last cell of a table that ends in 0.
  static constexpr double kDark_lx = 1e-12;
  std::size_t judged = 0;  ///< points above the case's dim_lx
  double worst_relative = 0.0;
  double worst_absolute_lx = 0.0;  ///< over all points
  double highest_lx = 0.0;
  std::size_t worst_line = 0;  ///< of the table, where the worst relative error is
};
ReferenceErrors compare(const ReferenceCase& expected, const std::vector<double>& measured_lx);

}  // namespace phare
