// The ladders of the vehicle.
#include "config/vehicle.h"

#include <map>

#include "tools/cost/measure_ladders.h"
#include "vehicle_dynamics/reference.h"
#include "vehicle_dynamics/work_precision.h"

namespace phare::cost {

Result<std::vector<Ladder>> vehicle_ladders(const Plan& plan) {
  plan.progress("the car's levels, integrators and steps", 0.0);
  const Result<VehicleParams> vehicle = read_vehicle(plan.vehicle_file);
  if (!vehicle) return vehicle.error();
  const bool reference = ReferenceIntegrator::there().ok();
  const bool short_run = plan.quick || !reference;
  const auto lines = work_precision::table(*vehicle, plan.vehicle_file, short_run);
  if (!lines) return lines.error();
  constexpr double kDegPerRad = 57.29577951308232;
  std::vector<Ladder> ladders;
  for (const work_precision::Line& line : *lines) {
    const std::string name = "vehicle-" + line.level;
    if (ladders.empty() || ladders.back().name != name)
      ladders.push_back(
          {.name = name,
           .what = "pitch of level " + line.level +
                   " in ten seconds of rough road, a step of the wheel and braking; the cut-off rises "
                   "and falls with it",
           .reference =
               short_run
                   ? "the level itself by rk4 in steps of 0.1 ms"
                   : "the level itself by an adaptive Runge-Kutta of order 8 (SUNDIALS), relative tolerance 1e-11",
           .error_unit = "deg",
           .time_unit = "ms of processor a second driven"});
    char level_name[64];
    std::snprintf(level_name, sizeof level_name, "%s, %g ms", line.integrator.c_str(), 1e3 * line.step_s);
    Level level{.name = level_name};
    level.error.max = kDegPerRad * line.pitch_error_rad;
    level.error.samples = 1000;
    std::vector<double> ms_a_second;
    for (const double run_s : line.runs_s) ms_a_second.push_back(1e3 * run_s / work_precision::kEnd_s);
    level.time = times_of(std::move(ms_a_second));
    ladders.back().levels.push_back(level);
  }
  return ladders;
}

}  // namespace phare::cost
