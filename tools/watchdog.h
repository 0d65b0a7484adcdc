// Tells a process that hangs from one that is slow: by its signs of life (net/alive.h) and its processor time.
//
// A loop that goes round leaves a sign of life at least ten times a second, but for a picture that takes long, files
// that are read, a drive that is brought to its end: those cost processor time. Who leaves no sign and uses no
// processor is stopped, or waits for what will not come.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

#include "net/alive.h"

namespace phare {

struct HungAfter {
  std::chrono::nanoseconds idle{std::chrono::seconds(3)};        ///< no sign of life, no processor time
  std::chrono::nanoseconds beginning{std::chrono::seconds(30)};  ///< the same before the first sign of life
  std::chrono::nanoseconds busy{std::chrono::seconds(60)};       ///< no sign of life, whatever it computes
  bool may_be_covered = false;  ///< it has a window, whose pictures may be held back while it is covered: what waits
                                ///< without a processor is no fault then, unless it is stopped (SIGSTOP)
};

/// What the system says of a process: /proc/PID/stat.
struct ProcessUse {
  double processor_s = 0.0;  ///< of all its threads
  bool stopped = false;
};
std::optional<ProcessUse> use_of(pid_t pid);

class Watchdog {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Watchdog(HungAfter limits) : limits_(limits) {}

  /// To be called often. Why the process counts as hung; nullopt: it does not. Time in which we were not called (we
  /// were stopped ourselves) does not count.
  std::optional<std::string> hung(Clock::time_point now, std::optional<Clock::time_point> beat,
                                  const std::optional<ProcessUse>& use);

 private:
  HungAfter limits_;
  std::optional<Clock::time_point> beat_, called_;
  double processor_s_ = 0.0;
  std::chrono::nanoseconds silent_{}, idle_{};
};

}  // namespace phare
