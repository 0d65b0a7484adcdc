// Which level a moment of driving calls for, and why: a declared table.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "config/vehicle.h"
#include "vehicle_dynamics/road.h"
#include "vehicle_dynamics/state.h"

namespace phare {

/// What the choice looks at.
struct Situation {
  double utilisation_01 = 0.0;  ///< acceleration in the plane over what the tyres can do
  double friction = 1.0;        ///< lowest under a wheel
  double unevenness_m = 0.0;    ///< of the road within 2 m ahead of the wheels, beyond a straight line
  double least_load_share = 1.0;
  double ax_mps2 = 0.0, ay_mps2 = 0.0;
  double speed_mps = 0.0;
  bool brake_or_grade = false;
};

/// Why a level was chosen; the strongest reason counts.
enum class Reason { kSmooth, kAcceleration, kRoughness, kUtilisation, kFriction, kUnevenness, kLoad, kStandstill };
const char* name(Reason reason);

struct Choice {
  int rung = 0;  ///< 0 kinematic, 1 single-track, 2 full
  Reason reason = Reason::kSmooth;
  double fact = 0.0;  ///< the number that decided, in the unit of its reason: 0.62 of utilisation, 0.041 m
};

/// One change of level, as it is told: when, from where to where, and what decided.
struct LevelSwitch {
  double time_s = 0.0;  ///< since the loop began
  int from = 0, to = 0;
  Reason reason = Reason::kSmooth;
  double fact = 0.0;
};
/// Of a rung: "kinematic", "single-track", "full".
const char* rung_name(int rung);
/// "kinematic to full: tyres used by more than half (0.62)".
std::string text(const LevelSwitch& change);

/// The table: full for utilisation > 0.5, friction < 0.5, unevenness > 3 cm, a load below a fifth, standing with brakes
/// or on a grade below 1.5 m/s; single-track for more than 0.5 m/s2 or unevenness > 2 mm; else kinematic. `scale` < 1
/// makes it stricter.
Choice choose(const Situation& situation, double scale = 1.0);

/// Up at once, down after 2 s below 0.7 of every threshold. Up again within as long as that took, it waits twice as
/// long the next time, up to half a minute: a situation on the edge does not make it hunt.
class AutoLevel {
 public:
  /// The rung for the coming step.
  Choice next(const Situation& situation, double dt);
  Choice now() const { return now_; }
  std::uint64_t switches() const { return switches_; }
  /// Switch number `n`, counted from 0; of the newest kKept.
  static constexpr std::uint64_t kKept = 64;
  const LevelSwitch& change(std::uint64_t n) const { return changes_[n % kKept]; }
  const std::array<double, 3>& seconds() const { return seconds_; }  ///< spent on each rung

 private:
  void go(const Choice& choice);

  Choice now_;
  double time_s_ = 0.0, quiet_s_ = 0.0, wait_s_ = 2.0, went_down_s_ = -1e9;
  std::array<LevelSwitch, kKept> changes_{};
  std::uint64_t switches_ = 0;
  std::array<double, 3> seconds_{};
};

/// What the car's state and the road ahead say. `friction_peak`: of the tyre, times g what it can do.
Situation situation_of(const VehicleParams& vehicle, const CarState& state, const Controls& controls, const Road& road,
                       double path_m, double least_load_share);

}  // namespace phare
