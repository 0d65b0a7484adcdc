// One program started by us, in our process group, that dies with us.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;  ///< when signal is 0
  int signal = 0;
  std::string text() const;  ///< "exit 2", "SIGKILL"
};

class ChildProcess {
 public:
  /// Forks and executes; no shell in between. SIGTERM comes to the child when this program dies, however it dies.
  /// Error when the program cannot be executed.
  static Result<ChildProcess> start(const std::filesystem::path& program, const std::vector<std::string>& arguments);

  /// The end, once it has ended; nullopt while it runs. Never blocks.
  std::optional<ProcessEnd> ended();
  void send_signal(int signal) const;
  pid_t pid() const { return pid_; }

 private:
  explicit ChildProcess(pid_t pid) : pid_(pid) {}
  pid_t pid_;
  std::optional<ProcessEnd> end_;
};

/// A program of ours: beside this executable.
std::filesystem::path program_beside_us(const std::string& name);

/// An executable in PATH.
std::optional<std::filesystem::path> find_in_path(const std::string& name);

}  // namespace phare
