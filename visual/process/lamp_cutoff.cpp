// Where the cut-off of the low beam stands on a wall, as the car moves: the part of Lamps that the page of a drive
// plots.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "config/base/conventions.h"
#include "config/base/on_all_cores.h"
#include "visual/process/lamps.h"

namespace phare {

void Lamps::find_cutoffs(std::size_t first_design, std::size_t count) const {
  // Lamps with the same sources, as the two headlamps of most cars, have it in the same place.
  struct Search {
    std::vector<SourceConfig> sources;
    LampConfig lamp;
    std::optional<double> found_deg{};
  };
  std::vector<Search> searches;
  struct Wanted {
    std::optional<double>* to_deg;
    std::size_t search;
  };
  std::vector<Wanted> wanted;
  for (std::size_t design = first_design; design < first_design + count; ++design) {
    const std::vector<LampConfig>& lamps = designs_[design].lamps;
    const auto [cutoffs, unknown] = cutoffs_deg_.try_emplace(design, lamps.size());
    for (std::size_t slot = 0; unknown && slot < lamps.size(); ++slot) {
      std::vector<SourceConfig> sources = lamps[slot].sources;
      std::erase_if(sources, [](const SourceConfig& source) { return source.function != LampFunction::kLow; });
      if (sources.empty()) continue;
      auto search = std::ranges::find(searches, sources, &Search::sources);
      if (search == searches.end()) {
        search = searches.insert(searches.end(), {std::move(sources), lamps[slot]});
        search->lamp.aim = {};  // it stands as the rig has aimed it, and is not turned again
      }
      wanted.push_back({&cutoffs->second[slot], static_cast<std::size_t>(search - searches.begin())});
    }
  }
  cutoff_searches_ += searches.size();
  on_all_cores(searches.size(), [&](std::size_t i) {
    const LampAiming aiming = aim_lamp(searches[i].lamp, tables_);
    if (aiming.found) searches[i].found_deg = aiming.before_deg;
  });
  for (const Wanted& one : wanted) *one.to_deg = searches[one.search].found_deg;
}

std::optional<double> Lamps::cutoff_height_m(const VehicleState& pose, double wall_m) const {
  if (!lit_.contains(LampFunction::kLow)) return std::nullopt;
  const std::vector<LampConfig>& lamps = designs_[design_].lamps;
  if (!cutoffs_deg_.contains(design_)) find_cutoffs(design_, 1);
  const std::vector<std::optional<double>>& cutoffs_deg = cutoffs_deg_.at(design_);
  const glm::dmat3 body = world_from_car(pose.roll_rad, pose.pitch_rad, pose.yaw_rad);
  const double cos_yaw = std::cos(pose.yaw_rad), sin_yaw = std::sin(pose.yaw_rad);
  double sum_m = 0.0;
  int count = 0;
  for (std::size_t slot = 0; slot < lamps.size(); ++slot) {
    if (!cutoffs_deg[slot]) continue;
    const Position& position = positions_[design_][slot];
    const double elevation_rad = *cutoffs_deg[slot] * std::numbers::pi / 180.0;
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
