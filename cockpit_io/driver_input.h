// What the driver does with hands and feet, as a source reads it, before switch logic.
#pragma once

#include "cockpit_io/switch_logic.h"
#include "net/messages.h"

namespace phare {

struct DriverInput {
  SwitchInput switches;
  double steering_wheel_rad = 0.0;  ///< left positive
  double accelerator_01 = 0.0;
  double brake_01 = 0.0;
  double clutch_01 = 0.0;
  double parking_brake_01 = 0.0;  ///< stays when the source falls silent: a lever does not let go by itself
  double lamp_aim_rad = 0.0;      ///< of the levelling wheel, positive up
  Gear gear = Gear::kDrive;

  friend bool operator==(const DriverInput&, const DriverInput&) = default;
};

}  // namespace phare
