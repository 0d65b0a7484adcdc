#include "visual/passes/fog.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "shaders/fog.h"
#include "shaders/fog_sky_frag.h"
#include "shaders/fog_sky_vert.h"
#include "shaders/lib/luminance.h"
#include "visual/falling.h"
#include "visual/fog_nodes.h"
#include "visual/gpu/spirv.h"
#include "visual/passes/constants.h"

namespace phare {
namespace {

/// The sky stands behind so much fog; far beyond what lamps light.
constexpr double kSkyBehind_m = 3000.0;
/// Slices end where the way along a ray is this over their number times k/(1 − k/number): half of them lie within it.
/// Chosen: the lamps of a car are 2 m ahead of its driver, and beams end within 100 m.
constexpr double kSliceReach_m = 8.0;
/// In thick fog nothing comes from beyond a few times the way after which 1/e is left.
constexpr double kSliceReachInThickFog = 2.0;
/// A sky darker than this, exposed, is not seen.
constexpr double kLeastOfSky = 1e-3;
/// Of what the grid is computed from so much may change and it is kept: rounding of places in the world, far below
/// what is seen.
constexpr double kSame_m = 1e-6;

const std::array<vk::DescriptorSetLayoutBinding, 3> kComputeBindings{
    vk::DescriptorSetLayoutBinding{.binding = 0,
                                   .descriptorType = vk::DescriptorType::eStorageBuffer,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eCompute},
    vk::DescriptorSetLayoutBinding{.binding = 1,
                                   .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eCompute},
    vk::DescriptorSetLayoutBinding{.binding = 2,
                                   .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eCompute}};

void put(SpecConstants& constants, const FogGrid& grid) {
  constants.put(shader::kSpecFogLamps, grid.lamps);
  constants.put(shader::kSpecFogGrid, grid.columns | grid.rows << 16u);
  constants.put(shader::kSpecFogSlices, grid.slices);
}

glm::dvec3 ray_of(const ViewGeometry& view, double x, double y) {
  return glm::dvec3(view.direction_from_clip() * glm::dvec4(x, y, 1.0, 0.0));
}

shader::GpuFog data_of(const LitScene& scene, const LitView& view, const ViewInput& input, bool hdr, bool drops) {
  shader::GpuFog fog{};
  const double extinction = extinction_per_m(input.air), scattering = scattering_per_m(input.air);
  fog.air = glm::vec4(glm::dvec4(extinction * std::numbers::log2e, scattering,
                                 std::min(kSliceReach_m, kSliceReachInThickFog / extinction),
                                 transmittance(extinction, kSkyBehind_m)));
  const glm::vec3 exposure = hdr ? glm::vec3(1.0f) : view.sky.exposure_per_cdm2;
  // Under an even sky over dark ground fog is half as bright as the sky.
  const double under_sky_cdm2 =
      0.5 * scattering / extinction * static_cast<double>(shader::luminance_of(glm::vec3(view.sky.zenith())));
  fog.colour = glm::vec4(scene.mean_colour(view.air_lamps) * exposure, static_cast<float>(under_sky_cdm2));
  const glm::dvec3 corner = ray_of(view.geometry, -1.0, -1.0);
  fog.ray = glm::vec4(glm::vec3(corner), 0.0f);
  fog.ray_right = glm::vec4(glm::vec3(ray_of(view.geometry, 1.0, -1.0) - corner), 0.0f);
  fog.ray_down = glm::vec4(glm::vec3(ray_of(view.geometry, -1.0, 1.0) - corner), 0.0f);
  if (drops) {
    const DrawnShares drawn = drawn_shares(input.air.particles(), view.geometry);
    for (int i = 0; i < static_cast<int>(kDropClasses); ++i) {
      fog.drawn_to_m[i] = static_cast<float>(drawn.to_m[static_cast<std::size_t>(i)]);
      fog.drawn_share[i] = static_cast<float>(drawn.shares[static_cast<std::size_t>(i)]);
    }
  }
  return fog;
}

/// Places of the grid's nodes in the view, and of the picture's pixels among them.
void fill_places(gpu::HostBuffer& buffer, const LitView& view, const glm::dvec3& eye_m, const vk::Rect2D& area,
                 const FogLevel& level) {
  std::vector<LampInFog> lamps;
  for (const PlacedLamp& lamp : view.air_lamps) lamps.push_back({lamp.position_m - eye_m, lamp.world_from_image[0]});
  const glm::dvec2 size_px(area.extent.width, area.extent.height);
  const FogNodes nodes = place_nodes(view.geometry, size_px, lamps, level.columns, level.rows, level.columns_of_peaks);
  auto* texels = static_cast<glm::vec2*>(buffer.data);
  const auto put = [&](int axis, const NodeRow& row, double first_px, double side_px) {
    const std::vector<double> pixels = places_of_pixels(row, first_px, side_px);
    for (std::size_t i = 0; i < row.at_01.size(); ++i) texels[i][axis] = static_cast<float>(row.at_01[i]);
    for (std::size_t i = 0; i < pixels.size(); ++i)
      texels[shader::kFogMostNodes + static_cast<int>(i)][axis] = static_cast<float>(pixels[i]);
  };
  put(0, nodes.columns, area.offset.x, size_px.x);
  put(1, nodes.rows, area.offset.y, size_px.y);
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
  if (used_ < grids_.size()) device_.wait_for_frames();
  grids_.resize(std::min(grids_.size(), used_));
  used_ = 0;
}

bool FogPass::Source::same(const Source& other) const {
  const auto same_way = [](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::all(glm::lessThan(glm::abs(a - b), glm::dvec3(kSame_m)));
  };
  return air == other.air && drops == other.drops && level == other.level && area == other.area &&
         lamps == other.lamps && std::ranges::equal(ways, other.ways, same_way) && scene == other.scene &&
         shadows == other.shadows && std::ranges::equal(world, other.world, same_way);
}

FogPass::Source FogPass::source_of(const LitScene& scene, const LitView& view, std::size_t level, bool drops,
                                   const ViewInput& input, const vk::Rect2D& area) {
  Source source{.air = input.air, .drops = drops, .level = level, .area = area};
  const glm::dmat3& eye = input.camera.world_from_eye;  // way * eye: as the eye has it
  for (const glm::dvec2& corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1)})
    source.ways.push_back(ray_of(view.geometry, corner.x, corner.y) * eye);
  for (const PlacedLamp& lamp : view.air_lamps) {
    source.lamps.push_back({lamp.beam, scene.beam_version(lamp.beam), lamp.body_m});
    source.ways.push_back((lamp.position_m - input.camera.eye_m) * eye);
    for (int axis = 0; axis < 3; ++axis) source.ways.push_back(lamp.world_from_image[axis] * eye);
  }
  if (!has_shadows(level) || view.air_shadows.depths == nullptr) return source;
  source.scene = scene.geometry_version();
  source.shadows = view.air_shadows.level;
  const auto add_place = [&](const glm::dvec3& place_m, const glm::dmat3& turn) {
    source.world.push_back(place_m);
    for (int axis = 0; axis < 3; ++axis) source.world.push_back(turn[axis]);
  };
  add_place(input.camera.eye_m, eye);
  for (const PlacedMesh& mesh : view.moving) add_place(mesh.position_m, mesh.world_from_mesh);
  return source;
}

void FogPass::make(Grid& grid, std::uint64_t texels, std::uint64_t places) {
  device_.wait_for_frames();
  grid = {};
  grid.texels =
      gpu::DeviceBuffer(device_, 16 * texels,
                        vk::BufferUsageFlagBits::eUniformTexelBuffer | vk::BufferUsageFlagBits::eStorageBuffer, "fog");
  grid.view = vk::raii::BufferView(device_.device, vk::BufferViewCreateInfo{.buffer = *grid.texels.buffer,
                                                                            .format = vk::Format::eR32G32B32A32Uint,
                                                                            .range = VK_WHOLE_SIZE});
  grid.places = gpu::HostBuffer(device_, 8 * places, vk::BufferUsageFlagBits::eUniformTexelBuffer, "fog places");
  grid.places_view = vk::raii::BufferView(
      device_.device, vk::BufferViewCreateInfo{
                          .buffer = *grid.places.buffer, .format = vk::Format::eR32G32Sfloat, .range = VK_WHOLE_SIZE});
  grid.sets = gpu::DescriptorSets(device_, kFogBindings);
  grid.set = grid.sets.make();
  grid.compute_sets = gpu::DescriptorSets(device_, kComputeBindings);
  grid.compute_set = grid.compute_sets.make();
  const vk::DescriptorBufferInfo cells{*grid.texels.buffer, 0, VK_WHOLE_SIZE};
  std::vector<vk::WriteDescriptorSet> writes{{.dstSet = grid.compute_set,
                                              .dstBinding = 0,
                                              .descriptorCount = 1,
                                              .descriptorType = vk::DescriptorType::eStorageBuffer,
                                              .pBufferInfo = &cells}};
  const vk::BufferView cell_view = *grid.view, phase_view = *phase_view_, places_view = *grid.places_view;
  for (const auto& [set, binding, view] :
       {std::tuple(grid.set, 0u, &cell_view), std::tuple(grid.set, 1u, &places_view),
        std::tuple(grid.compute_set, 1u, &phase_view), std::tuple(grid.compute_set, 2u, &places_view)})
    writes.push_back({.dstSet = set,
                      .dstBinding = binding,
                      .descriptorCount = 1,
                      .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                      .pTexelBufferView = view});
  device_.device.updateDescriptorSets(writes, nullptr);
}

void FogPass::fill_phase(const Air& air) {
  if (phase_of_ == air) return;
  device_.wait_for_frames();
  if (phase_.bytes == 0) {
    phase_ = gpu::HostBuffer(device_, 16 * shader::kFogPhaseSteps, vk::BufferUsageFlagBits::eUniformTexelBuffer,
                             "fog phase function");
    phase_view_ =
        vk::raii::BufferView(device_.device, vk::BufferViewCreateInfo{.buffer = *phase_.buffer,
                                                                      .format = vk::Format::eR32G32B32A32Sfloat,
                                                                      .range = VK_WHOLE_SIZE});
  }
  auto* texels = static_cast<glm::vec4*>(phase_.data);
  const auto at = [&](std::uint32_t step) {
    const double angle = std::numbers::pi * step / shader::kFogPhaseSteps;
    return glm::vec2(phase_per_sr(air, angle), phase_of_particles_per_sr(air, angle));
  };
  for (std::uint32_t i = 0; i < shader::kFogPhaseSteps; ++i) {
    const glm::vec2 here = at(i), next = at(i + 1);
    texels[i] = {here.x, next.x, here.y, next.y};
  }
  phase_of_ = air;
}

vk::Pipeline FogPass::pipeline(const LitScene& scene, const Key& key) {
  if (const auto found = pipelines_.find(key); found != pipelines_.end()) return *found->second;
  const auto& [tables, lamps, grid, level, adds, maps, shadows] = key;
  if (!*layout_) {
    compute_layout_ = gpu::DescriptorSets(device_, kComputeBindings);
    const std::array layouts{scene.lamps_layout(), compute_layout_.layout(), scene.shadow_layout()};
    layout_ = vk::raii::PipelineLayout(
        device_.device, vk::PipelineLayoutCreateInfo{.setLayoutCount = layouts.size(), .pSetLayouts = layouts.data()});
  }
  SpecConstants constants;
  constants.put(shader::kSpecLampCount, lamps);
  constants.put(shader::kSpecFogSteps, kFogLevels[level].steps);
  constants.put(shader::kSpecFogWidest, std::bit_cast<std::uint32_t>(kFogLevels[level].widest_deg));
  constants.put(shader::kSpecFogAdd, adds ? 1u : 0u);
  put(constants, grid);
  if (maps != 0) {
    constants.put(shader::kSpecShadowMaps, maps);
    constants.put(shader::kSpecShadowWidth, shadows.width);
    constants.put(shader::kSpecShadowHeight, shadows.height);
    constants.put(shader::kSpecShadowTaps, kFogLevels[level].shadow_places);
  }
  constants.put_all(shader::kSpecTables, scene.table_words(tables));
  const vk::raii::ShaderModule module = gpu::make_shader(
      device_, gpu::specialised(fog_comp(shader_for(lamps), scene.filtered(), maps != 0), constants.info()));
  ++*device_.pipelines_made;
  return *pipelines_
              .emplace(
                  key,
                  vk::raii::Pipeline(
                      device_.device, nullptr,
                      vk::ComputePipelineCreateInfo{
                          .stage = {.stage = vk::ShaderStageFlagBits::eCompute, .module = *module, .pName = "main"},
                          .layout = *layout_}))
              .first->second;
}

void FogPass::draw(gpu::FrameGraph& graph, LitScene& scene, LitView& view, std::size_t level_number,
                   const ViewInput& input, const vk::Rect2D& area, bool hdr, bool drops) {
  while (level_number > 1 && texels_of(kFogLevels[level_number]) > device_.properties.limits.maxTexelBufferElements)
    --level_number;
  const FogLevel& level = kFogLevels[level_number];
  view.fog = {level.columns, level.rows, level.slices, view.air_lamps.empty() ? 0u : 1u};
  fill_phase(input.air);
  if (used_ == grids_.size()) grids_.push_back(std::make_unique<Grid>());
  Grid& grid = *grids_[used_++];
  const vk::Offset2D end(area.offset.x + static_cast<std::int32_t>(area.extent.width),
                         area.offset.y + static_cast<std::int32_t>(area.extent.height));
  const auto places = static_cast<std::uint64_t>(shader::kFogMostNodes + std::max(end.x, end.y));
  if (grid.texels.bytes != 16 * texels_of(level) || grid.places.bytes != 8 * places)
    make(grid, texels_of(level), places);
  graph.count_kept(&grid, grid.texels.bytes + grid.places.bytes);
  view.fog_set = grid.set;
  const shader::GpuFog data = data_of(scene, view, input, hdr, drops);
  for (const LitBy& lit : view.lit_by) lit.data->fog = data;

  // As it was in the frame before, so it stays.
  Source source = source_of(scene, view, level_number, drops, input, area);
  if (grid.source && grid.source->same(source)) return;
  device_.wait_for_frames();
  grid.source = std::move(source);
  fill_places(grid.places, view, input.camera.eye_m, area, level);
  if (view.air_lamps.empty()) return;

  const bool shadowed = has_shadows(level_number) && view.air_shadows.depths != nullptr;
  std::vector<LitBy> groups;
  for (std::size_t first = 0; first < view.air_lamps.size(); first += shader::kMaxLamps) {
    const auto count = std::min<std::size_t>(shader::kMaxLamps, view.air_lamps.size() - first);
    groups.push_back(scene.fill(view, std::span(view.air_lamps).subspan(first, count)));
    groups.back().data->fog = data;
    if (!shadowed) continue;
    for (std::size_t k = 0; k < count; ++k) {
      if (!view.air_lit[first + k]) continue;
      const AirShadows::Map& map = view.air_shadows.maps[*view.air_lit[first + k]];
      groups.back().shadow_maps |= map.number << (4 * k);
      groups.back().data->shadows[k] = map.place;
    }
  }
  graph.pass("fog", {}, [&](gpu::Recorder& commands) {
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    // The frame before may still read the cells.
    const vk::MemoryBarrier2 once_read{.srcStageMask = Stage::eFragmentShader,
                                       .dstStageMask = Stage::eComputeShader,
                                       .dstAccessMask = Access::eShaderStorageWrite};
    commands.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &once_read});
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (i > 0)
        wait_for_cells(commands, Stage::eComputeShader, Access::eShaderStorageRead | Access::eShaderStorageWrite);
      commands.bindPipeline(
          vk::PipelineBindPoint::eCompute,
          pipeline(scene, scene.key_for(groups[i], pipelines_,
                                        {0, groups[i].lamps, view.fog, level_number, i > 0, groups[i].shadow_maps,
                                         groups[i].shadow_maps != 0 ? view.air_shadows.level : ShadowLevel{}})));
      commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, groups[i].set, groups[i].data_at);
      commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 1, grid.compute_set, nullptr);
      if (groups[i].shadow_maps != 0)
        commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 2, view.air_shadows.depths->set,
                                    nullptr);
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
    if (!*vertex_) {
      vertex_ = gpu::make_shader(device_, k_fog_sky_vert);
      fragment_ = gpu::make_shader(device_, k_fog_sky_frag);
    }
    SpecConstants constants;
    constants.put(shader::kSpecOutput, static_cast<std::uint32_t>(output));
    constants.put(shader::kSpecFogSky, sky_seen ? 1u : 0u);
    put(constants, view.fog);
    const vk::SpecializationInfo info = constants.info();
    found = pipelines_
                .emplace(key, make_pipeline(device_, {.vertex = *vertex_,
                                                      .fragment = *fragment_,
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
