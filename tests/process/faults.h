// Drives with faults at random times: processes killed, stopped, both; and what every picture showed meanwhile.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace phare::test {

struct FaultSetup {
  enum class Kind { kKill, kStop, kBoth };  ///< both: one process is stopped while another is killed
  Kind kind = Kind::kKill;
  bool lockstep = false;
  int faults = 10;
  std::uint64_t seed = 1;
  std::chrono::milliseconds shortest_stop{10}, longest_stop{6000};
};

struct FaultResult {
  int exit_code = -1;
  int kills = 0, stops = 0;             ///< done
  int stops_to_death = 0;               ///< so long that the launcher ends the process
  int restarts_reported = 0;            ///< in report.json
  std::uint64_t pictures = 0;           ///< that say which beam they show
  std::uint64_t fail_safe = 0;          ///< of them with the low beam of the fail-safe
  std::uint64_t wrong = 0;              ///< that show a beam which neither the stalk nor the fail-safe asked for
  std::uint64_t time_back = 0;          ///< pictures of a time before that of the picture before
  std::vector<std::string> wrong_ones;  ///< the first few, in words
  double driven_s = 0.0, log_s = 0.0;   ///< of simulated time
};

/// One `phare drive` on a log that moves the stalk every second; a fault about every three.
FaultResult drive_with_faults(const FaultSetup& setup, const std::filesystem::path& folder);

}  // namespace phare::test
