// Files that a command reads: standard input as "-", once; and no result over one of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// Does `name` mean standard input? A file called "-" is "./-".
bool is_standard_input(const std::filesystem::path& name);

/// What stands in messages for it: "standard input", else the name.
std::string input_name(const std::filesystem::path& name);

/// Why `name` cannot be read as a file that is asked for its size and read again: "no such file", "is a folder", "is
/// not a regular file"; empty: it can, unless its permissions forbid it.
std::string why_no_file(const std::filesystem::path& name);

/// All bytes of a file, a pipe or standard input, whose bytes are kept for a second reader of one program run. Error
/// where there is nothing to read or more than `limit` bytes; its place is input_name().
Result<std::string> read_input_bytes(const std::filesystem::path& name, std::uintmax_t limit);

/// All of a regular file, or of standard input up to 4 GiB.
Result<std::string> read_file_or_input(const std::filesystem::path& name);

/// Before anything is read or written. Error when two inputs are standard input, or a result would be written over an
/// input, under whatever name: "./x", a symbolic or a hard link. Empty names are options that were not given.
Status check_inputs(const std::vector<std::string>& inputs, const std::vector<std::string>& results = {});

}  // namespace phare
