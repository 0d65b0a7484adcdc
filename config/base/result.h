// A value, or the place and reason why there is none. Bad data from outside (file, bus, socket, flag) travels as a
// Result.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace phare {

/// What was wrong with data from outside.
struct Error {
  std::string place;   ///< "low_beam.ies:14", "--size", "can0"; may be empty
  std::string reason;  ///< "expected 181 angles, got 180"

  std::string text() const { return place.empty() ? reason : place + ": " + reason; }
};

template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() {
    assert(ok());
    return std::get<0>(content_);
  }
  const T& value() const {
    assert(ok());
    return std::get<0>(content_);
  }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const {
    assert(!ok());
    return std::get<1>(content_);
  }

 private:
  std::variant<T, Error> content_;
};

/// A Result without a value.
struct Done {};
using Status = Result<Done>;

/// Exit codes of every Phare program.
inline constexpr int kExitDone = 0;
inline constexpr int kExitCheckFailed = 1;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitInterrupted = 130;  ///< a drive that was ended by Ctrl-C or SIGTERM: it is cut short

}  // namespace phare
