#include "vehicle_dynamics/models/powertrain.h"

#include <algorithm>
#include <cmath>

namespace phare::powertrain {
namespace {

constexpr double kEngineLag_s = 0.1, kBrakeLag_s = 0.06;  // notes of the field, usual for passenger cars
constexpr double kShiftPause_s = 0.6;                     // no two shifts within
constexpr double kAbsFrom_mps = 1.5;                      // below it wheel speed sensors are blind
// ABS: band of slip over the slip of the highest force, and how fast the pressure follows, over the pressure that there
// is. Chosen for 7 to 10 cycles a second, as cars have, from friction 0.05 to 1 at any step up to 5 ms.
constexpr double kAbsRelease = 2.0, kAbsApply = 0.8;
constexpr double kAbsFall_ps = 25.0, kAbsRise_ps = 12.0, kAbsLeast_01 = 0.01;
constexpr double kReverseBelow_radps = 5.0;  // of the wheels, 1.5 m/s: rolling faster, gearboxes refuse it
constexpr double kParkLock_mps = 0.5;        // below it the pawl of the parking lock falls in
constexpr double kParkTorque_nm = 3000.0;    // of the pawl, at each driven wheel; chosen: it never slips
constexpr double kStands_mps = 0.05;         // hill hold: slower is standing
constexpr double kDrivesOff_01 = 0.05;       // hill hold: so much accelerator means to go

// What of a lag is made up in a step: the trapezoid's rule, within (dt / lag)^3 / 12 of the exponential.
double caught_up(double dt, double lag_s) {
  return dt / (lag_s + 0.5 * dt);
}

void choose_gear(const EngineParams& e, double accelerator, double wheel_radps, State& s) {
  if (s.since_shift_s <= kShiftPause_s) return;
  const auto ratio = [&](double gear) { return e.gear_ratio[static_cast<std::size_t>(gear)] * e.final_ratio; };
  const double top = static_cast<double>(e.gear_ratio.size() - 1), speed = std::abs(wheel_radps) * ratio(s.gear);
  const double up = std::lerp(e.shift_up_low_radps, e.shift_up_full_radps, accelerator);
  // Down again well below, and lower still the lighter the foot: the gearbox does not hunt.
  const double down = std::min(std::lerp(e.shift_down_radps, 0.5 * e.shift_up_full_radps, accelerator),
                               s.gear > 0.0 ? 0.85 * up * ratio(s.gear) / ratio(s.gear - 1.0) : 0.0);
  if (s.gear < top && speed > up)
    s.gear += 1.0, s.since_shift_s = 0.0;
  else if (s.gear > 0.0 && speed < down)
    s.gear -= 1.0, s.since_shift_s = 0.0;
}

// At the wheels, of all together, > 0 the way of the gear.
double with_engine_nm(const EngineParams& e, double accelerator, double wheel_radps, bool reverse, double dt,
                      State& s) {
  s.since_shift_s += dt;
  if (!reverse) choose_gear(e, accelerator, wheel_radps, s);
  const double total = (reverse ? e.reverse_ratio : e.gear_ratio[static_cast<std::size_t>(s.gear)]) * e.final_ratio;
  const double turbine = std::abs(wheel_radps) * total;
  // The converter lets the engine turn faster than the gearbox and multiplies its torque while it does.
  const double stall = e.idle_radps * (1.0 + 1.5 * accelerator);
  s.engine_radps = std::max(turbine, stall);
  const double multiplied = turbine < stall ? std::lerp(e.converter_ratio, 1.0, turbine / stall) : 1.0;
  const double dragging = std::clamp((turbine - e.idle_radps) / e.idle_radps, 0.0, 1.0);  // it idles, it does not stall
  return (accelerator * engine_torque_nm(e, s.engine_radps) * multiplied * e.efficiency_01 -
          (1.0 - accelerator) * e.drag_nm * dragging) *
         total;
}

// No more than its power over the speed that the driven wheels turn at.
double without_engine_nm(const VehicleParams& v, double accelerator, double wheel_radps) {
  const double tread_mps = std::max(std::abs(wheel_radps) * v.tyre_radius_m, 0.1);
  return accelerator * std::min(v.max_drive_force_n, v.max_power_w / tread_mps) * v.tyre_radius_m;
}

double drive_target_nm(const VehicleParams& v, const Controls& input, double wheel_radps, State& s, double dt) {
  const bool reverse = input.gear == Gear::kReverse;
  if (input.gear != Gear::kDrive && !reverse) return 0.0;
  double torque = v.engine ? with_engine_nm(*v.engine, input.accelerator_01, wheel_radps, reverse, dt, s)
                           : without_engine_nm(v, input.accelerator_01, wheel_radps);
  if (reverse && wheel_radps > kReverseBelow_radps) return 0.0;
  if (v.creep_force_n > 0.0) {  // the idling engine pulls through its converter
    const double ahead_mps = (reverse ? -wheel_radps : wheel_radps) * v.tyre_radius_m;
    const double slower = std::clamp(1.0 - ahead_mps / v.creep_speed_mps, 0.0, 1.0);
    torque += (1.0 - input.accelerator_01) * slower * v.creep_force_n * v.tyre_radius_m;
  }
  return reverse ? -torque : torque;
}

// What the pedal asks of the brakes; on a let-go pedal of a standing car hill hold asks on for a while.
double brake_target_01(const VehicleParams& v, const Controls& input, double speed_mps, State& s, double dt) {
  if (v.hill_hold_s <= 0.0) return input.brake_01;
  const bool stands = std::abs(speed_mps)<kStands_mps, goes = input.accelerator_01> kDrivesOff_01;
  const bool geared = input.gear == Gear::kDrive || input.gear == Gear::kReverse;
  if (stands && input.brake_01 >= s.held_01)
    s.held_01 = input.brake_01, s.held_s = 0.0;
  else
    s.held_s += dt;
  if (goes || !geared || s.held_s > v.hill_hold_s) s.held_01 = 0.0;
  return std::max(input.brake_01, s.held_01);
}

// By how much the wheels slip under the brakes, over the slip of the highest force.
std::array<double, 4> abs_slips(const VehicleParams& v, const Wheels& w) {
  std::array<double, 4> slip{};
  for (std::size_t i = 0; i < 4; ++i) {
    const double way = w.ahead_mps[i] < 0.0 ? -1.0 : 1.0, ahead = way * w.ahead_mps[i];
    if (w.peak_slip[i] > 0.0)
      slip[i] = (ahead - way * w.spin_radps[i] * v.tyre_radius_m) / (std::max(ahead, 1.0) * w.peak_slip[i]);
  }
  slip[2] = slip[3] = std::max(slip[2], slip[3]);
  return slip;
}

void let_through(const VehicleParams& v, double speed_mps, const Wheels& w, State& s, double dt) {
  const bool at_work = w.peak_slip[0] > 0.0 && std::abs(speed_mps) > kAbsFrom_mps && s.brake_01 > 0.0;
  if (!at_work) {
    s.abs_01.fill(1.0);
    return;
  }
  const std::array<double, 4> slip = abs_slips(v, w);
  for (std::size_t i = 0; i < 4; ++i) {
    if (slip[i] > kAbsRelease)
      s.abs_01[i] *= std::exp(-kAbsFall_ps * dt);
    else if (slip[i] < kAbsApply && s.abs_01[i] < 1.0)
      s.abs_01[i] = std::min(1.0, s.abs_01[i] * std::exp(kAbsRise_ps * dt) + kAbsLeast_01 * kAbsRise_ps * dt);
  }
}

}  // namespace

double engine_torque_nm(const EngineParams& e, double speed_radps) {
  if (speed_radps <= e.speed_radps.front()) return e.torque_nm.front();
  if (speed_radps >= e.speed_radps.back()) return 0.0;  // limiter
  std::size_t i = 1;
  while (e.speed_radps[i] < speed_radps) ++i;
  const double u = (speed_radps - e.speed_radps[i - 1]) / (e.speed_radps[i] - e.speed_radps[i - 1]);
  return std::lerp(e.torque_nm[i - 1], e.torque_nm[i], u);
}

State standing(const VehicleParams& v, const Controls& input) {
  State s;
  s.brake_01 = input.brake_01;
  if (v.hill_hold_s > 0.0) s.held_01 = input.brake_01;
  return s;
}

State under_way(const VehicleParams& v, double speed_mps, double force_n) {
  State s;
  const bool pushed = force_n * speed_mps >= 0.0;
  if (pushed)
    s.drive_nm = force_n * v.tyre_radius_m;
  else
    s.brake_01 = std::min(std::abs(force_n) / v.max_brake_force_n, 1.0);
  if (v.engine)
    for (std::size_t gear = 1; gear < v.engine->gear_ratio.size(); ++gear) {
      const double engine = std::abs(speed_mps) / v.tyre_radius_m * v.engine->gear_ratio[gear] * v.engine->final_ratio;
      if (engine > 1.2 * v.engine->shift_down_radps) s.gear = static_cast<double>(gear);
    }
  return s;
}

Torques advance(const VehicleParams& v, const Controls& input, double speed_mps, const Wheels& w, State& s, double dt) {
  const double front_drive = v.chassis ? v.chassis->drive_front_01 : 0.0;
  const double front_brake = v.chassis ? v.chassis->brake_front_01 : 0.6;
  Torques out;

  // drive: a differential between the wheels of an axle, and one between the axles
  const double driven = front_drive * 0.5 * (w.spin_radps[0] + w.spin_radps[1]) +
                        (1.0 - front_drive) * 0.5 * (w.spin_radps[2] + w.spin_radps[3]);
  s.drive_nm += (drive_target_nm(v, input, driven, s, dt) - s.drive_nm) * caught_up(dt, kEngineLag_s);
  if (std::abs(s.drive_nm) < 1e-6) s.drive_nm = 0.0;  // a lag never ends; a parked car shall rest
  if (!v.engine && s.drive_nm * driven > v.max_power_w) s.drive_nm = v.max_power_w / driven;  // spun up within the lag
  for (std::size_t i = 0; i < 4; ++i) out.drive_nm[i] = 0.5 * s.drive_nm * (i < 2 ? front_drive : 1.0 - front_drive);

  // brakes
  s.brake_01 += (brake_target_01(v, input, speed_mps, s, dt) - s.brake_01) * caught_up(dt, kBrakeLag_s);
  if (s.brake_01 < 1e-9) s.brake_01 = 0.0;
  let_through(v, speed_mps, w, s, dt);
  for (std::size_t i = 0; i < 4; ++i) {
    const double share = 0.5 * (i < 2 ? front_brake : 1.0 - front_brake);
    out.brake_nm[i] = s.brake_01 * s.abs_01[i] * share * v.max_brake_force_n * v.tyre_radius_m;
    if (i >= 2) out.brake_nm[i] += parking_nm(v, input.parking_brake_01);
    const bool driven_wheel = i < 2 ? front_drive > 0.0 : front_drive < 1.0;
    if (input.gear == Gear::kPark && driven_wheel && std::abs(speed_mps) < kParkLock_mps)
      out.brake_nm[i] += kParkTorque_nm;
  }
  return out;
}

}  // namespace phare::powertrain
