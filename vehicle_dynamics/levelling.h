// Headlamp levelling: how the lamps stand in the body that carries them.
//
// What: the pitch that an actuator gives the lamps against the body: by the wheel at the dashboard, by the static load,
//   or by a dynamic system that follows the axles' travel.
// Source: UN R48, 6.2.6 (vertical orientation and its levelling devices); the dynamic system as a first-order filter of
//   the body's pitch against the axles and an actuator with a limited rate, filter and rate from the vehicle file.
// Frame: angles of the lamps against the body, > 0 up, as lighting engineers speak.
// Leaves out: different filters for driving steadily and braking, sensor quantisation.
// Tests: tests/vehicle_dynamics/running_test.cpp (filter, rate, load), process_test.cpp (tilt on the bus).
#pragma once

#include "config/vehicle.h"

namespace phare::levelling {

enum class Kind { kNone, kManual, kStatic, kDynamic };

/// What the dynamics moves by itself: the driver's wheel is none of it, the cockpit sends its angle to the picture.
inline Kind kind_of(LevellingSystem system) {
  return system == LevellingSystem::kStatic    ? Kind::kStatic
         : system == LevellingSystem::kDynamic ? Kind::kDynamic
                                               : Kind::kNone;
}

struct State {
  double measured_rad = 0.0;  ///< body pitch against the axles as filtered, nose down > 0
  double tilt_rad = 0.0;      ///< of the lamps against the body, > 0 up
};

/// Of a car that has stood with its load before the drive: systems that move by themselves have done so.
State settled(const LevellingParams& params, Kind kind, double rest_pitch_rad);

/// One step. `axle_pitch_rad`: pitch of the body against its axles or the road, nose down > 0, rest 0; `wheel_steps`:
/// of the manual wheel, 0 upwards. kStatic follows the pitch only while the car stands.
void advance(const LevellingParams& params, Kind kind, double wheel_steps, double axle_pitch_rad, double speed_mps,
             State& state, double dt);

/// Height of the cut-off on an upright wall 25 m ahead of the lamp, over the level ground under the car's origin, m:
/// what an aiming screen shows. `pitch_rad`, `heave_m` of the body, nose down and up > 0, heave at the car's origin.
double cutoff_on_wall_m(const LevellingParams& params, double pitch_rad, double heave_m, double tilt_rad);

inline constexpr double kWall_m = 25.0;

}  // namespace phare::levelling
