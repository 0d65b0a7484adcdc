#include "vehicle_dynamics/driver.h"

#include <algorithm>
#include <cmath>

namespace phare::batch {

Driver::Pedals Driver::pedals(double x_m, double speed_mps, double dt) {
  if (x_m > o_.hold_until_x_m) return {};
  constexpr double kGain_ps = 0.5, kIntegral_ps2 = 0.3, kBrakeShare = 0.4, kDead = 0.05;
  const double short_of = *o_.hold_speed_mps - speed_mps;
  const double asked = kGain_ps * short_of + integral_;
  // What the pedals cannot give is not added up.
  if (std::abs(asked) < 1.0 || asked * short_of < 0.0) integral_ += kIntegral_ps2 * short_of * dt;
  return {.accelerator_01 = std::clamp(asked, 0.0, 1.0),
          .brake_01 = kBrakeShare * std::clamp(-asked - kDead, 0.0, 1.0)};
}

double Driver::steer_rad(double x_m, double y_m, double yaw_rad, double speed_mps, double wheelbase_m, double lock_rad,
                         double before_rad, double dt) {
  const auto& path = o_.path;
  const auto distance = [&](const LanePoint& p) { return std::hypot(p.x_m - x_m, p.y_m - y_m); };
  while (at_ + 1 < path.size() && distance(path[at_ + 1]) <= distance(path[at_])) ++at_;
  arrived_ = at_ + 1 >= path.size();
  const double ahead_m = std::max(o_.preview_s * std::abs(speed_mps), o_.least_preview_m);
  // The point so far ahead; beyond the end the path goes straight on.
  std::size_t k = at_;
  while (k + 1 < path.size() && distance(path[k]) < ahead_m) ++k;
  double target_x = path[k].x_m, target_y = path[k].y_m;
  if (k > 0 && distance(path[k]) > ahead_m && k > at_) {
    const double far = distance(path[k]), near = distance(path[k - 1]);
    const double u = far > near ? std::clamp((ahead_m - near) / (far - near), 0.0, 1.0) : 1.0;
    target_x = std::lerp(path[k - 1].x_m, path[k].x_m, u), target_y = std::lerp(path[k - 1].y_m, path[k].y_m, u);
  } else if (k + 1 == path.size()) {
    const double more = std::max(ahead_m - distance(path[k]), 0.0);
    target_x += more * std::cos(path[k].heading_rad), target_y += more * std::sin(path[k].heading_rad);
  }
  const double dx = target_x - x_m, dy = target_y - y_m;
  const double aside = -std::sin(yaw_rad) * dx + std::cos(yaw_rad) * dy, far2 = std::max(dx * dx + dy * dy, 1.0);
  const double wanted = std::clamp(std::atan(2.0 * wheelbase_m * aside / far2), -lock_rad, lock_rad);
  const double most = o_.most_rate_radps * dt;
  return before_rad + std::clamp(wanted - before_rad, -most, most);
}

}  // namespace phare::batch
