#include "visual/process/switch_to_photon.h"

#include <algorithm>

namespace phare {

void SwitchToPhoton::frame_finished(const CockpitState& controls, SimTime frame_sim, WallTime finished,
                                    std::int64_t lockstep_rate_hz) {
  constexpr std::size_t kRemembered = 64, kListed = 200;
  finished_.push_back(finished);
  if (finished_.size() > kRemembered) finished_.pop_front();
  const bool changed = is_change(controls);
  first_frame_ = false;
  drawn_changes_ = controls.light_changes;
  if (!changed) return;

  Change change{controls.light_changes, 0, static_cast<double>(finished.ns - controls.light_change_wall.ns) * 1e-6,
                controls.light_change_sim.seconds()};
  if (lockstep_rate_hz > 0) {
    const std::int64_t late_ns = std::max<std::int64_t>(frame_sim.ns - controls.light_change_sim.ns, 0);
    change.frames = 1 + late_ns * lockstep_rate_hz / 1'000'000'000;
  } else {
    change.frames =
        std::count_if(finished_.begin(), finished_.end(), [&](WallTime at) { return at > controls.light_change_wall; });
  }
  ++changes_;
  ++frames_[std::min<std::int64_t>(change.frames, 64)];
  ms_.add(std::max(change.ms, 0.0));
  newest_.push_back(change);
  if (newest_.size() > kListed) newest_.pop_front();
}

nlohmann::json SwitchToPhoton::json() const {
  nlohmann::json frames = nlohmann::json::object(), newest = nlohmann::json::array();
  for (const auto& [count, changes] : frames_) frames[std::to_string(count)] = changes;
  for (const Change& change : newest_) {
    newest.push_back(
        {{"change", change.number}, {"frames", change.frames}, {"ms", change.ms}, {"sim_s", change.sim_s}});
  }
  return {{"changes", changes_}, {"frames", frames}, {"ms", to_json(ms_)}, {"newest", newest}};
}

}  // namespace phare
