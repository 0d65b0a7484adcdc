// The larger models for tests: a car on a road, driven by torques or pedals.
#pragma once

#include <cmath>
#include <cstdlib>

#include "test_car.h"
#include "vehicle_dynamics/models/full.h"
#include "vehicle_dynamics/models/single_track.h"

namespace phare::test {

/// Hours instead of minutes of simulated time.
inline bool long_run() {
  return std::getenv("PHARE_LONG_TESTS") != nullptr;
}

constexpr double kDeg = 180.0 / 3.14159265358979323846;

/// The 320i of the references: relaxation as in its file, unless lengths are given.
inline full::Params full_car(const char* file = "bmw_320i.toml", double long_relaxation_m = 0.0,
                             double lat_relaxation_m = 0.0) {
  VehicleParams vehicle = car(file);
  if (long_relaxation_m > 0.0) {
    vehicle.chassis->tyre.long_relaxation_m = long_relaxation_m;
    vehicle.chassis->tyre.lat_relaxation_m = lat_relaxation_m;
  }
  Result<full::Params> params = full::params_of(vehicle, file);
  if (!params) throw std::runtime_error(params.error().text());
  return *params;
}

/// As the notes' hard cases have it: relaxation 0.3 m along, 0.5 m across.
inline full::Params hard_car() {
  return full_car("bmw_320i.toml", 0.3, 0.5);
}

inline single_track::Params single_car(single_track::Options options = {}, const char* file = "bmw_320i.toml") {
  Result<single_track::Params> params = single_track::params_of(car(file), options, file);
  if (!params) throw std::runtime_error(params.error().text());
  return *params;
}

/// A car and its input, advanced together.
struct Drive {
  full::Params params;
  full::Input input;
  full::State state;
  double time_s = 0.0;

  explicit Drive(const full::Params& p, double speed_mps = 0.0, const Road* road = nullptr) : params(p) {
    input.road = road;
    input.air_and_rolling = false;
    std::array<double, 4> height{};
    bool off = false;
    if (road)
      for (std::size_t i = 0; i < 4; ++i)
        height[i] = road->at(p.x_m[i], p.y_m[i], p.x_m[i], p.y_m[i] > 0.0, 0.0, &off).z_m;
    state = full::at_rest(p, 0.0, 0.0, 0.0, speed_mps, height);
  }
  void step(double dt) {
    full::advance(params, input, state, dt);
    time_s += dt;
  }
  template <class Each>
  void run(double seconds, double dt, Each&& each) {
    const auto steps = static_cast<long>(std::llround(seconds / dt));
    for (long i = 0; i < steps; ++i) step(dt), each(*this);
  }
  void run(double seconds, double dt) {
    run(seconds, dt, [](const Drive&) {});
  }
  full::Forces forces() const { return full::forces(params, input, state); }
  double pitch_rad() const { return forces().pitch_rad; }
  double roll_rad() const { return forces().roll_rad; }

  /// Brake torque that decelerates the car by that much, 66 % in front.
  void brake(double mps2) {
    const double torque = params.mass_kg * mps2 * params.radius_m;
    input.brake_nm = {0.33 * torque, 0.33 * torque, 0.17 * torque, 0.17 * torque};
  }
};

inline bool finite(const full::State& s) {
  const double* values = &s.x_m;
  for (std::size_t i = 0; i < full::kStateSize; ++i)
    if (!std::isfinite(values[i])) return false;
  return true;
}

}  // namespace phare::test
