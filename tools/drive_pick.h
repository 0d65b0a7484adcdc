// What `phare drive --budget-ms` and `--tolerance` pick: settings of the picture from the measured table of this
// machine (tools/cost/settings.h), measured now where there is none that counts.
#pragma once

#include "tools/drive_options.h"

namespace phare {

/// Fills options.picked_arguments, what phare-visual is told of it. Error: of the device, of a tolerance that no
/// setting holds, of settings given by hand that no measured one has.
Status pick_settings(DriveOptions& options, const Rig& rig);

}  // namespace phare
