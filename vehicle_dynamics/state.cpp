#include "vehicle_dynamics/state.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace phare {
namespace {

constexpr std::size_t kFields = kCarStateFields;

// Every double of a state in declaration order; one list for hash and interpolation.
template <class State, class Visit>
void for_each_field(State& s, Visit&& visit) {
  for (auto* field : {&s.x_m,
                      &s.y_m,
                      &s.z_m,
                      &s.yaw_rad,
                      &s.speed_mps,
                      &s.steer_rad,
                      &s.road_pitch_rad,
                      &s.road_roll_rad,
                      &s.road_pitch_rate_radps,
                      &s.road_roll_rate_radps,
                      &s.pitch_rad,
                      &s.pitch_rate_radps,
                      &s.roll_rad,
                      &s.roll_rate_radps,
                      &s.heave_m,
                      &s.heave_rate_mps,
                      &s.ax_mps2,
                      &s.ay_mps2,
                      &s.yaw_rate_radps,
                      &s.lamp_tilt_rad})
    visit(*field);
  for (auto& height : s.contact_z_m) visit(height);
}
static_assert(sizeof(CarState) == kFields * sizeof(double), "a new field belongs into for_each_field");

}  // namespace

std::array<double, kCarStateFields> fields_of(const CarState& state) {
  std::array<double, kFields> values{};
  std::size_t i = 0;
  for_each_field(state, [&](const double& field) { values[i++] = field; });
  return values;
}

std::uint64_t state_hash(const CarState& state) {
  const auto values = fields_of(state);
  return hash_of(values.data(), values.size());
}

std::uint64_t hash_of(const double* values, std::size_t count) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::size_t i = 0; i < count; ++i) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(values[i])) * 0x100000001b3u;
    hash ^= hash >> 32;  // multiplication carries upwards only
  }
  return hash;
}

CarState interpolate(const CarState& from, const CarState& to, double fraction) {
  if (fraction <= 0.0) return from;
  if (fraction >= 1.0) return to;
  std::array<double, kFields> target{};
  std::size_t i = 0;
  for_each_field(to, [&](const double& field) { target[i++] = field; });
  CarState between = from;
  i = 0;
  for_each_field(between, [&](double& field) { field += (target[i++] - field) * fraction; });
  return between;
}

VehicleState to_message(const CarState& s, const RestAttitude& rest) {
  VehicleState m;
  m.x_m = s.x_m, m.y_m = s.y_m, m.z_m = s.z_m + s.heave_m + rest.heave_m;
  m.roll_rad = s.road_roll_rad + s.roll_rad;
  m.pitch_rad = s.road_pitch_rad + s.pitch_rad + rest.pitch_rad;
  m.yaw_rad = std::remainder(s.yaw_rad, 2.0 * std::numbers::pi);
  const double level_speed = s.speed_mps * std::cos(s.road_pitch_rad);
  m.vx_mps = level_speed * std::cos(s.yaw_rad);
  m.vy_mps = level_speed * std::sin(s.yaw_rad);
  m.vz_mps = -s.speed_mps * std::sin(s.road_pitch_rad) + s.heave_rate_mps;
  m.roll_rate_radps = s.road_roll_rate_radps + s.roll_rate_radps;
  m.pitch_rate_radps = s.road_pitch_rate_radps + s.pitch_rate_radps;
  m.yaw_rate_radps = s.yaw_rate_radps;
  m.ax_mps2 = s.ax_mps2, m.ay_mps2 = s.ay_mps2;
  m.speed_mps = s.speed_mps;
  m.steer_rad = s.steer_rad;
  m.suspension_pitch_rad = s.pitch_rad + rest.pitch_rad;
  m.suspension_roll_rad = s.roll_rad;
  m.suspension_heave_m = s.heave_m + rest.heave_m;
  m.lamp_tilt_rad = s.lamp_tilt_rad;
  return m;
}

CarState from_message(const VehicleState& m, double wheelbase_m, double track_m, const RestAttitude& rest) {
  CarState s;
  s.x_m = m.x_m, s.y_m = m.y_m, s.z_m = m.z_m - m.suspension_heave_m;
  s.yaw_rad = m.yaw_rad;
  s.speed_mps = m.speed_mps;
  s.steer_rad = m.steer_rad;
  s.road_pitch_rad = m.pitch_rad - m.suspension_pitch_rad;
  s.road_roll_rad = m.roll_rad - m.suspension_roll_rad;
  s.pitch_rad = m.suspension_pitch_rad - rest.pitch_rad, s.pitch_rate_radps = m.pitch_rate_radps;
  s.roll_rad = m.suspension_roll_rad, s.roll_rate_radps = m.roll_rate_radps;
  s.heave_m = m.suspension_heave_m - rest.heave_m;
  s.heave_rate_mps = m.vz_mps + m.speed_mps * std::sin(s.road_pitch_rad);
  s.ax_mps2 = m.ax_mps2, s.ay_mps2 = m.ay_mps2;
  s.yaw_rate_radps = m.yaw_rate_radps;
  s.lamp_tilt_rad = m.lamp_tilt_rad;
  const double to_front = -wheelbase_m * std::tan(s.road_pitch_rad);
  const double to_left = 0.5 * track_m * std::tan(s.road_roll_rad) / std::cos(s.road_pitch_rad);
  s.contact_z_m = {s.z_m + to_front + to_left, s.z_m + to_front - to_left, s.z_m + to_left, s.z_m - to_left};
  return s;
}

Controls accepted(const Controls& controls, const Controls& last, bool* refused) {
  const bool sane = std::isfinite(controls.steering_wheel_rad) && std::isfinite(controls.accelerator_01) &&
                    std::isfinite(controls.brake_01) && std::isfinite(controls.parking_brake_01) &&
                    controls.gear >= Gear::kDrive && controls.gear <= Gear::kPark;
  if (refused) *refused = !sane;
  if (!sane) return last;
  Controls limited = controls;
  limited.steering_wheel_rad =
      std::clamp(controls.steering_wheel_rad, -100.0, 100.0);  // the model knows the car's lock
  limited.accelerator_01 = std::clamp(controls.accelerator_01, 0.0, 1.0);
  limited.brake_01 = std::clamp(controls.brake_01, 0.0, 1.0);
  limited.parking_brake_01 = std::clamp(controls.parking_brake_01, 0.0, 1.0);
  return limited;
}

Controls faded(const Controls& controls, std::chrono::nanoseconds silence) {
  if (silence <= kSilentAfter) return controls;
  const double gone_s = std::chrono::duration<double>(silence - kSilentAfter).count();
  const double left = std::max(0.0, 1.0 - gone_s);
  Controls fading = controls;
  fading.accelerator_01 *= left;
  fading.brake_01 *= left;
  return fading;
}

}  // namespace phare
