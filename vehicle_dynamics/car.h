// The car: one of its levels at a time. Nothing outside of here asks which.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>
#include <variant>

#include "vehicle_dynamics/auto_level.h"
#include "vehicle_dynamics/levels.h"

namespace phare {

class Car {
  // The one place that asks which level it is.
  template <class Ask>
  decltype(auto) on(Ask&& ask) {
    return std::visit(std::forward<Ask>(ask), now);
  }
  template <class Ask>
  decltype(auto) on(Ask&& ask) const {
    return std::visit(std::forward<Ask>(ask), now);
  }

 public:
  using AnyLevel = std::variant<PoseLevel, KinematicLevel, SingleTrackLevel, FullLevel>;

  /// All that a step changes. Plain numbers, so that copying it keeps it whole, but for `input.road`.
  AnyLevel now = KinematicLevel{};
  chassis::Input input;
  Seen shown;  ///< as of show()

  /// A car of that level, before begin() or take_over(). kAuto is one of the others at any time.
  static AnyLevel of(Level level);

  Level level() const {
    return on([](const auto& l) { return l.kLevel; });
  }
  bool recorded() const {
    return on([](const auto& l) { return l.kRecorded; });
  }
  bool sprung() const {
    return on([](const auto& l) { return l.kSprung; });
  }
  bool heights_along_road() const {
    return on([](const auto& l) { return l.kHeightsAlongRoad; });
  }

  void begin(const CarParams& p, const Start& start) {
    on([&](auto& l) { l.begin(p, start); });
  }
  bool stand(const CarParams& p) {
    return on([&](auto& l) { return l.stand(p, input); });
  }
  void advance(const CarParams& p, double dt) {
    on([&](auto& l) { l.advance(p, input, dt); });
  }
  /// The same, into an account of energies.
  void advance(const CarParams& p, double dt, energy::Account& account) {
    on([&](auto& l) {
      const auto before = l;
      l.advance(p, input, dt);
      l.account(p, input, before, dt, account);
    });
  }
  /// By another integrator, as ReferenceIntegrator is one.
  template <class Reference>
  Status advance_by(Reference& reference, const CarParams& p, double dt) {
    return on([&](auto& l) { return l.advance_by(reference, p, input, dt); });
  }

  /// Goes on at another level from what is shown.
  void take_over(Level level, const CarParams& p) {
    now = of(level);
    on([&](auto& l) { l.take_over(p, shown); });
  }
  /// At level auto: looks at what is shown and at the road, and goes on at the level they call for. True: another one.
  bool choose(AutoLevel& choice, const CarParams& p, const Controls& controls, const Road& road, double dt);

  /// Brings `shown` up to date; its yaw counts on.
  const Seen& show(const CarParams& p) {
    return shown = on([&](const auto& l) { return l.seen(p, input, shown.state.yaw_rad); });
  }
  /// `in`: at the moment asked for.
  Motion motion(const CarParams& p, const chassis::Input& in) const {
    return on([&](const auto& l) { return l.motion(p, in); });
  }
  WheelFigures figures(const CarParams& p, const chassis::Forces& forces, double dt) const {
    return on([&](const auto& l) { return l.figures(p, input, forces, dt); });
  }
  LanePoint place(const CarParams& p) const {
    return on([&](const auto& l) { return l.place(p); });
  }
  double speed_mps(const CarParams& p) const {
    return on([&](const auto& l) { return l.speed_mps(p); });
  }
  powertrain::Wheels wheels(const CarParams& p) const {
    return on([&](const auto& l) { return l.wheels(p, input); });
  }
  energy::Account open_account(const CarParams& p) const {
    return on([&](const auto& l) { return l.open_account(p, input); });
  }
  bool sound() const {
    return on([](const auto& l) { return l.sound(); });
  }
  /// Of the level's own state; where it has none beside it, of `state`.
  std::uint64_t hash(const CarState& state) const {
    return on([&](const auto& l) { return l.hash(state); });
  }
};
static_assert(std::is_trivially_copyable_v<Car>);

/// How far the steering of a live drive turns the front wheels in a step: the wheel at 1000 degrees a second at most.
double turned_rad(const VehicleParams& vehicle, double steering_wheel_rad, double before_rad, double dt);

}  // namespace phare
