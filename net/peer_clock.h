// The clock of a process on another machine against ours, by question and answer.
//
// We ask at t1, it hears at t2 and answers at t3, we hear at t4, each by the clock of its side; then its clock is ahead
// of ours by ((t2 - t1) + (t3 - t4)) / 2, to half of (t4 - t1) - (t3 - t2), whatever way was the slower one (D. Mills,
// RFC 5905, section 8). Of the newest 16 exchanges the tightest counts, an older one less by kDrift_ppm of its age:
// what queued somewhere tells little. Drift is the line through the tightest exchange of each ten seconds, first to
// last of ten minutes. A clock that was set, so that an exchange contradicts the estimate, begins anew. Arrival is the
// kernel's stamp (net/udp.h): what waits for a busy process does not count. Checked by tests/net/peer_clock_test.cpp.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "net/sim_time.h"

namespace phare {

/// One exchange: we asked, it heard and answered, we heard.
struct ClockExchange {
  WallTime asked, heard_there, answered_there, heard;
};

class PeerClock {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Two quartz clocks differ by less, and a clock that is being disciplined is slewed no faster (adjtimex: 500 ppm).
  static constexpr double kDrift_ppm = 500.0;

  struct Estimate {
    std::int64_t ahead_ns = 0;  ///< its clock minus ours
    std::int64_t within_ns = 0;
    double drift_ppm = 0.0;  ///< how fast `ahead` grows; 0 with infinite error before the first twenty seconds are over
    double drift_within_ppm = 0.0;
  };

  /// `now`: of the steady clock, when the answer was heard. Exchanges that no clock can have made (an answer before its
  /// question) are left out.
  void add(const ClockExchange& exchange, Time now);

  /// At `now`; nullopt before the first exchange.
  std::optional<Estimate> at(Time now) const;
  /// How often the clock was set, on either side, since the first exchange.
  std::uint64_t steps() const { return steps_; }
  std::uint64_t exchanges() const { return exchanges_; }

 private:
  struct Sample {
    Time when;
    std::int64_t ahead_ns = 0, within_ns = 0;
  };
  static constexpr std::size_t kNewest = 16;
  static constexpr std::size_t kAnchors = 60;
  static constexpr std::chrono::seconds kAnchorEvery{10};

  static double within_at(const Sample& sample, Time now);
  const Sample* tightest(Time now) const;

  std::deque<Sample> newest_;
  std::deque<Sample> anchors_;  // the tightest of each ten seconds; the last one is being made
  Time anchor_began_{};
  std::uint64_t exchanges_ = 0, steps_ = 0;
};

}  // namespace phare
