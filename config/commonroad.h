// Vehicles as the CommonRoad vehicle models give them (parameters_vehicleN.yaml, parameters_tire.yaml), and the vehicle
// file of ours that they come to.
//
// Source: M. Althoff, G. Wuersching, CommonRoad: Vehicle Models (version 2020a), tables 6 and 7. Theirs is a multi-body
//   model of which level full has what docs/dynamics.md says; what is not taken is named, what theirs has not is chosen
//   and says so in the file.
// Tests: tests/vehicle_dynamics/vehicle_import_test.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/tyre_file.h"

namespace phare {

/// Numbers of a CommonRoad file by their key, one level deep: "m", "steering.max".
class CommonRoadFile {
 public:
  /// Error with file and line: no YAML, a key twice, something else than numbers.
  static Result<CommonRoadFile> read(const std::filesystem::path& file);

  const std::string& file() const { return file_; }
  bool has(const std::string& key) const { return numbers_.count(key) > 0; }
  double at(const std::string& key);  ///< notes the key as used
  /// Keys that nobody asked for and that are not 0, sorted.
  std::vector<std::string> unused() const;

 private:
  std::string file_;
  std::map<std::string, double> numbers_;
  std::set<std::string> used_;
};

/// A vehicle file as text, and what was not taken over, one line each.
struct VehicleText {
  std::string toml;
  std::vector<std::string> notes;
};

/// `vehicle`: parameters_vehicleN.yaml. `tyre`: parameters_tire.yaml or a .tir file, whose coefficients are then those
/// at `load_n` (nothing: a quarter of the car's weight). The text is checked as every vehicle file is.
Result<VehicleText> vehicle_of_commonroad(const std::filesystem::path& vehicle, const std::filesystem::path& tyre,
                                          std::optional<double> load_n);

/// The table [tyre] alone, of a .tir file at `load_n` (nothing: the nominal load), with what else the file says.
Result<VehicleText> tyre_table(const std::filesystem::path& tyre, std::optional<double> load_n);

}  // namespace phare
