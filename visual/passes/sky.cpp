#include "visual/passes/sky.h"

#include "shaders/lib/tone.h"
#include "shaders/sky.h"
#include "shaders/sky_frag.h"
#include "shaders/sky_vert.h"
#include "visual/lit_scene.h"

namespace phare {

static_assert(sizeof(shader::SkyConstants) == 96);

namespace {

/// The sine of the highest elevation in the picture; above 0 there is sky.
double highest_sine(const ViewGeometry& view) {
  double highest = -1.0;
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0}) {
      const glm::dvec3 direction(view.direction_from_clip() * glm::dvec4(x, y, 1.0, 0.0));
      highest = std::max(highest, glm::normalize(direction).z);
    }
  return highest;
}

bool is_parallel(const ViewGeometry& view) {
  return view.camera().orthographic_width_m > 0.0;
}

}  // namespace

glm::vec4 Sky::zenith() const {
  return {glm::vec3(0.75f, 1.0f, 1.7f) * static_cast<float>(zenith_cdm2), 3.0f};
}

SkyPass::SkyPass(gpu::Device& device)
    : device_(device), vertex_(gpu::make_shader(device, k_sky_vert)), fragment_(gpu::make_shader(device, k_sky_frag)) {
  const vk::PushConstantRange push{
      .stageFlags = vk::ShaderStageFlagBits::eVertex, .offset = 0, .size = sizeof(shader::SkyConstants)};
  layout_ = vk::raii::PipelineLayout(
      device.device, vk::PipelineLayoutCreateInfo{.pushConstantRangeCount = 1, .pPushConstantRanges = &push});
}

vk::ClearValue SkyPass::clear_value(const Sky& sky, LampOutput output, const ViewGeometry& view) {
  if (output == LampOutput::kFalseColour) return vk::ClearColorValue(std::array{0.0f, 0.0f, 0.1f, 1.0f});
  // Parallel rays have one direction, so one colour of sky.
  const double sine = is_parallel(view) ? view.camera().world_from_eye[0].z : 0.0;
  glm::vec3 colour = shader::sky_luminance(sky.zenith(), static_cast<float>(sine));
  const bool hdr = output == LampOutput::kHdr;
  if (!hdr) colour = shader::srgb_encoded(shader::tone_curve(colour * sky.exposure_per_cdm2));
  return vk::ClearColorValue(std::array{colour.x, colour.y, colour.z, hdr ? 0.0f : 1.0f});
}

void SkyPass::draw(gpu::Recorder& commands, const Sky& sky, const ViewGeometry& view, LampOutput output,
                   vk::Format format, vk::SampleCountFlagBits samples) {
  if (output == LampOutput::kFalseColour || is_parallel(view) || highest_sine(view) <= 0.0) return;
  const auto key = std::tuple(output, format, samples);
  auto found = pipelines_.find(key);
  if (found == pipelines_.end()) {
    const auto value = static_cast<std::uint32_t>(output);
    const vk::SpecializationMapEntry entry{.constantID = shader::kSpecSkyOutput, .offset = 0, .size = 4};
    const vk::SpecializationInfo constants{.mapEntryCount = 1, .pMapEntries = &entry, .dataSize = 4, .pData = &value};
    found = pipelines_
                .emplace(key, make_pipeline(device_, {.vertex = *vertex_,
                                                      .fragment = *fragment_,
                                                      .constants = &constants,
                                                      .colour = {format},
                                                      .depth = true,
                                                      .compare = vk::CompareOp::eAlways,
                                                      .samples = samples,
                                                      .layout = *layout_}))
                .first;
  }
  shader::SkyConstants push{};
  const glm::mat4 clip(view.clip_from_eye());
  for (int i = 0; i < 4; ++i) push.clip_from_eye[i] = clip[i];
  push.zenith = sky.zenith();
  push.exposure = glm::vec4(sky.exposure_per_cdm2, 0.0f);
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *found->second);
  commands.pushConstants<shader::SkyConstants>(*layout_, vk::ShaderStageFlagBits::eVertex, 0, push);
  commands.draw(6 * shader::kSkyRings * shader::kSkySectors, 1, 0, 0);
}

}  // namespace phare
