// The control law of the lamps as a picture follows it: whose answer holds in this frame, and how late answers come.
//
// With --law. In lockstep a frame waits for the answer to it. In real time the newest answer holds; when none has come
// for channel_of<LawAnswer>().stale_after, it holds no more: low beam, lamps straight, and the picture says so.
// Checked by tests/visual_process/law_test.cpp.
#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "net/bus.h"
#include "net/messages.h"
#include "visual/process/frame_stats.h"
#include "visual/process/lamps.h"

namespace phare {

/// The controls with the beam that the law wants: while the stalk is at low or high, and the law says one.
CockpitState with_beam_of(const LawAnswer& answer, CockpitState controls);

/// The controls when the law is silent: low beam at most, with the reason in source_fault.
CockpitState without_law(CockpitState controls);

class LawLink {
 public:
  /// A lockstep frame can be drawn: the answer to it is here.
  static bool has_answered(const Bus& bus, std::int64_t frame);

  /// Lockstep, often: says once of a frame that it waits for its answer.
  void waits_for(std::int64_t frame);

  /// Turns and dims the lamps as the newest answer says, and returns the controls with its beam. `period`: of a frame,
  /// which an answer should not take longer than. `waits`: lockstep, where an answer does not age.
  CockpitState lead(const Bus& bus, Lamps& lamps, const CockpitState& controls, std::chrono::nanoseconds period,
                    bool waits);

  /// {"answers", "in_frame", "delay_ms": {…}, "silent_frames", "refused", "why"}. Delay: from when the pose was sent to
  /// when the answer to it arrived; in_frame counts those within a frame's time. In lockstep only the frames tell
  /// nothing of a real controller, but how long each waited.
  nlohmann::json json() const;

 private:
  void take(const Newest<LawAnswer>& answer, std::chrono::nanoseconds period);

  WallTime sent_{};  // of the answer that was counted last
  LogHistogram delay_ms_;
  std::uint64_t in_frame_ = 0, silent_frames_ = 0, refused_ = 0;
  std::string why_;  // the last was refused
  bool silent_ = false;
  std::int64_t waits_for_ = -1;
  std::chrono::steady_clock::time_point waits_since_{};
};

}  // namespace phare
