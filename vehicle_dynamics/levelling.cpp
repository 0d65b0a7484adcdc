#include "vehicle_dynamics/levelling.h"

#include <algorithm>
#include <cmath>

#include "config/base/conventions.h"

namespace phare::levelling {

State settled(const LevellingParams& p, Kind kind, double rest_pitch_rad) {
  if (kind != Kind::kStatic && kind != Kind::kDynamic) return {};
  return {rest_pitch_rad, std::clamp(rest_pitch_rad, -p.range_rad, p.range_rad)};
}

void advance(const LevellingParams& p, Kind kind, double wheel_steps, double axle_pitch_rad, double speed_mps, State& s,
             double dt) {
  constexpr double kStanding_mps = 0.05;
  double target = 0.0;
  switch (kind) {
    case Kind::kNone:
      break;
    case Kind::kManual:
      target = -wheel_steps * p.manual_step_rad;
      break;
    case Kind::kStatic:
      // Load is weighed with the car standing; what braking does to the springs is none of it.
      if (std::abs(speed_mps) < kStanding_mps)
        s.measured_rad += (axle_pitch_rad - s.measured_rad) * -std::expm1(-dt / std::max(10.0 * p.filter_s, 1e-6));
      target = s.measured_rad;
      break;
    case Kind::kDynamic:
      s.measured_rad += (axle_pitch_rad - s.measured_rad) * -std::expm1(-dt / std::max(p.filter_s, 1e-6));
      target = s.measured_rad;
      break;
  }
  target = std::clamp(target, -p.range_rad, p.range_rad);
  s.tilt_rad += std::clamp(target - s.tilt_rad, -p.rate_radps * dt, p.rate_radps * dt);
}

double cutoff_on_wall_m(const LevellingParams& p, double pitch_rad, double heave_m, double tilt_rad) {
  const double lamp_m = heave_m - p.lamp_x_m * std::sin(pitch_rad) + p.lamp_height_m * std::cos(pitch_rad);
  return lamp_m + kWall_m * std::tan(p.aim_rad + tilt_rad + aim_from_pitch_rad(pitch_rad));
}

}  // namespace phare::levelling
