#include "visual/passes/spray.h"

#include <algorithm>

#include "shaders/spray_frag.h"
#include "shaders/spray_vert_2.h"
#include "shaders/spray_vert_2_filtered.h"
#include "shaders/spray_vert_4.h"
#include "shaders/spray_vert_4_filtered.h"
#include "shaders/spray_vert_8.h"
#include "shaders/spray_vert_8_filtered.h"
#include "visual/passes/constants.h"

namespace phare {

static_assert(sizeof(shader::GpuSpray) <= 128, "what every device takes as push constants");

void add_spray(LitScene& scene, LitView& view, std::span<const SprayingVehicle> vehicles, double water_mm) {
  const auto count = std::min<std::size_t>(shader::kMaxLamps, view.air_lamps.size());
  view.spray_by.push_back(scene.fill(view, std::span(view.air_lamps).first(count)));
  view.spray_by.back().data->fog = view.lit_by.front().data->fog;
  for (const SprayingVehicle& vehicle : vehicles)
    view.spray.push_back(spray_of(vehicle, water_mm, view.geometry.camera().eye_m));
}

vk::Pipeline Spray::pipeline(const LitScene& scene, const Key& key) {
  if (const auto found = pipelines_.find(key); found != pipelines_.end()) return *found->second;
  const auto& [tables, lamps, format, samples] = key;
  if (!*layout_) {
    layout_ =
        pushing_layout(device_, scene.lamps_layout(), vk::ShaderStageFlagBits::eVertex, sizeof(shader::GpuSpray));
    fragment_ = gpu::make_shader(device_, k_spray_frag);
  }
  using ShaderCode = std::span<const std::uint32_t>;
  static const std::array<ShaderCode, 6> codes{k_spray_vert_2,          k_spray_vert_4,
                                               k_spray_vert_8,          k_spray_vert_2_filtered,
                                               k_spray_vert_4_filtered, k_spray_vert_8_filtered};
  SpecConstants constants;
  constants.put(shader::kSpecLampCount, lamps);
  constants.put_all(shader::kSpecTables, scene.table_words(tables));
  const vk::SpecializationInfo info = constants.info();
  return *pipelines_
              .emplace(key,
                       make_pipeline(device_, {.fragment = *fragment_,
                                               .vertex_code = codes[shader_for(lamps) + (scene.filtered() ? 3 : 0)],
                                               .constants = &info,
                                               .topology = vk::PrimitiveTopology::eTriangleStrip,
                                               .colour = {format},
                                               .over = true,
                                               .depth = true,
                                               .samples = samples,
                                               .layout = *layout_}))
              .first->second;
}

void Spray::draw(gpu::Recorder& commands, const LitScene& scene, const LitView& view, vk::Format format,
                 vk::SampleCountFlagBits samples) {
  for (const LitBy& lit : view.spray_by) {
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics,
                          pipeline(scene, scene.key_for(lit, pipelines_, {0, lit.lamps, format, samples})));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, lit.set, lit.data_at);
    for (const shader::GpuSpray& spray : view.spray) {
      commands.pushConstants<shader::GpuSpray>(*layout_, vk::ShaderStageFlagBits::eVertex, 0, spray);
      commands.draw(shader::kSprayVertices, shader::kSprayPuffs, 0, 0);
    }
  }
}

}  // namespace phare
