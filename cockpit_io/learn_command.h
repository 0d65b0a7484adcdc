// The command phare-cockpit --learn.
#pragma once

#include <filesystem>
#include <string>

#include "net/clock.h"

namespace phare {

struct LearnOptions {
  std::string interface;           ///< a CAN interface; with a log the one whose frames are taken
  std::filesystem::path log_file;  ///< a candump log
  std::filesystem::path dbc_file;  ///< may be empty: bits
  bool gamepad = false;            ///< the axes and buttons of a gamepad instead
  double rest_s = 5.0;
  double seconds = 0.0;  ///< stop after so long; 0: until told to
};

/// Shows on standard output what changes while the stalk is moved. Exit code: 0; 2 with one line for bad input; 1 when
/// nothing moved.
int learn(const LearnOptions& options, const StopFlag& stop);

}  // namespace phare
