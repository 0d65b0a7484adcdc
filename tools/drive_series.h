// What drive.csv and probes.csv of a drive's folder say, as series over time and as the few figures that sum them up.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// One quantity over time; NaN where it has no value.
struct TimeSeries {
  std::string name{};
  std::vector<double> time_s{}, value{};
};

struct DriveSeries {
  /// A row of drive.csv whose picture was kept.
  struct Picture {
    std::int64_t frame = 0;
    double time_s = 0.0;
  };
  /// Rows one after the other with the same light of the same design.
  struct Lit {
    double from_s = 0.0, to_s = 0.0;
    std::string lit, design;
  };

  std::size_t rows = 0;
  double driven_s = 0.0, distance_m = 0.0;  ///< from row to row, where time does not go back
  TimeSeries speed_kmh, pitch_deg, cutoff_m;
  std::vector<TimeSeries> reach_m;    ///< left and right of each level, as drive.csv names them
  std::vector<TimeSeries> probes_lx;  ///< of probes.csv; none where it is not there
  /// What lamps do to the driver's eyes, others' lamps, and to those of who comes toward the car, ours; only lines that
  /// have a value somewhere, of veil and threshold increment one above 0.
  std::vector<TimeSeries> veil_cdm2, threshold_increment_percent, de_boer;
  std::vector<Picture> pictures;
  std::vector<Lit> lit;
};

/// Nothing where the folder has no drive.csv; a last row that was cut off is left out. Error: file:line of a row that
/// is none.
Result<std::optional<DriveSeries>> read_drive_series(const std::filesystem::path& folder);

/// {"rows", "driven_s", "distance_m", "speed_kmh", "pitch_deg", "cutoff_25m_m", "reach_m"}: least, median and greatest
/// of each that has values. Reach is of rows with light.
nlohmann::json figures_of(const DriveSeries& series);

}  // namespace phare
