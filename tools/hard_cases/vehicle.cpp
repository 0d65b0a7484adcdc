// The car where models of cars break. All its cases with their numbers are tests; these run in a moment.
#include "config/vehicle.h"

#include <algorithm>
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

/// What a run begins with.
struct Start {
  double speed_mps = 0.0, x_m = 0.0, step_s = 0.002, output_hz = 10.0;
  Level level = Level::kFull;
};

Result<std::vector<batch::Row>> rows_of(const batch::Inputs& inputs, const Start& start, const Road& road) {
  const std::string file = (config_dir() / "vehicles/bmw_320i.toml").string();
  const Result<VehicleParams> vehicle = read_vehicle(file);
  if (!vehicle) return vehicle.error();
  batch::Options options;
  options.vehicle = *vehicle;
  options.vehicle_place = file;
  options.level = start.level, options.integrator = batch::integrator_of(start.level);
  options.speed_mps = start.speed_mps, options.start_x_m = start.x_m;
  options.step_s = start.step_s, options.output_hz = start.output_hz;
  options.road = &road;
  std::vector<batch::Row> rows;
  const auto ran = batch::run(options, inputs, [&](const batch::Row& row) { rows.push_back(row); });
  if (!ran) return ran.error();
  return rows;
}

Outcome run(const batch::Inputs& inputs, const Start& start, const Road& road,
            const std::function<double(const batch::Row& before, const batch::Row& row)>& value,
            bool from_first = true) {
  const Result<std::vector<batch::Row>> rows = rows_of(inputs, start, road);
  if (!rows) return {.error = rows.error().text()};
  Outcome outcome;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const batch::Row& before = (*rows)[from_first || i == 0 ? 0 : i - 1];
    outcome.float64.push_back({(*rows)[i].time_s, value(before, (*rows)[i])});
  }
  return outcome;
}

Outcome on_a_slope(const Bench&) {
  Road road;
  road.slope_x = 0.2;
  return run(held(0.0, 1.0, 0.0), {}, road, [](const batch::Row& first, const batch::Row& row) {
    return std::hypot(row.x_m - first.x_m, row.y_m - first.y_m, row.z_m - first.z_m);
  });
}

Outcome standing_wheel_turned(const Bench&) {
  return run(held(0.0, 1.0, 0.5), {}, Road{}, [](const batch::Row& first, const batch::Row& row) {
    return std::hypot(row.x_m - first.x_m, row.y_m - first.y_m) + std::abs(row.yaw_rad - first.yaw_rad);
  });
}

Outcome stop(const Bench&) {
  // After the stop the car is to stand: its speed in the last two seconds.
  return run(held(0.0, 0.6, 0.0), {.speed_mps = 50.0 / 3.6}, Road{},
             [](const batch::Row&, const batch::Row& row) { return row.time_s < 8.0 ? 0.0 : std::abs(row.vx_mps); });
}

Outcome against_its_engine(const Bench&) {
  // On ice the engine turns the wheels by more than they carry to the road.
  Road road;
  road.friction_everywhere = 0.3;
  return run(held(1.0, 1.0, 0.0), {.level = Level::kSingleTrack}, road,
             [](const batch::Row& first, const batch::Row& row) { return std::abs(row.x_m - first.x_m); });
}

Outcome onto_ice(const Bench&) {
  Road road;
  road.friction.push_back({.from_m = 40.0, .to_m = 80.0, .left = 0.1, .right = 0.1});
  const auto gained_mps = [](const batch::Row& before, const batch::Row& row) {
    return row.vx_mps > 1.0 ? std::max(row.vx_mps - before.vx_mps, 0.0) : 0.0;  // at its end a stop rocks
  };
  return run(held(0.0, 0.8, 0.0), {.speed_mps = 100.0 / 3.6}, road, gained_mps, false);
}

Outcome backwards(const Bench&) {
  constexpr double kSteer_rad = 0.25;
  const Result<VehicleParams> vehicle = read_vehicle(config_dir() / "vehicles/bmw_320i.toml");
  if (!vehicle) return {.error = vehicle.error().text()};
  return run(held(0.0, 0.0, kSteer_rad), {.speed_mps = -3.0}, Road{}, [&](const batch::Row&, const batch::Row& row) {
    const double of_path = row.vx_mps * std::tan(kSteer_rad) / vehicle->wheelbase_m;
    return row.time_s < 2.0 ? 0.0 : std::abs(row.yaw_rate_radps / of_path - 1.0);
  });
}

Road class_e() {
  Road road;
  road.profiles.push_back(HeightProfile::iso8608(RoughnessClass::kE, 1));
  road.profiles.back().smooth(0.1);
  return road;
}

Outcome tyres_pull(const Bench&) {
  const Road road = class_e();
  return run(
      held(0.3, 0.0, 0.0), {.speed_mps = 150.0 / 3.6, .output_hz = 100.0}, road,
      [](const batch::Row&, const batch::Row& row) { return std::max(-*std::ranges::min_element(row.fz_n), 0.0); });
}

Outcome steps_agree(const Bench&) {
  const Road road = class_e();
  std::vector<double> pitch_rms;
  for (const double step_s : {0.0005, 0.001, 0.002}) {
    const auto rows =
        rows_of(held(0.3, 0.0, 0.0), {.speed_mps = 150.0 / 3.6, .step_s = step_s, .output_hz = 500.0}, road);
    if (!rows) return {.error = rows.error().text()};
    double squares = 0.0;
    for (const batch::Row& row : *rows) squares += row.pitch_rad * row.pitch_rad;
    pitch_rms.push_back(std::sqrt(squares / static_cast<double>(rows->size())));
  }
  return {.float64 = {{10.0, std::abs(pitch_rms[1] / pitch_rms[0] - 1.0)},
                      {10.0, std::abs(pitch_rms[2] / pitch_rms[0] - 1.0)}}};
}

Outcome far_away(const Bench&) {
  batch::Inputs slalom;
  for (int i = 0; i <= 100; ++i) {
    slalom.time_s.push_back(0.1 * i);
    slalom.steer_rad.push_back(0.03 * std::sin(0.3 * i));
    slalom.accelerator_01.push_back(0.2);
    slalom.brake_01.push_back(0.0);
  }
  const auto here = rows_of(slalom, {.speed_mps = 25.0}, Road{}),
             there = rows_of(slalom, {.speed_mps = 25.0, .x_m = 1e7}, Road{});
  if (!here || !there) return {.error = (here ? there : here).error().text()};
  Outcome outcome;
  for (std::size_t i = 0; i < std::min(here->size(), there->size()); ++i) {
    const batch::Row &a = (*here)[i], &b = (*there)[i];
    outcome.float64.push_back({a.time_s, std::hypot(b.x_m - 1e7 - a.x_m, b.y_m - a.y_m) +
                                             std::abs(b.yaw_rad - a.yaw_rad) + std::abs(b.pitch_rad - a.pitch_rad)});
  }
  return outcome;
}

}  // namespace

std::vector<HardCase> vehicle_cases() {
  const auto car = [](const char* name, const char* breaks, const char* setup, const char* unit, double bound,
                      const char* source, Outcome (*run)(const Bench&)) {
    return float64_case("The car", name, breaks, setup, unit, "time, s", bound, source, run);
  };
  return {car("parked-on-a-slope", "a standing car creeps, or shakes where slip divides by its speed",
              "20 % up, brakes on, ten seconds, level full", "m moved", 1e-6, "a micrometre: nothing that anyone sees",
              on_a_slope),
          car("wheel-turned-at-a-stand", "slip angles of a standing car are 0 over 0: it yaws or blows up",
              "wheels turned to 0.5 rad, brakes on, ten seconds, level full", "m and rad moved", 1e-6, "as above",
              standing_wheel_turned),
          car("stop-from-fifty", "at the end of a stop the car rolls back or trembles for ever",
              "50 km/h to a stand by 0.6 of the brake, level full", "m/s in the last two seconds", 1e-6,
              "the brakes hold what they have stopped", stop),
          car("braked-against-its-engine",
              "brakes are asked to hold more than reaches the road: the car creeps, out of nothing",
              "accelerator and brake down at a stand, friction 0.3, ten seconds, level single-track", "m moved", 1e-6,
              "what the tyres do not carry need not be held", against_its_engine),
          car("braking-onto-ice", "friction that falls to a tenth within a step throws the car forward",
              "100 km/h, 0.8 of the brake, ice from 40 to 80 m, level full", "m/s gained in 0.1 s", 1e-9,
              "brakes give nothing", onto_ice),
          car("turning-backwards", "slip of the wrong sign makes a reversing car unstable",
              "-3 m/s, wheels at 0.25 rad, level full", "yaw rate beside that of its path, relative", 0.02,
              "u tan(d)/L, and slip angles of a slow car", backwards),
          car("tyres-do-not-pull", "a wheel in the air hangs on the road and drags the body down",
              "150 km/h on a road of class E, level full", "N of pull", 0.0, "a tyre only pushes", tyres_pull),
          car("steps-agree", "the ride depends on the step: what is tuned at 1 ms is wrong at 2",
              "the same, steps of 0.5, 1 and 2 ms", "rms of pitch, relative", 1e-3,
              "fourth order: what is left are wheels that leave the road within a step", steps_agree),
          car("far-from-the-origin", "single precision 10,000 km away has steps of a metre",
              "ten seconds of slalom at 90 km/h, here and 10,000 km on, level full", "m and rad apart", 1e-6,
              "5,000 steps of a rounding of 1.9e-9 m, as they fall", far_away)};
}

}  // namespace phare::hard
