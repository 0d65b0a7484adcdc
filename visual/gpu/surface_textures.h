// Textures of a scene's materials on the device (shaders/textured.h): of each material with a look at every pixel one
// image of two layers, its sampler and its numbers, as a descriptor set. A scene without them has none of it.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "shaders/textured.h"
#include "visual/gpu/descriptor_sets.h"
#include "visual/gpu/device.h"
#include "visual/scene/scene.h"

namespace phare {

/// What a material's pipeline is compiled for: kLook… of shaders/textured.h. 0: it has no look.
std::uint32_t look_bits(const SceneMaterial& material);

/// Why a device cannot draw them, in the words of its limit; nullptr: it can.
const char* no_textures(const gpu::Device& device);

class SurfaceTextures {
 public:
  SurfaceTextures() = default;
  /// Materials are numbered on from one scene to the next.
  SurfaceTextures(gpu::Device& device, std::span<const Scene* const> scenes);

  bool empty() const { return sets_.empty(); }
  vk::DescriptorSetLayout layout() const { return descriptors_->layout(); }
  /// Of a material that has a look.
  vk::DescriptorSet set(std::size_t material) const { return sets_.at(material); }
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::vector<gpu::Image> images_;
  std::vector<vk::raii::Sampler> samplers_;
  gpu::DeviceBuffer looks_;  ///< GpuLook of each material
  std::unique_ptr<gpu::DescriptorSets> descriptors_;
  std::map<std::size_t, vk::DescriptorSet> sets_;
  std::uint64_t bytes_ = 0;
};

}  // namespace phare
