// One [control.…] table of a cockpit file. Part of the reader in cockpit.cpp.
#pragma once

#include "config/cockpit.h"
#include "config/formats/toml_table.h"

namespace phare {

inline constexpr double kMostTimeout_s = 3600.0;

/// `timeout_s`: the source's. `gamepad`: axis and button instead of message and signal. Errors are noted in the table.
ControlMapping read_control(Control control, TomlTable table, double timeout_s, bool gamepad);

/// Notes an error where two signals claim the same control.
void check_conflicts(TomlTable& controls, const CockpitConfig& config);

}  // namespace phare
