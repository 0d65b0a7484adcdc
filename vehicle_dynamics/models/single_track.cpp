#include "vehicle_dynamics/models/single_track.h"

#include <algorithm>
#include <cmath>

#include "config/conventions.h"

namespace phare::single_track {
namespace {

constexpr double kAirDensity_kgpm3 = 1.2041;  // dry air, 20 degrees C, 101325 Pa

double sign(double value) {
  return value > 0.0 ? 1.0 : (value < 0.0 ? -1.0 : 0.0);
}

// The plane through the four contacts, as slopes along and across the car; > 0 rises forwards, to the left.
struct Slopes {
  double along = 0.0, across = 0.0;
};
Slopes slopes(const full::Params& car, const std::array<double, 4>& h) {
  return {0.5 * (h[0] + h[1] - h[2] - h[3]) / car.wheelbase_m,
          (h[0] + h[2] - h[1] - h[3]) / (car.y_m[0] - car.y_m[1] + car.y_m[2] - car.y_m[3])};
}

// Attitude is kept as slopes: on a steep plane an angle more is a larger step of slope, d tan = (1 + tan2) d angle.
double steep(double slope) {
  return 1.0 + slope * slope;
}

// Everything the tyres and springs do at a state.
struct Acting {
  std::array<double, 4> height_m{}, spring_n{}, load_n{};
  Slopes plane;
  double gx = 0.0, gy = 0.0;
  double front_x_n = 0.0, rear_x_n = 0.0, front_y_n = 0.0, rear_y_n = 0.0;  ///< in the wheels' heading
  double push_n = 0.0;                                                      ///< along the car without brakes
  double fx_n = 0.0, fy_n = 0.0;                                            ///< of the tyres, along the car's axes
  double ax_mps2 = 0.0, ay_mps2 = 0.0;
  std::array<double, 2> slip_rate_ps{}, slip_decay_ps{};
};

// Side force of an axle whose longitudinal force uses up a part of the friction.
double side_force_n(const Params& p, double slip, double load_n, double friction, double used) {
  const tyre::Constants& t = p.car.tyre;
  if (!p.options.magic_formula) return t.p.lat_stiffness * load_n * slip;
  const double bs = t.by / friction * slip;
  const double bent = bs - t.p.lat_curvature * (bs - std::atan(bs));
  const double pure = friction * t.p.lat_peak * load_n * std::sin(t.p.lat_shape * std::atan(bent));
  return used == 0.0 ? pure : pure * std::sqrt(std::max(0.0, 1.0 - used * used));
}

Acting acting(const Params& p, const full::Input& in, const Held& held, const State& s, double t_s) {
  const full::Params& car = p.car;
  Acting a;
  // body over its contacts
  for (std::size_t i = 0; i < 4; ++i) {
    a.height_m[i] = held.road.height_m[i] + held.road.rate_mps[i] * t_s;
    const double lift = s.z_m - car.x_m[i] * s.pitch + car.y_m[i] * s.roll - a.height_m[i];
    const double rate =
        s.z_rate_mps - car.x_m[i] * s.pitch_rate_ps + car.y_m[i] * s.roll_rate_ps - held.road.rate_mps[i];
    a.spring_n[i] = -p.spring_npm[i] * lift - (p.options.dynamic_attitude ? p.damper_nspm[i] * rate : 0.0);
  }
  a.plane = slopes(car, a.height_m);
  const double level = 1.0 / std::sqrt(1.0 + a.plane.along * a.plane.along + a.plane.across * a.plane.across);
  a.gx = -kGravity_mps2 * a.plane.along * level;
  a.gy = -kGravity_mps2 * a.plane.across * level;
  const double roll = s.roll - a.plane.across;
  for (std::size_t i = 0; i < 4; ++i) {
    const double track = car.y_m[i & 2u] - car.y_m[(i & 2u) + 1u], bar = i < 2 ? p.front_bar_nmprad : p.rear_bar_nmprad;
    a.load_n[i] = std::max(0.0, car.load_n[i] * level + a.spring_n[i] - sign(car.y_m[i]) * bar * roll / track);
  }
  const double front_load = a.load_n[0] + a.load_n[1], rear_load = a.load_n[2] + a.load_n[3];

  // along: torque over radius up to the limit of friction
  const double mu = held.road.friction, r = car.radius_m;
  const double front_limit = mu * car.tyre.p.long_peak * front_load, rear_limit = mu * car.tyre.p.long_peak * rear_load;
  const double drive_f = (in.drive_nm[0] + in.drive_nm[1]) / r, drive_r = (in.drive_nm[2] + in.drive_nm[3]) / r;
  const double brake_f = (in.brake_nm[0] + in.brake_nm[1]) / r, brake_r = (in.brake_nm[2] + in.brake_nm[3]) / r;
  double rolling = 0.0, drag = 0.0;
  if (in.air_and_rolling) {
    drag = 0.5 * kAirDensity_kgpm3 * car.drag_area_m2 * s.u_mps * std::abs(s.u_mps);
    rolling = car.rolling_coefficient * (front_load + rear_load) * s.u_mps / std::sqrt(s.u_mps * s.u_mps + 0.0025);
  }
  const double ahead_f = std::clamp(drive_f - held.brake_sign * brake_f, -front_limit, front_limit);
  const double ahead_r = std::clamp(drive_r - held.brake_sign * brake_r, -rear_limit, rear_limit);

  // across
  const double vf = s.v_mps + car.x_m[0] * s.r_radps, vr = s.v_mps + car.x_m[2] * s.r_radps;
  const double ahead = s.u_mps * held.cosine + vf * held.sine, aside = vf * held.cosine - s.u_mps * held.sine;
  const auto front = tyre::slip_rate(car.tyre, 0.0, s.front_slip, ahead, aside, ahead, held.most_slip_pm);
  const auto rear = tyre::slip_rate(car.tyre, 0.0, s.rear_slip, s.u_mps, vr, s.u_mps, held.most_slip_pm);
  a.slip_rate_ps = {front.tan_alpha_ps, rear.tan_alpha_ps};
  a.slip_decay_ps = {front.tan_alpha_decay_ps, rear.tan_alpha_decay_ps};
  const auto damping = [&](const tyre::SlipRate& slip, double speed, double load) {
    constexpr double kDampedBelow_mps = 2.0, kFullDamping_n = 2700.0;  // as in level full
    const double fade = 1.0 - std::abs(speed) / kDampedBelow_mps;
    return fade <= 0.0 ? 0.0
                       : car.tyre.p.carcass_damping_nspm * fade * load / kFullDamping_n * slip.tan_alpha_stretch_mps;
  };
  const double used_f = front_limit > 0.0 ? ahead_f / front_limit : 1.0,
               used_r = rear_limit > 0.0 ? ahead_r / rear_limit : 1.0;
  const double side_f = mu * car.tyre.p.lat_peak * front_load, side_r = mu * car.tyre.p.lat_peak * rear_load;
  a.front_y_n = side_force_n(p, s.front_slip, front_load, mu, used_f) + damping(front, ahead, front_load);
  a.rear_y_n = side_force_n(p, s.rear_slip, rear_load, mu, used_r) + damping(rear, s.u_mps, rear_load);
  if (p.options.magic_formula) {
    a.front_y_n = std::clamp(a.front_y_n, -side_f, side_f);
    a.rear_y_n = std::clamp(a.rear_y_n, -side_r, side_r);
  }

  // What torque leaves for the car after spinning up its own wheels.
  a.push_n = drive_f * held.cosine + drive_r + car.mass_kg * a.gx;
  const double pull = ahead_f * held.cosine - a.front_y_n * held.sine + ahead_r - drag - rolling + car.mass_kg * a.gx;
  const double accel = held.stopped ? 0.0 : pull / p.effective_kg;
  const double spun = 0.5 * (p.effective_kg - car.mass_kg) * accel;
  a.front_x_n = ahead_f - spun, a.rear_x_n = ahead_r - spun;
  a.fx_n = held.stopped ? -car.mass_kg * a.gx : a.front_x_n * held.cosine - a.front_y_n * held.sine + a.rear_x_n;
  a.fy_n = a.front_x_n * held.sine + a.front_y_n * held.cosine + a.rear_y_n;
  if (held.stopped) a.fy_n = a.front_y_n * held.cosine + a.rear_y_n;
  a.ax_mps2 = accel;
  a.ay_mps2 = a.fy_n / car.mass_kg + a.gy;
  return a;
}

// Where constant forces hold the body: front and rear springs share the transfer, the roll stiffness the side force.
void settle(const Params& p, const Acting& a, State& s) {
  const full::Params& car = p.car;
  const double transfer =
      car.cg_height_m * a.fx_n * steep(a.plane.along) / car.wheelbase_m;  // from the front axle to the rear one
  const double jack_f = -std::min(a.front_x_n, 0.0) * p.front_brake_jack,
               jack_r = std::max(a.rear_x_n, 0.0) * p.rear_drive_jack;
  const double front_up = (transfer + jack_f) / (p.spring_npm[0] + p.spring_npm[1]);
  const double rear_up = (-transfer + jack_r) / (p.spring_npm[2] + p.spring_npm[3]);
  const double front = 0.5 * (a.height_m[0] + a.height_m[1]) + front_up,
               rear = 0.5 * (a.height_m[2] + a.height_m[3]) + rear_up;
  s.pitch = (rear - front) / car.wheelbase_m;
  s.z_m = front + car.x_m[0] * s.pitch;
  double stiffness = p.front_bar_nmprad + p.rear_bar_nmprad;
  for (std::size_t i = 0; i < 4; ++i) stiffness += p.spring_npm[i] * car.y_m[i] * car.y_m[i];
  const double toppling = car.sprung_kg * car.cg_height_m;
  s.roll =
      a.plane.across + toppling * a.fy_n / car.mass_kg * steep(a.plane.across) / (stiffness - toppling * kGravity_mps2);
}

}  // namespace

Result<Params> params_of(const VehicleParams& vehicle, const Options& options, const std::string& place) {
  Result<full::Params> car = full::params_of(vehicle, place);
  if (!car) return Error{place, "level single-track needs the tables [body] and [tyre] in the vehicle file"};
  Params p;
  p.car = *car;
  p.options = options;
  for (std::size_t i = 0; i < 4; ++i) {
    const double share = p.car.tyre_rate_npm / (p.car.spring_npm[i] + p.car.tyre_rate_npm);
    p.spring_npm[i] = p.car.spring_npm[i] * share;
    p.damper_nspm[i] =
        p.car.damper_nspm[i] * share * share;  // the spring's share of the whole stroke, in rate and force
  }
  const auto bar = [&](std::size_t left) {
    const double track = p.car.y_m[left] - p.car.y_m[left + 1], half2 = 0.5 * track * track;
    const double springs = p.car.spring_npm[left] * half2 + p.car.bar_npm[left] * track * track;
    const double tyres = p.car.tyre_rate_npm * half2;
    return springs * tyres / (springs + tyres) - p.spring_npm[left] * half2;
  };
  p.front_bar_nmprad = bar(0), p.rear_bar_nmprad = bar(2);
  p.effective_kg = p.car.mass_kg + 4.0 * p.car.spin_inertia_kgm2 / (p.car.radius_m * p.car.radius_m);
  p.front_brake_jack = p.car.brake_jack[0], p.rear_drive_jack = p.car.drive_jack[2];
  return p;
}

State at_rest(const Params& p, double x_m, double y_m, double yaw_rad, double speed_mps,
              const std::array<double, 4>& h) {
  State s;
  s.x_m = x_m, s.y_m = y_m, s.yaw_rad = yaw_rad, s.path_m = x_m;
  s.u_mps = speed_mps;
  const Slopes plane = slopes(p.car, h);
  s.pitch = -plane.along, s.roll = plane.across;
  s.z_m = 0.5 * (h[0] + h[1]) + p.car.x_m[0] * s.pitch;
  return s;
}

Under under(const Params& p, const full::Input& in, const State& s, double dt) {
  Under road;
  if (in.heights_given) {
    road.height_m = in.height_m, road.rate_mps = in.height_rate_mps;
    if (in.road) road.friction = in.road->friction_everywhere;
    return road;
  }
  if (!in.road) return road;
  // Along a road that is made of profiles only, where the car is in the world does not matter.
  const bool placed = in.road->mesh || in.road->slope_x != 0.0 || in.road->slope_y != 0.0;
  const double c = placed ? std::cos(s.yaw_rad) : 1.0, sn = placed ? std::sin(s.yaw_rad) : 0.0;
  const double dx = (s.u_mps * c - s.v_mps * sn) * dt, dy = (s.u_mps * sn + s.v_mps * c) * dt;
  double friction = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = s.x_m + c * p.car.x_m[i] - sn * p.car.y_m[i], y = s.y_m + sn * p.car.x_m[i] + c * p.car.y_m[i];
    const double path = s.path_m + p.car.x_m[i];
    const bool left = p.car.y_m[i] > 0.0;
    const Ground here = in.road->at(x, y, path, left, in.height_m[i], &road.off_road);
    const Ground there = in.road->at(x + dx, y + dy, path + s.u_mps * dt, left, in.height_m[i], &road.off_road);
    road.height_m[i] = here.z_m;
    road.rate_mps[i] = dt > 0.0 ? (there.z_m - here.z_m) / dt : 0.0;
    friction += 0.25 * here.friction;
  }
  road.friction = friction;
  return road;
}

Held held(const Params& p, const full::Input& in, const State& s, double dt) {
  Held h;
  h.road = under(p, in, s, dt);
  h.steer_rad = in.steer_rad;
  h.cosine = std::cos(in.steer_rad), h.sine = std::sin(in.steer_rad);
  h.brake_sign = sign(s.u_mps);
  if (p.integrator == Integrator::kRk4) {
    const double fastest =
        std::abs(s.u_mps) + std::abs(h.sine) * (std::abs(s.v_mps) + p.car.x_m[0] * std::abs(s.r_radps));
    h.most_slip_pm = 1.0 / std::max(0.5 * fastest * dt, 1e-6);
  }
  double brake = 0.0;
  for (const double torque : in.brake_nm) brake += torque / p.car.radius_m;
  if (brake > 0.0 && std::abs(s.u_mps) * p.effective_kg <= dt * brake) {
    const Acting a = acting(p, in, h, s, 0.0);
    const double limit = h.road.friction * p.car.tyre.p.long_peak * p.car.mass_kg * kGravity_mps2;
    h.stopped = std::abs(a.push_n) <= std::min(brake, limit);
    if (!h.stopped && s.u_mps == 0.0) h.brake_sign = sign(a.push_n);
  }
  return h;
}

void finish_step(const full::Input& in, const Held& h, const State& before, State& s) {
  const bool braked = in.brake_nm[0] + in.brake_nm[1] + in.brake_nm[2] + in.brake_nm[3] > 0.0;
  if (h.stopped || (braked && before.u_mps * s.u_mps < 0.0)) s.u_mps = 0.0;
}

namespace {

// All rates but those of the place, which the semi-implicit step works out its own way.
void rates(const Params& p, const full::Input& in, const Held& h, const State& s, double t_s, State& d,
           std::array<double, 2>* slip_decay_ps) {
  const full::Params& car = p.car;
  const Acting a = acting(p, in, h, s, t_s);
  d.yaw_rad = s.r_radps, d.path_m = s.u_mps;
  d.u_mps = h.stopped ? 0.0 : a.ax_mps2 + s.r_radps * s.v_mps;
  d.v_mps = a.ay_mps2 - s.r_radps * s.u_mps;
  const double front_side = h.stopped ? a.front_y_n * h.cosine : a.front_x_n * h.sine + a.front_y_n * h.cosine;
  d.r_radps = (car.x_m[0] * front_side + car.x_m[2] * a.rear_y_n) / car.yaw_inertia_kgm2;
  d.front_slip = a.slip_rate_ps[0], d.rear_slip = a.slip_rate_ps[1];
  if (slip_decay_ps) *slip_decay_ps = a.slip_decay_ps;
  if (!p.options.dynamic_attitude) return;
  double lift = 0.0, pitch = -car.cg_height_m * a.fx_n * steep(a.plane.along), roll = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    double force = a.spring_n[i];
    if (i < 2) force -= 0.5 * std::min(a.front_x_n, 0.0) * p.front_brake_jack;
    if (i >= 2) force += 0.5 * std::max(a.rear_x_n, 0.0) * p.rear_drive_jack;
    lift += force;
    pitch -= car.x_m[i] * force;
    roll += car.y_m[i] * force;
  }
  const double relative = s.roll - a.plane.across;
  roll -= (p.front_bar_nmprad + p.rear_bar_nmprad) * relative;
  roll += car.sprung_kg * car.cg_height_m * (a.fy_n / car.mass_kg * steep(a.plane.across) + kGravity_mps2 * relative);
  d.z_m = s.z_rate_mps, d.pitch = s.pitch_rate_ps, d.roll = s.roll_rate_ps;
  d.z_rate_mps = lift / car.sprung_kg;
  d.pitch_rate_ps = pitch / car.pitch_inertia_kgm2;
  d.roll_rate_ps = roll / car.roll_inertia_kgm2;
}

void step_semi_implicit(const Params& p, const full::Input& in, const Held& h, State& s, double dt) {
  State d;
  std::array<double, 2> decay{};
  rates(p, in, h, s, 0.0, d, &decay);
  s.u_mps += dt * d.u_mps, s.v_mps += dt * d.v_mps, s.r_radps += dt * d.r_radps;
  s.z_rate_mps += dt * d.z_rate_mps, s.pitch_rate_ps += dt * d.pitch_rate_ps, s.roll_rate_ps += dt * d.roll_rate_ps;
  // Trapezoidal for the path: the velocities at both ends are known.
  const double u = s.u_mps - 0.5 * dt * d.u_mps, v = s.v_mps - 0.5 * dt * d.v_mps, r = s.r_radps - 0.5 * dt * d.r_radps;
  const double yaw = s.yaw_rad + 0.5 * dt * r, c = std::cos(yaw), sn = std::sin(yaw);
  s.x_m += dt * (u * c - v * sn), s.y_m += dt * (u * sn + v * c);
  s.yaw_rad += dt * r, s.path_m += dt * u;
  s.z_m += dt * s.z_rate_mps, s.pitch += dt * s.pitch_rate_ps, s.roll += dt * s.roll_rate_ps;
  // Slips with the new velocities, their decay at the end of the step.
  const full::Params& car = p.car;
  const double vf = s.v_mps + car.x_m[0] * s.r_radps, vr = s.v_mps + car.x_m[2] * s.r_radps;
  const double ahead = s.u_mps * h.cosine + vf * h.sine, aside = vf * h.cosine - s.u_mps * h.sine;
  const auto front = tyre::slip_rate(car.tyre, 0.0, s.front_slip, ahead, aside, ahead, h.most_slip_pm);
  const auto rear = tyre::slip_rate(car.tyre, 0.0, s.rear_slip, s.u_mps, vr, s.u_mps, h.most_slip_pm);
  s.front_slip += dt * front.tan_alpha_ps / (1.0 + dt * front.tan_alpha_decay_ps);
  s.rear_slip += dt * rear.tan_alpha_ps / (1.0 + dt * rear.tan_alpha_decay_ps);
}

}  // namespace

void derivative(const Params& p, const full::Input& in, const Held& h, const State& s, double t_s, State& d,
                std::array<double, 2>* slip_decay_ps) {
  rates(p, in, h, s, t_s, d, slip_decay_ps);
  const double c = std::cos(s.yaw_rad), sn = std::sin(s.yaw_rad);
  d.x_m = s.u_mps * c - s.v_mps * sn, d.y_m = s.u_mps * sn + s.v_mps * c;
}

void advance(const Params& p, const full::Input& in, State& s, double dt) {
  const Held during = held(p, in, s, dt);
  const State before = s;
  switch (p.integrator) {
    case Integrator::kSemiImplicitEuler:
      step_semi_implicit(p, in, during, s, dt);
      break;
    case Integrator::kEtd2:
      step_etd2<2>(s, dt, [&](const State& at, double t, std::array<double, 2>& decay) {
        State d;
        derivative(p, in, during, at, t, d, &decay);
        return d;
      });
      break;
    case Integrator::kRk4:
    case Integrator::kReference:  // the caller's, see reference.h
      step_rk4(s, dt, [&](const State& at, double t) {
        State d;
        derivative(p, in, during, at, t, d);
        return d;
      });
      break;
  }
  finish_step(in, during, before, s);
  if (!p.options.dynamic_attitude) {
    settle(p, acting(p, in, during, s, dt), s);
    s.z_rate_mps = (s.z_m - before.z_m) / dt;
    s.pitch_rate_ps = (s.pitch - before.pitch) / dt;
    s.roll_rate_ps = (s.roll - before.roll) / dt;
  }
}

full::Forces forces(const Params& p, const full::Input& in, const State& s) {
  const Held h = held(p, in, s, 1e-3);
  const Acting a = acting(p, in, h, s, 0.0);
  full::Forces out;
  out.load_n = a.load_n;
  const double front = a.load_n[0] + a.load_n[1], rear = a.load_n[2] + a.load_n[3];
  for (std::size_t i = 0; i < 4; ++i) {
    const double axle = i < 2 ? front : rear, share = axle > 0.0 ? a.load_n[i] / axle : 0.0;
    out.fx_n[i] = 0.5 * (i < 2 ? a.front_x_n : a.rear_x_n);
    out.fy_n[i] = share * (i < 2 ? a.front_y_n : a.rear_y_n);
  }
  out.ground_m = a.height_m;
  out.ax_mps2 = a.ax_mps2, out.ay_mps2 = a.ay_mps2;
  out.roll_rad = std::atan(s.roll), out.pitch_rad = std::atan(s.pitch), out.yaw_rad = s.yaw_rad;
  out.roll_rate_radps = s.roll_rate_ps / (1.0 + s.roll * s.roll);
  out.pitch_rate_radps = s.pitch_rate_ps / (1.0 + s.pitch * s.pitch);
  out.yaw_rate_radps = s.r_radps;
  out.road_pitch_rad = -std::atan(a.plane.along), out.road_roll_rad = std::atan(a.plane.across);
  out.off_road = h.road.off_road;
  return out;
}

}  // namespace phare::single_track
