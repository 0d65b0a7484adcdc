// Work against precision: error of every level, integrator and step against the reference, and what it costs.
#pragma once

#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/vehicle.h"
#include "vehicle_dynamics/models/fixed_step.h"

namespace phare::work_precision {

inline constexpr double kEnd_s = 10.0;  ///< how long the car is driven

struct Line {
  std::string level, integrator;
  double step_s = 0.0;
  double ns_per_step = 0.0;  ///< processor time, least of several runs
  double real_time = 0.0;    ///< simulated seconds in one of computing, in the quickest run
  std::vector<double> runs_s{};  ///< processor time of each run; those of all lines take turns
  double p99_9_ns = 0.0;     ///< of single steps, with the clock's own 20 to 30 ns
  double pitch_error_rad = 0.0, yaw_rate_error_radps = 0.0, position_error_m = 0.0;  ///< largest over 10 s
};

/// Ten seconds: class C road, 80 km/h, step steer of 10 mrad at 1 s, braking with 5.5 m/s2 from 4 s on. Inputs change
/// at multiples of 10 ms only, so that every step size sees the same. `short_run`: steps 1, 2, 5 ms only,
/// against rk4 with 0.1 ms.
Result<std::vector<Line>> table(const VehicleParams& vehicle, const std::string& place, bool short_run);

std::string markdown(const std::vector<Line>& lines);

}  // namespace phare::work_precision
