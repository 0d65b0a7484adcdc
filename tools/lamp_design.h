// A design made of lamps named on the command line: --lamp, --lamp-high, --lamp-fog, in the places of a rig's
// headlamps.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "config/rig.h"

namespace phare {

/// What was said on the command line.
struct LampFlags {
  std::vector<std::string> low{}, high{}, fog{};  ///< each at most once
  std::string aim{};                              ///< "as-filed", "cut-off" or degrees up; empty: cut-off
  std::string others = "rig";                     ///< "rig" or "none": where the functions come from that are not given

  bool any() const { return !low.empty() || !high.empty() || !fog.empty(); }
};

/// Hangs the options on a command.
void add_lamp_flags(CLI::App* command, LampFlags& flags);
/// How a lamp is given, for the end of --help.
extern const char* const kLampFlagsHelp;

/// One of them, read: a file for both sides, or one for each.
struct LampChoice {
  std::string flag, text;  ///< as typed, for messages
  LampFunction function = LampFunction::kLow;
  std::filesystem::path left, right;    ///< absolute; equal for a pair from one file
  SourceConfig source;                  ///< without its file; of the left lamp
  std::optional<double> x_m, y_m, z_m;  ///< instead of the rig's place
  bool two_files = false, pitch_given = false, axis_given = false;
};
/// FILE[,key=value…] or left=FILE,right=FILE[,key=value…] with the keys of `phare measure --lamp` and
/// colour_temperature_k or spectrum. A file name may hold commas; one that holds ",word=" stands in double quotes, a
/// quote doubled.
Result<LampChoice> parse_lamp_choice(const std::string& flag, LampFunction function, const std::string& text);

/// "as-filed", "cut-off" or degrees up.
Result<AimConfig> parse_aim(const std::string& text);

/// What is told to the person who drives: one line each.
struct LampDesignNotes {
  std::vector<std::string> lines, warnings;
};

/// Where no lamp of one's own is given: error, what of the flags is about one.
Status nothing_of_a_lamp(const LampFlags& flags);

/// Puts the design first and has the rig keep it. Every file is read. Errors: a file that is not there or cannot be
/// read, no light in front, a file given twice, no place for it.
Result<LampDesignNotes> put_lamp_design(Rig& rig, const LampFlags& flags);

/// What came of every `aim` of a rig.
Result<LampDesignNotes> aim_notes(const Rig& rig);

/// Is there light ahead, from 45° below to 20° above and 60° to the sides?
bool lights_ahead(const SourceConfig& source, const struct IntensityTable& table);

}  // namespace phare
