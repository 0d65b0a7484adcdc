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

/// The same at level single-track.
struct Track {
  single_track::Params params;
  full::Input input;
  single_track::State state;
  double time_s = 0.0;

  explicit Track(const single_track::Params& p, double speed = 0.0)
      : params(p), state(single_track::at_rest(p, 0.0, 0.0, 0.0, speed, {})) {
    input.air_and_rolling = false;
  }
  void step(double dt) {
    single_track::advance(params, input, state, dt);
    time_s += dt;
  }
  template <class Each>
  void run(double seconds, double dt, Each&& each) {
    single_track::set_step(params, dt);
    for (long i = 0; i < std::lround(seconds / dt); ++i) step(dt), each(*this);
  }
  void run(double seconds, double dt) {
    run(seconds, dt, [](const Track&) {});
  }
  full::Forces forces() const { return single_track::forces(params, input, state); }
  void brake(double mps2) {
    const double torque = params.car.mass_kg * mps2 * params.car.radius_m;
    input.brake_nm = {0.33 * torque, 0.33 * torque, 0.17 * torque, 0.17 * torque};
  }
};

/// Most of the friction ellipse that a wheel uses: at most 1. `friction`: under each wheel.
inline double friction_use(const chassis::Params& p, const full::Forces& f, const std::array<double, 4>& friction) {
  double most = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (f.load_n[i] <= 0.0) {
      most = std::max(most, f.fx_n[i] != 0.0 || f.fy_n[i] != 0.0 ? 1e9 : 0.0);  // in the air nothing holds
      continue;
    }
    const double x = f.fx_n[i] / (friction[i] * p.tyre.p.long_peak * f.load_n[i]);
    const double y = f.fy_n[i] / (friction[i] * p.tyre.p.lat_peak * f.load_n[i]);
    most = std::max(most, x * x + y * y);
  }
  return most;
}

/// What lies under each wheel along the car's way; within 5 cm of a border, which pitch and roll move, the better of
/// both.
inline std::array<double, 4> friction_under(const full::Params& p, const Road& road, double path_m) {
  std::array<double, 4> most{};
  for (const double beside_m : {-0.05, 0.0, 0.05})
    for (std::size_t i = 0; i < 4; ++i)
      most[i] = std::max(most[i], road.laid(path_m + p.x_m[i] + beside_m).friction[i % 2]);
  return most;
}

inline bool finite(const full::State& s) {
  const double* values = &s.x_m;
  for (std::size_t i = 0; i < full::kStateSize; ++i)
    if (!std::isfinite(values[i])) return false;
  return true;
}

}  // namespace phare::test
