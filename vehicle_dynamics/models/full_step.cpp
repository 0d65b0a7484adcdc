// Level `full`: parameters, start, and one step of each integrator.
#include <algorithm>
#include <cmath>

#include "config/base/conventions.h"
#include "vehicle_dynamics/models/equilibrium.h"
#include "vehicle_dynamics/models/full_parts.h"
#include "vehicle_dynamics/models/rk4_step.h"

namespace phare::full {

Result<Params> params_of(const VehicleParams& vehicle, const std::string& place) {
  Result<chassis::Params> car = chassis::params_of(vehicle, place);
  if (!car) return car.error();
  return Params{std::move(*car)};
}

State at_rest(const Params& p, double x_m, double y_m, double yaw_rad, double speed_mps,
              const std::array<double, 4>& h) {
  State s;
  s.x_m = x_m, s.y_m = y_m, s.path_m = x_m;
  const double front = 0.5 * (h[0] + h[1]), rear = 0.5 * (h[2] + h[3]);
  const double left = 0.5 * (h[0] + h[2]), right = 0.5 * (h[1] + h[3]);
  const double pitch = -std::atan((front - rear) / p.wheelbase_m);
  const double track = 0.5 * (p.y_m[0] - p.y_m[1] + p.y_m[2] - p.y_m[3]);
  const double roll = std::atan((left - right) / track * std::cos(pitch));
  // Height of the plane below the centre of gravity, which lies on the plane's normal.
  const double under = rear + (front - rear) * (-p.x_m[2] / p.wheelbase_m);
  const double cp = std::cos(0.5 * pitch), sp = std::sin(0.5 * pitch), cr = std::cos(0.5 * roll),
               sr = std::sin(0.5 * roll), cy = std::cos(0.5 * yaw_rad), sy = std::sin(0.5 * yaw_rad);
  s.qw = cr * cp * cy + sr * sp * sy, s.qx = sr * cp * cy - cr * sp * sy;
  s.qy = cr * sp * cy + sr * cp * sy, s.qz = cr * cp * sy - sr * sp * cy;
  s.z_m = under + p.cg_height_m / (std::cos(pitch) * std::cos(roll)) - p.cg_height_m;
  s.u_mps = speed_mps;
  s.spin_radps.fill(speed_mps / p.radius_m);
  return s;
}

bool stand(const Params& p, const Input& input, State& state) {
  // Roll, pitch, height, travels; the slips that hold it: of the braked wheels along, of the axles across.
  constexpr std::size_t kUnknowns = 10, kAlong = 7;
  const bool braked = std::any_of(input.brake_nm.begin(), input.brake_nm.end(), [](double nm) { return nm > 0.0; });
  Held h;
  h.steer = steer_angles(p, input.steer_rad);
  for (std::size_t i = 0; i < 4; ++i) h.locked[i] = input.brake_nm[i] > 0.0;
  const State from = state;
  const auto placed = [&](const std::array<double, kUnknowns>& x) {
    State s = from;
    const double cr = std::cos(0.5 * x[0]), sr = std::sin(0.5 * x[0]), cp = std::cos(0.5 * x[1]),
                 sp = std::sin(0.5 * x[1]);
    // Turned on from where it is: R = R_from Ry Rx, with the small angles that springs give.
    const State& f = from;
    const double w = cp * cr, i = cp * sr, j = sp * cr, k = -sp * sr;
    s.qw = f.qw * w - f.qx * i - f.qy * j - f.qz * k, s.qx = f.qw * i + f.qx * w + f.qy * k - f.qz * j;
    s.qy = f.qw * j - f.qx * k + f.qy * w + f.qz * i, s.qz = f.qw * k + f.qx * j - f.qy * i + f.qz * w;
    s.z_m = from.z_m + x[2];
    for (std::size_t n = 0; n < 4; ++n) {
      s.travel_m[n] = x[3 + n];
      s.kappa[n] = h.locked[n] ? x[kAlong] : 0.0;
      s.tan_alpha[n] = n < 2 ? x[8] : x[9];
    }
    return s;
  };
  const auto rates = [&](const std::array<double, kUnknowns>& x) {
    State d;
    derivative(p, input, h, placed(x), 0.0, d);
    return std::array<double, kUnknowns>{d.p_radps,     d.q_radps,     d.w_mps,       d.rise_mps[0],
                                         d.rise_mps[1], d.rise_mps[2], d.rise_mps[3], braked ? d.u_mps : x[kAlong],
                                         d.v_mps,       d.r_radps};
  };
  std::array<double, kUnknowns> x{};
  if (!find_equilibrium(x, {1e-7, 1e-7, 1e-7, 1e-7, 1e-7, 1e-7, 1e-7, 1e-6, 1e-6, 1e-6}, rates)) return false;
  const State settled = placed(x);
  const Held then = held(p, input, settled, 1e-3);
  if (then.locked != h.locked) return false;  // the brakes give way
  state = settled;
  return true;
}

void derivative(const Params& p, const Input& input, const Held& held, const State& s, double t_s, State& rate,
                std::array<double, 8>* slip_decay_ps) {
  const Geometry g = geometry(p, input, s, t_s);
  Contact contact;
  TyreForces tyres;
  kinematics(p, held, g, held.steer, s, rate, contact);
  dynamics(p, input, held, g, contact, s, rate, tyres);
  if (slip_decay_ps) *slip_decay_ps = contact.decay_ps;
}

namespace {

// What of the tyre a step of that length bears. A short patch answers a wheel's spin at once: spin and slip swing at
// the root of answer / sigma, some 470 per second for 0.02 m, and each method follows only so much of a swing in a
// step. It depends on the speed, too: what rolls through the patch carries the slip away.
void soften(const Params& p, const State& s, double dt, Held& h) {
  struct Bears {
    double answer;   // (swing dt)^2; by Runge-Kutta 8, by Euler's methods 4 and 0: less, for what else moves
    double damping;  // carcass damping dt over the wheel's inertia; 2.8 and 2
  };
  const auto [answer, damping] = p.integrator == Integrator::kRk4                 ? Bears{6.0, 2.0}
                                 : p.integrator == Integrator::kSemiImplicitEuler ? Bears{2.0, 0.7}
                                                                                  : Bears{0.5, 0.7};
  const double swing = p.spin_answer_mps2 * dt, carried = answer * std::abs(s.u_mps) / swing;
  double floor_m = 0.0;
  if (carried < 1.0) floor_m = swing * dt / answer * (carried > 1e-9 ? carried / -std::log1p(-carried) : 1.0);
  if (p.integrator == Integrator::kRk4) {
    // The decay itself: half of what the fastest patch rolls in a step; a spinning wheel's runs faster than the car.
    const bool tilted = s.qx * s.qx + s.qy * s.qy > 0.25;  // by more than 60 degrees: wheels face any way
    double fastest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double x = s.u_mps - s.r_radps * p.y_m[i], y = s.v_mps + s.r_radps * p.x_m[i];
      const double cosine = h.steer.cosine[i], sine = h.steer.sine[i];
      fastest = std::max({fastest, std::abs(x * cosine + y * sine) + std::abs(s.rise_mps[i]),
                          tyre::kSlideCarries * std::abs(y * cosine - x * sine)});
      if (tilted) fastest = std::max(fastest, std::hypot(x, y, s.rise_mps[i]));
    }
    for (const double spin : s.spin_radps) fastest = std::max(fastest, std::abs(spin) * p.radius_m);
    h.most_across_pm = 1.0 / std::max(0.5 * fastest * dt, 1e-6);
    floor_m = std::max(floor_m, 0.5 * fastest * dt);
  }
  if (floor_m > 0.0) h.most_along_pm = 1.0 / std::max(floor_m, 1e-6);
  h.most_damping_nspm = damping * p.spin_kg / dt;
}

}  // namespace

Held held(const Params& p, const Input& input, const State& s, double dt) {
  Held h;
  h.steer = steer_angles(p, input.steer_rad);
  if (p.integrator != Integrator::kReference) soften(p, s, dt, h);
  if (std::all_of(input.brake_nm.begin(), input.brake_nm.end(), [](double b) { return b <= 0.0; })) return h;
  bool slow = false;
  for (std::size_t i = 0; i < 4; ++i) {
    const double brake = input.brake_nm[i], spin = s.spin_radps[i];
    h.brake_nm[i] = spin > 0.0 ? brake : (spin < 0.0 ? -brake : 0.0);
    slow = slow || (brake > 0.0 && std::abs(spin) * p.spin_inertia_kgm2 <= dt * brake);
  }
  if (!slow) return h;
  // A wheel that the brake can stop within the step, and that nothing turns against it, stands for the whole step:
  // decided before the tyres move, or the car would creep by a little each step.
  Held all = h;
  all.locked.fill(true);
  const Geometry g = geometry(p, input, s, 0.0);
  Contact contact;
  TyreForces tyres;
  State rate;
  kinematics(p, all, g, h.steer, s, rate, contact);
  dynamics(p, input, all, g, contact, s, rate, tyres);
  for (std::size_t i = 0; i < 4; ++i) {
    const double brake = input.brake_nm[i];
    if (brake <= 0.0 || std::abs(s.spin_radps[i]) * p.spin_inertia_kgm2 > dt * brake) continue;
    if (std::abs(tyres.net_nm[i]) <= brake) {
      h.locked[i] = true;
    } else if (s.spin_radps[i] == 0.0) {
      h.brake_nm[i] = tyres.net_nm[i] > 0.0 ? brake : -brake;  // breaks loose: the brake opposes what turns it
    }
  }
  return h;
}

namespace {

// A patch that has slid and is dragged back sticks: its carcass then holds what the highest force stretches it by,
// however far it slid. The slip of the slide would have to be unwound first, a decimetre and more at centimetres a
// second. Half the slip of the peak gives nine tenths of its force, about what a far slide gives.
void let_stick(const Params& p, const Input& input, const Held& held, State& s) {
  constexpr double kSlow_mps = 0.1, kSticks = 0.5;
  if (std::abs(s.u_mps) + std::abs(s.v_mps) > kSlow_mps) return;
  const powertrain::Wheels w = wheels(p, input, s);
  const double alike = 1.0 / (p.tyre.per_tan_alpha_bend * 1.5 * p.tyre.peak_kappa);  // peaks: across over along
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = w.ahead_mps[i], y = s.v_mps + s.r_radps * p.x_m[i];
    const double c = held.steer.cosine[i], sn = held.steer.sine[i];
    const double slides_x = s.spin_radps[i] * p.radius_m - (x * c + y * sn), slides_y = x * sn - y * c;
    if (std::hypot(slides_x, slides_y) > kSlow_mps || slides_x * s.kappa[i] + slides_y * s.tan_alpha[i] >= 0.0)
      continue;
    const double over = std::hypot(s.kappa[i], s.tan_alpha[i] / alike) / (kSticks * w.peak_slip[i]);
    if (over > 1.0) s.kappa[i] /= over, s.tan_alpha[i] /= over;
  }
}

}  // namespace

void finish_step(const Held& held, const State& before, State& s) {
  for (std::size_t i = 0; i < 4; ++i)
    if (held.locked[i] || (held.brake_nm[i] != 0.0 && before.spin_radps[i] * s.spin_radps[i] < 0.0))
      s.spin_radps[i] = 0.0;
  const double inv = 1.0 / std::sqrt(s.qw * s.qw + s.qx * s.qx + s.qy * s.qy + s.qz * s.qz);
  s.qw *= inv, s.qx *= inv, s.qy *= inv, s.qz *= inv;
}

namespace {

// Velocities first, with the forces of the old place; then places with the new velocities. The slips' decay is taken at
// the end of the step, so that no speed makes it overshoot.
void step_semi_implicit(const Params& p, const Input& input, const Held& held, State& s, double dt) {
  const Geometry g = geometry(p, input, s, 0.0);
  Contact contact;
  TyreForces tyres;
  State rate;
  kinematics(p, held, g, held.steer, s, rate, contact);
  dynamics(p, input, held, g, contact, s, rate, tyres);
  s.u_mps += dt * rate.u_mps, s.v_mps += dt * rate.v_mps, s.w_mps += dt * rate.w_mps;
  s.p_radps += dt * rate.p_radps, s.q_radps += dt * rate.q_radps, s.r_radps += dt * rate.r_radps;
  for (std::size_t i = 0; i < 4; ++i) {
    s.rise_mps[i] += dt * rate.rise_mps[i];
    s.spin_radps[i] += dt * rate.spin_radps[i];
  }
  kinematics(p, held, g, held.steer, s, rate, contact);
  s.x_m += dt * rate.x_m, s.y_m += dt * rate.y_m, s.z_m += dt * rate.z_m, s.path_m += dt * rate.path_m;
  s.qw += dt * rate.qw, s.qx += dt * rate.qx, s.qy += dt * rate.qy, s.qz += dt * rate.qz;
  for (std::size_t i = 0; i < 4; ++i) {
    s.travel_m[i] += dt * rate.travel_m[i];
    s.kappa[i] += dt * rate.kappa[i] / (1.0 + dt * contact.decay_ps[i]);
    s.tan_alpha[i] += dt * rate.tan_alpha[i] / (1.0 + dt * contact.decay_ps[i + 4]);
  }
}

}  // namespace

void advance(const Params& p, const Input& input, State& state, double dt) {
  const Held during = held(p, input, state, dt);
  const State before = state;
  switch (p.integrator) {
    case Integrator::kSemiImplicitEuler:
      step_semi_implicit(p, input, during, state, dt);
      break;
    case Integrator::kEtd2:
      step_etd2<8>(state, dt, [&](const State& at, double t, std::array<double, 8>& decay) {
        State rate;
        derivative(p, input, during, at, t, rate, &decay);
        return rate;
      });
      break;
    case Integrator::kRk4:
    case Integrator::kReference:  // the caller's, see reference.h; a real-time run takes the best it has
      // From where the step begins: far from the origin each of the method's sums would round the place anew.
      state.x_m = state.y_m = state.path_m = 0.0;
      step_rk4(state, dt, [&](State at, double t) {
        at.x_m += before.x_m, at.y_m += before.y_m, at.path_m += before.path_m;
        State rate;
        derivative(p, input, during, at, t, rate);
        return rate;
      });
      state.x_m += before.x_m, state.y_m += before.y_m, state.path_m += before.path_m;
      break;
  }
  finish_step(during, before, state);
  let_stick(p, input, during, state);
}

powertrain::Wheels wheels(const Params& p, const Input& input, const State& s) {
  powertrain::Wheels w;
  w.spin_radps = s.spin_radps;
  std::array<double, 4> friction{1.0, 1.0, 1.0, 1.0};
  if (input.road && input.heights_given) friction.fill(input.road->friction_everywhere);
  if (input.road && !input.heights_given) {
    const double cosine = 1.0 - 2.0 * (s.qy * s.qy + s.qz * s.qz), sine = 2.0 * (s.qx * s.qy + s.qw * s.qz);
    const Road::Laid laid[2] = {input.road->laid(s.path_m + p.x_m[0]), input.road->laid(s.path_m + p.x_m[2])};
    for (std::size_t i = 0; i < 4; ++i) {
      const double x = s.x_m + cosine * p.x_m[i] - sine * p.y_m[i], y = s.y_m + sine * p.x_m[i] + cosine * p.y_m[i];
      friction[i] = laid[i / 2].friction[static_cast<int>(i % 2)] * input.road->base_friction(x, y);
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    w.ahead_mps[i] = s.u_mps - s.r_radps * p.y_m[i];
    w.peak_slip[i] = p.tyre.peak_kappa * friction[i];
  }
  return w;
}

Forces forces(const Params& p, const Input& input, const State& s, double t_s) {
  Held turning;
  turning.steer = steer_angles(p, input.steer_rad);
  for (std::size_t i = 0; i < 4; ++i) turning.locked[i] = s.spin_radps[i] == 0.0 && input.brake_nm[i] > 0.0;
  const Geometry g = geometry(p, input, s, t_s);
  Contact contact;
  TyreForces tyres;
  State rate;
  kinematics(p, turning, g, turning.steer, s, rate, contact);
  dynamics(p, input, turning, g, contact, s, rate, tyres);
  Forces out;
  out.load_n = tyres.load_n, out.fx_n = tyres.fx_n, out.fy_n = tyres.fy_n;
  out.ground_m = g.ground_m;
  out.ax_mps2 = tyres.ax_mps2, out.ay_mps2 = tyres.ay_mps2;
  out.off_road = g.off_road;
  const auto& m = g.world_from_body;
  out.pitch_rad = std::asin(std::clamp(-m[6], -1.0, 1.0));
  out.roll_rad = std::atan2(m[7], m[8]);
  out.yaw_rad = std::atan2(m[3], m[0]);
  const double cr = std::cos(out.roll_rad), sr = std::sin(out.roll_rad), cp = std::max(std::cos(out.pitch_rad), 1e-6);
  out.yaw_rate_radps = (s.q_radps * sr + s.r_radps * cr) / cp;
  out.pitch_rate_radps = s.q_radps * cr - s.r_radps * sr;
  out.roll_rate_radps = s.p_radps + out.yaw_rate_radps * -m[6];
  // The plane's angles in the heading of the car, so that body less plane is what the springs show.
  const double cy = std::cos(out.yaw_rad), sy = std::sin(out.yaw_rad);
  const auto n = normal_of(g.x_m, g.y_m, g.ground_m);
  out.road_pitch_rad = std::atan2(n[0] * cy + n[1] * sy, n[2]);
  out.road_roll_rad = std::asin(std::clamp(n[0] * sy - n[1] * cy, -1.0, 1.0));
  return out;
}

double energy_j(const Params& p, const State& s, const Forces& f) {
  double e = 0.5 * p.mass_kg * (s.u_mps * s.u_mps + s.v_mps * s.v_mps) + 0.5 * p.sprung_kg * s.w_mps * s.w_mps +
             0.5 * (p.roll_inertia_kgm2 * s.p_radps * s.p_radps + p.pitch_inertia_kgm2 * s.q_radps * s.q_radps +
                    p.yaw_inertia_kgm2 * s.r_radps * s.r_radps) +
             p.sprung_kg * kGravity_mps2 * s.z_m;
  for (std::size_t i = 0; i < 4; ++i) {
    const double travel = s.travel_m[i], squeeze = f.load_n[i] / p.tyre_rate_npm, rest = p.load_n[i] / p.tyre_rate_npm;
    e += 0.5 * p.unsprung_kg[i] * s.rise_mps[i] * s.rise_mps[i] +
         0.5 * p.spin_inertia_kgm2 * s.spin_radps[i] * s.spin_radps[i] + p.spring_n[i] * travel +
         0.5 * p.spring_npm[i] * travel * travel +
         0.25 * p.bar_npm[i] * (travel - s.travel_m[i ^ 1u]) * (travel - s.travel_m[i ^ 1u]) +
         0.5 * p.tyre_rate_npm * (squeeze * squeeze - rest * rest);
    const double from_driver = travel + p.sunk_m[i];
    const double beyond = from_driver > 0.0 ? std::max(from_driver - p.bump_travel_m, 0.0)
                                            : std::min(from_driver + p.rebound_travel_m, 0.0);
    e += 0.5 * p.stop_rate_npm * beyond * beyond;
    // Height of the wheel itself over its place at rest.
    const double body_z =
        s.z_m + 2.0 * (s.qx * s.qz - s.qw * s.qy) * p.x_m[i] + 2.0 * (s.qy * s.qz + s.qw * s.qx) * p.y_m[i];
    e += p.unsprung_kg[i] * kGravity_mps2 * (body_z + travel);
  }
  return e;
}

}  // namespace phare::full
