// Our levels beside the reference runs of two other programs and a measured drive: phare-dynamics --compare DIR.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "vehicle_dynamics/models/fixed_step.h"

namespace phare::compare {

/// One figure of one run against one reference.
struct Line {
  std::string manoeuvre, reference, level, quantity;
  double error = 0.0;     ///< largest difference over the reference's peak, %; of rms values, %; or m
  double band = 0.0;      ///< what it has to stay within; 0: none is set
  double programs = 0.0;  ///< the same figure between the two reference programs; where they differ more it is the band
  const char* unit = "%";
  double allowed() const { return programs > band ? programs : band; }
  /// A figure that is not finite never does, band or none.
  bool passes() const;
};
std::string text(const Line& line);

/// Runs D01 to D06 open loop with the recorded inputs at both levels. Each by the method that real time runs it with
/// (full: rk4, single-track: etd2), unless one is given. Error: a file is missing or broken, or a run came to no end.
Result<std::vector<Line>> manoeuvres(const std::filesystem::path& directory, const std::filesystem::path& vehicle_file,
                                     std::optional<Integrator> integrator, double step_s);

/// The largest distance between two columns row by row, and between two paths; NaN if any of them is.
double largest_difference(const std::vector<double>& a, const std::vector<double>& b);
double largest_distance(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& our_x,
                        const std::vector<double>& our_y);

/// Launch, coasting and ABS stop of a real car from its pedals.
struct Measured {
  double speed_rms_mps = 0.0, speed_peak_mps = 0.0;
  double pitch_rms_rad = 0.0, pitch_peak_rad = 0.0;
};
Result<Measured> measured_drive(const std::filesystem::path& directory, const std::filesystem::path& vehicle_file);

}  // namespace phare::compare
