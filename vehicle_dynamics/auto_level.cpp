#include "vehicle_dynamics/auto_level.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "config/base/conventions.h"
#include "vehicle_dynamics/models/kinematic.h"

namespace phare {

const char* name(Reason reason) {
  constexpr std::array<const char*, 8> kNames{"smooth road, gentle driving",
                                              "acceleration above 0.5 m/s2",
                                              "road uneven by more than 2 mm",
                                              "tyres used by more than half",
                                              "low friction",
                                              "road uneven by more than 3 cm",
                                              "a wheel nearly lifts",
                                              "standing or creeping with brakes or on a grade"};
  return kNames[static_cast<std::size_t>(reason)];
}

const char* rung_name(int rung) {
  constexpr std::array<const char*, 3> kRungs{"kinematic", "single-track", "full"};
  return kRungs[static_cast<std::size_t>(rung)];
}

std::string text(const LevelSwitch& change) {
  char number[40];
  std::snprintf(number, sizeof number, " (%.3g)", change.fact);
  return std::string(rung_name(change.from)) + " to " + rung_name(change.to) + ": " + name(change.reason) + number;
}

Choice choose(const Situation& s, double scale) {
  const double accelerated = std::max(std::abs(s.ax_mps2), std::abs(s.ay_mps2));
  if (s.least_load_share < 1.0 - 0.8 * scale) return {2, Reason::kLoad, s.least_load_share};
  if (s.unevenness_m > 0.03 * scale) return {2, Reason::kUnevenness, s.unevenness_m};
  if (s.friction < 0.5 / scale) return {2, Reason::kFriction, s.friction};
  if (s.utilisation_01 > 0.5 * scale) return {2, Reason::kUtilisation, s.utilisation_01};
  if (std::abs(s.speed_mps) < 1.5 / scale && s.brake_or_grade) return {2, Reason::kStandstill, s.speed_mps};
  if (s.unevenness_m > 0.002 * scale) return {1, Reason::kRoughness, s.unevenness_m};
  if (accelerated > 0.5 * scale) return {1, Reason::kAcceleration, accelerated};
  return {0, Reason::kSmooth, accelerated};
}

void AutoLevel::go(const Choice& choice) {
  changes_[switches_ % kKept] = {time_s_, now_.rung, choice.rung, choice.reason, choice.fact};
  ++switches_;
  now_ = choice;
  quiet_s_ = 0.0;
}

Choice AutoLevel::next(const Situation& situation, double dt) {
  constexpr double kCalmer = 0.7, kQuiet_s = 2.0, kLongest_s = 30.0;
  const Choice wanted = choose(situation);
  if (wanted.rung > now_.rung) {
    wait_s_ = time_s_ - went_down_s_ < wait_s_ ? std::min(2.0 * wait_s_, kLongest_s) : kQuiet_s;
    go(wanted);
  } else if (const Choice strict = choose(situation, kCalmer); strict.rung < now_.rung) {
    quiet_s_ += dt;
    if (quiet_s_ >= wait_s_) {
      go(strict);
      went_down_s_ = time_s_;
    }
  } else {
    quiet_s_ = 0.0;
    if (wanted.rung == now_.rung) now_ = wanted;
  }
  time_s_ += dt;
  seconds_[static_cast<std::size_t>(now_.rung)] += dt;
  return now_;
}

Situation situation_of(const VehicleParams& v, const CarState& s, const Controls& controls, const Road& road,
                       double path_m, double least_load_share) {
  Situation situation;
  const double peak = v.chassis ? v.chassis->tyre.lat_peak : v.max_lateral_mps2 / kGravity_mps2;
  const auto points = kinematic::contact_points(v, s);
  const double c = std::cos(s.yaw_rad), sn = std::sin(s.yaw_rad), way = s.speed_mps < 0.0 ? -1.0 : 1.0;
  bool off = false;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<double, 3> z{};
    const double here = path_m + (i < 2 ? v.cg_to_front_m : v.cg_to_front_m - v.wheelbase_m);
    for (std::size_t k = 0; k < 3; ++k) {
      const double ahead = way * static_cast<double>(k);
      const Ground ground =
          road.at(points[i].x + c * ahead, points[i].y + sn * ahead, here + ahead, i % 2 == 0, s.contact_z_m[i], &off);
      z[k] = ground.z_m;
      situation.friction = std::min(situation.friction, ground.friction);
    }
    if (!off) situation.unevenness_m = std::max(situation.unevenness_m, 2.0 * std::abs(z[1] - 0.5 * (z[0] + z[2])));
  }
  situation.utilisation_01 = std::hypot(s.ax_mps2, s.ay_mps2) / (situation.friction * peak * kGravity_mps2);
  situation.least_load_share = least_load_share;
  situation.ax_mps2 = s.ax_mps2, situation.ay_mps2 = s.ay_mps2, situation.speed_mps = s.speed_mps;
  situation.brake_or_grade =
      controls.brake_01 > 0.0 || controls.gear == Gear::kPark || std::abs(s.road_pitch_rad) > 0.005;
  return situation;
}

}  // namespace phare
