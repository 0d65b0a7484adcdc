// What the panel tells and what it sets from, as plain values. Pure: tests/visual_process/panel_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "config/desk.h"
#include "net/bus.h"
#include "visual/process/frame_stats.h"
#include "visual/process/lamps.h"

namespace phare {

/// A lamp or a pair that may be moved: each quantity now and in the rig file, in the order of MountQuantity, m and
/// degrees. Of a pair its middle, and the turns of its left lamp.
struct PanelLamp {
  std::string name;
  bool pair = false;
  std::array<double, 7> now{}, of_rig{};
  std::vector<std::string> members{};  ///< it, or both of the pair
  double light_01 = 1.0;               ///< mean of how their sources are dimmed, as commanded
};

/// Datagrams of one kind.
struct PanelMessages {
  std::string name;
  std::uint64_t sent = 0, received = 0, lost = 0, late = 0;
};

struct PanelFacts {
  // Beam and design.
  std::string lit{};  ///< functions that shine; empty: none
  std::vector<std::string> designs{};
  std::size_t design = 0;  ///< that shines
  bool driven = true;      ///< keys of the car reach a cockpit; else a drive is shown
  double speed_kmh = 0.0;
  // Lamps.
  bool moves_lamps = true;  ///< the first picture of a rig does
  std::vector<PanelLamp> lamps{};
  double aim_deg = 0.0;        ///< of all lamps, up
  std::size_t undo_steps = 0;  ///< to take back
  std::string rig_file{};      ///< that the places may be saved in
  // View, effects, times: none before the first frame.
  Desk desk{};
  FrameResult frame{};
  double frames_per_s = 0.0;
  // Messages.
  std::vector<PanelMessages> messages{};  ///< kinds that came or went
  std::uint64_t refused = 0;
  // What the last command of the panel was answered.
  std::string answer{};
  bool answer_refused = false;
};

std::vector<PanelLamp> panel_lamps(const Lamps& lamps);
std::vector<PanelMessages> panel_messages(const BusCounters& counters);

}  // namespace phare
