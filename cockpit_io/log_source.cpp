#include "cockpit_io/log_source.h"

#include <algorithm>

namespace phare {

LogSource::LogSource(CandumpLog log, SignalMap map) : log_(std::move(log)), map_(std::move(map)) {
  counts_.broken_lines = log_.broken_lines;
}

void LogSource::advance(Moment now, const VehicleState*, Cockpit& cockpit) {
  // The wall stamp of an entry is the moment at which the log was due, which for entries before `now` lies in the past.
  const auto moment = [&](std::int64_t sim_ns) {
    return Moment{SimTime{sim_ns}, WallTime{now.wall.ns - (now.sim.ns - sim_ns)}};
  };
  const auto fall_silent_before = [&](std::int64_t sim_ns) {
    if (silent_ || map_.silent_at_ns() > sim_ns) return;
    silent_ = true;
    ++counts_.fail_safes;
    cockpit.take(input_, true, moment(map_.silent_at_ns()));
  };

  const std::int64_t begin_ns = log_.entries.front().stamp_ns;
  for (; next_ < log_.entries.size(); ++next_) {
    const CandumpEntry& entry = log_.entries[next_];
    const std::int64_t due_ns = std::max(due_ns_, entry.stamp_ns - begin_ns);
    if (due_ns > now.sim.ns) break;
    due_ns_ = due_ns;
    fall_silent_before(due_ns);
    ++counts_.frames_read;
    if (entry.frame.error) {
      ++counts_.error_frames;
      continue;
    }
    const SignalMap::Taken taken = map_.take(entry.frame, due_ns, input_);
    if (taken == SignalMap::Taken::kNotMapped) {
      if (!map_.knows(entry.frame)) ++counts_.unknown_ids;
      continue;
    }
    ++(taken == SignalMap::Taken::kDecoded ? counts_.decoded : counts_.incomplete);
    silent_ = map_.silent_at_ns() <= due_ns;
    if (on_frame) on_frame(moment(due_ns).wall);
    cockpit.take(input_, silent_, moment(due_ns));
  }
  fall_silent_before(now.sim.ns);
  cockpit.take(input_, silent_, now);
}

std::string LogSource::status() const {
  return ended() ? "ended" : silent_ ? "silent" : "up";
}

}  // namespace phare
