// The wall clock, pacing by it, and the signals that end a process in order. wall_now() is declared in sim_time.h.
#pragma once

#include <chrono>
#include <cstdint>

#include "net/sim_time.h"

namespace phare {

/// Wakes its caller every `period` on CLOCK_MONOTONIC by absolute deadlines, so that lateness does not add up.
class Pacer {
 public:
  /// The first deadline is one period from now.
  explicit Pacer(std::chrono::nanoseconds period);

  /// Sleeps until the deadline and sets the next. Returns how many whole periods the caller was behind (they are
  /// skipped, not caught up); 0 in time. Returns early when a signal came; the deadline then stays.
  std::int64_t wait();

  /// How long after its deadline the last wait() came back, before it returned.
  std::chrono::nanoseconds late() const { return std::chrono::nanoseconds(late_ns_); }

  /// Time left until the deadline, 0 when it has passed: for loops that sleep in Bus::wait.
  std::chrono::nanoseconds left() const;

  /// True when the deadline has passed; sets the next as wait() does.
  bool due();

  /// The next deadline is one period from now.
  void restart();

 private:
  std::int64_t advance(std::int64_t now_ns);

  std::int64_t period_ns_;
  std::int64_t deadline_ns_;
  std::int64_t late_ns_ = 0;
};

/// True once SIGTERM, SIGINT or SIGHUP has come. Copies show the same.
class StopFlag {
 public:
  bool requested() const;
  explicit operator bool() const { return requested(); }

  /// As if the signal had come: RigControl::Quit, a closed window.
  void request() const;
};

/// Handles SIGTERM, SIGINT, and SIGHUP where it is not ignored, from now on: sleeping calls return, the flag is set.
/// SIGPIPE is ignored.
StopFlag install_stop_signals();

}  // namespace phare
