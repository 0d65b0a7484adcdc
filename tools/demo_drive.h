// The drives that come with our scenes: what a rig drives when nobody names a drive. `config`: the folder of our rigs
// and drives.
// Checked by tests/tools/demo_drive_test.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "config/rig.h"

namespace phare {

/// Of a rig on a scene of ours the driver model's script for its road, the file drives/<scene>_script.toml. Nothing:
/// the scene is of others, and we know no lane there.
std::optional<std::string> demo_script(const Rig& rig, const std::filesystem::path& config);

/// The same, recorded: drives/<scene>.pcap. Nothing: none was, or the scene is of others.
std::optional<std::string> demo_recording(const Rig& rig, const std::filesystem::path& config);

}  // namespace phare
