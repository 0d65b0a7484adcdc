// Specialization constants of a pipeline by their numbers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visual/gpu/vulkan.h"

namespace phare {

struct SpecConstants {
  std::vector<std::uint32_t> values{};
  std::vector<vk::SpecializationMapEntry> entries{};

  void put(std::uint32_t id, std::uint32_t value) {
    entries.push_back({.constantID = id, .offset = static_cast<std::uint32_t>(4 * values.size()), .size = 4});
    values.push_back(value);
  }
  /// One after the other from `id` on.
  void put_all(std::uint32_t id, std::span<const std::uint32_t> all) {
    for (const std::uint32_t value : all) put(id++, value);
  }
  /// As long as this stands.
  vk::SpecializationInfo info() const {
    return {.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
            .pMapEntries = entries.data(),
            .dataSize = 4 * values.size(),
            .pData = values.data()};
  }
};

/// Which of the shaders that are compiled for 2, 4 and 8 lamps.
constexpr std::size_t shader_for(std::uint32_t lamps) {
  return lamps <= 2 ? 0 : lamps <= 4 ? 1 : 2;
}

}  // namespace phare
