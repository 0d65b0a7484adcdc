// The subcommands of `phare`. Each adds itself to the parser and, when it was chosen, leaves what to run in `chosen`.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "config/base/result.h"

namespace phare {

using Command = std::function<int()>;  ///< returns the exit code

void add_drive(CLI::App& app, Command& chosen);
void add_record(CLI::App& app, Command& chosen);
void add_control(CLI::App& app, Command& chosen);
void add_replay(CLI::App& app, Command& chosen);
void add_can(CLI::App& app, Command& chosen);
void add_bus_relay(CLI::App& app, Command& chosen);
void add_import(CLI::App& app, Command& chosen);
void add_lamp(CLI::App& app, Command& chosen);
void add_measure(CLI::App& app, Command& chosen);
void add_vehicle(CLI::App& app, Command& chosen);
void add_rig(CLI::App& app, Command& chosen);
void add_cost(CLI::App& app, Command& chosen);
void add_hard_cases(CLI::App& app, Command& chosen);
void add_doctor(CLI::App& app, Command& chosen);
void add_help_data(CLI::App& app, Command& chosen);

/// Version, commit, Vulkan device.
std::string version_text();

/// Prints one line to stderr and gives exit code 2.
int bad_input(const Error& error);

/// config/ of this source tree: the demo rig and drive.
std::string config_path(const std::string& below);

/// A file of config/examples/ as an example on the command line names it: from the root of the source tree, or, for an
/// installed program, with its whole path.
std::string example_file(const std::string& name);

}  // namespace phare
