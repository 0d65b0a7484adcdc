#include "net/scheduling.h"

#include <sched.h>

#include <cerrno>
#include <cstring>

namespace phare {

Scheduling run_before_others(bool wanted) {
  constexpr int kPriority = 10;  // of 1 to 99: below the kernel's own threads (50) and sound (usually 70 and more)
  if (!wanted) return {false, "ordinary, as the rig says"};
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0)
    return {true, "SCHED_FIFO, priority " + std::to_string(kPriority)};
  return {false, std::string("ordinary: SCHED_FIFO: ") + std::strerror(errno)};
}

}  // namespace phare
