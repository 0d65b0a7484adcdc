#include "visual/passes/pipeline.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "config/base/on_all_cores.h"
#include "visual/gpu/spirv.h"

namespace phare {

vk::raii::PipelineLayout pushing_layout(const gpu::Device& device, vk::DescriptorSetLayout set,
                                        vk::ShaderStageFlags stages, std::uint32_t bytes) {
  const vk::PushConstantRange push{.stageFlags = stages, .offset = 0, .size = bytes};
  return vk::raii::PipelineLayout(
      device.device,
      vk::PipelineLayoutCreateInfo{
          .setLayoutCount = 1, .pSetLayouts = &set, .pushConstantRangeCount = 1, .pPushConstantRanges = &push});
}

namespace {

vk::raii::Pipeline compile(const gpu::Device& device, const PipelineRecipe& recipe) {
  std::vector<vk::raii::ShaderModule> own;  // until the pipeline is made
  std::vector<vk::PipelineShaderStageCreateInfo> stages;
  const auto add = [&](vk::ShaderStageFlagBits stage, vk::ShaderModule module, std::span<const std::uint32_t> code) {
    if (!code.empty()) module = *own.emplace_back(gpu::make_shader(device, gpu::specialised(code, *recipe.constants)));
    if (module)
      stages.push_back({.stage = stage,
                        .module = module,
                        .pName = "main",
                        .pSpecializationInfo = code.empty() ? recipe.constants : nullptr});
  };
  add(vk::ShaderStageFlagBits::eVertex, recipe.vertex, recipe.vertex_code);
  add(vk::ShaderStageFlagBits::eFragment, recipe.fragment, recipe.fragment_code);
  std::vector<vk::VertexInputBindingDescription> bindings;
  const auto bind = [&](std::uint32_t binding, std::uint32_t stride, bool by_instance) {
    if (stride > 0)
      bindings.push_back(
          {.binding = binding,
           .stride = stride,
           .inputRate = by_instance ? vk::VertexInputRate::eInstance : vk::VertexInputRate::eVertex});
  };
  bind(0, recipe.stride, false);
  bind(1, recipe.second_stride, recipe.second_by_instance);
  bind(2, recipe.third_stride, recipe.third_by_instance);
  bind(3, recipe.fourth_stride, false);
  bind(4, recipe.fifth_stride, false);
  bind(5, recipe.sixth_stride, false);
  const vk::PipelineVertexInputStateCreateInfo input{
      .vertexBindingDescriptionCount = static_cast<std::uint32_t>(bindings.size()),
      .pVertexBindingDescriptions = bindings.data(),
      .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(recipe.attributes.size()),
      .pVertexAttributeDescriptions = recipe.attributes.data()};
  const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = recipe.topology};
  const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
  const vk::PipelineRasterizationStateCreateInfo raster{.polygonMode = vk::PolygonMode::eFill,
                                                        .cullMode = recipe.cull,
                                                        .frontFace = vk::FrontFace::eCounterClockwise,
                                                        .depthBiasEnable = recipe.depth_slope != 0.0f,
                                                        .depthBiasSlopeFactor = recipe.depth_slope,
                                                        .lineWidth = 1.0f};
  const vk::PipelineMultisampleStateCreateInfo multisample{.rasterizationSamples = recipe.samples};
  const vk::PipelineDepthStencilStateCreateInfo depth{
      .depthTestEnable = recipe.depth, .depthWriteEnable = recipe.depth_write, .depthCompareOp = recipe.compare};
  const bool keeps_alpha = recipe.add || recipe.over;
  using Mask = vk::ColorComponentFlagBits;
  const std::vector<vk::PipelineColorBlendAttachmentState> blends(
      recipe.colour.size(),
      {.blendEnable = recipe.blend || recipe.add || recipe.over || recipe.brighter,
       .srcColorBlendFactor = recipe.add ? vk::BlendFactor::eOne : vk::BlendFactor::eSrcAlpha,
       .dstColorBlendFactor = recipe.add ? vk::BlendFactor::eOne : vk::BlendFactor::eOneMinusSrcAlpha,
       .colorBlendOp = recipe.brighter ? vk::BlendOp::eMax : vk::BlendOp::eAdd,
       .srcAlphaBlendFactor = keeps_alpha ? vk::BlendFactor::eZero : vk::BlendFactor::eOne,
       .dstAlphaBlendFactor = keeps_alpha ? vk::BlendFactor::eOne : vk::BlendFactor::eOneMinusSrcAlpha,
       .alphaBlendOp = recipe.brighter ? vk::BlendOp::eMax : vk::BlendOp::eAdd,
       .colorWriteMask = Mask::eR | Mask::eG | Mask::eB | Mask::eA});
  const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = static_cast<std::uint32_t>(blends.size()),
                                                    .pAttachments = blends.data()};
  const std::array dynamic{vk::DynamicState::eViewport, vk::DynamicState::eScissor, vk::DynamicState::eFrontFace};
  const vk::PipelineDynamicStateCreateInfo dynamics{.dynamicStateCount = static_cast<std::uint32_t>(dynamic.size()),
                                                    .pDynamicStates = dynamic.data()};
  const vk::PipelineRenderingCreateInfo rendering{
      .colorAttachmentCount = static_cast<std::uint32_t>(recipe.colour.size()),
      .pColorAttachmentFormats = recipe.colour.data(),
      .depthAttachmentFormat = recipe.depth ? vk::Format::eD32Sfloat : vk::Format::eUndefined};
  return vk::raii::Pipeline(device.device, nullptr,
                            vk::GraphicsPipelineCreateInfo{.pNext = &rendering,
                                                           .stageCount = static_cast<std::uint32_t>(stages.size()),
                                                           .pStages = stages.data(),
                                                           .pVertexInputState = &input,
                                                           .pInputAssemblyState = &assembly,
                                                           .pViewportState = &viewport,
                                                           .pRasterizationState = &raster,
                                                           .pMultisampleState = &multisample,
                                                           .pDepthStencilState = &depth,
                                                           .pColorBlendState = &blend,
                                                           .pDynamicState = &dynamics,
                                                           .layout = recipe.layout});
}

}  // namespace

vk::raii::Pipeline make_pipeline(const gpu::Device& device, const PipelineRecipe& recipe) {
  ++*device.pipelines_made;
  return compile(device, recipe);
}

std::vector<vk::raii::Pipeline> make_pipelines(const gpu::Device& device,
                                               std::span<const PipelineRecipe* const> recipes) {
  std::vector<std::optional<vk::raii::Pipeline>> made(recipes.size());
  on_all_cores(recipes.size(), [&](std::size_t i) { made[i] = compile(device, *recipes[i]); });
  *device.pipelines_made += recipes.size();
  std::vector<vk::raii::Pipeline> all;
  for (std::optional<vk::raii::Pipeline>& pipeline : made) all.push_back(std::move(*pipeline));
  return all;
}

std::vector<vk::raii::Pipeline> make_in_turn(const gpu::Device& device, std::span<const PipelineRecipe* const> recipes,
                                             const std::stop_token& stop) {
  std::vector<vk::raii::Pipeline> made;
  for (const PipelineRecipe* recipe : recipes)
    if (!stop.stop_requested()) made.push_back(compile(device, *recipe));
  return made;
}

void set_area(vk::CommandBuffer commands, const vk::Rect2D& area, bool mirrored) {
  commands.setViewport(0, vk::Viewport{.x = static_cast<float>(area.offset.x),
                                       .y = static_cast<float>(area.offset.y),
                                       .width = static_cast<float>(area.extent.width),
                                       .height = static_cast<float>(area.extent.height),
                                       .minDepth = 0.0f,
                                       .maxDepth = 1.0f});
  commands.setScissor(0, area);
  commands.setFrontFace(mirrored ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
}

void set_area(vk::CommandBuffer commands, vk::Extent2D extent) {
  set_area(commands, vk::Rect2D{{0, 0}, extent});
}

vk::RenderingAttachmentInfo attachment(const gpu::Image& image, vk::ImageLayout layout, vk::AttachmentLoadOp load,
                                       vk::ClearValue clear, const gpu::Image* resolved) {
  vk::RenderingAttachmentInfo info{
      .imageView = *image.view,
      .imageLayout = layout,
      .loadOp = load,
      .storeOp = resolved != nullptr ? vk::AttachmentStoreOp::eDontCare : vk::AttachmentStoreOp::eStore,
      .clearValue = clear};
  if (resolved != nullptr) {
    info.resolveMode = vk::ResolveModeFlagBits::eAverage;
    info.resolveImageView = *resolved->view;
    info.resolveImageLayout = vk::ImageLayout::eColorAttachmentOptimal;
  }
  return info;
}

}  // namespace phare
