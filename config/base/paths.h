// Where the files that come with the program are: beside an installed program, else in the tree it was built from.
#pragma once

#include <filesystem>

namespace phare {

/// The folder of rigs, cockpits, vehicles, rules and drives: <prefix>/share/phare/config of an installed program
/// (<prefix>/bin/…), else the config/ it was built from.
std::filesystem::path config_dir();

/// The folder of the lamps and scenes that the build makes: environment PHARE_GENERATED_DIR, else
/// <prefix>/share/phare/generated of an installed program, else the build's own.
std::filesystem::path generated_dir();

/// Path of a file named in a config file: absolute as it is; "generated/…" below generated_dir(); anything else
/// relative to the naming file's directory.
std::filesystem::path resolve_path(const std::filesystem::path& named, const std::filesystem::path& naming_file);

/// The list of Debian packages: share/phare/packages.txt of an installed program, else that of the tree.
std::filesystem::path packages_file();

/// This program is an installed one: nothing may be written beside its files.
bool is_installed();

}  // namespace phare
