// Pedals to wheel torques: engine, automatic gearbox, brakes with ABS, parking brake.
//
// What: torque of each wheel from accelerator, brake and gear.
// Source: T. D. Gillespie, Fundamentals of Vehicle Dynamics, 1992, ch. 2 (tractive effort), ch. 3 (brake
//   proportioning); ABS as a slip band controller per front wheel, both rear wheels by the worse one ("select
//   low"), after Bosch Automotive Handbook, chapter wheel slip control systems; lags chosen: engine 0.1 s, brake
//   pressure 0.06 s.
// Frame: torque > 0 drives forwards.
// Leaves out: clutch and converter dynamics (the converter is a torque ratio falling with speed), shift jerk, idle
//   creep, differential locks, traction control, brake fade.
// Tests: tests/vehicle_dynamics/running_test.cpp (gearbox and ABS), hard_cases_test.cpp (gear change while rolling).
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
  std::array<double, 4> abs_01{1.0, 1.0, 1.0, 1.0};  ///< share of the pressure that ABS lets through

  friend bool operator==(const State&, const State&) = default;
};

struct Torques {
  std::array<double, 4> drive_nm{}, brake_nm{};
};

/// One step. `speed_mps` along the car, `spin_radps` of the wheels (for ABS and engine speed). `has_slip` false: a
/// model without wheel slip, so no ABS.
Torques advance(const VehicleParams& vehicle, const Controls& input, double speed_mps,
                const std::array<double, 4>& spin_radps, bool has_slip, State& state, double dt);

/// Full-load torque of the engine, linear between the points of its curve.
double engine_torque_nm(const EngineParams& engine, double speed_radps);

}  // namespace phare::powertrain
