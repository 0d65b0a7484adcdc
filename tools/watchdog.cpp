#include "tools/watchdog.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace phare {

std::optional<ProcessUse> use_of(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  // "1234 (name) S ppid pgrp …", where the name may hold anything; utime and stime are fields 14 and 15 from 1.
  const std::size_t after_name = line.rfind(')');
  if (after_name == std::string::npos) return std::nullopt;
  std::istringstream words(line.substr(after_name + 1));
  std::string state, skipped;
  words >> state;
  for (int field = 4; field < 14; ++field) words >> skipped;
  double user = 0.0, system = 0.0;
  if (!(words >> user >> system)) return std::nullopt;
  return ProcessUse{(user + system) / static_cast<double>(sysconf(_SC_CLK_TCK)), state == "T" || state == "t"};
}

std::optional<std::string> Watchdog::hung(Clock::time_point now, std::optional<Clock::time_point> beat,
                                          const std::optional<ProcessUse>& use) {
  constexpr std::chrono::nanoseconds kMostAtOnce = std::chrono::milliseconds(100);
  const std::chrono::nanoseconds passed = std::min<std::chrono::nanoseconds>(now - called_.value_or(now), kMostAtOnce);
  called_ = now;
  if (!use) return std::nullopt;  // it has ended
  const bool computes = use->processor_s > processor_s_;
  processor_s_ = use->processor_s;
  if (beat != beat_) {
    beat_ = beat;
    silent_ = idle_ = {};
    return std::nullopt;
  }
  silent_ += passed;
  const bool waits = !computes && (!limits_.may_be_covered || use->stopped);
  idle_ = waits ? idle_ + passed : std::chrono::nanoseconds{};

  const char* how = nullptr;
  if (idle_ >= (beat_ || use->stopped ? limits_.idle : limits_.beginning)) {
    how = use->stopped ? "stopped" : "hung";
  } else if (silent_ >= limits_.busy && !(limits_.may_be_covered && !computes)) {
    how = "hung, computing";
  }
  if (how == nullptr) return std::nullopt;
  char text[80];
  std::snprintf(text, sizeof text, "%s: no sign of life for %.1f s", how,
                std::chrono::duration<double>(silent_).count());
  return text;
}

}  // namespace phare
