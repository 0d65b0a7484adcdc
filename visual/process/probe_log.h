// Lux at probes and the reach of the beam over a drive: probes.csv in the drive's folder, ten rows a second of
// simulated time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/base/appended_file.h"
#include "visual/process/lamps.h"
#include "visual/process/road_marks.h"

namespace phare {

/// One row: what the lamps give now. A probe that is nowhere (a road that the scene has not) has no number.
struct ProbeRow {
  SimTime time{};
  VehicleState car{};
  std::vector<std::optional<double>> probes_lx;
  std::vector<Reach> reach;
};

/// The names of the columns, for so many probes.
std::string probe_columns(std::size_t probes);
/// The row under them.
std::string probe_row(const ProbeRow& row);

class ProbeLog {
 public:
  /// `folder`: empty keeps nothing. `going_on`: rows there are of this drive.
  ProbeLog() = default;
  ProbeLog(std::filesystem::path folder, bool going_on);

  /// Whether a row is due: ten times a second, each tenth once.
  bool due(SimTime now) const { return !file_.empty() && now.ns / kEvery_ns != newest_; }
  /// Writes it. With another number of probes than before the columns are named again. False, once: the disk did not
  /// take it.
  bool write(const ProbeRow& row);

 private:
  static constexpr std::int64_t kEvery_ns = 100'000'000;
  std::filesystem::path file_;
  AppendedFile rows_;
  std::int64_t newest_ = -1;
  std::optional<std::size_t> probes_;
  bool going_on_ = false, failed_ = false;
};

}  // namespace phare
