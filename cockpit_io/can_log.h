// CAN logs of every kind, as candump entries.
//
// candump's own is read here (candump.h). Others are read by python-can, a program of its own that may be missing:
// Vector ASC and BLF, PEAK TRC, and MF4 where it has asammdf (python-can 4.2 and newer). The kind is told by the ending
// of the name. Python is $PHARE_PYTHON, else python3 in PATH. Stamps of an ASC log that count from event to event are
// added up here, and a BLF file that was cut off is told: python-can does neither.
#pragma once

#include <filesystem>
#include <string>

#include "cockpit_io/candump.h"
#include "config/base/result.h"

namespace phare {

struct CanLog {
  CandumpLog log;
  std::string read_with;  ///< "python-can 4.1.0, BLFReader"; empty: read here
};

/// Error where it cannot be read, holds no frame, or python-can is missing (with the package that brings it). A log
/// that breaks off is used up to there, and counts a broken line.
Result<CanLog> read_can_log(const std::filesystem::path& file);

/// Whether the ending of the name is one of those that python-can reads.
bool is_foreign_can_log(const std::filesystem::path& file);

/// Whether Python and python-can are there.
bool reads_foreign_can_logs();

}  // namespace phare
