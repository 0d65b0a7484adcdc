// What the processes of one drive keep beside the bus: signs of life, and the state that a killed one leaves behind.
// A folder of its own in the user's run folder (net/run_key.h), gone with the drive.
#pragma once

#include <filesystem>
#include <string>

#include "config/base/result.h"
#include "config/rig.h"

namespace phare {

class RunFiles {
 public:
  static Result<RunFiles> make(const Rig& rig);
  RunFiles(RunFiles&& other) noexcept;
  RunFiles& operator=(RunFiles&&) = delete;
  ~RunFiles();

  std::filesystem::path alive(const std::string& process) const { return folder_ / ("alive-" + process); }
  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path state(const std::string& process) const { return folder_ / (process + ".state"); }

 private:
  explicit RunFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path folder_;
};

}  // namespace phare
