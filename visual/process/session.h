// Everything a visual process holds while it runs; made by main, used by the loop.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "config/road/lane.h"
#include "net/bus.h"
#include "net/clock.h"
#include "visual/fixed_light.h"
#include "visual/process/adaptation.h"
#include "visual/process/album.h"
#include "visual/process/audit.h"
#include "visual/process/fail_safe_log.h"
#include "visual/process/frame_lock.h"
#include "visual/process/frame_stats.h"
#include "visual/process/governor.h"
#include "visual/process/lamp_replay.h"
#include "visual/process/lamps.h"
#include "visual/process/law.h"
#include "visual/process/movers.h"
#include "visual/process/options.h"
#include "visual/process/props.h"
#include "visual/process/switch_to_photon.h"
#include "visual/process/traffic.h"
#include "visual/process/window.h"
#include "visual/scene/scene.h"

namespace phare {

/// How long each design has shone in the drive, s.
struct DesignsLit {
  std::map<std::size_t, double> seconds;
  std::optional<std::size_t> shining;
  SimTime since{};

  void see(std::optional<std::size_t> design, SimTime now) {
    if (shining) seconds[*shining] += now.seconds() - since.seconds();
    if (design) seconds.try_emplace(*design, 0.0);
    shining = design, since = now;
  }
  /// The other of two that are compared is on the page as well.
  void see_beside(std::size_t design, std::size_t other) {
    seconds.try_emplace(other, 0.0);
    compared = std::pair(design, other);
  }
  std::optional<std::pair<std::size_t, std::size_t>> compared{};  ///< the last two
};

struct Session {
  Session(VisualOptions options_, Rig rig_, Desk desk_, Scene scene_, Lamps lamps_, std::optional<Window> window_,
          Renderer renderer_, Bus bus_, Album album_, StopFlag stop_, nlohmann::json lamps_json_)
      : options(std::move(options_)),
        rig(std::move(rig_)),
        desk(std::move(desk_)),
        scene(std::move(scene_)),
        lamps(std::move(lamps_)),
        window(std::move(window_)),
        renderer(std::move(renderer_)),
        bus(std::move(bus_)),
        album(std::move(album_)),
        stop(stop_),
        lamps_json(std::move(lamps_json_)) {}

  VisualOptions options;
  Rig rig;
  Desk desk;  ///< what the user sets of the picture
  Scene scene;
  Lamps lamps;
  std::optional<Window> window;
  Renderer renderer;  // before the window goes
  Bus bus;
  Album album;
  StopFlag stop;
  FrameStats stats;
  AuditStats audit;
  SwitchToPhoton switches;
  FailSafeLog fail_safes;
  LawLink law;
  FrameLock lock{options.channel, static_cast<std::uint32_t>(rig.channels.size()), options.lockstep};
  DesignsLit designs_lit;
  std::optional<std::size_t> stills_design;  ///< that the stills show; of a process that was killed not known
  EyeAdaptation eye;
  Governor governor;             ///< in real time, where a budget is given
  nlohmann::json governor_left;  ///< its report, where it has left the lead to the user
  Movers movers;
  Props props;  ///< what some cameras show besides
  Traffic traffic;
  std::shared_ptr<const FixedLight> fixed_light = std::make_shared<FixedLight>();  ///< street lamps, moon, windows
  LampReplay lamps_then;                                                           ///< of the drive that is shown
  std::vector<LanePoint> lane;  ///< of the scene; empty where it has none
  nlohmann::json lamps_json;    ///< tables with hashes, peak and flux: does not change

  const ChannelConfig& channel() const { return rig.channels[options.channel]; }
};

}  // namespace phare
