// What a process of the rig leaves of itself for the one that takes its place, as plain bytes: one function names the
// fields, for leaving and for taking up again, so that the two cannot differ.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace phare {

class Memory {
 public:
  /// To be filled.
  Memory() = default;
  /// Filled by the predecessor, to be taken up; kept by the caller as long as this lives.
  explicit Memory(std::span<const std::byte> left) : recalls_(true), left_(left) {}

  /// Leaves the value, or takes it up. What has not been left stays as it is.
  template <class T>
  void field(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (!recalls_) {
      const auto bytes = std::as_bytes(std::span(&value, 1));
      bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    } else if (left_.size() >= sizeof(T)) {
      std::memcpy(static_cast<void*>(&value), left_.data(), sizeof(T));
      left_ = left_.subspan(sizeof(T));
    }
  }

  bool recalls() const { return recalls_; }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  bool recalls_ = false;
  std::span<const std::byte> left_;
  std::vector<std::byte> bytes_;
};

}  // namespace phare
