// Who keeps the first picture waiting, said after ten seconds and then each time that has doubled: a drive in which one
// process cannot reach another looks like one that is slow to begin.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "net/messages.h"

namespace phare {

class Stall {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kFirst{10};

  explicit Stall(Clock::time_point since) : since_(since) {}
  /// How long there has been no picture, when that is to be said now.
  std::optional<std::chrono::seconds> told_at(Clock::time_point now) {
    if (now - since_ < next_) return std::nullopt;
    const auto waited = next_;
    next_ *= 2;
    return waited;
  }

 private:
  Clock::time_point since_;
  std::chrono::seconds next_ = kFirst;
};

/// Of which processes what comes next is missing: "cockpit", "dynamics", both, or "" for neither. `controls` and `car`:
/// the newest of each, null: none ever came; `drawn`: the newest frame that was drawn in lockstep, -1 in real time.
std::string silent_ones(const CockpitState* controls, const VehicleState* car, std::int64_t drawn, bool lockstep);

}  // namespace phare
