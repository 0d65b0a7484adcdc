// What phare drive is asked for, and everything that can be wrong with it before a process is started.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/picture_options.h"
#include "config/rig.h"
#include "tools/commands.h"
#include "tools/lamp_design.h"

namespace phare {

struct DriveOptions {
  std::string rig_file = config_path("rigs/country_road.toml");
  std::string drive, script, log, dbc, cockpit, out, record, log_level = "info";
  bool headless = false, lockstep = false, closed_loop = false, json = false;
  bool single_file = false;  ///< the page holds its pictures and its video
  bool overwrite = false, open_bus = false;
  bool law = false;           ///< a control law leads the lamps
  bool explain = false;       ///< which effects a moment calls for, instead of a drive
  std::string explain_light;  ///< that moment is not of a drive: the light switch, and
  bool explain_fog = false;   ///< the front fog lamps
  bool explain_cost = false;  ///< draw it, and tell what each effect takes
  PictureOptions picture;
  std::uint16_t port_base = 0;
  LampFlags lamps;
  std::string design, versus;     ///< of the rig by name or number; versus may be a lamp as --lamp has them
  bool made_design = false;       ///< a design is driven that the rig's file does not have
  std::vector<std::string> desk;  ///< what they set of the picture, as --set has it
  LampDesignNotes lamp_told;      ///< what became of them
  std::string drive_told;         ///< a warning about the drive that was taken because none was named; empty: none
  std::string lamp_notes;         ///< the same, as the derived rig says it
  std::vector<std::string> command;
  std::string level, vehicle;                 ///< of the car, instead of the rig's
  std::vector<std::string> car_and_road;      ///< what phare-dynamics is told besides
  double budget_ms = 0.0;                     ///< of a frame; 0: none is given
  std::optional<double> tolerance;            ///< a share of the light
  std::vector<std::string> picked_arguments;  ///< what phare-visual is told of what was picked for them
  std::string guide;          ///< somebody sits at the window and drives (live) or looks on (replay); empty: nobody
  bool demo_at_once = false;  ///< live: the demo driver begins
};

/// The options of `phare drive`, and its help.
void add_drive_options(CLI::App& command, const std::shared_ptr<DriveOptions>& options);

/// The rig as it will be driven. Fills what the options leave open (the demo, the folder, who drives), and refuses
/// files, ports and flags that cannot be driven with.
Result<Rig> prepare_drive(DriveOptions& options);

}  // namespace phare
