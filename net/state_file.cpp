#include "net/state_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace phare {
namespace {

/// FNV-1a (Fowler, Noll, Vo 1991; 64 bit), eight bytes at a time, over key and state.
std::uint64_t hash_of_slot(std::int64_t key, std::span<const std::byte> state) {
  std::uint64_t hash = (0xcbf29ce484222325u ^ static_cast<std::uint64_t>(key)) * 0x100000001b3u;
  for (std::size_t at = 0; at < state.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, state.data() + at, std::min<std::size_t>(8, state.size() - at));
    hash = (hash ^ word) * 0x100000001b3u;
    hash ^= hash >> 32;
  }
  return hash | 1u;  // 0: no state
}

struct Head {
  std::uint64_t hash = 0;
  std::int64_t key = 0;
};

}  // namespace

struct StateFile::Mapped {
  std::byte* memory = nullptr;
  std::size_t state_bytes = 0;

  std::size_t slot_bytes() const { return (sizeof(Head) + state_bytes + 63) / 64 * 64; }
  std::byte* slot(std::size_t index) const { return memory + index * slot_bytes(); }
  ~Mapped() {
    if (memory != nullptr) munmap(memory, 2 * slot_bytes());
  }
};

StateFile::StateFile(std::unique_ptr<Mapped> mapped) : mapped_(std::move(mapped)) {}
StateFile::StateFile(StateFile&&) noexcept = default;
StateFile& StateFile::operator=(StateFile&&) noexcept = default;
StateFile::~StateFile() = default;

Result<StateFile> StateFile::open(const std::filesystem::path& file, std::size_t bytes) {
  auto mapped = std::make_unique<Mapped>();
  mapped->state_bytes = bytes;
  const std::size_t whole = 2 * mapped->slot_bytes();
  const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  const auto failed = [&](int error) { return Error{file.string(), std::strerror(error)}; };
  if (fd < 0) return failed(errno);
  struct stat found {};
  int error = 0;
  const bool another = fstat(fd, &found) == 0 && found.st_size != static_cast<off_t>(whole);
  if (another && (ftruncate(fd, 0) != 0 || ftruncate(fd, static_cast<off_t>(whole)) != 0)) error = errno;
  // Room on the disk now, where it is an error, and not later, where it is a signal.
  if (error == 0) error = posix_fallocate(fd, 0, static_cast<off_t>(whole));
  void* memory = error == 0 ? mmap(nullptr, whole, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0) : MAP_FAILED;
  if (error == 0 && memory == MAP_FAILED) error = errno;
  ::close(fd);
  if (error != 0) return failed(error);
  mapped->memory = static_cast<std::byte*>(memory);
  return StateFile(std::move(mapped));
}

void StateFile::save(std::int64_t key, std::span<const std::byte> state) {
  std::byte* slot = mapped_->slot(static_cast<std::size_t>(key) % 2);
  const std::size_t size = std::min(state.size(), mapped_->state_bytes);
  Head head{0, key};
  std::memcpy(slot, &head, sizeof head);
  std::atomic_signal_fence(std::memory_order_seq_cst);
  std::memcpy(slot + sizeof head, state.data(), size);
  std::atomic_signal_fence(std::memory_order_seq_cst);
  head.hash = hash_of_slot(key, state.first(size));
  std::memcpy(slot, &head, sizeof head);
}

std::optional<StateFile::Saved> StateFile::slot(std::size_t index) const {
  Head head;
  std::memcpy(&head, mapped_->slot(index), sizeof head);
  const std::span<const std::byte> state(mapped_->slot(index) + sizeof head, mapped_->state_bytes);
  if (head.hash == 0 || head.hash != hash_of_slot(head.key, state)) return std::nullopt;
  return Saved{head.key, state};
}

std::optional<StateFile::Saved> StateFile::at(std::int64_t key) const {
  for (std::size_t index = 0; index < 2; ++index)
    if (const auto saved = slot(index); saved && saved->key == key) return saved;
  return std::nullopt;
}

std::optional<StateFile::Saved> StateFile::newest() const {
  const auto even = slot(0), odd = slot(1);
  if (!even || !odd) return even ? even : odd;
  return even->key > odd->key ? even : odd;
}

}  // namespace phare
