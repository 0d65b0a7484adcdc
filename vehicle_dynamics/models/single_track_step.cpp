// Level `single-track`: one step of each integrator.
#include <algorithm>
#include <cmath>

#include "config/base/conventions.h"
#include "vehicle_dynamics/models/equilibrium.h"
#include "vehicle_dynamics/models/rk4_step.h"
#include "vehicle_dynamics/models/single_track_parts.h"

namespace phare::single_track {
namespace {

ride::Body body_of(const State& s) {
  return {s.z_m, s.pitch, s.z_rate_mps, s.pitch_rate_ps, s.roll, s.roll_rate_ps};
}

void set_body(State& s, const ride::Body& b) {
  s.z_m = b.z_m, s.pitch = b.pitch, s.z_rate_mps = b.z_rate_mps, s.pitch_rate_ps = b.pitch_rate_ps;
  s.roll = b.roll, s.roll_rate_ps = b.roll_rate_ps;
}

// The place, with the mean velocities: those at both ends of the step are known.
void travel(const Held& h, const State& before, State& s, double dt) {
  const double u = 0.5 * (before.u_mps + s.u_mps) * h.on_map[0], v = 0.5 * (before.v_mps + s.v_mps) * h.on_map[1];
  s.x_m = before.x_m + dt * (u * h.yaw_cosine - v * h.yaw_sine);
  s.y_m = before.y_m + dt * (u * h.yaw_sine + v * h.yaw_cosine);
  s.yaw_rad = before.yaw_rad + dt * 0.5 * (before.r_radps + s.r_radps), s.path_m = before.path_m + dt * u;
}

// Mean over a step of a force that friction cuts off, the limit going evenly from one value to another.
double cut_off(double force_n, double from_n, double to_n) {
  const double size = std::abs(force_n), low = std::min(from_n, to_n), high = std::max(from_n, to_n);
  const double beyond = size - low;
  const double mean =
      size >= high ? 0.5 * (from_n + to_n) : (beyond <= 0.0 ? size : size - 0.5 * beyond * beyond / (high - low));
  return std::copysign(mean, force_n);
}

// Exponential, second order (Cox and Matthews, see fixed_step.h): the body's springs and the slips' decay exactly, the
// rest by Heun's method. The tyres are asked once; over the step their force follows its tangent, which keeps the
// order.
void step_exponential(const Params& p, const Held& h, const ride::Step& ride, State& s, double dt) {
  // as far as the forces at the start take the car,
  const State before = s;
  const Grip tyres = grip(p, h, before);
  const Acting first = acting(p, h, tyres.share, before, 0.0);
  const TwoPhi decay = phi(-dt * first.slip_decay_ps);
  const Two from{before.front_slip, before.rear_slip};
  const Two to = from + dt * decay.one * first.slip_rate_ps;
  const ride::Body swung = ride::after(ride, body_of(before), first.ride);
  State end = before;
  end.u_mps += dt * first.u_mps2, end.v_mps += dt * first.v_mps2, end.r_radps += dt * first.r_ps2;
  end.front_slip = to[0], end.rear_slip = to[1];
  set_body(end, swung);

  // corrected by what they have become there
  const Acting last = acting(p, h, tyres.near(to), end, dt);
  s.u_mps += 0.5 * dt * (first.u_mps2 + last.u_mps2), s.v_mps += 0.5 * dt * (first.v_mps2 + last.v_mps2);
  s.r_radps += 0.5 * dt * (first.r_ps2 + last.r_ps2);
  ride::Push change{last.ride.heave - first.ride.heave, last.ride.pitch - first.ride.pitch,
                    last.ride.roll - first.ride.roll};
  if (last.ahead_n[0] != first.ahead_n[0] || last.ahead_n[1] != first.ahead_n[1]) {
    // Brakes at the limit on a rough road: the limit comes and goes within a step, the mean of its ends is not its
    // mean.
    const double front_n = cut_off(h.front_push_n, first.limit_n[0], last.limit_n[0]) -
                           0.5 * (first.ahead_n[0] + last.ahead_n[0]),
                 rear_n = cut_off(h.rear_push_n, first.limit_n[1], last.limit_n[1]) -
                          0.5 * (first.ahead_n[1] + last.ahead_n[1]);
    const double more_mps2 = h.stopped ? 0.0 : (front_n * h.cosine + rear_n) * p.per_effective_kg;
    s.u_mps += dt * more_mps2;
    change.heave += 2.0 * more_mps2 * h.rise[0];
    change.pitch -=
        2.0 * p.car.cg_height_m * p.car.mass_kg * more_mps2 * p.per_pitch_kgm2;  // twice at the end: in the mean
  }
  const Two slip = to + dt * decay.two * (last.slip_rate_ps - first.slip_rate_ps + first.slip_decay_ps * (to - from));
  s.front_slip = slip[0], s.rear_slip = slip[1];
  set_body(s, ride::add(ride, swung, change));
  travel(h, before, s, dt);
}

// Velocities first, with the forces of the old place; then places and slips with the new velocities, the slips' decay
// taken at the end of the step.
void step_semi_implicit(const Params& p, const Held& h, State& s, double dt) {
  const State before = s;
  State d;
  derivative(p, h, before, 0.0, d);
  s.u_mps += dt * d.u_mps, s.v_mps += dt * d.v_mps, s.r_radps += dt * d.r_radps;
  s.z_rate_mps += dt * d.z_rate_mps, s.pitch_rate_ps += dt * d.pitch_rate_ps, s.roll_rate_ps += dt * d.roll_rate_ps;
  travel(h, before, s, dt);
  s.z_m += dt * s.z_rate_mps, s.pitch += dt * s.pitch_rate_ps, s.roll += dt * s.roll_rate_ps;
  const chassis::Params& car = p.car;
  const double vf = s.v_mps + car.x_m[0] * s.r_radps, vr = s.v_mps + car.x_m[2] * s.r_radps;
  const double ahead = s.u_mps * h.cosine + vf * h.sine, aside = vf * h.cosine - s.u_mps * h.sine;
  const Two slip{s.front_slip, s.rear_slip};
  const auto change = tyre::side_slip_rate(car.tyre, slip, Two{ahead, s.u_mps}, Two{aside, vr}, h.most_slip_pm);
  const Two next = slip + dt * change.tan_alpha_ps / (1.0 + dt * change.decay_ps);
  s.front_slip = next[0], s.rear_slip = next[1];
}

// Quasi-static attitude: where constant forces hold the body. Front and rear springs share the transfer, the roll
// stiffness the side force.
void settle(const Params& p, const Held& h, const State& before, State& s, double dt) {
  const Acting a = acting(p, h, grip(p, h, s).share, s, dt);
  const chassis::Params& car = p.car;
  const Two front_m = h.front.height_m + dt * h.front.rate_mps, rear_m = h.rear.height_m + dt * h.rear.rate_mps;
  const double front_road = 0.5 * (front_m[0] + front_m[1]), rear_road = 0.5 * (rear_m[0] + rear_m[1]);
  const double along = (front_road - rear_road) * p.per_wheelbase_m, across = h.across + h.across_rate_ps * dt;
  const double transfer = car.cg_height_m * a.fx_n * (1.0 + along * along) / car.wheelbase_m;  // from front to rear
  const double front_jack = -std::min(a.front_x_n, 0.0) * p.front_brake_jack,
               rear_jack = std::max(a.rear_x_n, 0.0) * p.rear_drive_jack;
  const double front = front_road + 0.5 * (transfer + front_jack) / p.axles[0].spring_npm;
  const double rear = rear_road + 0.5 * (-transfer + rear_jack) / p.axles[1].spring_npm;
  s.pitch = (rear - front) / car.wheelbase_m;
  s.z_m = front + car.x_m[0] * s.pitch;
  const double felt_nm = car.sprung_kg * car.cg_height_m *
                         (a.fy_n / car.mass_kg * (1.0 + h.bank * h.bank) + kGravity_mps2 * (across - h.bank));
  s.roll = across + felt_nm / (p.springs.roll_stiffness_ps2 * car.roll_inertia_kgm2);
  s.z_rate_mps = (s.z_m - before.z_m) / dt;
  s.pitch_rate_ps = (s.pitch - before.pitch) / dt;
  s.roll_rate_ps = (s.roll - before.roll) / dt;
}

}  // namespace

namespace {

// At the limit of grip the exponential step is taken in parts of no more than this: there a car answers to what a load
// or a slip does within a step, on a rough road above all, and what is missed grows. Chosen: with parts of 1 ms class D
// at the limit is as near as rk4 at 5 ms or nearer (single_track_test.cpp); without, a tenth of a radian a second off.
constexpr double kLimitStep_s = 0.001;

int parts_of(double dt) {
  return std::max(1, static_cast<int>(std::ceil(dt / kLimitStep_s - 1e-6)));
}

// Either axle beyond 0.4 of the slip of its highest side force, where it has some 85 % of it.
bool at_limit(const Params& p, double friction, const State& s) {
  const double slip = std::max(std::abs(s.front_slip), std::abs(s.rear_slip));
  return p.options.magic_formula && 1.5 * slip * p.car.tyre.per_tan_alpha_bend > 0.4 * friction;
}

void advance_in_parts(const Params& p, chassis::Input in, State& s, double dt) {
  const int parts = parts_of(dt);
  const double part = dt / parts;
  const ride::Step ride = p.short_ride.dt_s == part ? p.short_ride : ride::step_of(p.springs, part);
  for (int k = 0; k < parts; ++k) {
    const State before = s;
    const Held during = held(p, in, s, part);
    step_exponential(p, during, ride, s, part);
    finish_step(in, during, before, s);
    if (in.heights_given)
      for (std::size_t i = 0; i < 4; ++i) in.height_m[i] += in.height_rate_mps[i] * part;
  }
}

}  // namespace

bool stand(const Params& p, const chassis::Input& input, State& state) {
  if (!p.options.dynamic_attitude) return false;
  const State from = state;
  const auto placed = [&](const std::array<double, 5>& x) {
    State s = from;
    s.z_m += x[0], s.pitch += x[1], s.roll += x[2], s.front_slip = x[3], s.rear_slip = x[4];
    return s;
  };
  const auto rates = [&](const std::array<double, 5>& x) {
    const State s = placed(x);
    State d;
    derivative(p, held(p, input, s, 1e-3), s, 0.0, d);
    return std::array<double, 5>{d.z_rate_mps, d.pitch_rate_ps, d.roll_rate_ps, d.v_mps, d.r_radps};
  };
  std::array<double, 5> x{};
  if (!find_equilibrium(x, {1e-7, 1e-7, 1e-7, 1e-6, 1e-6}, rates)) return false;
  state = placed(x);
  return true;
}

void set_step(Params& p, double dt) {
  if (p.ride.dt_s != dt) p.ride = ride::step_of(p.springs, dt);
  const double part = dt / parts_of(dt);
  if (p.short_ride.dt_s != part) p.short_ride = ride::step_of(p.springs, part);
}

void finish_step(const chassis::Input& in, const Held& h, const State& before, State& s) {
  const bool braked = in.brake_nm[0] + in.brake_nm[1] + in.brake_nm[2] + in.brake_nm[3] > 0.0;
  // Brakes end a motion and begin none; a car that slides aside may well turn from forwards to backwards.
  const bool turned = before.u_mps * s.u_mps < 0.0 && std::abs(before.u_mps) <= h.sticks_mps;
  if (h.stopped || (braked && turned)) {
    s.z_rate_mps -= s.u_mps * h.rise[0];  // the body's way along the slope ends with it
    s.u_mps = 0.0;
  }
  // An exponential never ends: what has faded to nothing is none, before it becomes a denormal number, ten times as
  // slow.
  constexpr double kNothing = 1e-100;
  for (double* value : {&s.v_mps, &s.r_radps, &s.z_m, &s.pitch, &s.roll, &s.z_rate_mps, &s.pitch_rate_ps,
                        &s.roll_rate_ps, &s.front_slip, &s.rear_slip})
    if (std::abs(*value) < kNothing) *value = 0.0;
}

void advance(const Params& p, const chassis::Input& in, State& s, double dt) {
  const Held during = held(p, in, s, dt);
  const State before = s;
  switch (p.integrator) {
    case Integrator::kSemiImplicitEuler:
      step_semi_implicit(p, during, s, dt);
      break;
    case Integrator::kEtd2:
      if (dt > kLimitStep_s && at_limit(p, during.friction, s))
        advance_in_parts(p, in, s, dt);
      else if (p.ride.dt_s == dt)
        step_exponential(p, during, p.ride, s, dt);
      else  // a length that set_step() was not told
        step_exponential(p, during, ride::step_of(p.springs, dt), s, dt);
      break;
    case Integrator::kRk4:
    case Integrator::kReference:  // the caller's, see reference.h
      step_rk4(s, dt, [&](const State& at, double t) {
        State d;
        derivative(p, during, at, t, d);
        return d;
      });
      break;
  }
  finish_step(in, during, before, s);
  if (!p.options.dynamic_attitude) settle(p, during, before, s, dt);
}

}  // namespace phare::single_track
