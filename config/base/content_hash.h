// The name of some content: SHA-256, so that a report can say exactly which file it was made from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "config/base/result.h"

namespace phare {

/// "sha256:" and 64 hex digits; the same as `sha256sum` says.
std::string content_hash(std::span<const std::byte> bytes);

/// Same of a file, read in pieces. Error when it cannot be read.
Result<std::string> content_hash_of_file(const std::filesystem::path& path);

}  // namespace phare
