// From the moment a light control moved to the finished first frame that shows it.
#pragma once

#include <deque>

#include "net/messages.h"
#include "visual/process/frame_stats.h"

namespace phare {

class SwitchToPhoton {
 public:
  /// Call after every finished frame, with the controls drawn in it. `next_frame_sim`: simulated time of frame and
  /// spacing are only used in lockstep, where frames are counted in simulated time: 1 is the first frame due at or
  /// after the change. In real time they are counted by the wall clock: frames finished after the change, the showing
  /// one included.
  void frame_finished(const CockpitState& controls, SimTime frame_sim, WallTime finished,
                      std::int64_t lockstep_rate_hz);

  /// The next finished frame will be the first to show a change, if it is drawn with these.
  bool is_change(const CockpitState& controls) const {
    return !first_frame_ && controls.light_changes != drawn_changes_;  // the first frame shows what was before it
  }

  /// {"changes", "frames": {"1": n, "2": n, …}, "ms": {…}, "newest": [{"change", "frames", "ms", "sim_s"}]} newest 200
  /// changes.
  nlohmann::json json() const;

 private:
  struct Change {
    std::uint64_t number = 0;
    std::int64_t frames = 0;
    double ms = 0.0;
    double sim_s = 0.0;
  };
  std::uint64_t drawn_changes_ = 0;
  bool first_frame_ = true;
  std::deque<WallTime> finished_;  // of the newest 64 frames
  std::deque<Change> newest_;
  std::map<std::int64_t, std::uint64_t> frames_;
  LogHistogram ms_;
  std::uint64_t changes_ = 0;
};

}  // namespace phare
