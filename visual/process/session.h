// Everything a visual process holds while it runs; made by main, used by the loop.
#pragma once

#include <optional>

#include "net/bus.h"
#include "net/clock.h"
#include "visual/process/album.h"
#include "visual/process/audit.h"
#include "visual/process/frame_stats.h"
#include "visual/process/lamps.h"
#include "visual/process/options.h"
#include "visual/process/switch_to_photon.h"
#include "visual/process/window.h"
#include "visual/scene/scene.h"

namespace phare {

struct Session {
  VisualOptions options;
  Rig rig;
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
  nlohmann::json lamps_json;  ///< tables with hashes, peak and flux: does not change

  const ChannelConfig& channel() const { return rig.channels[options.channel]; }
};

}  // namespace phare
