// Where a recorded drive goes: a lane it is put onto, or the table of its poses. Frame: world x east, y north, z up;
// yaw and pitch as ISO 8855 has them. Test: tests/tools/can_import_test.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// The lane to drive on, metre by metre.
struct ImportLane {
  std::vector<double> s_m, x_m, y_m, z_m, heading_rad, curvature_1pm;

  struct Point {
    double x_m, y_m, z_m, heading_rad, curvature_1pm, grade;
  };
  /// Cubic Hermite between the rows, with the headings as tangents; straight on past the ends.
  Point at(double s) const;

 private:
  double grade(std::size_t i) const;
};

/// Error at the file for what is no lane.
Result<ImportLane> import_lane(const std::filesystem::path& file);

/// A row each, times ascending, angles without jumps.
struct ImportPose {
  std::vector<double> t_s, east_m, north_m, up_m, yaw_rad, pitch_rad;
};

/// A table with columns t_s, east_m, north_m, up_m, heading_deg_cw_from_north, path_pitch_deg. Error with file and
/// line.
Result<ImportPose> read_import_pose(const std::filesystem::path& file);

}  // namespace phare
