#include "visual/passes/glare.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>

#include "shaders/glare.h"
#include "shaders/glare_frag.h"
#include "shaders/glare_vert.h"
#include "visual/passes/pipeline.h"
#include "visual/passes/tone_mapping.h"

namespace phare {

static_assert(sizeof(shader::GpuGlare) == 80 + 32 * kMostGlaringLamps);
static_assert(shader::kMostGlareLamps == kMostGlaringLamps);

namespace {

constexpr std::array<vk::DescriptorSetLayoutBinding, 2> kBindings{
    {{.binding = shader::kGlareInput,
      .descriptorType = vk::DescriptorType::eCombinedImageSampler,
      .descriptorCount = 1,
      .stageFlags = vk::ShaderStageFlagBits::eFragment},
     {.binding = shader::kGlareSources,
      .descriptorType = vk::DescriptorType::eUniformBuffer,
      .descriptorCount = 1,
      .stageFlags = vk::ShaderStageFlagBits::eVertex}}};

glm::vec4 wide(const glm::dvec3& v) {
  return {glm::vec3(v), 0.0f};
}

shader::GpuGlare data_of(const glm::vec3& exposure_per_cdm2, const ViewGeometry& view,
                         std::span<const GlaringLamp> sources, const Viewer& viewer) {
  shader::GpuGlare data{};
  data.exposure = glm::vec4(exposure_per_cdm2, 0.0f);
  data.terms = wide(veil_terms(viewer));
  const glm::dmat4 direction = view.direction_from_clip();
  data.right = wide(direction[0]);
  data.down = wide(direction[1]);
  data.ahead = wide(direction[2]);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    data.lamps[i].toward = wide(glm::normalize(sources[i].place_m - view.camera().eye_m));
    data.lamps[i].eye_lx = glm::vec4(static_cast<float>(sources[i].eye_lx) * sources[i].colour, 0.0f);
  }
  return data;
}

}  // namespace

void GlarePass::begin_frame() {
  used_ = 0;
  sets_.begin_frame();
}

void GlarePass::make() {
  sets_ = gpu::DescriptorSets(device_, kBindings);
  vertex_ = gpu::make_shader(device_, k_glare_vert);
  fragment_ = gpu::make_shader(device_, k_glare_frag);
  const vk::DescriptorSetLayout set_layout = sets_.layout();
  layout_ = vk::raii::PipelineLayout(device_.device,
                                     vk::PipelineLayoutCreateInfo{.setLayoutCount = 1, .pSetLayouts = &set_layout});
  sampler_ = vk::raii::Sampler(device_.device, vk::SamplerCreateInfo{});
}

vk::Pipeline GlarePass::pipeline(vk::Format format, std::uint32_t lamps) {
  const auto [found, made] = pipelines_.try_emplace({format, lamps}, nullptr);
  if (!made) return *found->second;
  const vk::SpecializationMapEntry entry{shader::kSpecGlareLamps, 0, sizeof lamps};
  const vk::SpecializationInfo constants{1, &entry, sizeof lamps, &lamps};
  found->second = make_pipeline(
      device_,
      {.vertex = *vertex_, .fragment = *fragment_, .constants = &constants, .colour = {format}, .layout = *layout_});
  return *found->second;
}

void GlarePass::draw(gpu::FrameGraph& graph, gpu::Image& hdr_cdm2, gpu::Image& display, const vk::Rect2D& area,
                     bool first, const glm::vec3& exposure_per_cdm2, const ViewGeometry& view,
                     std::span<const GlaringLamp> sources, const Viewer& viewer) {
  if (!*layout_) make();
  const auto lamps_summed =
      std::clamp(std::bit_ceil(static_cast<std::uint32_t>(sources.size())), 2u, shader::kMostGlareLamps);
  const vk::Pipeline by = pipeline(display.format, lamps_summed);
  if (used_ == data_->size())
    data_->push_back(std::make_unique<gpu::HostBuffer>(device_, sizeof(shader::GpuGlare),
                                                      vk::BufferUsageFlagBits::eUniformBuffer, "glare"));
  const gpu::HostBuffer& data = *(*data_)[used_++];
  *static_cast<shader::GpuGlare*>(data.data) = data_of(exposure_per_cdm2, view, sources, viewer);
  const vk::DescriptorImageInfo input{*sampler_, *hdr_cdm2.view, vk::ImageLayout::eShaderReadOnlyOptimal};
  const vk::DescriptorBufferInfo lamps{*data.buffer, 0, VK_WHOLE_SIZE};
  const vk::DescriptorSet set = sets_.make();
  device_.device.updateDescriptorSets({{.dstSet = set,
                                        .dstBinding = shader::kGlareInput,
                                        .descriptorCount = 1,
                                        .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                        .pImageInfo = &input},
                                       {.dstSet = set,
                                        .dstBinding = shader::kGlareSources,
                                        .descriptorCount = 1,
                                        .descriptorType = vk::DescriptorType::eUniformBuffer,
                                        .pBufferInfo = &lamps}},
                                      nullptr);
  map_to_display(graph, "glare", hdr_cdm2, display, area, first, [&](gpu::Recorder& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, by);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, set, nullptr);
  });
}

}  // namespace phare
