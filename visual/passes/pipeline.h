// What the graphics pipelines of the passes have in common.
#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include "visual/gpu/device.h"

namespace phare {

struct PipelineRecipe {
  vk::ShaderModule vertex{};
  vk::ShaderModule fragment{};  ///< null: depth only
  /// In place of these, shaders that are much more than the constants, which must be there, leave of them
  /// (visual/gpu/spirv.h).
  std::span<const std::uint32_t> vertex_code{}, fragment_code{};
  const vk::SpecializationInfo* constants = nullptr;  ///< of both stages
  std::span<const vk::VertexInputAttributeDescription> attributes{};
  std::uint32_t stride = 0;         ///< of a vertex; 0: none are read
  std::uint32_t second_stride = 0;  ///< of a vertex in a second buffer; 0: there is none
  bool second_by_instance = false;  ///< of that one for a whole draw
  std::uint32_t third_stride = 0, fourth_stride = 0, fifth_stride = 0, sixth_stride = 0;  ///< the same of four more
  bool third_by_instance = false;
  vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
  vk::CullModeFlags cull = vk::CullModeFlagBits::eNone;
  std::vector<vk::Format> colour{};
  bool blend = false;  ///< over what is there, by alpha; what is there stays opaque
  bool add = false;    ///< to what is there, whose alpha stays
  bool over = false;      ///< over what is there, by alpha; the alpha that is there stays
  bool brighter = false;  ///< of both stays what is more, each channel by itself
  bool depth = false, depth_write = false;
  vk::CompareOp compare = vk::CompareOp::eGreater;  ///< reversed depth: 1 near, 0 far
  float depth_slope = 0.0f;  ///< added to depth, times how much depth changes from pixel to pixel
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  vk::PipelineLayout layout{};
};

vk::raii::Pipeline make_pipeline(const gpu::Device& device, const PipelineRecipe& recipe);
/// One of each, in their order; as many at once as there are processors, for a software device takes tenths of a second
/// to compile a large shader.
std::vector<vk::raii::Pipeline> make_pipelines(const gpu::Device& device,
                                               std::span<const PipelineRecipe* const> recipes);

/// The same one after the other, on the thread of who calls; not those that are left when it is told to stop. Nothing
/// is counted: the device's counts are not this thread's.
std::vector<vk::raii::Pipeline> make_in_turn(const gpu::Device& device, std::span<const PipelineRecipe* const> recipes,
                                             const std::stop_token& stop);

/// One descriptor set, and push constants of these stages.
vk::raii::PipelineLayout pushing_layout(const gpu::Device& device, vk::DescriptorSetLayout set,
                                        vk::ShaderStageFlags stages, std::uint32_t bytes);

/// Viewport and scissor over a part of the target, y down as Vulkan has it. `mirrored`: left and right are swapped, as
/// in a mirror, so front faces turn the other way round.
void set_area(vk::CommandBuffer commands, const vk::Rect2D& area, bool mirrored = false);
/// Over the whole of `extent`.
void set_area(vk::CommandBuffer commands, vk::Extent2D extent);

/// A target of a pass; `resolved`: where its samples are averaged into.
vk::RenderingAttachmentInfo attachment(const gpu::Image& image, vk::ImageLayout layout, vk::AttachmentLoadOp load,
                                       vk::ClearValue clear, const gpu::Image* resolved = nullptr);

}  // namespace phare
