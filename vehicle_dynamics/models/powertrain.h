// Pedals to wheel torques: engine, automatic gearbox, brakes with ABS, parking brake. One for all levels of the car.
//
// What: torque of each wheel from accelerator, brake and gear.
// Source: T. D. Gillespie, Fundamentals of Vehicle Dynamics, 1992, ch. 2 (tractive effort), ch. 3 (brake
//   proportioning); ABS after Bosch Automotive Handbook, chapter wheel slip control systems: pressure held in a band
//   around the slip of the highest force, per front wheel, both rear wheels by the worse one ("select low"). Where that
//   slip lies a controller finds by trying; here the tyre and the friction under the wheel tell. Lags chosen: engine
//   0.1 s, brake pressure 0.06 s.
// Frame: torque > 0 drives forwards.
// Leaves out: clutch and converter dynamics (the converter is a torque ratio falling with speed), shift jerk,
//   differential locks, traction control, brake fade. Hill hold holds on level ground, too.
// Tests: tests/vehicle_dynamics/powertrain_test.cpp (gearbox, power, ABS, the same at every level),
//   hard_cases_test.cpp (gear change while rolling).
#pragma once

#include <array>

#include "config/vehicle.h"
#include "vehicle_dynamics/state.h"

namespace phare::powertrain {

struct State {
  double drive_nm = 0.0;  ///< of all wheels together, after the lag
  double brake_01 = 0.0;  ///< pressure after the lag
  double gear = 0.0;      ///< counted from 0; a number so that the state stays plain
  double since_shift_s = 1e3;
  double engine_radps = 0.0;                         ///< 0 without an engine in the vehicle file
  double held_01 = 0.0, held_s = 0.0;                ///< by hill hold: pedal, and for how long
  std::array<double, 4> abs_01{1.0, 1.0, 1.0, 1.0};  ///< share of the pressure that ABS lets through

  friend bool operator==(const State&, const State&) = default;
};

/// How the wheels turn.
struct Wheels {
  std::array<double, 4> spin_radps{};
  std::array<double, 4> ahead_mps{};  ///< of the hubs, along the car
  std::array<double, 4> peak_slip{};  ///< of the tyre on what lies under it; 0 where the model has no slip: no ABS
};

/// Wheels that roll without slip.
inline Wheels rolling(double speed_mps, double radius_m) {
  Wheels w;
  w.spin_radps.fill(speed_mps / radius_m), w.ahead_mps.fill(speed_mps);
  return w;
}

struct Torques {
  std::array<double, 4> drive_nm{}, brake_nm{};
};

/// One step. `speed_mps` along the car.
Torques advance(const VehicleParams& vehicle, const Controls& input, double speed_mps, const Wheels& wheels,
                State& state, double dt);

/// Of a car that is in motion already, pushed by `force_n` at its treads and doing `speed_mps`: the lags are over, the
/// gear is the highest that it would not shift down from.
State under_way(const VehicleParams& vehicle, double speed_mps, double force_n);

/// Of a car that has stood with its driver's foot where it is: brake pressure is there, the engine pulls nothing yet.
State standing(const VehicleParams& vehicle, const Controls& input);

/// What the parking brake asks of one rear wheel.
inline double parking_nm(const VehicleParams& v, double parking_01) {
  return 0.5 * kParkingShare_01 * parking_01 * v.max_brake_force_n * v.tyre_radius_m;
}

/// Full-load torque of the engine, linear between the points of its curve.
double engine_torque_nm(const EngineParams& engine, double speed_radps);

}  // namespace phare::powertrain
