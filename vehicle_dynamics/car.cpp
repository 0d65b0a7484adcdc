#include "vehicle_dynamics/car.h"

#include <algorithm>

namespace phare {
namespace {

template <class... Levels>
std::variant<Levels...> level_of(Level level, std::type_identity<std::variant<Levels...>>) {
  static_assert((CarLevel<Levels> && ...));
  std::variant<Levels...> made = KinematicLevel{};  // kAuto begins there
  ((Levels::kLevel == level ? void(made = Levels{}) : void()), ...);
  return made;
}

}  // namespace

Car::AnyLevel Car::of(Level level) {
  return level_of(level, std::type_identity<AnyLevel>{});
}

bool Car::choose(AutoLevel& choice, const CarParams& p, const Controls& controls, const Road& road, double dt) {
  const Situation situation =
      situation_of(p.vehicle, shown.state, controls, road, shown.path_m, shown.least_load_share);
  const Level wanted = level_of_rung(choice.next(situation, dt).rung);
  if (wanted == level()) return false;
  take_over(wanted, p);
  return true;
}

double turned_rad(const VehicleParams& vehicle, double steering_wheel_rad, double before_rad, double dt) {
  const double wheel = std::clamp(steering_wheel_rad, -vehicle.max_steering_wheel_rad, vehicle.max_steering_wheel_rad);
  const double most = kinematic::kMaxSteeringWheelRate_radps / vehicle.steering_ratio * dt;
  return before_rad + std::clamp(wheel / vehicle.steering_ratio - before_rad, -most, most);
}

}  // namespace phare
