#include "net/run_key.h"

#include <fcntl.h>
#include <sodium.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

namespace phare {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOpenBus = "; --open-bus, or run_key = false under [bus] of the rig, goes without a key";

/// What is wrong with a file or folder that is to be ours alone; empty: nothing.
std::string not_ours_alone(const struct stat& found) {
  if (found.st_uid != geteuid()) return "belongs to another user";
  if ((found.st_mode & 0077) != 0) return "others may read it: chmod go= makes it yours alone";
  return {};
}

bool is_folder(const fs::path& path) {
  struct stat found {};
  return stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == geteuid();
}

std::string hexadecimal(const BusKey& key) {
  std::string digits(2 * key.size() + 1, '\0');
  sodium_bin2hex(digits.data(), digits.size(), key.data(), key.size());
  digits.back() = '\n';
  return digits;
}

/// A new key in the file of `fd`, which is locked for us alone.
std::optional<std::string> write_new_key(int fd) {
  BusKey key{};
  randombytes_buf(key.data(), key.size());
  const std::string digits = hexadecimal(key);
  if (ftruncate(fd, 0) == 0 && pwrite(fd, digits.data(), digits.size(), 0) == static_cast<ssize_t>(digits.size()))
    return std::nullopt;
  return std::strerror(errno);
}

}  // namespace

Result<fs::path> run_folder() {
  const char* named = std::getenv("PHARE_RUN_DIR");
  const std::string user = std::to_string(geteuid());
  const fs::path of_user = fs::path("/run/user") / user;
  std::error_code failed;
  const fs::path folder = named != nullptr && *named != '\0' ? fs::path(named)
                          : is_folder(of_user)               ? of_user / "phare"
                                                             : fs::temp_directory_path(failed) / ("phare-" + user);
  if (failed) return Error{"TMPDIR", "names no folder; the key of the run is kept there"};
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST)
    return Error{folder.string(), std::string("cannot be made: ") + std::strerror(errno) + kOpenBus};
  struct stat found {};
  if (lstat(folder.c_str(), &found) != 0) return Error{folder.string(), std::strerror(errno)};
  if (!S_ISDIR(found.st_mode)) return Error{folder.string(), "is no folder"};
  if (std::string why = not_ours_alone(found); !why.empty()) return Error{folder.string(), why};
  return folder;
}

Result<fs::path> run_key_file(const Rig& rig) {
  Result<fs::path> folder = run_folder();
  if (!folder) return folder.error();
  return *folder / (rig.bind_address + "-" + std::to_string(rig.port_base) + ".key");
}

Status take_run_key(Rig& rig, RunKey how) {
  if (rig.bus_key || !rig.run_key) return Done{};
  const Result<fs::path> file = run_key_file(rig);
  if (!file) return file.error();
  const auto wrong = [&](const std::string& why) { return Error{file->string(), why + kOpenBus}; };
  const int fd = ::open(file->c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fd < 0) return wrong(std::strerror(errno));
  struct stat found {};
  std::optional<std::string> failed;
  if (fstat(fd, &found) != 0) failed = std::strerror(errno);
  if (!failed && !S_ISREG(found.st_mode)) failed = "is no file";
  if (std::string why = not_ours_alone(found); !failed && !why.empty()) failed = why;
  if (!failed && how == RunKey::kMake && flock(fd, LOCK_EX | LOCK_NB) == 0) failed = write_new_key(fd);
  if (!failed && flock(fd, LOCK_SH) != 0) failed = std::strerror(errno);
  if (!failed && fstat(fd, &found) == 0 && found.st_size == 0) {
    if (flock(fd, LOCK_EX) != 0) failed = std::strerror(errno);
    if (!failed && fstat(fd, &found) == 0 && found.st_size == 0) failed = write_new_key(fd);
    if (!failed && flock(fd, LOCK_SH) != 0) failed = std::strerror(errno);
  }
  if (failed) {
    ::close(fd);
    return wrong(*failed);
  }
  // The file stays open: its lock says that the key is in use.
  const Result<BusKey> key = read_bus_key(*file);
  if (!key) return key.error();
  rig.bus_key = *key;
  return Done{};
}

}  // namespace phare
