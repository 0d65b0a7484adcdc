// The car's pose at the time of display, from poses that came at other times.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "net/messages.h"

namespace phare {

/// The pose `seconds` later (or earlier) under constant velocity and yaw, pitch and roll rate; acceleration adds its
/// half square. Position error below jerk·dt³/6: at 10 m/s³ over one 4 ms message interval under a micrometre, over 200
/// ms 13 mm.
VehicleState extrapolate(const VehicleState& state, double seconds);

/// Real time only: keeps the newest few poses. Between two it interpolates (cubic Hermite on position, so velocity is
/// continuous; linear on angles, the short way round); past the newest it coasts for 200 ms, then holds (design,
/// section 3).
class PoseBuffer {
 public:
  static constexpr double kCoast_s = 0.2;

  struct Drawn {
    VehicleState pose;
    double age_s = 0.0;  ///< how long ago the newest message was due
    bool stale = false;  ///< older than the coast: the pose is held
  };

  /// Simulated time that the picture may show at `wanted`: no further than the coast past the newest pose, for the car
  /// is nowhere yet; and not before `shown`, which others have been told, when the car comes back a little behind it
  /// and drives on. A seek goes back for good, in a pause however little.
  SimTime time_to_show(SimTime wanted, std::optional<SimTime> shown) const;

  /// Poses that go back in time (a seek, a new start) clear the buffer.
  void push(SimTime time, const VehicleState& state);
  std::optional<Drawn> at(SimTime time) const;

 private:
  struct Entry {
    SimTime time;
    VehicleState state;
  };
  std::array<Entry, 16> ring_{};
  std::size_t count_ = 0;   // of valid entries
  std::size_t newest_ = 0;  // index
  /// It went back in time to the newest, which has come so many times again since: from kStands on somebody has sought
  /// in a pause. Twice one that begins anew may say where it is.
  std::optional<int> back_again_;
  static constexpr int kStands = 3;
};

/// Simulated time of now in real time, from the stamps of the messages that came: simulation runs at the speed of the
/// wall clock, so the largest (simulated - wall) of late is the one with the least delay. Follows slow drift (100 ppm)
/// and jumps (pause, seek) of more than 50 ms.
class DisplayClock {
 public:
  void observe(SimTime stamped, WallTime sent);
  std::optional<SimTime> at(WallTime wall) const;
  /// In a pause: the same time has come again and again, for longer than any step takes. Not before the drive begins.
  bool stands() const { return stamped_.ns > 0 && observed_.ns - first_stamped_.ns > kStands_ns; }

 private:
  std::optional<std::int64_t> offset_ns_;
  WallTime observed_;
  SimTime stamped_{-1};
  WallTime first_stamped_;  // when `stamped_` came first
  static constexpr std::int64_t kStands_ns = 200'000'000;
};

}  // namespace phare
