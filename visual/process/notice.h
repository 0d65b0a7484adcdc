// Why a key did nothing, in the picture for a few seconds.
#pragma once

#include <chrono>
#include <string>
#include <utility>

namespace phare {

class Notice {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kStands{6};  // long enough to read; chosen

  void say(std::string words, Clock::time_point now) {
    words_ = std::move(words);
    until_ = now + kStands;
  }
  /// Empty: nothing is to be told, or no longer.
  std::string line(Clock::time_point now) const { return now < until_ ? words_ : std::string(); }

 private:
  std::string words_;
  Clock::time_point until_{};
};

}  // namespace phare
