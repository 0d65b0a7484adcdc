// phare-visual --explain: which effects a moment of a rig calls for, and why, without a window, a picture or a device;
// and the words for what each takes, where the moment has been drawn (cost_of_moment.h).
#pragma once

#include <filesystem>
#include <string>

#include "config/base/result.h"
#include "net/drive_file.h"
#include "visual/process/frame_stats.h"
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

/// No drive: the car at rest where one of this scene begins, on the first row of its lane; without a lane at the
/// world's origin.
AskedMoment moment_at_rest(const std::filesystem::path& scene_file, LightSwitch light, bool fog_front);

/// What the picture of that moment is drawn from, as the first eye sees it; nothing lies over it. Switches `lamps` to
/// the moment.
FrameInput frame_of_moment(Lamps& lamps, const Desk& desk, const ChannelConfig& channel, const AskedMoment& moment,
                           const Scene& scene, const Movers& movers, const Traffic& traffic, const RoadLine& road,
                           const FixedLight& fixed);

/// What a window lays over the picture of that moment: lines of text, instruments, the start panel; not the panel that
/// the mouse sets from.
void lay_over(FrameInput& input, const Lamps& lamps, const Desk& desk, const AskedMoment& moment);

/// "# lit: low, design "reflector", 12.0 s, 50 km/h, on llvmpipe": the moment.
std::string moment_text(const Lamps& lamps, const AskedMoment& moment, const std::string& device);

/// moment_text(), a line for each effect with name, level, reason, and how to have what it takes. `device`: the name of
/// what would be taken. `window`: there is one, so that there is an overlay. Switches `lamps` to
/// the moment.
std::string explain_moment(Lamps& lamps, const Desk& desk, const ChannelConfig& channel, const AskedMoment& moment,
                           const std::string& device, const Scene& scene, const Movers& movers, const Traffic& traffic,
                           const RoadLine& road, const FixedLight& fixed, bool window);

/// A line for each effect as it was drawn: name, level, passes, bytes, ms on the device, reason; then the same of what
/// any frame has. `drawn`: frames of the moment, whose medians are told. `anew`: one before which the eye has turned;
/// what it computed and they have kept is told below.
std::string explain_costs(const FrameStats& drawn, const FrameResult& anew, PictureSize size);

}  // namespace phare
