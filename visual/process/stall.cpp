#include "visual/process/stall.h"

namespace phare {

std::string silent_ones(const CockpitState* controls, const VehicleState* car, std::int64_t drawn, bool lockstep) {
  const bool no_controls = controls == nullptr || (lockstep && controls->frame_index <= drawn);
  const bool no_car = car == nullptr || (lockstep && car->frame_index <= drawn);
  return no_controls && no_car ? "cockpit and dynamics" : no_controls ? "cockpit" : no_car ? "dynamics" : "";
}

}  // namespace phare
