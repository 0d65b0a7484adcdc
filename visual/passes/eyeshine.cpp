#include "visual/passes/eyeshine.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "shaders/eyeshine.h"
#include "shaders/eyeshine_frag.h"
#include "shaders/eyeshine_vert.h"
#include "visual/passes/constants.h"

namespace phare {

static_assert(sizeof(shader::GpuPupil) <= 128, "what every device takes as push constants");

namespace {

/// Before the lid and the head about it, so that they do not hide it.
constexpr double kBefore_m = 0.03;
constexpr vk::ShaderStageFlags kStages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;

shader::GpuPupil data_of(const PupilInPicture& pupil, const LitView& view, const vk::Rect2D& area, bool hdr) {
  const double distance_m = glm::length(pupil.from_eye_m);
  const glm::dvec3 before_m = pupil.from_eye_m * std::max(1.0 - kBefore_m / distance_m, 0.5);
  const glm::dvec4 clip = view.geometry.clip_from_eye() * glm::dvec4(before_m, 1.0);
  const glm::dvec2 size(area.extent.width, area.extent.height);
  const glm::dvec2 middle =
      glm::dvec2(area.offset.x, area.offset.y) + size * (0.5 + 0.5 * glm::dvec2(clip) / clip.w);
  const double half = pupil.radius_px < static_cast<double>(shader::kEyeshineDisc_px) ? 1.0 : pupil.radius_px + 0.5;
  shader::GpuPupil data{};
  data.clip = glm::vec4(clip);
  data.place = glm::vec4(middle.x, middle.y, pupil.radius_px, half);
  data.light = glm::vec4(hdr ? pupil.sum_cdm2 : pupil.sum_cdm2 * view.sky.exposure_per_cdm2, 0.0f);
  data.size = glm::vec4(size.x, size.y, 0.0f, 0.0f);
  return data;
}

}  // namespace

void Eyeshine::draw(gpu::Recorder& commands, const LitView& view, const vk::Rect2D& area, LampOutput output,
                    vk::Format format, vk::SampleCountFlagBits samples) {
  const Key key(output, format, samples);
  auto found = pipelines_.find(key);
  if (found == pipelines_.end()) {
    if (!*layout_) {
      const vk::PushConstantRange push{kStages, 0, sizeof(shader::GpuPupil)};
      layout_ = vk::raii::PipelineLayout(
          device_.device, vk::PipelineLayoutCreateInfo{.pushConstantRangeCount = 1, .pPushConstantRanges = &push});
      vertex_ = gpu::make_shader(device_, k_eyeshine_vert);
      fragment_ = gpu::make_shader(device_, k_eyeshine_frag);
    }
    SpecConstants constants;
    constants.put(shader::kSpecEyeshineOutput, static_cast<std::uint32_t>(output));
    const vk::SpecializationInfo info = constants.info();
    found = pipelines_
                .emplace(key, make_pipeline(device_, {.vertex = *vertex_,
                                                      .fragment = *fragment_,
                                                      .constants = &info,
                                                      .colour = {format},
                                                      .brighter = true,
                                                      .depth = true,
                                                      .samples = samples,
                                                      .layout = *layout_}))
                .first;
  }
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *found->second);
  for (const PupilInPicture& pupil : view.pupils) {
    const shader::GpuPupil data = data_of(pupil, view, area, output == LampOutput::kHdr);
    commands.pushConstants<shader::GpuPupil>(*layout_, kStages, 0, data);
    commands.draw(6, 1, 0, 0);
  }
}

}  // namespace phare
