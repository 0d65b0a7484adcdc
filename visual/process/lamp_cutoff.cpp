// Where the cut-off of the low beam stands on a wall, as the car moves: the part of Lamps that the page of a drive
// plots.
#include <cmath>
#include <numbers>

#include "config/base/conventions.h"
#include "visual/process/lamps.h"

namespace phare {

std::optional<double> Lamps::cutoff_height_m(const VehicleState& pose, double wall_m) const {
  if (!lit_.contains(LampFunction::kLow)) return std::nullopt;
  const std::vector<LampConfig>& lamps = designs_[design_].lamps;
  auto [known, first] = cutoffs_deg_.try_emplace(design_);
  if (first) {
    for (LampConfig lamp : lamps) {  // a copy: it stands as the rig has aimed it, and is not turned again
      lamp.aim = {};
      const LampAiming aiming = aim_lamp(lamp, tables_);
      const bool low = aiming.found && aiming.function == LampFunction::kLow;
      known->second.push_back(low ? std::optional(aiming.before_deg) : std::nullopt);
    }
  }
  const glm::dmat3 body = world_from_car(pose.roll_rad, pose.pitch_rad, pose.yaw_rad);
  const double cos_yaw = std::cos(pose.yaw_rad), sin_yaw = std::sin(pose.yaw_rad);
  double sum_m = 0.0;
  int count = 0;
  for (std::size_t slot = 0; slot < lamps.size(); ++slot) {
    if (!known->second[slot]) continue;
    const Position& position = positions_[design_][slot];
    const double elevation_rad = *known->second[slot] * std::numbers::pi / 180.0;
    const glm::dvec3 way =
        body * turned(position, pose.lamp_tilt_rad) * glm::dvec3(std::cos(elevation_rad), 0.0, std::sin(elevation_rad));
    const double ahead = way.x * cos_yaw + way.y * sin_yaw;
    if (ahead <= 0.0) continue;
    sum_m += (body * position.mount.position_m).z + wall_m / ahead * way.z;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum_m / count;
}

}  // namespace phare
