#include "vehicle_dynamics/models/energy.h"

#include <algorithm>
#include <array>

#include "config/base/conventions.h"
#include "vehicle_dynamics/models/air.h"
#include "vehicle_dynamics/models/full_parts.h"
#include "vehicle_dynamics/models/single_track_parts.h"

namespace phare::energy {
namespace {

// Powers at one moment, W, and what the road needs to be followed over a step.
struct Flow {
  double car_j = 0.0, engine_w = 0.0, brakes_w = 0.0, tyres_w = 0.0, air_w = 0.0;
  std::array<double, 4> damper_n{}, closing_mps{};         // of the dampers
  std::array<double, 4> up_n{}, ground_m{}, x_m{}, y_m{};  // of the tyres' loads; contacts in the world
  std::array<double, 4> rising_mps{};                      // of the road under the wheels, level single-track
  double along_n = 0.0, heaving_mps = 0.0;                 // what its body's way along the plane lifts it by
  std::array<double, 3> normal{0.0, 0.0, 1.0};
};

// Of two numbers that go evenly from their first to their second value: a rough road turns them within a step.
double mean_product(double a0, double a1, double b0, double b1) {
  return (2.0 * (a0 * b0 + a1 * b1) + a0 * b1 + a1 * b0) / 6.0;
}

void add_means(const Flow& a, const Flow& b, double dt, Account& to) {
  to.engine_j += 0.5 * dt * (a.engine_w + b.engine_w), to.brakes_j += 0.5 * dt * (a.brakes_w + b.brakes_w);
  to.tyres_j += 0.5 * dt * (a.tyres_w + b.tyres_w);
  for (std::size_t i = 0; i < 4; ++i)
    to.dampers_j += dt * mean_product(a.damper_n[i], b.damper_n[i], a.closing_mps[i], b.closing_mps[i]);
  to.air_j += 0.5 * dt * (a.air_w + b.air_w);
  to.car_j = b.car_j;
}

constexpr double kKnee_mps = 0.05;  // of rolling resistance, as in the models

double air_w(const chassis::Params& p, const chassis::Input& in, double u) {
  return in.air_and_rolling ? drag_n(p.drag_area_m2, u) * u : 0.0;
}

Flow flow(const full::Params& p, const chassis::Input& in, const full::Held& held, const full::State& s, double t_s) {
  const full::Geometry g = full::geometry(p, in, s, t_s);
  full::Contact c;
  full::TyreForces tyres;
  full::State d;
  full::kinematics(p, held, g, held.steer, s, d, c);
  full::dynamics(p, in, held, g, c, s, d, tyres);
  Flow out;
  full::Forces f;
  out.normal = g.normal_world, out.ground_m = g.ground_m;
  for (std::size_t i = 0; i < 4; ++i) {
    const double spin = s.spin_radps[i], vx = s.u_mps - s.r_radps * p.y_m[i], vy = s.v_mps + s.r_radps * p.x_m[i];
    const double ahead = vx * c.along[i][0] + vy * c.along[i][1] + s.rise_mps[i] * c.along[i][2];
    const double aside = vx * c.left[i][0] + vy * c.left[i][1] + s.rise_mps[i] * c.left[i][2];
    const double rolling = in.air_and_rolling && !held.locked[i]
                               ? p.rolling_coefficient * tyres.load_n[i] * c.rolling_mps[i] * c.rolling_mps[i] /
                                     std::hypot(c.rolling_mps[i], kKnee_mps)
                               : 0.0;
    const double squeezed_n = p.tyre_rate_npm * std::max(g.squeeze_m[i], 0.0);
    out.engine_w += in.drive_nm[i] * spin;
    out.brakes_w += std::abs(held.brake_nm[i] * spin);
    out.tyres_w += tyres.fx_n[i] * (spin * p.radius_m - ahead) - tyres.fy_n[i] * aside + rolling +
                   (tyres.load_n[i] - squeezed_n) * c.closing_mps[i];
    out.closing_mps[i] = d.travel_m[i], out.damper_n[i] = p.damper_nspm[i] * d.travel_m[i];
    out.up_n[i] = tyres.load_n[i], out.x_m[i] = s.x_m + g.x_m[i], out.y_m[i] = s.y_m + g.y_m[i];
    f.load_n[i] = squeezed_n;
  }
  out.air_w = air_w(p, in, s.u_mps);
  out.car_j = full::energy_j(p, s, f);
  return out;
}

// The other levels know no wheels of their own; the body hangs on springs over the road as it was asked for.
Flow flow(const single_track::Params& p, const single_track::Held& h, const single_track::State& s, double t_s,
          const chassis::Input& in) {
  const chassis::Params& car = p.car;
  const single_track::Acting a = single_track::acting(p, h, single_track::grip(p, h, s).share, s, t_s);
  Flow out;
  const double vf = s.v_mps + car.x_m[0] * s.r_radps, vr = s.v_mps + car.x_m[2] * s.r_radps;
  const std::array<double, 2> ahead{s.u_mps * h.cosine + vf * h.sine, s.u_mps},
      aside{vf * h.cosine - s.u_mps * h.sine, vr}, side{a.front_y_n, a.rear_y_n};
  out.car_j = 0.5 * (p.effective_kg * s.u_mps * s.u_mps + car.mass_kg * s.v_mps * s.v_mps +
                     car.yaw_inertia_kgm2 * s.r_radps * s.r_radps + car.sprung_kg * s.z_rate_mps * s.z_rate_mps +
                     car.pitch_inertia_kgm2 * s.pitch_rate_ps * s.pitch_rate_ps +
                     car.roll_inertia_kgm2 * s.roll_rate_ps * s.roll_rate_ps);
  const double leaning = s.roll - h.across - h.across_rate_ps * t_s;
  for (std::size_t k = 0; k < 2; ++k) {
    const single_track::Axle& axle = p.axles[k];
    const single_track::Under& road = k == 0 ? h.front : h.rear;
    const int lane = static_cast<int>(k);
    const double drive_n = (in.drive_nm[2 * k] + in.drive_nm[2 * k + 1]) * p.per_radius_m;
    const double push_n = k == 0 ? h.front_push_n : h.rear_push_n;
    // Of it, by friction; what only holds the car against its brakes does no work, though a turned wheel slips aside.
    const double passed = h.stopped ? 0.0 : push_n != 0.0 ? a.ahead_n[lane] / push_n : 1.0;
    out.engine_w += passed * drive_n * ahead[k];
    out.brakes_w -= passed * (push_n - drive_n) * ahead[k];
    // What the linkage puts on the body it takes from the road, which lifts it on a slope.
    const double linkage_n =
        k == 0 ? -std::min(a.front_x_n, 0.0) * p.front_brake_jack : std::max(a.rear_x_n, 0.0) * p.rear_drive_jack;
    out.tyres_w -= side[k] * aside[k];
    out.car_j += 0.5 * axle.bar_nmprad * leaning * leaning;
    for (std::size_t j = 0; j < 2; ++j) {
      const int track = static_cast<int>(j);
      const double y = j == 0 ? axle.half_track_m : -axle.half_track_m;
      const double height =
          road.height_m[track] + t_s * (road.rate_mps[track] + (t_s - h.dt_s) * road.bend_mps2[track]);
      const double rate = road.rate_mps[track] + (2.0 * t_s - h.dt_s) * road.bend_mps2[track];
      const double give = height - (s.z_m - axle.x_m * s.pitch + y * s.roll);
      const double closing = rate - (s.z_rate_mps - axle.x_m * s.pitch_rate_ps + y * s.roll_rate_ps);
      const std::size_t i = 2 * k + j;
      out.car_j += 0.5 * axle.spring_npm * give * give;
      out.closing_mps[i] = closing, out.damper_n[i] = axle.damper_nspm * closing;
      out.rising_mps[i] = rate;
      out.up_n[i] = axle.spring_npm * give + axle.damper_nspm * closing + 0.5 * linkage_n, out.ground_m[i] = height;
    }
  }
  out.along_n = car.sprung_kg * (a.ax_mps2 * h.rise[0] + a.ay_mps2 * h.rise[1]), out.heaving_mps = s.z_rate_mps;
  out.tyres_w += h.rolling * (a.front_load_n[0] + a.front_load_n[1] + a.rear_load_n[0] + a.rear_load_n[1]) * s.u_mps;
  out.air_w = h.drag_kgpm * std::abs(s.u_mps) * s.u_mps * s.u_mps;
  return out;
}

double kinetic_j(const VehicleParams& v, const CarState& s) {
  const double inertia = v.mass_kg + 4.0 * v.wheel_inertia_kgm2 / (v.tyre_radius_m * v.tyre_radius_m);
  return 0.5 * inertia * s.speed_mps * s.speed_mps;
}

}  // namespace

Account open(const full::Params& p, const chassis::Input& in, const full::State& s) {
  return {.car_j = flow(p, in, full::held(p, in, s, 1e-6), s, 0.0).car_j};
}

void add(const full::Params& p, const chassis::Input& in, const full::State& before, const full::State& after,
         double dt, Account& account) {
  const full::Held held = full::held(p, in, before, dt);
  const Flow a = flow(p, in, held, before, 0.0), b = flow(p, in, held, after, dt);
  add_means(a, b, dt, account);
  const auto& n = a.normal;
  for (std::size_t i = 0; i < 4; ++i) {
    const double grade = -(n[0] * (b.x_m[i] - a.x_m[i]) + n[1] * (b.y_m[i] - a.y_m[i])) / n[2];
    account.road_j += 0.5 * (a.up_n[i] + b.up_n[i]) * n[2] * (b.ground_m[i] - a.ground_m[i] - grade);
  }
}

Account open(const single_track::Params& p, const chassis::Input& in, const single_track::State& s) {
  return {.car_j = flow(p, single_track::held(p, in, s, 1e-6), s, 0.0, in).car_j};
}

void add(const single_track::Params& p, const chassis::Input& in, const single_track::State& before,
         const single_track::State& after, double dt, Account& account) {
  const single_track::Held held = single_track::held(p, in, before, dt);
  const Flow a = flow(p, held, before, 0.0, in), b = flow(p, held, after, dt, in);
  const double had_j = account.car_j, start_j = a.car_j;
  add_means(a, b, dt, account);
  // Height on the map is the road's: what the grade takes is had as height.
  const double climbed_j =
      p.car.mass_kg * kGravity_mps2 * held.level * 0.5 * (before.u_mps + after.u_mps) * dt * held.along +
      p.car.mass_kg * kGravity_mps2 * held.level * 0.5 * (before.v_mps + after.v_mps) * dt * held.bank;
  // What the way along a plane gives the heave is had in the speed along it already.
  const double twice_j = dt * mean_product(a.along_n, b.along_n, a.heaving_mps, b.heaving_mps);
  account.car_j = had_j + (b.car_j - start_j) + climbed_j - twice_j;
  for (std::size_t i = 0; i < 4; ++i)
    account.road_j += dt * mean_product(a.up_n[i], b.up_n[i], a.rising_mps[i], b.rising_mps[i]);
}

Account open(const VehicleParams& v, const CarState& s) {
  return {.car_j = kinetic_j(v, s)};
}

void add(const VehicleParams& v, const kinematic::Push& push, const CarState& before, const CarState& after, double dt,
         Account& account) {
  const double way = 0.5 * (before.speed_mps + after.speed_mps) * dt, u = before.speed_mps;
  const double climbed_j = -v.mass_kg * kGravity_mps2 * std::sin(before.road_pitch_rad) * way;
  const double drag_j = drag_n(v.drag_area_m2, u) * way;
  const double rolling_n = v.rolling_coefficient * v.mass_kg * kGravity_mps2 * std::cos(before.road_pitch_rad);
  const double held_n = push.brake_n + rolling_n;
  const double change_j = kinetic_j(v, after) - kinetic_j(v, before) + climbed_j;
  // What holds takes what is left, and no more than its force over the way.
  const double taken_j = std::min(push.drive_n * way - drag_j - change_j, held_n * std::abs(way));
  account.engine_j += push.drive_n * way, account.air_j += drag_j;
  account.brakes_j += held_n > 0.0 ? taken_j * push.brake_n / held_n : 0.0;
  account.tyres_j += held_n > 0.0 ? taken_j * rolling_n / held_n : 0.0;
  account.car_j += change_j;
}

}  // namespace phare::energy
