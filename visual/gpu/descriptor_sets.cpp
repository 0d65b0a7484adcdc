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
  if (made_ == pools_.size() * kInPool)
    pools_.emplace_back(device_->device,
                        vk::DescriptorPoolCreateInfo{.maxSets = kInPool,
                                                     .poolSizeCount = static_cast<std::uint32_t>(sizes_.size()),
                                                     .pPoolSizes = sizes_.data()});
  const vk::DescriptorSetLayout layout = *layout_;
  const vk::DescriptorSet set =
      (*device_->device)
          .allocateDescriptorSets(vk::DescriptorSetAllocateInfo{
              .descriptorPool = *pools_[made_ / kInPool], .descriptorSetCount = 1, .pSetLayouts = &layout})
          .front();
  ++made_;
  return set;
}

void DescriptorSets::clear() {
  for (const vk::raii::DescriptorPool& pool : pools_) pool.reset();
  made_ = 0;
}

}  // namespace phare::gpu
