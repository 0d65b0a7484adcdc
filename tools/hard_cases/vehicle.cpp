// The car where models of cars break. Its seventeen cases with their numbers are tests; these run in a moment.
#include "config/vehicle.h"

#include <cmath>

#include "config/base/paths.h"
#include "tools/hard_cases/hard_case.h"
#include "vehicle_dynamics/batch.h"
#include "vehicle_dynamics/road.h"

namespace phare::hard {
namespace {

/// Ten seconds with the same pedals and wheel throughout.
batch::Inputs held(double accelerator_01, double brake_01, double steer_rad) {
  batch::Inputs inputs;
  for (const double time_s : {0.0, 10.0}) {
    inputs.time_s.push_back(time_s);
    inputs.steer_rad.push_back(steer_rad);
    inputs.accelerator_01.push_back(accelerator_01);
    inputs.brake_01.push_back(brake_01);
  }
  return inputs;
}

Outcome run(const batch::Inputs& inputs, double speed_mps, const Road& road,
            const std::function<double(const batch::Row& first, const batch::Row& row)>& value) {
  Outcome outcome;
  const std::string file = (config_dir() / "vehicles/bmw_320i.toml").string();
  const Result<VehicleParams> vehicle = read_vehicle(file);
  if (!vehicle) return {.error = vehicle.error().text()};
  batch::Options options;
  options.vehicle = *vehicle;
  options.vehicle_place = file;
  options.speed_mps = speed_mps;
  options.output_hz = 10.0;
  options.road = &road;
  std::optional<batch::Row> first;
  const auto ran = batch::run(options, inputs, [&](const batch::Row& row) {
    if (!first) first = row;
    outcome.float64.push_back({row.time_s, value(*first, row)});
  });
  if (!ran) outcome.error = ran.error().text();
  return outcome;
}

Outcome on_a_slope(const Bench&) {
  Road road;
  road.slope_x = 0.2;
  return run(held(0.0, 1.0, 0.0), 0.0, road, [](const batch::Row& first, const batch::Row& row) {
    return std::hypot(row.x_m - first.x_m, row.y_m - first.y_m, row.z_m - first.z_m);
  });
}

Outcome standing_wheel_turned(const Bench&) {
  return run(held(0.0, 1.0, 0.5), 0.0, Road{}, [](const batch::Row& first, const batch::Row& row) {
    return std::hypot(row.x_m - first.x_m, row.y_m - first.y_m) + std::abs(row.yaw_rad - first.yaw_rad);
  });
}

Outcome stop(const Bench&) {
  // After the stop the car is to stand: its speed in the last two seconds.
  return run(held(0.0, 0.6, 0.0), 50.0 / 3.6, Road{},
             [](const batch::Row&, const batch::Row& row) { return row.time_s < 8.0 ? 0.0 : std::abs(row.vx_mps); });
}

}  // namespace

std::vector<HardCase> vehicle_cases() {
  const auto car = [](const char* name, const char* breaks, const char* setup, const char* unit, double bound,
                      const char* source, Outcome (*run)(const Bench&)) {
    return HardCase{.name = name,
                    .group = "The car",
                    .breaks = breaks,
                    .setup = setup,
                    .unit = unit,
                    .along = "time, s",
                    .float64_bound = bound,
                    .source = source,
                    .run = run};
  };
  return {car("parked-on-a-slope", "a standing car creeps, or shakes where slip divides by its speed",
              "20 % up, brakes on, ten seconds, level full", "m moved", 1e-6, "a micrometre: nothing that anyone sees",
              on_a_slope),
          car("wheel-turned-at-a-stand", "slip angles of a standing car are 0 over 0: it yaws or blows up",
              "wheels turned to 0.5 rad, brakes on, ten seconds, level full", "m and rad moved", 1e-6, "as above",
              standing_wheel_turned),
          car("stop-from-fifty", "at the end of a stop the car rolls back or trembles for ever",
              "50 km/h to a stand by 0.6 of the brake, level full", "m/s in the last two seconds", 1e-6,
              "the brakes hold what they have stopped", stop)};
}

}  // namespace phare::hard
