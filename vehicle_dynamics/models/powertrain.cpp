#include "vehicle_dynamics/models/powertrain.h"

#include <algorithm>
#include <cmath>

namespace phare::powertrain {
namespace {

constexpr double kEngineLag_s = 0.1, kBrakeLag_s = 0.06;  // notes of the field, usual for passenger cars
constexpr double kShiftPause_s = 0.6;                     // no two shifts within
constexpr double kAbsFrom_mps = 1.5;                      // below it wheel speed sensors are blind
constexpr double kAbsRelease = -0.15, kAbsApply = -0.10;  // slip band around the tyre's peak
constexpr double kAbsFall_ps = 20.0, kAbsRise_ps = 8.0;   // of the pressure share; gives 8 to 15 cycles a second
constexpr double kReverseBelow_radps = 5.0;               // of the wheels, 1.5 m/s: rolling faster, gearboxes refuse it
constexpr double kParkLock_mps = 0.5;                     // below it the pawl of the parking lock falls in
constexpr double kParkTorque_nm = 3000.0;                 // of the pawl, at each driven wheel; chosen: it never slips

double with_engine_nm(const EngineParams& e, double accelerator, double wheel_radps, bool reverse, double dt,
                      State& s) {
  const auto ratio = [&](double gear) { return e.gear_ratio[static_cast<std::size_t>(gear)] * e.final_ratio; };
  s.since_shift_s += dt;
  if (!reverse && s.since_shift_s > kShiftPause_s) {
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
  const double total = reverse ? e.reverse_ratio * e.final_ratio : ratio(s.gear);
  const double turbine = std::abs(wheel_radps) * total;
  // The converter lets the engine turn faster than the gearbox and multiplies its torque while it does.
  const double stall = e.idle_radps * (1.0 + 1.5 * accelerator);
  const double speed = std::max(turbine, stall);
  const double multiplied = turbine < stall ? std::lerp(e.converter_ratio, 1.0, turbine / stall) : 1.0;
  const double dragging = std::clamp((turbine - e.idle_radps) / e.idle_radps, 0.0, 1.0);  // it idles, it does not stall
  const double torque = accelerator * engine_torque_nm(e, speed) * multiplied * e.efficiency_01 -
                        (1.0 - accelerator) * e.drag_nm * dragging;
  return (reverse ? -torque : torque) * total * (reverse && wheel_radps > kReverseBelow_radps ? 0.0 : 1.0);
}

double without_engine_nm(const VehicleParams& v, double accelerator, double speed_mps, bool reverse) {
  const double force = accelerator * std::min(v.max_drive_force_n, v.max_power_w / std::max(std::abs(speed_mps), 0.1));
  return (reverse ? -force : force) * v.tyre_radius_m;
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

Torques advance(const VehicleParams& v, const Controls& input, double speed_mps, const std::array<double, 4>& spin,
                bool has_slip, State& s, double dt) {
  const double front_drive = v.chassis ? v.chassis->drive_front_01 : 0.0;
  const double front_brake = v.chassis ? v.chassis->brake_front_01 : 0.6;
  Torques out;

  // drive
  double target = 0.0;
  const bool reverse = input.gear == Gear::kReverse;
  if (input.gear == Gear::kDrive || reverse) {
    const double driven = front_drive * 0.5 * (spin[0] + spin[1]) + (1.0 - front_drive) * 0.5 * (spin[2] + spin[3]);
    target = v.engine ? with_engine_nm(*v.engine, input.accelerator_01, driven, reverse, dt, s)
                      : without_engine_nm(v, input.accelerator_01, speed_mps, reverse);
  }
  s.drive_nm += (target - s.drive_nm) * -std::expm1(-dt / kEngineLag_s);
  if (std::abs(s.drive_nm) < 1e-6) s.drive_nm = 0.0;  // an exponential never ends; a parked car shall rest
  for (std::size_t i = 0; i < 4; ++i) out.drive_nm[i] = 0.5 * s.drive_nm * (i < 2 ? front_drive : 1.0 - front_drive);

  // brakes
  s.brake_01 += (input.brake_01 - s.brake_01) * -std::expm1(-dt / kBrakeLag_s);
  if (s.brake_01 < 1e-9) s.brake_01 = 0.0;
  std::array<double, 4> slip{};
  const double reference = std::max(std::abs(speed_mps), 1.0);
  for (std::size_t i = 0; i < 4; ++i) slip[i] = (std::abs(spin[i]) * v.tyre_radius_m - std::abs(speed_mps)) / reference;
  slip[2] = slip[3] = std::min(slip[2], slip[3]);
  for (std::size_t i = 0; i < 4; ++i) {
    const bool active = has_slip && std::abs(speed_mps) > kAbsFrom_mps && s.brake_01 > 0.0;
    if (!active)
      s.abs_01[i] = 1.0;
    else if (slip[i] < kAbsRelease)
      s.abs_01[i] = std::max(0.0, s.abs_01[i] - kAbsFall_ps * dt);
    else if (slip[i] > kAbsApply)
      s.abs_01[i] = std::min(1.0, s.abs_01[i] + kAbsRise_ps * dt);
    const double share = 0.5 * (i < 2 ? front_brake : 1.0 - front_brake);
    out.brake_nm[i] = s.brake_01 * s.abs_01[i] * share * v.max_brake_force_n * v.tyre_radius_m;
    if (i >= 2)
      out.brake_nm[i] += 0.5 * kParkingShare_01 * input.parking_brake_01 * v.max_brake_force_n * v.tyre_radius_m;
    const bool driven = i < 2 ? front_drive > 0.0 : front_drive < 1.0;
    if (input.gear == Gear::kPark && driven && std::abs(speed_mps) < kParkLock_mps) out.brake_nm[i] += kParkTorque_nm;
  }
  return out;
}

}  // namespace phare::powertrain
