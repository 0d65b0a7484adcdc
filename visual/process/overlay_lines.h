// The desk in a frame: what it sets of the picture, and the lines of text that it lets be shown. Pure:
// tests/visual_process/explain_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/desk.h"
#include "config/desk_cameras.h"
#include "net/messages.h"
#include "visual/process/adaptation.h"
#include "visual/process/cameras.h"
#include "visual/process/lamps.h"
#include "visual/process/road_end.h"
#include "visual/process/road_line.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {

/// View, levels, exposure and chosen effects of a frame.
void set_by_desk(FrameInput& input, const Desk& desk);
/// The eye that the desk has chosen.
inline CameraEye first_eye(const Desk& desk) {
  return {desk.camera, desk.free_eye};
}
/// `road`: for the oncoming eye, where it is known.
SeenBy seen_by(const CameraEye& eye, const ChannelConfig& channel, const Lamps& lamps, const VehicleState& pose,
               const RoadLine* road = nullptr);

/// The controls with the design that the picture shows, whichever the cockpit has chosen.
CockpitState shown_by_desk(const Desk& desk, CockpitState controls);

/// What the lines tell of.
struct OverlayMoment {
  SimTime time{};
  const CockpitState& controls;
  const VehicleState& pose;
  bool pose_held = false;
  bool paused = false;    ///< by command: simulated time stands
  double frame_ms = 0.0;  ///< of the frame before
  const EyeAdaptation& eye;
  const FrameResult* frame = nullptr;         ///< the one before: its effects and what they took
  std::optional<MeasurePoint> under_mouse{};  ///< of the world
  const RoadLine* road_line = nullptr;        ///< for probes of the road
  std::vector<std::string> point{};           ///< the point that is read, and the reach (point_reading.h, road_marks.h)
  const World* world = nullptr;               ///< what is in it hides light; none: nothing does
  std::vector<std::string> moving{};          ///< of lamps that are being moved (lamp_keys.h)
  RoadPlace road = RoadPlace::kThere;
  std::string picked{};     ///< for a budget or a tolerance, as it holds now
  std::string audit{};      ///< what the self-audit has found (audit.h)
  bool audit_over = false;  ///< a pixel was off by more than its level states
  bool coming = false;      ///< a picture of another kind was asked for, and is made beside the frames
};

/// What the driver is told over the picture besides the instruments: time, lux at probes and under the mouse, and
/// everything that is not as it should be, which shows whatever the desk says.
std::vector<std::string> overlay_lines(const Desk& desk, const Lamps& lamps, const OverlayMoment& moment);

}  // namespace phare
