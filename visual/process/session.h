// Everything a visual process holds while it runs; made by main, used by the loop.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "config/road/lane.h"
#include "net/bus.h"
#include "net/clock.h"
#include "visual/process/adaptation.h"
#include "visual/process/album.h"
#include "visual/process/audit.h"
#include "visual/process/fail_safe_log.h"
#include "visual/process/frame_stats.h"
#include "visual/process/governor.h"
#include "visual/process/lamp_replay.h"
#include "visual/process/lamps.h"
#include "visual/process/law.h"
#include "visual/process/options.h"
#include "visual/process/switch_to_photon.h"
#include "visual/process/window.h"
#include "visual/scene/scene.h"

namespace phare {

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
  EyeAdaptation eye;
  Governor governor;             ///< in real time, where a budget is given
  nlohmann::json governor_left;  ///< its report, where it has left the lead to the user
  LampReplay lamps_then;         ///< of the drive that is shown
  std::vector<LanePoint> lane;   ///< of the scene; empty where it has none
  nlohmann::json lamps_json;     ///< tables with hashes, peak and flux: does not change

  const ChannelConfig& channel() const { return rig.channels[options.channel]; }
};

}  // namespace phare
