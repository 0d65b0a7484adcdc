#include "tools/import_motion.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "vehicle_dynamics/models/kinematic.h"

namespace phare {

DrivenCar::DrivenCar(const VehicleParams& vehicle, const RoadSurface& road, CarState start)
    : vehicle_(vehicle), road_(road), car_(std::move(start)) {
  stand(0.0);
}

/// On the road under its wheels; where there is none, on the height where it stands.
void DrivenCar::stand(double dt) {
  const auto contacts = kinematic::contact_points(vehicle_, car_);
  std::array<double, 4> height{};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto road = road_.at(contacts[i].x, contacts[i].y);
    height[i] = road ? road->z_m : car_.z_m;
  }
  kinematic::stand_on(vehicle_, height, car_, dt);
}

void DrivenCar::advance(double steering_wheel_rad, double speed_mps, double dt) {
  const double before_mps = car_.speed_mps;
  car_.speed_mps = 0.5 * (before_mps + speed_mps);
  kinematic::advance(vehicle_, steering_wheel_rad, {}, car_, dt);
  car_.speed_mps = speed_mps;
  car_.ax_mps2 = (speed_mps - before_mps) / dt;
  stand(dt);
}

Drift drift_of(const VehicleParams& vehicle, std::int64_t steps, double dt,
               const std::function<double(std::int64_t)>& steering_wheel_rad,
               const std::function<double(std::int64_t)>& speed_mps,
               const std::function<PlanePose(std::int64_t)>& recorded) {
  const RoadSurface plane;
  const PlanePose begin = recorded(0), end = recorded(steps);
  CarState start;
  start.x_m = begin.x_m;
  start.y_m = begin.y_m;
  start.yaw_rad = begin.yaw_rad;
  start.speed_mps = speed_mps(0);
  start.steer_rad = steering_wheel_rad(0) / vehicle.steering_ratio;
  DrivenCar car(vehicle, plane, start);
  Drift drift;
  for (std::int64_t k = 1; k <= steps; ++k) {
    car.advance(steering_wheel_rad(k), speed_mps(k), dt);
    drift.path_m += std::abs(car.state().speed_mps) * dt;
  }
  drift.distance_m = std::hypot(car.state().x_m - end.x_m, car.state().y_m - end.y_m);
  drift.heading_rad = std::remainder(car.state().yaw_rad - end.yaw_rad, 2.0 * std::numbers::pi);
  return drift;
}

std::string Drift::text() const {
  char text[200];
  std::snprintf(
      text, sizeof text,
      "driven by CAN speed and steering alone the car would end %.1f m from the recorded position after %.0f m "
      "(%.1f %%), turned by %+.1f deg",
      distance_m, path_m, path_m > 0.0 ? 100.0 * distance_m / path_m : 0.0, heading_rad * 180.0 / std::numbers::pi);
  return text;
}

}  // namespace phare
