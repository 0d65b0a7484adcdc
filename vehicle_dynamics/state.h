// The car as the models know it, and what the driver asks of it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "config/vehicle.h"
#include "net/messages.h"

namespace phare {

/// What the parking brake can do, on the rear wheels: its share of max_brake_force_n. Chosen.
inline constexpr double kParkingShare_01 = 0.5;

/// What the driver does, as the models take it.
struct Controls {
  double steering_wheel_rad = 0.0;  ///< left positive
  double accelerator_01 = 0.0;
  double brake_01 = 0.0;
  Gear gear = Gear::kDrive;
  double parking_brake_01 = 0.0;

  friend bool operator==(const Controls&, const Controls&) = default;
};

/// State of the car after a step. Position and angles are those of proto VehicleState: origin on the ground under the
/// middle of the rear axle, world frame, ISO 8855 signs (pitch > 0 nose down). Road angles and suspension angles add up
/// to the body's; the product of rotations would differ by their products, below 0.1 mrad on ordinary roads.
struct CarState {
  double x_m = 0.0, y_m = 0.0;
  double z_m = 0.0;        ///< of the road under the origin; the body's is this plus heave
  double yaw_rad = 0.0;    ///< counts on beyond ±pi
  double speed_mps = 0.0;  ///< along the car's x, < 0 backwards
  double steer_rad = 0.0;  ///< mean road-wheel angle, left positive
  double road_pitch_rad = 0.0, road_roll_rad = 0.0;
  double road_pitch_rate_radps = 0.0, road_roll_rate_radps = 0.0;
  double pitch_rad = 0.0, pitch_rate_radps = 0.0;  ///< of the body on its springs, relative to the road plane
  double roll_rad = 0.0, roll_rate_radps = 0.0;
  double heave_m = 0.0, heave_rate_mps = 0.0;  ///< lift of the body at the origin, i.e. over the rear axle
  double ax_mps2 = 0.0, ay_mps2 = 0.0;         ///< of the last step, car frame, without gravity
  double yaw_rate_radps = 0.0;
  double lamp_tilt_rad = 0.0;           ///< of the lamps against the body by levelling, > 0 up
  std::array<double, 4> contact_z_m{};  ///< road under the wheels: front left, front right, rear left, rear right

  friend bool operator==(const CarState&, const CarState&) = default;
};

/// Of the body against the road: no car comes back from there, and no level has a body that touches the road.
inline constexpr double kRolledOver_rad = 1.2;

inline constexpr std::size_t kCarStateFields = 24;
/// All of it, in order.
std::array<double, kCarStateFields> fields_of(const CarState& state);

/// Over the bits of every field in order, after FNV-1a (Fowler, Noll, Vo 1991; 64 bit) but eight bytes at a time: a
/// step is hashed in a tenth of a microsecond. Two states that differ in one field never share it.
std::uint64_t state_hash(const CarState& state);

/// The same over any state that is doubles only.
std::uint64_t hash_of(const double* values, std::size_t count);
template <class State>
std::uint64_t state_hash(const State& state) {
  static_assert(sizeof(State) % sizeof(double) == 0 && std::is_trivially_copyable_v<State>);
  std::array<double, sizeof(State) / sizeof(double)> values;
  std::memcpy(values.data(), &state, sizeof(State));
  return hash_of(values.data(), values.size());
}

/// Every number of a state that is doubles only is finite.
template <class State>
bool all_finite(const State& state) {
  static_assert(sizeof(State) % sizeof(double) == 0 && std::is_trivially_copyable_v<State>);
  constexpr std::size_t kCount = sizeof(State) / sizeof(double);
  const auto value = [bytes = reinterpret_cast<const char*>(&state)](std::size_t i) {
    double number = 0.0;
    std::memcpy(&number, bytes + i * sizeof number, sizeof number);  // a plain load
    return number;
  };
  // What is not finite makes its product with 0 not 0. Four sums, which do not wait for one another.
  std::array<double, 4> sum{};
  for (std::size_t i = 0; i + 4 <= kCount; i += 4)
    for (std::size_t k = 0; k < 4; ++k) sum[k] += value(i + k) * 0.0;
  if constexpr (kCount % 4 != 0)
    for (std::size_t i = kCount / 4 * 4; i < kCount; ++i) sum[0] += value(i) * 0.0;
  return sum[0] + sum[1] + sum[2] + sum[3] == 0.0;
}

/// Numbers that a car can have, by far: a step that is too long for the method, or a road that rises by kilometres,
/// leaves them.
inline bool a_car_could(double u_mps, double v_mps, double w_mps) {
  constexpr double kMost_mps = 1e4;
  return u_mps * u_mps + v_mps * v_mps + w_mps * w_mps < kMost_mps * kMost_mps;
}

/// Linear between two states, 0 gives `from` and 1 gives `to` exactly.
CarState interpolate(const CarState& from, const CarState& to, double fraction);

/// The message: yaw brought into (-pi, pi], world velocity from speed and road. Level, step, hash and flags are the
/// caller's. States count from where the car rests with its load, messages from where it rests without: `rest` is
/// between.
VehicleState to_message(const CarState& state, const RestAttitude& rest = {});

/// What a message tells of a state, to go on from after a restart. Rates of the road plane start at 0; contact heights
/// are those of the road plane through the pose.
CarState from_message(const VehicleState& message, double wheelbase_m, double track_m, const RestAttitude& rest = {});

/// `controls` if every number is finite, limited to their ranges; otherwise `last`. So models see sane numbers only.
Controls accepted(const Controls& controls, const Controls& last, bool* refused = nullptr);

/// Silence of the cockpit: from 0.5 s on the pedals fade to zero within another second, linearly; steering and gear
/// stay.
inline constexpr std::chrono::nanoseconds kSilentAfter = std::chrono::milliseconds(500);
Controls faded(const Controls& controls, std::chrono::nanoseconds silence);

}  // namespace phare
