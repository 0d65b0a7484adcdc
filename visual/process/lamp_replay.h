// Lamps that were moved while a drive was recorded, moved again at the same simulated times.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "net/drive_file.h"
#include "visual/process/lamps.h"

namespace phare {

/// As a message, of a design.
LampState state_of(const Lamps::Mounts& mounts, std::size_t design);
/// And back.
Lamps::Mounts mounts_of(const LampState& state);

class LampReplay {
 public:
  LampReplay() = default;
  /// The LampStates of the drive.
  explicit LampReplay(const Drive& drive);

  /// Lamps as they stood at `now`; where the drive has been wound back, from the rig file on. Error, said once: lamps
  /// of another rig, which stay as they are.
  Status follow(SimTime now, Lamps& lamps);

 private:
  std::vector<std::pair<SimTime, LampState>> states_;  // by time
  std::size_t next_ = 0;
  SimTime now_{};
  bool refused_ = false;
};

/// Tells the other pictures and the recorder of lamps that are not where the rig file has them: when that changes, and
/// once a second of simulated time.
class LampNews {
 public:
  explicit LampNews(const Lamps& lamps);

  /// What is to be sent with the frame of `now`, if anything.
  std::optional<LampState> of(SimTime now, const Lamps& lamps);

 private:
  std::vector<Lamps::Mounts> of_rig_, told_;  // of each design
  SimTime told_at_{};
};

}  // namespace phare
