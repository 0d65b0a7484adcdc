// The driver's controls from a drive file: the CockpitStates that were recorded, played at their simulated times.
#pragma once

#include <filesystem>
#include <vector>

#include "cockpit_io/source.h"

namespace phare {

class DriveSource : public Source {
 public:
  /// Error when the file cannot be read. A drive without CockpitStates plays to its end with low beam on.
  static Result<std::unique_ptr<Source>> open(const std::filesystem::path& file);

  void advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) override;
  bool plays_again() const override { return true; }
  bool ended() const override { return ended_; }

 private:
  struct Entry {
    SimTime due;
    CockpitState state;
  };
  std::vector<Entry> entries_;
  std::size_t next_ = 0;
  SimTime end_;
  bool ended_ = false;
};

}  // namespace phare
