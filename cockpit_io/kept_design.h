// What stands between a recorded source and the cockpit where the rig keeps its design: changes of design that were
// recorded are left out, so that a lamp of one's own is not swapped away by a drive of yesterday. By hand
// (RigControl::Design) the design changes and stays.
#pragma once

#include <cstdint>
#include <optional>

#include "cockpit_io/cockpit.h"

namespace phare {

class KeptDesign : public ControlSink {
 public:
  explicit KeptDesign(Cockpit& cockpit) : cockpit_(cockpit) {}

  void take(const DriverInput& input, bool silent, Moment now) override {
    const bool pressed = input.switches.design_next || input.switches.design_previous;
    if (pressed && !pressed_) ++left_out_;
    pressed_ = pressed;
    DriverInput kept = input;
    kept.switches.design_next = kept.switches.design_previous = false;
    cockpit_.take(kept, silent, now);
  }

  void take_recorded(const CockpitState& recorded, Moment now) override {
    if (design_index_.value_or(0) != recorded.design_index) ++left_out_;
    design_index_ = recorded.design_index;
    CockpitState kept = recorded;
    kept.design_index = cockpit_.design_index();
    cockpit_.take_recorded(kept, now);
  }

  std::uint64_t left_out() const { return left_out_; }

 private:
  Cockpit& cockpit_;
  bool pressed_ = false;
  std::optional<std::uint32_t> design_index_;
  std::uint64_t left_out_ = 0;
};

}  // namespace phare
