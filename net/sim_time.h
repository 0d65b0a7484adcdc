// Simulated and wall-clock time: two types, so that neither is taken for the other.
#pragma once

#include <compare>
#include <cstdint>

namespace phare {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

/// Simulated time since the start of the drive.
struct SimTime {
  std::int64_t ns = 0;

  double seconds() const { return static_cast<double>(ns) * 1e-9; }
  friend auto operator<=>(SimTime, SimTime) = default;
};

/// Wall-clock time, nanoseconds of CLOCK_REALTIME, so that stamps of the kernel and of other processes compare.
struct WallTime {
  std::int64_t ns = 0;

  friend auto operator<=>(WallTime, WallTime) = default;
};

/// The wall clock now, and how far it is put off the machine's own, for trials of a rig whose machines' clocks differ:
/// PHARE_CLOCK_OFFSET_MS of the environment, else 0.
WallTime wall_now();
std::int64_t wall_shift_ns();

/// Simulated time of lockstep frame `frame_index` at `frame_rate_hz` frames a second: floor(k·1e9 / rate), exact in
/// integers.
constexpr SimTime frame_time(std::int64_t frame_index, std::int64_t frame_rate_hz) {
  const std::int64_t whole = frame_index / frame_rate_hz;
  const std::int64_t rest = frame_index % frame_rate_hz;
  return SimTime{whole * kNsPerSecond + rest * kNsPerSecond / frame_rate_hz};
}

}  // namespace phare
