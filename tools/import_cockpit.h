// The controls of a recorded drive by a cockpit file: its signals, checks, latches and switch logic, as phare-cockpit
// has them, at the times of the log. Test: tests/tools/can_import_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cockpit_io/candump.h"
#include "cockpit_io/dbc.h"
#include "config/base/result.h"
#include "config/cockpit.h"
#include "net/messages.h"

namespace phare {

struct RecordedControls {
  struct At {
    double t_s = 0.0;  ///< on the log's clock
    CockpitState state;
  };
  std::vector<At> states;  ///< after each frame that moved or held a control, in time's order
  std::vector<double> steering_t_s, steering_rad;
  std::uint64_t used = 0, undecodable = 0, refused = 0;
  bool has_accelerator = false, has_brake = false;  ///< the file maps them

  /// The newest state at `t_s`; the first one before it.
  const CockpitState& at(double t_s) const;
};

/// Error where the cockpit file does not fit the DBC file, maps no steering, or nothing of it is in the log.
Result<RecordedControls> recorded_controls(const CockpitConfig& config, const Dbc& dbc, const CandumpLog& log);

}  // namespace phare
