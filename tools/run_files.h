// What the processes of one drive keep beside the bus: signs of life, and the state that a killed one leaves behind.
// A folder of its own in the user's run folder (net/run_key.h), gone with the drive; of a launcher that was killed,
// with the next one.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "config/base/result.h"
#include "config/rig.h"

namespace phare {

class RunFiles {
 public:
  static Result<RunFiles> make(const Rig& rig);
  /// Removes the folders that no launcher holds, but for new ones, which one may be about to hold.
  static void remove_left_behind(const std::filesystem::path& run_folder, std::chrono::seconds older_than);
  RunFiles(RunFiles&& other) noexcept;
  RunFiles& operator=(RunFiles&&) = delete;
  ~RunFiles();

  std::filesystem::path alive(const std::string& process) const { return folder_ / ("alive-" + process); }
  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path state(const std::string& process) const { return folder_ / (process + ".state"); }

 private:
  explicit RunFiles(std::filesystem::path folder);
  std::filesystem::path folder_;
  int held_ = -1;  ///< the folder, locked: its launcher runs
};

}  // namespace phare
