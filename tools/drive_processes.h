// The processes of a drive and what each is told.
#pragma once

#include <filesystem>
#include <vector>

#include "tools/drive_options.h"
#include "tools/run_files.h"
#include "tools/supervisor.h"

namespace phare {

/// Where each process says what it counted, NAME.json; empty: nowhere, for nobody would read it.
std::filesystem::path stats_folder(const DriveOptions& options, const RunFiles& files);

/// Dynamics, cockpit and a picture for each channel, in this order.
std::vector<ProcessSpec> processes_of(const Rig& rig, const DriveOptions& options, const RunFiles& files);

}  // namespace phare
