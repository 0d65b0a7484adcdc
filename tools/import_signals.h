// What a recorded drive takes from its log: the signals of a control with their units, and what is wrong with the times
// of its frames. Test: tests/tools/can_import_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cockpit_io/candump.h"
#include "cockpit_io/dbc.h"
#include "config/base/result.h"

namespace phare {

struct Samples {
  std::vector<double> t_s, value;
};

/// One control: the signals that add up to it and the factor into SI.
struct ImportControl {
  std::string what;
  std::vector<const DbcSignal*> signals;
  const DbcMessage* message = nullptr;
  double factor = 1.0;
  Samples samples;
};

/// What a control is measured in: spellings of its units are known, of flags none is asked for.
enum class ControlUnits { kNone, kSpeed, kAngle, kShare };

/// Finds "MESSAGE.SIGNAL+MESSAGE.SIGNAL" in the DBC. `unit`: stated in place of the file's; empty: that. Error: no such
/// signal, signals of several messages or units, a unit that is not known.
Result<ImportControl> find_control(const Dbc& dbc, const std::string& what, const std::string& path, ControlUnits units,
                                   const std::string& unit);

/// In SI; nothing: the frame is too short, or holds another part of a multiplexed message.
std::optional<double> decode_control(const ImportControl& control, const CanFrame& frame);

/// Error where the log's clock was set while it was written, or logs of different times stand in one file: a drive as
/// long as the jump would come of it.
Status one_recording(const CandumpLog& log);

/// "speed: no sample for 2.01 s at 4.00 s; bridged", for the widest hole; empty: none of half a second.
std::string widest_gap(const std::string& what, const std::vector<double>& t_s, double begin_s);

}  // namespace phare
