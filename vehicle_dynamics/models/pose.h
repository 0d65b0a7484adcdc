// Level `pose`.
//
// What: the recorded motion of a drive, at any time between its records.
// Source: cubic Hermite interpolation with tangents from the parabola through three neighbours (de Boor, A
//   Practical Guide to Splines, 1978, ch. IV: Bessel's tangents); third-order, so 60 Hz records of a car are exact
//   to micrometres.
// Frame: that of the records, world and ISO 8855; angles are unwrapped first, so a turn through ±pi is a small one.
// Leaves out: everything between records further apart than 1 s, where it goes straight; forces; the driver's
//   controls.
// Tests: tests/vehicle_dynamics/pose_test.cpp (a sampled analytic path, wrap, end, gaps).
#pragma once

#include <span>
#include <vector>

#include "net/messages.h"

namespace phare {

class PoseTrack {
 public:
  PoseTrack() = default;

  /// From all VehicleStates of a drive's datagrams, ordered by SimTime; of several for one time the first counts.
  static PoseTrack from_drive(std::span<const Datagram> datagrams);

  bool empty() const { return samples_.empty(); }
  SimTime begin() const { return empty() ? SimTime{} : samples_.front().time; }
  SimTime end() const { return empty() ? SimTime{} : samples_.back().time; }

  /// The pose at `time`. Before the first record it is the first; from the last on it holds that, at rest, with
  /// drive_ended. Step, hash, lag and telltale are the caller's.
  VehicleState at(SimTime time) const;

 private:
  struct Sample {
    SimTime time;
    VehicleState state;  // angles unwrapped
  };
  std::vector<Sample> samples_;
};

}  // namespace phare
