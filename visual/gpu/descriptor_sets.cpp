#include "visual/gpu/descriptor_sets.h"

namespace phare::gpu {

DescriptorSets::DescriptorSets(Device& device, std::span<const vk::DescriptorSetLayoutBinding> bindings)
    : device_(&device),
      layout_(device.device,
              vk::DescriptorSetLayoutCreateInfo{.bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                                .pBindings = bindings.data()}) {
  for (const vk::DescriptorSetLayoutBinding& binding : bindings)
    sizes_.push_back({binding.descriptorType, binding.descriptorCount * kInPool});
}

vk::DescriptorSet DescriptorSets::make() {
  auto& [pools, made] = pools_of_[device_->frame];
  if (made == pools.size() * kInPool)
    pools.emplace_back(device_->device,
                       vk::DescriptorPoolCreateInfo{.maxSets = kInPool,
                                                    .poolSizeCount = static_cast<std::uint32_t>(sizes_.size()),
                                                    .pPoolSizes = sizes_.data()});
  const vk::DescriptorSetLayout layout = *layout_;
  const vk::DescriptorSet set =
      (*device_->device)
          .allocateDescriptorSets(vk::DescriptorSetAllocateInfo{
              .descriptorPool = *pools[made / kInPool], .descriptorSetCount = 1, .pSetLayouts = &layout})
          .front();
  ++made;
  return set;
}

void DescriptorSets::Pools::clear() {
  if (made == 0) return;
  for (const vk::raii::DescriptorPool& pool : pools) pool.reset();
  made = 0;
}

void DescriptorSets::begin_frame() {
  if (device_ != nullptr) pools_of_[device_->frame].clear();
}

void DescriptorSets::clear() {
  if (device_ != nullptr) device_->wait_for_frames();
  for (Pools& pools : pools_of_) pools.clear();
}

}  // namespace phare::gpu
