// What each frame of a drive was: drive.csv in the drive's folder, one row a frame, for the page and for notebooks
// (docs/driving.md has the columns). Checked by tests/visual_process/drive_log_test.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/base/appended_file.h"
#include "visual/photometry/table/glare.h"
#include "visual/process/lamps.h"
#include "visual/process/road_marks.h"

namespace phare {

/// The wall that the height of the cut-off is told on: UN R149, annex 4.
inline constexpr double kCutoffWall_m = 25.0;

struct DriveRow {
  std::int64_t frame = 0;  ///< as its picture in frames/ is numbered
  SimTime time{};
  VehicleState car{};
  std::string lit{};  ///< "low high"; empty: dark
  std::string design{};
  bool fail_safe = false, pose_held = false, picture = false;
  std::optional<double> cutoff_m{};   ///< Lamps::cutoff_height_m on the wall
  std::vector<Reach> reach{};         ///< ten times a second; empty in between
  std::vector<Reach> versus_reach{};  ///< of the other design, where two are compared
  double frame_ms = 0.0, gpu_ms = 0.0;
  Glare glare{};         ///< of the lamps of others, at the driver's eyes
  Glare others_glare{};  ///< of our lamps, at those eyes of who comes toward us that get the most light
};

/// What stands in a row besides what every drive has.
struct DriveColumns {
  bool versus = false;   ///< the reach of the design beside
  bool traffic = false;  ///< glare, ours and of others
};
std::string drive_columns(DriveColumns columns = {});
std::string drive_row(const DriveRow& row, DriveColumns columns = {});

class DriveLog {
 public:
  /// `folder`: empty keeps nothing. `going_on`: rows there are of this drive; those of frames that are drawn again go.
  DriveLog() = default;
  DriveLog(std::filesystem::path folder, bool going_on, DriveColumns columns = {});

  bool wanted() const { return !file_.empty(); }
  /// One more than the number of the last frame of the process before; 0: there was none.
  std::int64_t frames_before() const;
  /// Whether the row of this time tells the reach.
  bool reach_is_due(SimTime now) const { return now.ns / kReachEvery_ns != newest_reach_; }
  /// False, once: the disk did not take it.
  bool write(const DriveRow& row);

 private:
  static constexpr std::int64_t kReachEvery_ns = 100'000'000;
  void begin(SimTime now);

  std::filesystem::path file_;
  AppendedFile rows_;
  std::int64_t newest_reach_ = -1;
  bool going_on_ = false, failed_ = false, begun_ = false;
  DriveColumns columns_;
};

}  // namespace phare
