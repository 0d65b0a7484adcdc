#include "vehicle_dynamics/models/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <variant>

namespace phare {
namespace {

constexpr double kDenseWithin_s = 1.0;

using Field = double VehicleState::*;
constexpr std::array<Field, 3> kAngles{&VehicleState::roll_rad, &VehicleState::pitch_rad, &VehicleState::yaw_rad};
constexpr std::array<Field, 6> kSmooth{&VehicleState::x_m,      &VehicleState::y_m,       &VehicleState::z_m,
                                       &VehicleState::roll_rad, &VehicleState::pitch_rad, &VehicleState::yaw_rad};
constexpr std::array<Field, 13> kLinear{&VehicleState::vx_mps,
                                        &VehicleState::vy_mps,
                                        &VehicleState::vz_mps,
                                        &VehicleState::roll_rate_radps,
                                        &VehicleState::pitch_rate_radps,
                                        &VehicleState::yaw_rate_radps,
                                        &VehicleState::ax_mps2,
                                        &VehicleState::ay_mps2,
                                        &VehicleState::speed_mps,
                                        &VehicleState::steer_rad,
                                        &VehicleState::suspension_pitch_rad,
                                        &VehicleState::suspension_roll_rad,
                                        &VehicleState::suspension_heave_m};

constexpr double kTwoPi = 2.0 * std::numbers::pi;

}  // namespace

PoseTrack PoseTrack::from_drive(std::span<const Datagram> datagrams) {
  PoseTrack track;
  for (const Datagram& datagram : datagrams)
    if (const auto* state = std::get_if<VehicleState>(&datagram.payload))
      track.samples_.push_back({datagram.sim_time, *state});
  std::vector<Sample>& samples = track.samples_;
  std::stable_sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.time < b.time; });
  samples.erase(
      std::unique(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.time == b.time; }),
      samples.end());
  for (std::size_t i = 1; i < samples.size(); ++i)
    for (const Field angle : kAngles) {
      const double before = samples[i - 1].state.*angle;
      samples[i].state.*angle = before + std::remainder(samples[i].state.*angle - before, kTwoPi);
    }
  return track;
}

VehicleState PoseTrack::at(SimTime time) const {
  VehicleState out;
  if (empty()) {
    out.drive_ended = true;
    return out;
  }
  const auto after =
      std::upper_bound(samples_.begin(), samples_.end(), time, [](SimTime t, const Sample& s) { return t < s.time; });
  if (after == samples_.begin()) {
    out = after->state;
  } else if (after == samples_.end()) {
    out = samples_.back().state;
    if (time > end()) {
      for (const Field rate :
           {&VehicleState::vx_mps, &VehicleState::vy_mps, &VehicleState::vz_mps, &VehicleState::roll_rate_radps,
            &VehicleState::pitch_rate_radps, &VehicleState::yaw_rate_radps, &VehicleState::ax_mps2,
            &VehicleState::ay_mps2, &VehicleState::speed_mps})
        out.*rate = 0.0;
    }
    out.drive_ended = true;
  } else {
    const auto i = static_cast<std::size_t>(after - samples_.begin()) - 1;
    const auto seconds = [this](std::size_t from, std::size_t to) {
      return static_cast<double>(samples_[to].time.ns - samples_[from].time.ns) * 1e-9;
    };
    const double h = seconds(i, i + 1);
    const double u = static_cast<double>(time.ns - samples_[i].time.ns) * 1e-9 / h;
    const VehicleState &a = samples_[i].state, &b = samples_[i + 1].state;
    out = a;
    for (const Field field : kLinear) out.*field = a.*field + u * (b.*field - a.*field);
    if (h > kDenseWithin_s) {
      for (const Field field : kSmooth) out.*field = a.*field + u * (b.*field - a.*field);
    } else {
      // Slope at a sample: of the parabola through it and its neighbours; one-sided at the ends and beside a gap.
      const bool has_before = i > 0 && seconds(i - 1, i) <= kDenseWithin_s;
      const bool has_after = i + 2 < samples_.size() && seconds(i + 1, i + 2) <= kDenseWithin_s;
      for (const Field field : kSmooth) {
        const double chord = (b.*field - a.*field) / h;
        double slope_a = chord, slope_b = chord;
        if (has_before) {
          const double hb = seconds(i - 1, i), before = (a.*field - samples_[i - 1].state.*field) / hb;
          slope_a = (before * h + chord * hb) / (h + hb);
        }
        if (has_after) {
          const double ha = seconds(i + 1, i + 2), beyond = (samples_[i + 2].state.*field - b.*field) / ha;
          slope_b = (beyond * h + chord * ha) / (h + ha);
        }
        if (!has_before) slope_a = 2.0 * chord - slope_b;  // the parabola through three points goes on to the end
        if (!has_after) slope_b = 2.0 * chord - slope_a;
        const double c2 = 3.0 * chord - 2.0 * slope_a - slope_b, c3 = slope_a + slope_b - 2.0 * chord;
        out.*field = a.*field + u * h * (slope_a + u * (c2 + u * c3));
      }
    }
  }
  for (const Field angle : kAngles) out.*angle = std::remainder(out.*angle, kTwoPi);
  return out;
}

}  // namespace phare
