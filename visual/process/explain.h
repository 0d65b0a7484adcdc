// phare-visual --explain: which effects a moment of a rig calls for, and why, without a window, a picture or a device.
#pragma once

#include <string>

#include "config/base/result.h"
#include "net/drive_file.h"
#include "visual/process/lamps.h"
#include "visual/process/options.h"
#include "visual/process/traffic.h"
#include "visual/renderer.h"
#include "visual/shadow_casters.h"

namespace phare {

/// The moment that is asked about.
struct AskedMoment {
  SimTime time{};
  CockpitState controls{};
  VehicleState pose{};
};

/// A drive at `at_s` of simulated time: the newest controls and the newest pose until then. Error: it has neither.
Result<AskedMoment> moment_of_drive(const Drive& drive, double at_s);

/// What the picture of that moment is drawn from, as the first eye sees it; nothing lies over it. Switches `lamps` to
/// the moment.
FrameInput frame_of_moment(Lamps& lamps, const Desk& desk, const ChannelConfig& channel, const AskedMoment& moment,
                           const Scene& scene, const Movers& movers, const Traffic& traffic, const RoadLine& road,
                           const FixedLight& fixed);

/// "# low, design "reflector", 12.0 s, on llvmpipe": the moment; then a line for each effect: name, level, reason.
/// `device`: the name of what would be taken. `window`: there is one, so that there is an overlay. Switches `lamps` to
/// the moment.
std::string explain_moment(Lamps& lamps, const Desk& desk, const ChannelConfig& channel, const AskedMoment& moment,
                           const std::string& device, const Scene& scene, const Movers& movers, const Traffic& traffic,
                           const RoadLine& road, const FixedLight& fixed, bool window);

}  // namespace phare
