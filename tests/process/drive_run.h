// A `phare drive` under test: started in a folder, looked at while it runs, its folder read when it has ended.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/child_process.h"
#include "tools/temporary_folder.h"

namespace phare::test {

/// Generous: the machine may be busy, and a wait that is too short is no finding.
inline constexpr std::chrono::seconds kPatience{240};

/// A range of UDP ports that other tests of this machine do not use while RESOURCE_LOCK udp_ports is held.
std::uint16_t port_base();

class DriveRun {
 public:
  /// `phare drive --headless --lockstep --size 160x90 --out OUT … arguments`, with `from` as working directory.
  DriveRun(const std::filesystem::path& out, const std::filesystem::path& from,
           const std::vector<std::string>& arguments, bool lockstep = true);
  ~DriveRun();  ///< kills a drive that still runs; its processes go with it
  DriveRun(const DriveRun&) = delete;
  DriveRun& operator=(const DriveRun&) = delete;

  /// Waits until frames/NNNNNN.png is there; false when the drive ended first.
  bool wait_for_frame(std::int64_t index);
  bool running() { return !child_.ended().has_value(); }
  /// Process ids of the launcher's children by program name ("phare-visual").
  std::map<std::string, pid_t> processes() const;
  /// Sends a signal to the launcher and waits for its end.
  int end(int signal);
  /// Waits for the end; the exit code, or 1000 + signal. The drive is killed when patience ends.
  int wait();

 private:
  ChildProcess child_;
  std::filesystem::path out_;
};

/// Runs a drive to its end: exit code.
int drive(const std::filesystem::path& out, const std::filesystem::path& from,
          const std::vector<std::string>& arguments);

nlohmann::json report_of(const std::filesystem::path& out);

/// Bytes by name below the folder: frames/*.png, drivers_view.png, birds_eye.png, wall_25m.png, and hdr.exr, whose
/// alpha is the illuminance of every pixel in lux.
std::map<std::string, std::string> pictures_of(const std::filesystem::path& out);

/// Names of the pictures that are not the same, byte for byte, in both; "frames/000007.png (only in one)".
std::vector<std::string> differences(const std::map<std::string, std::string>& a,
                                     const std::map<std::string, std::string>& b);

}  // namespace phare::test
