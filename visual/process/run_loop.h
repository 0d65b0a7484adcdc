// The visual process: receive, draw, report. Real time by the wall clock, or lockstep by frame index.
#pragma once

#include "visual/process/session.h"

namespace phare {

/// Runs until the drive has ended, N frames are done, the window is closed or a signal came. Throws what Vulkan throws
/// when the device is lost.
void run_loop(Session& session);

}  // namespace phare
