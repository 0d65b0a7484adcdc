#include "visual/passes/tone_mapping.h"

#include <array>
#include <span>

#include "shaders/fullscreen_vert.h"
#include "shaders/tone_mapping.h"
#include "shaders/tone_mapping_frag.h"
#include "visual/passes/pipeline.h"

namespace phare {

static_assert(sizeof(shader::ToneConstants) == 16);

namespace {

constexpr vk::DescriptorSetLayoutBinding kInput{.binding = shader::kToneInput,
                                                .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                .descriptorCount = 1,
                                                .stageFlags = vk::ShaderStageFlagBits::eFragment};

}  // namespace

ToneMappingPass::ToneMappingPass(gpu::Device& device)
    : device_(device),
      sets_(device, std::span(&kInput, 1)),
      vertex_(gpu::make_shader(device, k_fullscreen_vert)),
      fragment_(gpu::make_shader(device, k_tone_mapping_frag)) {
  layout_ =
      pushing_layout(device, sets_.layout(), vk::ShaderStageFlagBits::eFragment, sizeof(shader::ToneConstants));
  sampler_ = vk::raii::Sampler(device.device, vk::SamplerCreateInfo{});
}

void ToneMappingPass::begin_frame() {
  sets_.begin_frame();
}

void ToneMappingPass::draw(gpu::FrameGraph& graph, gpu::Image& hdr_cdm2, gpu::Image& display, const vk::Rect2D& area,
                           bool first, const glm::vec3& exposure_per_cdm2) {
  if (!pipelines_.contains(display.format))
    pipelines_.emplace(
        display.format,
        make_pipeline(device_,
                      {.vertex = *vertex_, .fragment = *fragment_, .colour = {display.format}, .layout = *layout_}));
  const vk::DescriptorImageInfo input{*sampler_, *hdr_cdm2.view, vk::ImageLayout::eShaderReadOnlyOptimal};
  const vk::DescriptorSet set = sets_.make();
  device_.device.updateDescriptorSets(
      vk::WriteDescriptorSet{.dstSet = set,
                             .dstBinding = shader::kToneInput,
                             .descriptorCount = 1,
                             .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                             .pImageInfo = &input},
      nullptr);
  map_to_display(graph, "tone mapping", hdr_cdm2, display, area, first, [&](gpu::Recorder& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_.at(display.format));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, set, nullptr);
    commands.pushConstants<shader::ToneConstants>(*layout_, vk::ShaderStageFlagBits::eFragment, 0,
                                                  shader::ToneConstants{glm::vec4(exposure_per_cdm2, 0.0f)});
  });
}

void map_to_display(gpu::FrameGraph& graph, const char* name, gpu::Image& hdr_cdm2, gpu::Image& display,
                    const vk::Rect2D& area, bool first, const std::function<void(gpu::Recorder&)>& bind) {
  const vk::Rect2D whole{{0, 0}, display.extent};
  const bool black_around = first && area != whole;
  graph.pass(name, {{&hdr_cdm2, gpu::Use::kSampled, false}, {&display, gpu::Use::kColourTarget, first}},
             [&](gpu::Recorder& commands) {
               const vk::RenderingAttachmentInfo target =
                   attachment(display, vk::ImageLayout::eColorAttachmentOptimal,
                              black_around ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eDontCare,
                              vk::ClearColorValue(std::array{0.0f, 0.0f, 0.0f, 1.0f}));
               commands.beginRendering(vk::RenderingInfo{.renderArea = black_around ? whole : area,
                                                         .layerCount = 1,
                                                         .colorAttachmentCount = 1,
                                                         .pColorAttachments = &target});
               set_area(commands, area);
               bind(commands);
               commands.draw(3, 1, 0, 0);
               commands.endRendering();
             });
}

}  // namespace phare
