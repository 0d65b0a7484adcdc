// Writing results to where the user pointed: a file that appears whole or not at all, a pipe, a device, standard
// output.
#pragma once

#include <filesystem>
#include <string_view>

#include "config/result.h"

namespace phare {

/// A regular file (one to be made, or behind symbolic links) is written beside and renamed, so a reader sees the old
/// file or the whole new one, links stay links and the mode is kept. A pipe or device is written to and never
/// replaced. "-", /dev/stdout, /dev/stderr and /dev/fd/N are the open descriptors themselves. The error names `path`.
Status write_whole_file(const std::filesystem::path& path, std::string_view content);

/// Does `path` mean standard output?
bool is_standard_output(const std::filesystem::path& path);

}  // namespace phare
