// The command line of phare-visual.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/desk.h"
#include "config/rig.h"
#include "net/messages.h"
#include "visual/process/governor.h"

namespace phare {

struct VisualOptions {
  std::filesystem::path rig_file;
  std::filesystem::path drive_file;  ///< only to know how long the drive is; may be empty
  std::filesystem::path out;         ///< folder of the pictures; empty: none are written
  std::filesystem::path stats_file;  ///< empty: visual-<channel>.json in `out`
  std::uint32_t channel = 0;
  std::filesystem::path alive_file;  ///< says that the process is not hung; empty: none
  bool open_bus = false;             ///< no key of the run
  bool lockstep = false;
  bool law = false;  ///< a control law leads the lamps: visual/process/law.h
  bool headless = false;
  bool explain = false;                           ///< tell which effects a moment calls for, and leave
  LightSwitch explain_light = LightSwitch::kLow;  ///< of that moment, where no drive says it
  bool explain_fog = false;
  bool explain_cost = false;  ///< draw that moment, and tell what each effect takes
  bool going_on = false;    ///< takes the place of a process that was killed in this drive: what it left in `out` stays
  std::int64_t frames = 0;  ///< > 0: save every one of this many frames, then leave
  int width_px = 0, height_px = 0;  ///< 0: the channel's
  int samples = 1;
  std::optional<int> frames_in_flight{};                ///< in real time; else two, in a window without a GPU one
  std::vector<DeskCommand> desk;                        ///< what the command line sets of the picture, after the rig
  std::optional<std::filesystem::path> traffic_file{};  ///< in place of the rig's
  bool video = false;                                   ///< keep a picture of every frame
  double still_at_s = -1.0;                             ///< simulated time of the stills; negative: chosen
  int road_cuts = 0;                                    ///< how often each triangle of the ground is cut in four
  std::int64_t audit_every = 300;                       ///< frames; 0: never
  std::optional<double> audit_bound;                    ///< a share of the light, in place of what the level states
  std::vector<GovernorLevel> levels;     ///< what was picked, and what the governor may step along; empty: nothing
  std::size_t begin_level = 0;           ///< of these, the one picked
  double budget_ms = 0.0;                ///< > 0: the governor keeps it, in real time
  std::string picked;                    ///< what was picked and why, in words
  std::string guide;                     ///< live, replay: somebody sits at the window; empty: nobody
  bool demo = false;                     ///< a demo driver waits for his key
  std::string report;                    ///< what the end screen says of the report
  std::optional<ImageLevel> beam_image;  ///< instead of the rig's
  bool validation = false;
  std::string device_name;
  std::string log_level = "info";
  std::optional<std::uint16_t> port_base;
};

/// What came of reading the command line: options, or the exit code (help was shown, or an error told on stderr).
struct ParsedOptions {
  std::optional<VisualOptions> options;
  int exit_code = kExitDone;
};

ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace phare
