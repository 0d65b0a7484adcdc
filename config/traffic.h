// Other road users on their way along the lane of a scene, from a TOML file (docs/control-law.md has every key). What
// they do is a function of time alone, so every process, and a law in Python (python/phare/control/road_users.py),
// knows the same of them without a message.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <string_view>
#include <vector>

#include "config/base/result.h"

namespace phare {

enum class RoadUserKind { kCar, kLorry, kMotorcycle, kBicycle, kPedestrian };
inline constexpr std::array<std::string_view, 5> kRoadUserNames{"car", "lorry", "motorcycle", "bicycle", "pedestrian"};

struct RoadUser {
  RoadUserKind kind = RoadUserKind::kCar;
  int direction = -1;      ///< -1 oncoming, 1 as we drive, 0 standing
  double start_s_m = 0.0;  ///< of its middle along the lane, at time 0
  double speed_mps = 0.0;
  double offset_m = 0.0;  ///< from the line we drive on, positive to the left
  bool lights = true;     ///< its lamps burn
  double from_s = 0.0, to_s = std::numeric_limits<double>::infinity();  ///< when it is there, simulated time
  double width_m = 1.8, height_m = 1.5, length_m = 4.3;                 ///< as sensors of a law see it

  double s_m(double time_s) const { return start_s_m + direction * speed_mps * time_s; }
  bool is_there(double time_s) const { return time_s >= from_s && time_s < to_s; }
  /// Its lamps look against the lane.
  bool faces_back() const { return direction < 0; }
};

/// Reads [[road_user]] tables. Errors say file:line.
Result<std::vector<RoadUser>> read_traffic(const std::filesystem::path& file);

}  // namespace phare
