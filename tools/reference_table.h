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
};

/// Knows 0_intensity (candela as lux at 1 m), a_road_flat_<beam>, b_wall25_<beam> and c_plates, with a case
/// for every file of the beam in whatever format. Error with file:line when a table or the manifest is malformed.
Result<std::vector<ReferenceCase>> read_reference_table(const std::filesystem::path& table);

/// How far measured values are from a case.
struct ReferenceErrors {
  static constexpr double kDim_lx = 0.01;  ///< relative errors count where more is expected
  std::size_t judged = 0;                  ///< points above kDim_lx
  double worst_relative = 0.0;
  double worst_absolute_lx = 0.0;  ///< over all points
  double highest_lx = 0.0;
  std::size_t worst_line = 0;  ///< of the table, where the worst relative error is
};
ReferenceErrors compare(const ReferenceCase& expected, const std::vector<double>& measured_lx);

}  // namespace phare
