// Who runs first when processes want a core at once.
#pragma once

#include <string>

namespace phare {

struct Scheduling {
  bool real_time = false;
  std::string text = "ordinary";  ///< for logs and stats: the priority, or why there is none
};

/// Lets this process run as soon as it wakes, before all ordinary ones (SCHED_FIFO, sched(7)): cockpit and dynamics
/// need hundredths of a core, but at once, while a picture drawn by software takes all there are. The kernel allows it
/// to root, with CAP_SYS_NICE, and up to RLIMIT_RTPRIO; if it does not, all stays as it was. Children do not inherit
/// it. `wanted` false: nothing is asked for.
Scheduling run_before_others(bool wanted);

}  // namespace phare
