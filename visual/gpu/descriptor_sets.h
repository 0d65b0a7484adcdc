// Descriptor sets of one layout, as many as are asked for: pools are added, never emptied one by one. Those of a frame
// come back with the next frame of the same number.
#pragma once

#include <array>
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
  /// Takes back the sets made for the frame that is recorded now, when it went before.
  void begin_frame();
  /// Takes all sets back, once no command that uses one is still to be done.
  void clear();

 private:
  Device* device_ = nullptr;
  vk::raii::DescriptorSetLayout layout_{nullptr};
  struct Pools {
    std::vector<vk::raii::DescriptorPool> pools;
    std::uint32_t made = 0;
    void clear();
  };
  std::vector<vk::DescriptorPoolSize> sizes_;           ///< of one pool
  std::array<Pools, kMostFramesInFlight> pools_of_;     ///< by frame
};

}  // namespace phare::gpu
