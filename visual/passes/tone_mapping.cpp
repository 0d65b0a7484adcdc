#include "visual/passes/tone_mapping.h"

#include "shaders/fullscreen_vert.h"
#include "shaders/tone_mapping.h"
#include "shaders/tone_mapping_frag.h"
#include "visual/passes/pipeline.h"

namespace phare {

static_assert(sizeof(shader::ToneConstants) == 16);

ToneMappingPass::ToneMappingPass(gpu::Device& device)
    : device_(device),
      vertex_(gpu::make_shader(device, k_fullscreen_vert)),
      fragment_(gpu::make_shader(device, k_tone_mapping_frag)) {
  const vk::DescriptorSetLayoutBinding binding{.binding = shader::kToneInput,
                                               .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                               .descriptorCount = 1,
                                               .stageFlags = vk::ShaderStageFlagBits::eFragment};
  set_layout_ = vk::raii::DescriptorSetLayout(
      device.device, vk::DescriptorSetLayoutCreateInfo{.bindingCount = 1, .pBindings = &binding});
  const vk::PushConstantRange push{
      .stageFlags = vk::ShaderStageFlagBits::eFragment, .offset = 0, .size = sizeof(shader::ToneConstants)};
  layout_ = vk::raii::PipelineLayout(device.device, vk::PipelineLayoutCreateInfo{.setLayoutCount = 1,
                                                                                 .pSetLayouts = &*set_layout_,
                                                                                 .pushConstantRangeCount = 1,
                                                                                 .pPushConstantRanges = &push});
  const vk::DescriptorPoolSize size{vk::DescriptorType::eCombinedImageSampler, 1};
  pool_ = vk::raii::DescriptorPool(
      device.device, vk::DescriptorPoolCreateInfo{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                                  .maxSets = 1,
                                                  .poolSizeCount = 1,
                                                  .pPoolSizes = &size});
  vk::raii::DescriptorSets sets(
      device.device,
      vk::DescriptorSetAllocateInfo{.descriptorPool = *pool_, .descriptorSetCount = 1, .pSetLayouts = &*set_layout_});
  set_ = std::move(sets.front());
  sampler_ = vk::raii::Sampler(device.device, vk::SamplerCreateInfo{});
}

void ToneMappingPass::draw(gpu::FrameGraph& graph, gpu::Image& hdr_cdm2, gpu::Image& display,
                           const glm::vec3& exposure_per_cdm2) {
  if (!pipelines_.contains(display.format))
    pipelines_.emplace(
        display.format,
        make_pipeline(device_,
                      {.vertex = *vertex_, .fragment = *fragment_, .colour = {display.format}, .layout = *layout_}));
  const vk::DescriptorImageInfo input{*sampler_, *hdr_cdm2.view, vk::ImageLayout::eShaderReadOnlyOptimal};
  device_.device.updateDescriptorSets(
      vk::WriteDescriptorSet{.dstSet = *set_,
                             .dstBinding = shader::kToneInput,
                             .descriptorCount = 1,
                             .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                             .pImageInfo = &input},
      nullptr);
  graph.pass("tone mapping", {{&hdr_cdm2, gpu::Use::kSampled, false}, {&display, gpu::Use::kColourTarget, true}},
             [&](gpu::Recorder& commands) {
               const vk::RenderingAttachmentInfo target{.imageView = *display.view,
                                                        .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                                        .loadOp = vk::AttachmentLoadOp::eDontCare,
                                                        .storeOp = vk::AttachmentStoreOp::eStore};
               commands.beginRendering(vk::RenderingInfo{.renderArea = {{0, 0}, display.extent},
                                                         .layerCount = 1,
                                                         .colorAttachmentCount = 1,
                                                         .pColorAttachments = &target});
               set_area(commands, display.extent);
               commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_.at(display.format));
               commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *set_, nullptr);
               commands.pushConstants<shader::ToneConstants>(*layout_, vk::ShaderStageFlagBits::eFragment, 0,
                                                             shader::ToneConstants{glm::vec4(exposure_per_cdm2, 0.0f)});
               commands.draw(3, 1, 0, 0);
               commands.endRendering();
             });
}

}  // namespace phare
