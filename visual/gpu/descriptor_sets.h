// Descriptor sets of one layout, as many as are asked for: pools are added, never emptied one by one.
#pragma once

#include <span>
#include <vector>

#include "visual/gpu/device.h"

namespace phare::gpu {

class DescriptorSets {
 public:
  static constexpr std::uint32_t kInPool = 16;

  DescriptorSets() = default;
  DescriptorSets(Device& device, std::span<const vk::DescriptorSetLayoutBinding> bindings);

  vk::DescriptorSetLayout layout() const { return *layout_; }
  vk::DescriptorSet make();
  /// Takes all sets back; no command that uses one is still to be done.
  void clear();
  std::uint32_t count() const { return made_; }

 private:
  Device* device_ = nullptr;
  vk::raii::DescriptorSetLayout layout_{nullptr};
  std::vector<vk::DescriptorPoolSize> sizes_;  ///< of one pool
  std::vector<vk::raii::DescriptorPool> pools_;
  std::uint32_t made_ = 0;
};

}  // namespace phare::gpu
