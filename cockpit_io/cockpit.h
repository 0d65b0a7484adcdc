// The cockpit's state: switch logic over the driver's input, pedals that fade while the source is silent.
#pragma once

#include <cstdint>
#include <string>

#include "cockpit_io/driver_input.h"
#include "cockpit_io/switch_logic.h"
#include "net/messages.h"

namespace phare {

class Cockpit {
 public:
  /// `source`: what drives, for CockpitState.source.
  Cockpit(SwitchParams params, std::string source);

  /// The driver's controls at `now`; to be called for every change, and once more when time has passed. Times that go
  /// back count as the newest seen.
  void take(const DriverInput& input, bool silent, Moment now);

  /// Controls that went through switch logic when they were recorded.
  void take_recorded(const CockpitState& recorded, Moment now);

  /// RigControl::Design.
  void choose_design(std::uint32_t design_index, Moment now);

  CockpitState state(std::int64_t frame_index, bool drive_ended) const;
  std::uint64_t light_changes() const { return switches_.light_changes; }
  bool fail_safe() const { return switches_.fail_safe; }

 private:
  SwitchParams params_;
  std::string source_;
  SwitchState switches_;
  DriverInput input_;
  SimTime newest_;
  SimTime silent_since_;
};

}  // namespace phare
