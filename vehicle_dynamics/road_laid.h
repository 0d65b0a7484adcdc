// What lies on a scene's road, from flags and files: heights, roughness, friction. Live and in batch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "vehicle_dynamics/road.h"

namespace phare {

struct Conditions {
  std::optional<double> friction{};  ///< of the whole road, 1 as the tyre was measured
  std::string roughness{};           ///< ISO 8608 class A to E, empty: none
  std::uint64_t seed = 1;
  std::string csv_file{};   ///< heights (x_m, z_m or z_left_m, z_right_m), friction (see road_friction.h), or both
  double envelope_m = 0.1;  ///< length over which a tyre averages the heights
};

/// Lays it on `road`; of the scene the friction file beside it, where there is one. Error: a file or a class is none.
Status lay(const Conditions& conditions, const std::filesystem::path& scene_file, Road& road);

/// "friction 0.3, 2 zones of friction, a height profile"; empty for a dry, even road.
std::string text(const Road& road);

}  // namespace phare
