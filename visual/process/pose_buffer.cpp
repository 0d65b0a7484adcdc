#include "visual/process/pose_buffer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace phare {
namespace {

double seconds_between(SimTime from, SimTime to) {
  return static_cast<double>(to.ns - from.ns) * 1e-9;
}

/// From a to b by the short way round.
double angle_between(double from_rad, double to_rad) {
  return std::remainder(to_rad - from_rad, 2.0 * std::numbers::pi);
}

double hermite(double p0, double v0, double p1, double v1, double u, double interval_s) {
  const double u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * p0 + (u3 - 2 * u2 + u) * interval_s * v0 + (3 * u2 - 2 * u3) * p1 +
         (u3 - u2) * interval_s * v1;
}

VehicleState interpolate(const VehicleState& a, const VehicleState& b, double u, double interval_s) {
  VehicleState mid = u < 0.5 ? a : b;
  mid.x_m = hermite(a.x_m, a.vx_mps, b.x_m, b.vx_mps, u, interval_s);
  mid.y_m = hermite(a.y_m, a.vy_mps, b.y_m, b.vy_mps, u, interval_s);
  mid.z_m = hermite(a.z_m, a.vz_mps, b.z_m, b.vz_mps, u, interval_s);
  mid.roll_rad = a.roll_rad + u * angle_between(a.roll_rad, b.roll_rad);
  mid.pitch_rad = a.pitch_rad + u * angle_between(a.pitch_rad, b.pitch_rad);
  mid.yaw_rad = a.yaw_rad + u * angle_between(a.yaw_rad, b.yaw_rad);
  mid.lamp_tilt_rad = a.lamp_tilt_rad + u * (b.lamp_tilt_rad - a.lamp_tilt_rad);
  mid.speed_mps = a.speed_mps + u * (b.speed_mps - a.speed_mps);
  return mid;
}

}  // namespace

VehicleState extrapolate(const VehicleState& state, double seconds) {
  VehicleState later = state;
  // Acceleration is in the car frame; yaw alone turns it well enough for the half square of a short time.
  const double c = std::cos(state.yaw_rad), s = std::sin(state.yaw_rad), half_square = 0.5 * seconds * seconds;
  later.x_m += state.vx_mps * seconds + (c * state.ax_mps2 - s * state.ay_mps2) * half_square;
  later.y_m += state.vy_mps * seconds + (s * state.ax_mps2 + c * state.ay_mps2) * half_square;
  later.z_m += state.vz_mps * seconds;
  later.roll_rad += state.roll_rate_radps * seconds;
  later.pitch_rad += state.pitch_rate_radps * seconds;
  later.yaw_rad += state.yaw_rate_radps * seconds;
  return later;
}

void PoseBuffer::push(SimTime time, const VehicleState& state) {
  if (count_ == 0 || time > ring_[newest_].time) {
    back_again_.reset();
  } else {
    const bool same = time == ring_[newest_].time;
    if (!same)
      back_again_ = 0;
    else if (back_again_)
      ++*back_again_;
    count_ = same ? count_ - 1 : 0;
    if (same) newest_ = (newest_ + ring_.size() - 1) % ring_.size();  // replaced below
  }
  newest_ = (newest_ + 1) % ring_.size();
  ring_[newest_] = {time, state};
  count_ = std::min(count_ + 1, ring_.size());
}

SimTime PoseBuffer::time_to_show(SimTime wanted, std::optional<SimTime> shown) const {
  constexpr auto kCoast_ns = static_cast<std::int64_t>(kCoast_s * 1e9);
  if (count_ == 0) return wanted;
  const SimTime time{std::min(wanted.ns, ring_[newest_].time.ns + kCoast_ns)};
  const bool stands = back_again_ && *back_again_ >= kStands;
  const bool a_little_behind = shown && time < *shown && shown->ns - time.ns <= kCoast_ns && !stands;
  return a_little_behind ? *shown : time;
}

std::optional<PoseBuffer::Drawn> PoseBuffer::at(SimTime time) const {
  if (count_ == 0) return std::nullopt;
  const Entry& newest = ring_[newest_];
  const double age_s = seconds_between(newest.time, time);
  if (age_s >= 0.0) return Drawn{extrapolate(newest.state, std::min(age_s, kCoast_s)), age_s, age_s > kCoast_s};
  // Walk back to the pair around `time`; before the oldest, the oldest.
  const Entry* later = &newest;
  for (std::size_t back = 1; back < count_; ++back) {
    const Entry& earlier = ring_[(newest_ + ring_.size() - back) % ring_.size()];
    if (earlier.time <= time) {
      const double interval_s = seconds_between(earlier.time, later->time);
      return Drawn{
          interpolate(earlier.state, later->state, seconds_between(earlier.time, time) / interval_s, interval_s), 0.0,
          false};
    }
    later = &earlier;
  }
  return Drawn{later->state, 0.0, false};
}

void DisplayClock::observe(SimTime stamped, WallTime sent) {
  constexpr std::int64_t kJump_ns = 50'000'000;
  constexpr std::int64_t kDriftPerNs = 10'000;  // 100 ppm
  const std::int64_t offset_ns = stamped.ns - sent.ns;
  const bool standing = stamped == stamped_;  // paused: display time stands with it
  if (!standing) first_stamped_ = sent;
  stamped_ = stamped;
  if (!offset_ns_ || standing || std::abs(offset_ns - *offset_ns_) > kJump_ns) {
    offset_ns_ = offset_ns;
  } else {
    offset_ns_ = std::max(offset_ns, *offset_ns_ - (sent.ns - observed_.ns) / kDriftPerNs);
  }
  observed_ = sent;
}

std::optional<SimTime> DisplayClock::at(WallTime wall) const {
  if (!offset_ns_) return std::nullopt;
  return SimTime{wall.ns + *offset_ns_};
}

}  // namespace phare
