#include "cockpit_io/log_source.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

namespace phare {

namespace {
constexpr std::int64_t kShowRefused_ns = 2'000'000'000;
}

LogSource::LogSource(CandumpLog log, SignalMap map) : log_(std::move(log)), map_(std::move(map)) {
  counts_.broken_lines = log_.broken_lines;
  input_ = initial_input(map_.config());
}

std::int64_t LogSource::sim_ns(std::int64_t log_ns) const {
  const double speed = map_.config().log_speed;
  return speed == 1.0 ? log_ns : std::llround(static_cast<double>(log_ns) / speed);
}

std::int64_t LogSource::log_ns(std::int64_t sim_ns) const {
  const double speed = map_.config().log_speed;
  return speed == 1.0 ? sim_ns : std::llround(static_cast<double>(sim_ns) * speed);
}

void LogSource::advance(Moment now, const VehicleState*, ControlSink& cockpit) {
  // The wall stamp of an entry is the moment at which the log was due, which for entries before `now` lies in the past.
  const auto moment = [&](std::int64_t at_ns) {
    const std::int64_t sim = std::min(sim_ns(at_ns), now.sim.ns);
    return Moment{SimTime{sim}, WallTime{now.wall.ns - (now.sim.ns - sim)}};
  };
  const std::int64_t now_ns = now_ns_ = log_ns(now.sim.ns);
  const auto fall_silent_before = [&](std::int64_t at_ns) {
    if (silent_ || map_.silent_at_ns() > at_ns) return;
    silent_ = true;
    ++counts_.fail_safes;
    cockpit.take(input_, true, moment(map_.silent_at_ns()));
  };

  const std::int64_t begin_ns = log_.entries.front().stamp_ns;
  for (; next_ < log_.entries.size(); ++next_) {
    const CandumpEntry& entry = log_.entries[next_];
    const std::int64_t due_ns = std::max(due_ns_, entry.stamp_ns - begin_ns);
    if (due_ns > now_ns) break;
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
    if (taken == SignalMap::Taken::kBadCrc || taken == SignalMap::Taken::kBadCounter) {
      const bool crc = taken == SignalMap::Taken::kBadCrc;
      refused_ = map_.dbc().find(entry.frame.id, entry.frame.extended)->name +
                 (crc ? " refused: its CRC is wrong" : " refused: its counter stands still or jumps");
      refused_until_ns_ = due_ns + kShowRefused_ns;
      if (counts_.bad_crc + counts_.bad_counter == 0)
        spdlog::warn("{}: {}; such frames are counted from here on", log_.file.string(), refused_);
      ++(crc ? counts_.bad_crc : counts_.bad_counter);
      continue;
    }
    ++(taken == SignalMap::Taken::kDecoded ? counts_.decoded : counts_.incomplete);
    counts_.lost_in_data = map_.lost();
    silent_ = map_.silent_at_ns() <= due_ns;
    if (on_frame) on_frame(moment(due_ns).wall);
    cockpit.take(input_, silent_, moment(due_ns));
  }
  fall_silent_before(now_ns);
  cockpit.take(input_, silent_, now);
}

std::string LogSource::fault() const {
  if (silent_ && !ended()) return "log: " + map_.most_silent() + " silent";
  return now_ns_ < refused_until_ns_ ? "log: " + refused_ : std::string();
}

std::string LogSource::status() const {
  return ended() ? "ended" : silent_ ? "silent" : "up";
}

}  // namespace phare
