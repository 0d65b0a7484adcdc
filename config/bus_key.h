// The secret that the processes of a bus share (net/seal.h).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "config/base/result.h"

namespace phare {

using BusKey = std::array<std::uint8_t, 32>;

/// A key from a file of 64 hexadecimal digits. Refused when others may read or change the file, and all zero. Never
/// tells what stands in it.
Result<BusKey> read_bus_key(const std::filesystem::path& file);

}  // namespace phare
