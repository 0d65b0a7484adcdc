// phare-visual --explain --cost: a moment of a rig drawn on the device again and again, for what each effect takes.
// Checked by tests/process/explain_cost_test.cpp against the reports of drives.
#pragma once

#include <cstdint>
#include <string>

#include "visual/process/explain.h"
#include "visual/process/props.h"

namespace phare {

/// Frames whose medians are told, where nobody says how many.
inline constexpr std::int64_t kCostFrames = 30;

/// What a moment is drawn from.
struct MomentScene {
  const ChannelConfig& channel;
  const Scene& scene;
  const Movers& movers;
  const Props& props;
  const Traffic& traffic;
  const RoadLine& road;
  const FixedLight& fixed;
};

/// What the renderer is to draw, and how.
struct MomentDrawn {
  AskedMoment before;     ///< the frame before, which leaves behind what a drive keeps from frame to frame
  AskedMoment moment;     ///< drawn after it each time, and told
  bool window = false;    ///< what a window lays over the picture, too
  bool lockstep = false;  ///< pipelines and maps as a drive in lockstep has them
  std::int64_t frames = kCostFrames;
};

/// Every view that the desk asks for, and what lies over them, as in a drive: explain_costs() of it. `renderer` has the
/// scene, without a window and with one frame in flight. Switches `lamps` to the moment.
std::string cost_of_moment(Renderer& renderer, Lamps& lamps, const Desk& desk, const MomentScene& from,
                           const MomentDrawn& drawn);

}  // namespace phare
