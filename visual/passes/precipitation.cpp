#include "visual/passes/precipitation.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shaders/precipitation_frag.h"
#include "shaders/precipitation_vert_2.h"
#include "shaders/precipitation_vert_2_filtered.h"
#include "shaders/precipitation_vert_4.h"
#include "shaders/precipitation_vert_4_filtered.h"
#include "shaders/precipitation_vert_8.h"
#include "shaders/precipitation_vert_8_filtered.h"
#include "visual/passes/constants.h"

namespace phare {

static_assert(sizeof(shader::GpuDrops) <= 128, "what every device takes as push constants");

namespace {

constexpr double kPerSquareMillimetre = 1e-6;

double past_whole(double value) {
  return value - std::floor(value);
}

shader::GpuDrops data_of(const ViewInput& input, const ViewGeometry& view) {
  const Particles particles = input.air.particles();
  const glm::dvec3& ahead = input.camera.world_from_eye[0];
  shader::GpuDrops data{};
  std::size_t drops = 0;
  const auto classes = drop_classes(particles);
  for (std::size_t i = 0; i < kDropClasses; ++i) {
    const DropClass& one = classes[i];
    const glm::dvec3 middle = input.camera.eye_m / one.cube_m + 0.5 * ahead;
    data.place[i] = glm::vec4(past_whole(middle.x), past_whole(middle.y), past_whole(middle.z), one.cube_m);
    drops += one.count;
    data.drops[i] = glm::vec4(one.least_mm, std::exp(-particles.slope_per_mm * (one.most_mm - one.least_mm)), drops,
                              drawn_to_m(one, view));
  }
  data.motion = glm::vec4(glm::vec3(input.falling.eye_mps * kExposure_s),
                          std::fmod(input.falling.time_s, double{shader::kDropsPeriod_s}));
  data.light = glm::vec4(particles.slope_per_mm, 0.25 * std::numbers::pi * particles.area_factor * kPerSquareMillimetre,
                         particles.g, kExposure_s);
  return data;
}

}  // namespace

void add_drops(LitScene& scene, LitView& view, const ViewInput& input) {
  view.drops = data_of(input, view.geometry);
  view.drops_count = static_cast<std::uint32_t>(view.drops.drops[kDropClasses - 1].z);
  view.flakes = input.air.particles().kind == Precipitation::kSnow;
  for (std::size_t first = 0; first < view.air_lamps.size(); first += shader::kMaxLamps) {
    const auto count = std::min<std::size_t>(shader::kMaxLamps, view.air_lamps.size() - first);
    view.drops_by.push_back(scene.fill(view, std::span(view.air_lamps).subspan(first, count)));
    view.drops_by.back().data->fog = view.lit_by.front().data->fog;
  }
}

vk::Pipeline Drops::pipeline(const LitScene& scene, const Key& key) {
  if (const auto found = pipelines_.find(key); found != pipelines_.end()) return *found->second;
  const auto& [tables, lamps, snow, format, samples] = key;
  if (!*layout_) {
    layout_ =
        pushing_layout(device_, scene.lamps_layout(), vk::ShaderStageFlagBits::eVertex, sizeof(shader::GpuDrops));
    fragment_ = gpu::make_shader(device_, k_precipitation_frag);
  }
  using ShaderCode = std::span<const std::uint32_t>;
  static const std::array<ShaderCode, 6> codes{k_precipitation_vert_2,          k_precipitation_vert_4,
                                               k_precipitation_vert_8,          k_precipitation_vert_2_filtered,
                                               k_precipitation_vert_4_filtered, k_precipitation_vert_8_filtered};
  SpecConstants constants;
  constants.put(shader::kSpecLampCount, lamps);
  constants.put(shader::kSpecDropsSnow, snow ? 1u : 0u);
  constants.put(shader::kSpecDropsStrict, device_.properties.limits.strictLines ? 1u : 0u);
  constants.put_all(shader::kSpecTables, scene.table_words(tables));
  const vk::SpecializationInfo info = constants.info();
  return *pipelines_
              .emplace(key,
                       make_pipeline(device_, {.fragment = *fragment_,
                                               .vertex_code = codes[shader_for(lamps) + (scene.filtered() ? 3 : 0)],
                                               .constants = &info,
                                               .topology = vk::PrimitiveTopology::eLineList,
                                               .colour = {format},
                                               .add = true,
                                               .depth = true,
                                               .samples = samples,
                                               .layout = *layout_}))
              .first->second;
}

void Drops::draw(gpu::Recorder& commands, const LitScene& scene, const LitView& view, const vk::Rect2D& area,
                 vk::Format format, vk::SampleCountFlagBits samples) {
  for (const LitBy& lit : view.drops_by) {
    // What a pixel in the middle of the picture takes of the world, sr.
    const glm::dmat4 ways = view.geometry.direction_from_clip();
    const double pixel_sr = 2.0 * glm::length(glm::dvec3(ways[0])) / area.extent.width * 2.0 *
                            glm::length(glm::dvec3(ways[1])) / area.extent.height;
    lit.data->size_px = glm::vec4(area.extent.width, area.extent.height, pixel_sr, 0.0f);
    commands.bindPipeline(
        vk::PipelineBindPoint::eGraphics,
        pipeline(scene, scene.key_for(lit, pipelines_, {0, lit.lamps, view.flakes, format, samples})));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, lit.set, lit.data_at);
    commands.pushConstants<shader::GpuDrops>(*layout_, vk::ShaderStageFlagBits::eVertex, 0, view.drops);
    commands.draw(2 * view.drops_count, 1, 0, 0);
  }
}

}  // namespace phare
