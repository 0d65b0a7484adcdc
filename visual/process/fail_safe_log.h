// When a drive was shown with the beam of the fail-safe, and why: for the report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "net/messages.h"

namespace phare {

class FailSafeLog {
 public:
  static constexpr std::size_t kMost = 100;  ///< of the times that are kept; all frames are counted

  /// Of every frame drawn.
  void add(SimTime time, const CockpitState& controls) {
    if (controls.fail_safe) {
      ++frames_;
      if (!on_ && times_.size() < kMost) times_.push_back({time, time, {}});
      if (!on_) ++count_;
      if (count_ <= kMost) times_.back().to = time, times_.back().because = because(controls);
    }
    on_ = controls.fail_safe;
  }

  std::uint64_t frames() const { return frames_; }

  /// {"frames", "count", "times": [{"from_s", "to_s", "because"}]}
  nlohmann::json json() const {
    nlohmann::json times = nlohmann::json::array();
    for (const Once& once : times_)
      times.push_back({{"from_s", once.from.seconds()}, {"to_s", once.to.seconds()}, {"because", once.because}});
    return {{"frames", frames_}, {"count", count_}, {"times", times}};
  }

 private:
  struct Once {
    SimTime from, to;
    std::string because;
  };
  static std::string because(const CockpitState& controls) {
    return controls.source_fault.empty() ? "the light switch is silent" : controls.source_fault;
  }

  std::vector<Once> times_;
  std::uint64_t frames_ = 0, count_ = 0;
  bool on_ = false;
};

}  // namespace phare
