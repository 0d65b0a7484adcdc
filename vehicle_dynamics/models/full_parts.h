// Parts of level `full` that its integrators put together: where the wheels are, how things move, what forces do.
#pragma once

#include <array>

#include "vehicle_dynamics/models/full.h"

namespace phare::full {

/// Where body and wheels are against the road.
struct Geometry {
  std::array<double, 9> world_from_body{};         ///< rows
  std::array<double, 3> normal_world{}, normal{};  ///< along which the tyres are loaded; in the world, in body axes
  std::array<double, 4> x_m{}, y_m{};              ///< contacts from the centre of gravity, world axes
  double ahead_x = 1.0, ahead_y = 0.0;             ///< where the car heads on the map, unit
  std::array<double, 4> tilt_m{};                  ///< heights that span the plane of that normal
  std::array<double, 4> ground_m{}, friction{}, squeeze_m{};
  bool off_road = false;
};
std::array<double, 3> normal_of(const std::array<double, 4>& x_m, const std::array<double, 4>& y_m,
                                const std::array<double, 4>& z_m);
Geometry geometry(const Params& params, const Input& input, const State& state, double t_s);

Steer steer_angles(const Params& params, double mean_rad);

/// How the contact patches move.
struct Contact {
  std::array<std::array<double, 3>, 4> along{}, left{};              ///< wheel directions in the road plane, body axes
  std::array<double, 4> rolling_mps{}, moving_mps{}, closing_mps{};  ///< moving: the patch, rolling or sliding
  std::array<double, 8> decay_ps{}, stretch_mps{};                   ///< kappa of the four wheels, then tan_alpha
};

struct TyreForces {
  std::array<double, 4> load_n{}, fx_n{}, fy_n{}, net_nm{};  ///< net: torque that turns a locked wheel's brake
  double ax_mps2 = 0.0, ay_mps2 = 0.0;
};

/// Rates of position, attitude, travel and slip.
void kinematics(const Params& params, const Held& held, const Geometry& geometry, const Steer& steer,
                const State& state, State& rate, Contact& contact);

/// Rates of velocities and spins; reads rate.travel_m.
void dynamics(const Params& params, const Input& input, const Held& held, const Geometry& geometry,
              const Contact& contact, const State& state, State& rate, TyreForces& tyres);

}  // namespace phare::full
