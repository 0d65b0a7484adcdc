#include "tools/run_files.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "net/run_key.h"

namespace phare {
namespace {

constexpr const char* kBeginning = "drive-";

/// The folder, locked so until it is closed; negative: it cannot be.
int hold(const std::filesystem::path& folder, int how) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
  if (fd < 0 || flock(fd, how | LOCK_NB) == 0) return fd;
  ::close(fd);
  return -1;
}

}  // namespace

Result<RunFiles> RunFiles::make(const Rig& rig) {
  const auto folder = run_folder();
  if (!folder) return folder.error();
  std::string name = (*folder / (kBeginning + std::to_string(rig.port_base) + "-XXXXXX")).string();
  remove_left_behind(*folder, std::chrono::minutes(1));
  if (mkdtemp(name.data()) == nullptr) return Error{name, std::strerror(errno)};
  return RunFiles(name);
}

void RunFiles::remove_left_behind(const std::filesystem::path& run_folder, std::chrono::seconds older_than) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const auto now = fs::file_time_type::clock::now();
  for (const fs::directory_entry& entry : fs::directory_iterator(run_folder, ignored)) {
    if (!entry.path().filename().string().starts_with(kBeginning) || !entry.is_directory(ignored)) continue;
    if (now - entry.last_write_time(ignored) < older_than) continue;
    const int fd = hold(entry.path(), LOCK_EX);
    if (fd < 0) continue;
    fs::remove_all(entry.path(), ignored);
    ::close(fd);
  }
}

RunFiles::RunFiles(std::filesystem::path folder) : folder_(std::move(folder)), held_(hold(folder_, LOCK_SH)) {}

RunFiles::RunFiles(RunFiles&& other) noexcept
    : folder_(std::exchange(other.folder_, {})), held_(std::exchange(other.held_, -1)) {}

RunFiles::~RunFiles() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  if (held_ >= 0) ::close(held_);
}

}  // namespace phare
