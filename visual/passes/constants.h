// Specialization constants of a pipeline by their numbers.
#pragma once

#include <cstdint>
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
  /// As long as this stands.
  vk::SpecializationInfo info() const {
    return {.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
            .pMapEntries = entries.data(),
            .dataSize = 4 * values.size(),
            .pData = values.data()};
  }
};

}  // namespace phare
