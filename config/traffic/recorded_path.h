// The recorded way of a road user: reader of its CSV file, and where it is between the rows.
//
// Columns: time_s, and either s_m and offset_m (on the lane: along its line, and positive to the left of it) or x_m and
// y_m (world frame), then with heading_rad (from x to y) or without. Others are passed over. Between rows each
// coordinate follows the monotone cubic of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984, eq. 4; at the ends
// three points, limited as MATLAB's pchip does): it passes through every row, its speed does not jump, and it does not
// overshoot, so who has stopped does not roll back. A heading goes straight from row to row; without the column it is
// that of the way at each row, and who stands looks as he came. Who reverses needs the column.
// Left out: height, pitch and roll, which the road under it has; that a way beside the lane is longer or shorter than
// the line in a bend, for the speed. The same as python/phare/control/recorded_path.py has;
// both are held to tests/traffic/path_poses.csv, and the curve to SciPy's (python/tests/test_control.py). Checked by
// tests/traffic/recorded_path_test.cpp.
#pragma once

#include <filesystem>
#include <vector>

#include "config/base/result.h"

namespace phare {

class RecordedPath {
 public:
  /// Time rises from row to row; at least two rows; no faster than 1000 km/h. Errors with file:line and reason.
  static Result<RecordedPath> read(const std::filesystem::path& file);

  bool on_lane() const { return on_lane_; }  ///< s_m and offset_m; else x_m and y_m
  double from_s() const { return rows_.front().time_s; }
  double to_s() const { return rows_.back().time_s; }

  struct Place {
    double first_m = 0.0, second_m = 0.0;  ///< s_m and offset_m, or x_m and y_m
    double heading_rad = 0.0;              ///< from the first to the second; on the lane against the line's own
    double speed_mps = 0.0;                ///< 0 or more
  };
  /// Before the first row as there, behind the last as there.
  Place at(double time_s) const;

 private:
  struct Row {
    double time_s = 0.0, first_m = 0.0, second_m = 0.0;
    double first_mps = 0.0, second_mps = 0.0;  ///< how the curve leaves the row
    double heading_rad = 0.0;                  ///< without jumps by whole turns
  };
  void look_along_the_way();

  std::vector<Row> rows_;
  bool on_lane_ = true;
};

}  // namespace phare
