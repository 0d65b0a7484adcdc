// Level `single-track`: one wheel per axle in the plane, a body on springs above it.
//
// What: yaw and side slip with linear or Magic Formula tyres and their relaxation; dive, roll and heave, as a
//   dynamic second-order body over four contacts or quasi-static; load transfer onto four wheels.
// Source: M. Mitschke, H. Wallentowitz, Dynamik der Kraftfahrzeuge, 5th ed. 2014, ch. 19 (single track); D. L.
//   Milliken, W. F. Milliken, Race Car Vehicle Dynamics, 1995, ch. 5 and 18; body on springs in series with the
//   tyres, its step in ride.h.
// Frame: centre of gravity, ISO 8855; place and heave in the world, the other velocities along the plane through the
//   contacts; attitude as slopes against the horizontal, small angles.
// Leaves out: wheel hop and lift-off, wheel spin and locking (tyre force follows torque up to the friction limit),
//   differences between left and right tyres, damping of the tyres.
// Tests: tests/vehicle_dynamics/single_track_test.cpp (closed forms), reference_test.cpp (two other programs, error
//   of the integrator).
#pragma once

#include <array>

#include "vehicle_dynamics/models/chassis.h"
#include "vehicle_dynamics/models/fixed_step.h"
#include "vehicle_dynamics/models/ride.h"

namespace phare::single_track {

struct Options {
  bool magic_formula = true;     ///< false: linear in slip, no limit
  bool dynamic_attitude = true;  ///< false: body at once where the forces hold it
};

/// One axle of the body on its springs; rates of one wheel.
struct Axle {
  double x_m = 0.0, half_track_m = 0.0;        ///< from the centre of gravity
  double spring_npm = 0.0, damper_nspm = 0.0;  ///< in series with the tyre
  double bar_nmprad = 0.0;                     ///< anti-roll bar, likewise
  double bar_n = 0.0;                          ///< load that it moves from wheel to wheel per slope of roll
};

struct Params {
  chassis::Params car;
  Options options;
  Integrator integrator = Integrator::kEtd2;
  std::array<Axle, 2> axles;                             ///< front, rear
  double effective_kg = 0.0;                             ///< mass with the wheels' spin inertia
  double front_brake_jack = 0.0, rear_drive_jack = 0.0;  ///< anti-dive, anti-squat: vertical over longitudinal force
  ride::Springs springs;                                 ///< of the body, all the above together
  ride::Step ride, short_ride;                           ///< for steps of one length, see set_step(); and their parts
  // One over what is divided by in every step.
  double per_effective_kg = 0.0, per_mass_kg = 0.0, per_sprung_kg = 0.0, per_wheelbase_m = 0.0, per_tracks_m = 0.0;
  double per_roll_kgm2 = 0.0, per_pitch_kgm2 = 0.0, per_yaw_kgm2 = 0.0, per_radius_m = 0.0;
};

Result<Params> params_of(const VehicleParams& vehicle, const Options& options, const std::string& place);

/// Works out beforehand what steps of that length need; without it, or for another length, each step does so itself.
void set_step(Params& params, double dt_s);

/// All zero: at rest on a level road of height 0.
struct State {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0, path_m = 0.0;
  double u_mps = 0.0, v_mps = 0.0, r_radps = 0.0;
  double z_m = 0.0, pitch = 0.0, roll = 0.0;  ///< height over rest; slopes
  double z_rate_mps = 0.0, pitch_rate_ps = 0.0, roll_rate_ps = 0.0;
  double front_slip = 0.0, rear_slip = 0.0;  ///< tan alpha, transient

  friend bool operator==(const State&, const State&) = default;
};
inline constexpr std::size_t kStateSize = 15;
static_assert(sizeof(State) == kStateSize * sizeof(double));

/// Its springs are at rest: with a speed it rolls evenly along the plane through the contacts.
State at_rest(const Params& params, double x_m, double y_m, double yaw_rad, double speed_mps,
              const std::array<double, 4>& height_m);

/// Lets a car that stands, at_rest(), settle where `input` holds it, as full::stand(). False: there is no such place,
/// or the attitude is quasi-static, which is where forces hold it after a step anyway.
bool stand(const Params& params, const chassis::Input& input, State& state);

/// Road under the wheels of an axle (left, right) during one step, asked for once, at the step's start and where it
/// will end: t into the step its height is height + t (rate + bend (t - dt)), the parabola through both heights that
/// bends as the slopes there differ.
struct Under {
  Two height_m{}, rate_mps{}, bend_mps2{};
};

/// What is decided once for a step.
struct Held {
  Under front, rear;
  double friction = 1.0;  ///< mean of the wheels
  double dt_s = 0.0;
  double along = 0.0, across = 0.0, across_rate_ps = 0.0;  ///< slopes of the plane through the contacts: along in the
                                                           ///< step's middle, across at its start
  double bank = 0.0;                ///< of it what pulls aside: of mesh or plane, two tracks of unlike height are none
  double level = 1.0;               ///< what is left of a load on that plane
  Two on_map{1.0, 1.0};             ///< what a way along the car, and aside, is on the map
  Two rise{};                       ///< and how far it rises
  double cosine = 1.0, sine = 0.0;  ///< of the steering
  double yaw_cosine = 1.0, yaw_sine = 0.0;       ///< of the heading in the middle of the step
  double front_push_n = 0.0, rear_push_n = 0.0;  ///< drive less brake torque at the tread
  Two reach{1.0, 1.0};      ///< of an axle's friction what brakes can use: a patch that slides aside gives little along
  double sticks_mps = 0.0;  ///< speed that the brakes of those patches that do not slide aside end within the step
  double drag_kgpm = 0.0, rolling = 0.0;  ///< drag over speed squared; rolling resistance over load
  bool stopped = false;                   ///< brakes hold the car along its x
  bool off_road = false;
  double most_slip_pm = std::numeric_limits<double>::infinity();
};
Held held(const Params& params, const chassis::Input& input, const State& state, double dt);
void finish_step(const chassis::Input& input, const Held& held, const State& before, State& state);

void derivative(const Params& params, const Held& held, const State& state, double t_s, State& rate);

/// One step of dt seconds.
void advance(const Params& params, const chassis::Input& input, State& state, double dt);

chassis::Forces forces(const Params& params, const chassis::Input& input, const State& state);

}  // namespace phare::single_track
