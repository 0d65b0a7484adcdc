// The cockpit's state: switch logic over the driver's input, pedals that fade while the source is silent.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cockpit_io/driver_input.h"
#include "cockpit_io/memory.h"
#include "cockpit_io/switch_logic.h"
#include "net/messages.h"

namespace phare {

/// Where a source puts what it reads.
class ControlSink {
 public:
  virtual ~ControlSink() = default;

  /// The driver's controls at `now`; to be called for every change, and once more when time has passed. Times that go
  /// back count as the newest seen.
  virtual void take(const DriverInput& input, bool silent, Moment now) = 0;

  /// Controls that went through switch logic when they were recorded.
  virtual void take_recorded(const CockpitState& recorded, Moment now) = 0;
};

class Cockpit : public ControlSink {
 public:
  /// `source`: what drives, for CockpitState.source.
  Cockpit(SwitchParams params, std::string source);

  void take(const DriverInput& input, bool silent, Moment now) override;
  void take_recorded(const CockpitState& recorded, Moment now) override;

  /// RigControl::Design. Of a recorded drive it stays until the recorded design changes.
  void choose_design(std::uint32_t design_index, Moment now);

  /// The car's speed, for the automatic high beam; counts from the next take() on.
  void set_speed(double speed_mps) { speed_mps_ = speed_mps; }

  CockpitState state(std::int64_t frame_index, bool drive_ended) const;
  Telltales telltales(SimTime now) const { return phare::telltales(switches_, now); }
  std::uint32_t design_index() const { return switches_.lights.design_index; }
  /// The newest recorded design that the rig does not have: left out, the one before it stays.
  std::optional<std::uint32_t> unknown_design() const { return unknown_design_; }
  /// All that the controls have become: every latch of the switch logic, the chosen design, counts and stamps.
  void remember(Memory& memory);
  /// Counts on from a predecessor's changes of the lights, where the lights themselves have come by another way.
  void count_on_from(std::uint64_t light_changes);
  std::uint64_t light_changes() const { return switches_.light_changes; }
  bool fail_safe() const { return switches_.fail_safe; }

 private:
  SwitchParams params_;
  std::string source_;
  SwitchState switches_;
  DriverInput input_;
  double speed_mps_ = 0.0;
  SimTime newest_;
  SimTime silent_since_;
  std::optional<std::uint32_t> recorded_design_, unknown_design_;
};

}  // namespace phare
