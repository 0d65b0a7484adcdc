// One mapped control: a signal's value becomes what the driver does. Shared by CAN, logs and gamepads.
#pragma once

#include <cstdint>

#include "cockpit_io/driver_input.h"
#include "cockpit_io/memory.h"
#include "config/cockpit.h"

namespace phare {

/// The flags of a car that has a bit for each lamp, or a bit for each side, instead of levels.
struct BeamBits {
  bool position = false, low = false;
  bool left = false, right = false;
};

class ControlReader {
 public:
  /// `mapping`: named values already looked up. `debounce_ns`: for latched flags.
  ControlReader(ControlMapping mapping, std::int64_t debounce_ns)
      : mapping_(std::move(mapping)), debounce_ns_(debounce_ns) {}

  /// Takes a value at a time that does not go back. False when the value fits no level: the control stays.
  bool take(double value, std::int64_t at_ns, BeamBits& bits, DriverInput& input);

  const ControlMapping& mapping() const { return mapping_; }

  void remember(Memory& memory) {
    memory.field(contact_);
    memory.field(latched_);
    memory.field(quiet_until_ns_);
  }

 private:
  bool pressed(double value, std::int64_t at_ns);

  ControlMapping mapping_;
  std::int64_t debounce_ns_ = 0;
  bool contact_ = false;  // of a latched flag
  bool latched_ = false;
  std::int64_t quiet_until_ns_ = 0;
};

/// Levels and flags that stand for one control become it.
void settle_bits(const CockpitConfig& config, const BeamBits& bits, DriverInput& input);

/// What the driver does before anything is known: the light switch as the cockpit file's `lights`.
DriverInput initial_input(const CockpitConfig& config);

/// Switch logic's numbers from the cockpit file.
SwitchParams switch_params(const CockpitConfig& config, std::uint32_t design_count);

}  // namespace phare
