#include "net/alive.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace phare {

static_assert(std::atomic<std::int64_t>::is_always_lock_free && sizeof(std::atomic<std::int64_t>) == 8);

Result<AliveFile> AliveFile::open(const std::filesystem::path& file) {
  const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fd < 0) return Error{file.string(), std::strerror(errno)};
  int error = ftruncate(fd, sizeof(Words)) != 0 ? errno : 0;
  if (error == 0) error = posix_fallocate(fd, 0, sizeof(Words));  // no room is an error now, not a signal later
  void* memory = error == 0 ? mmap(nullptr, sizeof(Words), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0) : MAP_FAILED;
  if (error == 0 && memory == MAP_FAILED) error = errno;
  ::close(fd);
  if (error != 0) return Error{file.string(), std::strerror(error)};
  return AliveFile(static_cast<Words*>(memory));
}

AliveFile::AliveFile(AliveFile&& other) noexcept : words_(std::exchange(other.words_, nullptr)) {}
AliveFile& AliveFile::operator=(AliveFile&& other) noexcept {
  std::swap(words_, other.words_);
  return *this;
}
AliveFile::~AliveFile() {
  if (words_ != nullptr) munmap(static_cast<void*>(words_), sizeof(Words));
}

void AliveFile::beat() {
  words_->beat_ns.store(std::chrono::steady_clock::now().time_since_epoch().count(), std::memory_order_relaxed);
}

std::optional<std::chrono::steady_clock::time_point> AliveFile::newest() const {
  const std::int64_t ns = words_->beat_ns.load(std::memory_order_relaxed);
  if (ns == 0) return std::nullopt;
  return std::chrono::steady_clock::time_point(std::chrono::nanoseconds(ns));
}

void AliveFile::let_go() {
  words_->go.store(1, std::memory_order_relaxed);
}
bool AliveFile::is_let_go() const {
  return words_->go.load(std::memory_order_relaxed) != 0;
}

void AliveFile::leaves_as_told() {
  words_->told_to_leave.store(1, std::memory_order_relaxed);
}
bool AliveFile::left_as_told() const {
  return words_->told_to_leave.load(std::memory_order_relaxed) != 0;
}

}  // namespace phare
