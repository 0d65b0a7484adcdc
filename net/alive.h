// A sign of life that costs nothing: the monotonic time of a process's newest look at the bus, in eight bytes of a
// file. Memory mapped by the process, read by who watches over it. It says that the loop goes round, not what it does.
// Eight more bytes are the answer: a process that has read all it needs leaves its first sign, and writes nothing
// before it is let go, which it is when all others have come as far.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "config/base/result.h"

namespace phare {

class AliveFile {
 public:
  /// Makes the file where it is not there, readable by its user only.
  static Result<AliveFile> open(const std::filesystem::path& file);

  AliveFile(AliveFile&&) noexcept;
  AliveFile& operator=(AliveFile&&) noexcept;
  ~AliveFile();

  /// "I am here", now.
  void beat();
  /// The newest beat; nullopt before the first.
  std::optional<std::chrono::steady_clock::time_point> newest() const;

  void let_go();
  bool is_let_go() const;
  /// That it ends because RigControl::Quit told it to.
  void leaves_as_told();
  bool left_as_told() const;

 private:
  struct Words {
    std::atomic<std::int64_t> beat_ns, go, told_to_leave;
  };
  explicit AliveFile(Words* words) : words_(words) {}
  Words* words_ = nullptr;
};

}  // namespace phare
