#include "visual/passes/fog.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shaders/fog.h"
#include "shaders/fog_sky_frag.h"
#include "shaders/fog_sky_frag_2.h"
#include "shaders/fog_sky_vert.h"
#include "shaders/fog_sky_vert_2.h"

namespace phare {
namespace {

/// The sky stands behind so much fog; far beyond what lamps light.
constexpr double kSkyBehind_m = 3000.0;
/// Slices end where the way along a ray is this over their number times k/(1 − k/number): half of them lie within it.
/// Chosen: the lamps of a car are 2 m ahead of its driver, and beams end within 100 m.
constexpr double kSliceReach_m = 8.0;
/// In thick fog nothing comes from beyond a few times the way after which 1/e is left.
constexpr double kSliceReachInThickFog = 2.0;
/// Elevations between which rows lie closer together, by this factor: cut-offs and what of them is near.
constexpr double kCloseRowsAbove_rad = 0.044, kCloseRowsBelow_rad = -0.095, kCloser = 5.0;
/// A sky darker than this, exposed, is not seen.
constexpr double kLeastOfSky = 1e-3;

const std::array<vk::DescriptorSetLayoutBinding, 2> kComputeBindings{
    vk::DescriptorSetLayoutBinding{.binding = 0,
                                   .descriptorType = vk::DescriptorType::eStorageBuffer,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eCompute},
    vk::DescriptorSetLayoutBinding{.binding = 1,
                                   .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eCompute}};

/// Constants of a pipeline by their numbers.
struct Constants {
  std::vector<std::uint32_t> values;
  std::vector<vk::SpecializationMapEntry> entries;

  void put(std::uint32_t id, std::uint32_t value) {
    entries.push_back({.constantID = id, .offset = static_cast<std::uint32_t>(4 * values.size()), .size = 4});
    values.push_back(value);
  }
  void put(const FogGrid& grid) {
    put(shader::kSpecFogLamps, grid.lamps);
    put(shader::kSpecFogGrid, grid.columns | grid.rows << 16u);
    put(shader::kSpecFogSlices, grid.slices);
  }
  vk::SpecializationInfo info() const {
    return {.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
            .pMapEntries = entries.data(),
            .dataSize = 4 * values.size(),
            .pData = values.data()};
  }
};

/// Where along the view rows of the grid lie close together: about the horizon, where the cut-offs of headlamps lie and
/// light changes by the tenth of a degree. As GpuFog::rows.
glm::dvec4 close_rows(const ViewGeometry& view, std::uint32_t rows) {
  const glm::dmat3& eye = view.camera().world_from_eye;
  const double half_up = std::tan(0.5 * view.camera().fov_horizontal_rad) / view.aspect();
  const auto way_down = [&](double elevation_rad) {
    // Straight ahead, at this elevation: up over forward of the eye.
    const double pitch = std::asin(std::clamp(eye[0].z, -1.0, 1.0));
    const double above = std::clamp(elevation_rad - pitch, -1.4, 1.4);
    return std::clamp(0.5 - 0.5 * std::tan(above) / half_up, 0.0, 1.0);
  };
  const double from = way_down(kCloseRowsAbove_rad), to = way_down(kCloseRowsBelow_rad);
  const double outside = (rows - 1) / (1.0 + (kCloser - 1.0) * (to - from));
  return {from, to, outside, kCloser * outside};
}

float luminance(const glm::vec3& rgb) {
  return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

shader::GpuFog data_of(const LitScene& scene, const LitView& view, const ViewInput& input, const vk::Rect2D& area,
                       bool hdr) {
  shader::GpuFog fog{};
  const double extinction = extinction_per_m(*input.visibility_m), albedo = input.fog_droplets.albedo;
  fog.air = glm::vec4(glm::dvec4(extinction * std::numbers::log2e, extinction * albedo,
                                 std::min(kSliceReach_m, kSliceReachInThickFog / extinction),
                                 transmittance(extinction, kSkyBehind_m)));
  const glm::vec3 exposure = hdr ? glm::vec3(1.0f) : view.sky.exposure_per_cdm2;
  // Under an even sky over dark ground fog is half as bright as the sky.
  const double under_sky_cdm2 = 0.5 * albedo * static_cast<double>(luminance(glm::vec3(view.sky.zenith())));
  fog.colour = glm::vec4(scene.mean_colour(view.air_lamps) * exposure, static_cast<float>(under_sky_cdm2));
  // From pixels to the way across and down the view, and on to columns and rows.
  const glm::dvec2 size(area.extent.width, area.extent.height), corner_px(area.offset.x, area.offset.y);
  const double columns_per_px = (view.fog.columns - 1) / size.x;
  const glm::dvec4 rows = close_rows(view.geometry, view.fog.rows);
  fog.to_column = glm::vec4(glm::dvec4(columns_per_px, -columns_per_px * corner_px.x, corner_px.y + rows.x * size.y,
                                       corner_px.y + rows.y * size.y));
  const double closer = (rows.w - rows.z) / size.y;
  fog.to_row = glm::vec4(glm::dvec4(
      rows.z / size.y, -rows.z / size.y * corner_px.y - closer * (corner_px.y + rows.x * size.y), closer, 0.0));
  fog.rows = glm::vec4(rows);
  const auto ray = [&](double x, double y) {
    return glm::dvec3(view.geometry.direction_from_clip() * glm::dvec4(x, y, 1.0, 0.0));
  };
  const glm::dvec3 corner = ray(-1.0, -1.0);
  fog.ray = glm::vec4(glm::vec3(corner), 0.0f);
  fog.ray_right = glm::vec4(glm::vec3(ray(1.0, -1.0) - corner), 0.0f);
  fog.ray_down = glm::vec4(glm::vec3(ray(-1.0, 1.0) - corner), 0.0f);
  for (std::uint32_t i = 0; i < view.fog.lamps; ++i)
    fog.lamps[i] = glm::vec4(glm::vec3(view.air_lamps[i].position_m - input.camera.eye_m), 0.0f);
  return fog;
}

void wait_for_cells(vk::CommandBuffer commands, vk::PipelineStageFlags2 reader, vk::AccessFlags2 reads) {
  const vk::MemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eComputeShader,
                                   .srcAccessMask = vk::AccessFlagBits2::eShaderStorageWrite,
                                   .dstStageMask = reader,
                                   .dstAccessMask = reads};
  commands.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
}

}  // namespace

void FogPass::begin_frame() {
  grids_.resize(std::min(grids_.size(), used_));
  used_ = 0;
}

FogPass::Grid& FogPass::grid_of(std::uint64_t texels) {
  if (used_ == grids_.size()) grids_.push_back(std::make_unique<Grid>());
  Grid& grid = *grids_[used_++];
  if (grid.texels.bytes != 16 * texels) {
    grid = {};
    grid.texels = gpu::DeviceBuffer(
        device_, 16 * texels, vk::BufferUsageFlagBits::eUniformTexelBuffer | vk::BufferUsageFlagBits::eStorageBuffer,
        "fog");
    grid.view = vk::raii::BufferView(device_.device, vk::BufferViewCreateInfo{.buffer = *grid.texels.buffer,
                                                                              .format = vk::Format::eR32G32B32A32Sfloat,
                                                                              .range = VK_WHOLE_SIZE});
    grid.sets = gpu::DescriptorSets(device_, kFogBindings);
    grid.set = grid.sets.make();
    const vk::BufferView view = *grid.view;
    device_.device.updateDescriptorSets(
        vk::WriteDescriptorSet{.dstSet = grid.set,
                               .dstBinding = 0,
                               .descriptorCount = 1,
                               .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                               .pTexelBufferView = &view},
        nullptr);
    grid.compute_sets = gpu::DescriptorSets(device_, kComputeBindings);
  }
  if (grid.phase == *phase_view_) return grid;
  grid.phase = *phase_view_;
  grid.compute_sets.clear();
  grid.compute_set = grid.compute_sets.make();
  const vk::DescriptorBufferInfo cells{*grid.texels.buffer, 0, VK_WHOLE_SIZE};
  device_.device.updateDescriptorSets({vk::WriteDescriptorSet{.dstSet = grid.compute_set,
                                                              .dstBinding = 0,
                                                              .descriptorCount = 1,
                                                              .descriptorType = vk::DescriptorType::eStorageBuffer,
                                                              .pBufferInfo = &cells},
                                       vk::WriteDescriptorSet{.dstSet = grid.compute_set,
                                                              .dstBinding = 1,
                                                              .descriptorCount = 1,
                                                              .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                                                              .pTexelBufferView = &grid.phase}},
                                      nullptr);
  return grid;
}

void FogPass::fill_phase(const FogDroplets& droplets) {
  if (droplets_ == droplets) return;
  if (phase_.bytes == 0) {
    phase_ = gpu::HostBuffer(device_, 8 * shader::kFogPhaseSteps, vk::BufferUsageFlagBits::eUniformTexelBuffer,
                             "fog phase function");
    phase_view_ = vk::raii::BufferView(
        device_.device, vk::BufferViewCreateInfo{
                            .buffer = *phase_.buffer, .format = vk::Format::eR32G32Sfloat, .range = VK_WHOLE_SIZE});
  }
  auto* texels = static_cast<glm::vec2*>(phase_.data);
  const auto at = [&](std::uint32_t step) {
    return static_cast<float>(phase_per_sr(droplets, std::numbers::pi * step / shader::kFogPhaseSteps));
  };
  for (std::uint32_t i = 0; i < shader::kFogPhaseSteps; ++i) texels[i] = {at(i), at(i + 1)};
  droplets_ = droplets;
}

vk::Pipeline FogPass::pipeline(const LitScene& scene, const Key& key) {
  if (const auto found = pipelines_.find(key); found != pipelines_.end()) return *found->second;
  const auto& [tables, lamps, grid, samples, adds] = key;
  if (!*layout_) {
    compute_layout_ = gpu::DescriptorSets(device_, kComputeBindings);
    const std::array layouts{scene.lamps_layout(), compute_layout_.layout()};
    layout_ = vk::raii::PipelineLayout(
        device_.device, vk::PipelineLayoutCreateInfo{.setLayoutCount = layouts.size(), .pSetLayouts = layouts.data()});
  }
  const std::size_t size = lamps <= 2 ? 0 : lamps <= 4 ? 1 : 2;
  if (!*modules_[size]) modules_[size] = gpu::make_shader(device_, fog_comp(size, scene.filtered()));
  Constants constants;
  constants.put(shader::kSpecLampCount, lamps);
  constants.put(shader::kSpecFogSamples, samples);
  constants.put(shader::kSpecFogAdd, adds ? 1u : 0u);
  constants.put(grid);
  std::uint32_t id = shader::kSpecTables;
  for (const std::uint32_t word : scene.table_words(tables)) constants.put(id++, word);
  const vk::SpecializationInfo info = constants.info();
  ++*device_.pipelines_made;
  return *pipelines_
              .emplace(key, vk::raii::Pipeline(
                                device_.device, nullptr,
                                vk::ComputePipelineCreateInfo{.stage = {.stage = vk::ShaderStageFlagBits::eCompute,
                                                                        .module = *modules_[size],
                                                                        .pName = "main",
                                                                        .pSpecializationInfo = &info},
                                                              .layout = *layout_}))
              .first->second;
}

void FogPass::draw(gpu::FrameGraph& graph, LitScene& scene, LitView& view, std::size_t level_number,
                   const ViewInput& input, const vk::Rect2D& area, bool hdr) {
  while (level_number > 1 && texels_of(kFogLevels[level_number]) > device_.properties.limits.maxTexelBufferElements)
    --level_number;
  const FogLevel& level = kFogLevels[level_number];
  view.fog = {level.columns, level.rows, level.slices,
              static_cast<std::uint32_t>(std::min<std::size_t>(view.air_lamps.size(), shader::kMaxLamps))};
  fill_phase(input.fog_droplets);
  Grid& grid = grid_of(texels_of(level));
  view.fog_set = grid.set;
  const shader::GpuFog data = data_of(scene, view, input, area, hdr);
  for (const LitBy& lit : view.lit_by) lit.data->fog = data;
  if (view.air_lamps.empty()) return;

  std::vector<LitBy> groups;
  for (std::size_t first = 0; first < view.air_lamps.size(); first += shader::kMaxLamps) {
    const auto count = std::min<std::size_t>(shader::kMaxLamps, view.air_lamps.size() - first);
    groups.push_back(scene.fill(view, std::span(view.air_lamps).subspan(first, count)));
    groups.back().data->fog = data;
  }
  graph.pass("fog", {}, [&](gpu::Recorder& commands) {
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (i > 0)
        wait_for_cells(commands, Stage::eComputeShader, Access::eShaderStorageRead | Access::eShaderStorageWrite);
      commands.bindPipeline(vk::PipelineBindPoint::eCompute,
                            pipeline(scene, {groups[i].tables, groups[i].lamps, view.fog, level.samples, i > 0}));
      commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, groups[i].set, groups[i].data_at);
      commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 1, grid.compute_set, nullptr);
      commands.dispatch((level.columns * level.rows + shader::kFogGroup - 1) / shader::kFogGroup, 1, 1);
    }
    wait_for_cells(commands, Stage::eFragmentShader, Access::eShaderSampledRead);
  });
}

void FogSky::draw(gpu::Recorder& commands, const LitScene& scene, const LitView& view, LampOutput output,
                  vk::Format format, vk::SampleCountFlagBits samples) {
  const glm::vec4 air = view.lit_by.front().data->fog.air;
  const glm::vec3 sky = glm::vec3(view.sky.zenith()) * view.sky.exposure_per_cdm2 * (air.w * view.sky.zenith().w);
  const bool sky_seen = std::max({sky.x, sky.y, sky.z}) > static_cast<float>(kLeastOfSky);
  const Key key(output, format, samples, view.fog, sky_seen);
  auto found = pipelines_.find(key);
  if (found == pipelines_.end()) {
    const std::size_t size = view.fog.lamps <= 2 ? 0 : 1;
    using Code = std::span<const std::uint32_t>;
    if (!*vertex_[size]) {
      vertex_[size] = gpu::make_shader(device_, size == 0 ? Code(k_fog_sky_vert_2) : Code(k_fog_sky_vert));
      fragment_[size] = gpu::make_shader(device_, size == 0 ? Code(k_fog_sky_frag_2) : Code(k_fog_sky_frag));
    }
    Constants constants;
    constants.put(3, static_cast<std::uint32_t>(output));
    constants.put(shader::kSpecFogSky, sky_seen ? 1u : 0u);
    constants.put(view.fog);
    const vk::SpecializationInfo info = constants.info();
    found = pipelines_
                .emplace(key, make_pipeline(device_, {.vertex = *vertex_[size],
                                                      .fragment = *fragment_[size],
                                                      .constants = &info,
                                                      .colour = {format},
                                                      .depth = true,
                                                      .compare = vk::CompareOp::eGreaterOrEqual,
                                                      .samples = samples,
                                                      .layout = scene.layout()}))
                .first;
  }
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *found->second);
  scene.bind(commands, view.lit_by.front());
  scene.bind_fog(commands, view);
  commands.draw(3, 1, 0, 0);
}

}  // namespace phare
