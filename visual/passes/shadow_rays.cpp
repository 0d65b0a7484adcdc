#include "visual/passes/shadow_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "visual/passes/shadows.h"

namespace phare {
namespace {

constexpr double kLargest_m = 64.0;        // a lamp may go so far from where the texels have their origin
constexpr std::uint64_t kMostTexels = 1u << 24u;  // float32 counts to there
constexpr std::size_t kMostMovers = 4096;

constexpr std::size_t kOpacitiesOfTexel = 12;  // three bytes of a float, which counts to 2^24

glm::vec4 row_of(const glm::dvec3& row, double shift) {
  return {glm::vec3(row), static_cast<float>(shift)};
}

std::uint64_t texels_of(const Holes& holes) {
  return 1 + (holes.opacity.size() + kOpacitiesOfTexel - 1) / kOpacitiesOfTexel;
}

/// Opacities of each material with holes, then each triangle that has them (shaders/lamps.h); where those begin.
std::vector<float> append_holes(std::vector<glm::vec4>& texels, const std::vector<Holes>& all,
                                const std::vector<CutTriangle>& cut) {
  std::vector<float> begins;
  for (const Holes& holes : all) {
    begins.push_back(static_cast<float>(texels.size()));
    const auto how = static_cast<float>(static_cast<unsigned>(holes.sampler.across) +
                                        4 * static_cast<unsigned>(holes.sampler.down) + (holes.sampler.nearest ? 16 : 0));
    texels.emplace_back(holes.width, holes.height, holes.below, how);
    const std::size_t first = texels.size();
    texels.resize(first + texels_of(holes) - 1);
    for (std::size_t i = 0; i < holes.opacity.size(); ++i)
      texels[first + i / kOpacitiesOfTexel][static_cast<int>(i / 3 % 4)] +=
          static_cast<float>(holes.opacity[i] * (1u << (8 * (i % 3))));
  }
  std::vector<float> of_cut;
  for (const CutTriangle& triangle : cut) {
    of_cut.push_back(static_cast<float>(texels.size()));
    texels.emplace_back(triangle.at, triangle.ab);
    texels.emplace_back(triangle.ac, begins[triangle.holes], 0.0f);
  }
  return of_cut;
}

}  // namespace

std::uint64_t ray_texels(const ShadowCasters& casters) {
  std::uint64_t texels = shader::kRayMovers + std::uint64_t{kMostMovers} * shader::kRayMoverTexels;
  // Three of a triangle and two of a box; leaves hold two triangles at least, so boxes are no more than triangles.
  texels += 5 * std::uint64_t{casters.ray_triangles()} + 2 * std::uint64_t{casters.ray_triangles_with_holes()};
  for (const Holes& holes : casters.holes()) texels += texels_of(holes);
  return texels;
}

bool holds_rays(std::uint64_t texels, std::uint64_t buffer_texels) {
  return texels <= std::min(kMostTexels, buffer_texels);
}

ShadowRays::ShadowRays(gpu::Device& device) : device_(device) {}

bool ShadowRays::begin_frame() {
  if (!replaced_.empty()) device_.wait_for_frames();
  replaced_.clear();
  return std::exchange(asked_, false);
}

void ShadowRays::upload(const ShadowCasters& casters, const glm::dvec3& near_m, std::size_t movers) {
  origin_m_ = glm::round(near_m);
  room_ = std::min(std::max<std::size_t>(2 * movers, 8), kMostMovers);
  std::vector<glm::vec4> texels(shader::kRayMovers + room_ * shader::kRayMoverTexels);
  const std::vector<float> of_cut = append_holes(texels, casters.holes(), trees_.cut);
  const auto add = [&](const RayTree& tree, const glm::dvec3& origin_m) {
    const std::size_t first = texels.size();
    const std::vector<glm::vec4> more = tree.texels(origin_m, first, of_cut);
    texels.insert(texels.end(), more.begin(), more.end());
    return std::pair(static_cast<float>(first), static_cast<float>(texels.size()));
  };
  mesh_places_.clear();
  for (const RayTree& mesh : trees_.moving) mesh_places_.push_back(add(mesh, glm::dvec3(0.0)));
  standing_place_ = add(trees_.standing, origin_m_);

  if (texels_) replaced_.push_back(std::move(texels_));
  texels_ = std::make_unique<ShadowDepths>(device_);
  texels_->texels =
      gpu::DeviceBuffer(device_, std::as_bytes(std::span(texels)), vk::BufferUsageFlagBits::eUniformTexelBuffer,
                        "triangles for rays");
  texels_->view = vk::raii::BufferView(device_.device, vk::BufferViewCreateInfo{.buffer = *texels_->texels.buffer,
                                                                                .format = vk::Format::eR32G32B32A32Sfloat,
                                                                                .range = VK_WHOLE_SIZE});
  texels_->sets = gpu::DescriptorSets(device_, kShadowBindings);
  texels_->set = texels_->sets.make();
  const vk::BufferView view = *texels_->view;
  device_.device.updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = texels_->set,
                                                             .dstBinding = 0,
                                                             .descriptorCount = 1,
                                                             .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                                                             .pTexelBufferView = &view},
                                      nullptr);
}

void ShadowRays::place(gpu::FrameGraph& graph, LitScene& scene, LitView& view, const ShadowLevel& level) {
  asked_ = true;
  if (view.lit_lamps.empty()) return;
  const glm::dvec3& near_m = view.lit_lamps.front().position_m;
  if (scene_version_ != scene.geometry_version()) {
    trees_ = scene.casters().ray_trees();
    scene_version_ = scene.geometry_version();
    if (texels_) replaced_.push_back(std::move(texels_));
  }
  const std::size_t movers = std::min(view.moving.size(), kMostMovers);
  const glm::dvec3 off_m = glm::abs(near_m - origin_m_);
  // Up and down less: over a level road heights have to be good to a millionth of a metre.
  const bool near = std::max(off_m.x, off_m.y) <= kLargest_m && off_m.z <= 4.0;
  if (!texels_ || !near || movers > room_) upload(scene.casters(), near_m, movers);

  // What this view asks: its lamps, and what moves, where it is now.
  std::vector<glm::vec4> head(shader::kRayMovers + movers * shader::kRayMoverTexels);
  std::size_t lamps = 0;
  const glm::dvec3 shift_m = view.geometry.camera().eye_m - origin_m_;
  const shader::GpuShadow from_eye{row_of({1, 0, 0}, shift_m.x), row_of({0, 1, 0}, shift_m.y),
                                   row_of({0, 0, 1}, shift_m.z), glm::vec4(1.0f)};
  for (std::size_t lamp = 0; lamp < view.lit_lamps.size(); ++lamp) {
    if (lamps == kMostShadowMaps) {
      ++view.without_map;
      continue;
    }
    const PlacedLamp& of = view.lit_lamps[lamp];
    const double carried_by = of.carried_by < view.moving.size() ? static_cast<double>(of.carried_by + 1) : 0.0;
    head[2 * lamps] = row_of(0.5 * of.opening.width_m * of.world_from_image[1], carried_by);
    head[2 * lamps + 1] = row_of(0.5 * of.opening.height_m * of.world_from_image[2], of.opening.round ? 1.0 : 0.0);
    ++lamps;
    for (LitBy& lit : view.lit_by)
      for (std::size_t k = 0; k < lit.lamps; ++k) {
        if (lit.lamp_at[k] != lamp) continue;
        lit.data->shadows[k] = from_eye;
        lit.shadow_maps |= static_cast<std::uint32_t>(lamps) << (4 * k);
      }
  }
  head[shader::kRayHead] = {static_cast<float>(movers), standing_place_.first, standing_place_.second, 0.0f};
  for (std::size_t i = 0; i < movers; ++i) {
    const PlacedMesh& placed = view.moving[i];
    glm::vec4* const mover = &head[shader::kRayMovers + i * shader::kRayMoverTexels];
    if (placed.mesh >= trees_.moving.size()) continue;  // no tree: begins and ends at 0
    const glm::dvec3 to_origin_m = origin_m_ - placed.position_m;
    for (int axis = 0; axis < 3; ++axis)
      mover[axis] =
          row_of(placed.world_from_mesh[axis], glm::dot(placed.world_from_mesh[axis], to_origin_m));
    mover[3] = {mesh_places_[placed.mesh].first, mesh_places_[placed.mesh].second, 0.0f, 0.0f};
  }
  graph.count_kept(texels_.get(), texels_->texels.bytes);
  graph.copy("triangles for rays", {}, [&](gpu::Recorder& commands) {
    const auto barrier = [&](vk::PipelineStageFlags2 from, vk::AccessFlags2 wrote, vk::PipelineStageFlags2 to,
                             vk::AccessFlags2 then) {
      const vk::MemoryBarrier2 memory{.srcStageMask = from, .srcAccessMask = wrote, .dstStageMask = to,
                                      .dstAccessMask = then};
      commands.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &memory});
    };
    constexpr auto kFragment = vk::PipelineStageFlagBits2::eFragmentShader;
    constexpr auto kTransfer = vk::PipelineStageFlagBits2::eAllTransfer;
    barrier(kFragment, {}, kTransfer, vk::AccessFlagBits2::eTransferWrite);  // a view before has read it
    constexpr std::size_t kAtOnce = 65'536 / sizeof(glm::vec4);              // Vulkan's limit
    for (std::size_t first = 0; first < head.size(); first += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, head.size() - first);
      commands.updateBuffer(*texels_->texels.buffer, first * sizeof(glm::vec4), count * sizeof(glm::vec4), &head[first]);
    }
    barrier(kTransfer, vk::AccessFlagBits2::eTransferWrite, kFragment, vk::AccessFlagBits2::eShaderSampledRead);
  });
  for (DrawItem& item : view.items) item.shadowed = true;
  view.shadows = level;
  if (!scene.casters().holes().empty()) view.shadows.taps += shader::kTapsWithHoles;
  view.depths = texels_.get();
}

}  // namespace phare
