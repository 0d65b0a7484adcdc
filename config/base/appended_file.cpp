#include "config/base/appended_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace phare {

AppendedFile::~AppendedFile() {
  if (is_open()) ::close(file_);
}

bool AppendedFile::open(const std::filesystem::path& path, bool keep_content) {
  if (is_open()) ::close(file_);
  constexpr mode_t kMode = 0666;
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_APPEND | (keep_content ? 0 : O_TRUNC), kMode);
  return is_open();
}

bool AppendedFile::append(std::string_view piece) {
  const off_t before = is_open() ? ::lseek(file_, 0, SEEK_END) : -1;
  if (before < 0) return false;
  while (!piece.empty()) {
    const ssize_t taken = ::write(file_, piece.data(), piece.size());
    if (taken < 0 && errno == EINTR) continue;
    if (taken <= 0) {
      (void)!::ftruncate(file_, before);
      return false;
    }
    piece.remove_prefix(static_cast<std::size_t>(taken));
  }
  return true;
}

}  // namespace phare
