// The state of a process in a file that outlives it: written in passing, read by the process that takes its place.
//
// The file is mapped memory: what was written stays when the process is killed, in whatever line of code. Two slots are
// written in turn by the parity of a growing key (a frame, a count); a slot that was being written does not fit its
// hash, and the other one holds the state before. Read by the same program only, in the same run: the bytes are those
// of memory, of no agreed format, and a file of another size is taken for none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>

#include "config/base/result.h"

namespace phare {

class StateFile {
 public:
  /// Opens the file or makes it, readable by its user only. `bytes`: of one state.
  static Result<StateFile> open(const std::filesystem::path& file, std::size_t bytes);

  StateFile(StateFile&&) noexcept;
  StateFile& operator=(StateFile&&) noexcept;
  ~StateFile();

  /// Keys count up from 0, none left out; the state of two keys ago is overwritten.
  void save(std::int64_t key, std::span<const std::byte> state);

  struct Saved {
    std::int64_t key = 0;
    std::span<const std::byte> state;  ///< valid until the key is overwritten
  };
  /// The whole state of this key, or of the highest there is.
  std::optional<Saved> at(std::int64_t key) const;
  std::optional<Saved> newest() const;

  template <class State>
  void save(std::int64_t key, const State& state) {
    static_assert(std::is_trivially_copyable_v<State>);
    save(key, std::as_bytes(std::span(&state, 1)));
  }

 private:
  struct Mapped;
  explicit StateFile(std::unique_ptr<Mapped> mapped);
  std::optional<Saved> slot(std::size_t index) const;
  std::unique_ptr<Mapped> mapped_;
};

/// `saved` as the struct it was written from.
template <class State>
State state_of(const StateFile::Saved& saved) {
  static_assert(std::is_trivially_copyable_v<State>);
  State state;
  std::copy(saved.state.begin(), saved.state.end(), reinterpret_cast<std::byte*>(&state));
  return state;
}

}  // namespace phare
