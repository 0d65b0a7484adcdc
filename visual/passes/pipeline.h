// What the graphics pipelines of the passes have in common.
#pragma once

#include <span>
#include <vector>

#include "visual/gpu/device.h"

namespace phare {

struct PipelineRecipe {
  vk::ShaderModule vertex{};
  vk::ShaderModule fragment{};                        ///< null: depth only
  const vk::SpecializationInfo* constants = nullptr;  ///< of both stages
  std::span<const vk::VertexInputAttributeDescription> attributes{};
  std::uint32_t stride = 0;  ///< of a vertex; 0: none are read
  vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
  vk::CullModeFlags cull = vk::CullModeFlagBits::eNone;
  std::vector<vk::Format> colour{};
  bool depth = false, depth_write = false;
  vk::CompareOp compare = vk::CompareOp::eGreater;  ///< reversed depth: 1 near, 0 far
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  vk::PipelineLayout layout{};
};

vk::raii::Pipeline make_pipeline(const gpu::Device& device, const PipelineRecipe& recipe);

/// Viewport and scissor over the whole of `extent`, y down as Vulkan has it.
void set_area(vk::CommandBuffer commands, vk::Extent2D extent);

}  // namespace phare
