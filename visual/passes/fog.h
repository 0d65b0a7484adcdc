// Fog with the beams visible in it: the light of every lamp that the air of a view scatters toward the eye, once
// (visual/photometry/table/fog.h has the model, in float64), computed for a grid of rays and slices and read where the
// view is lit (shaders/lib/fog.glsl). Surfaces and sky are dimmed by the way through the fog, and lamps by theirs.
//
// Error: of the sums over each slice (one or two points for each lamp, even in the angle at the lamp), and of
// interpolation between rays and slices; levels differ in both. Left out: shadows in fog, and of lamps of several
// colours where in the fog each colour is. Checked by tests/visual/fog_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <tuple>

#include "visual/gpu/frame_graph.h"
#include "visual/lit_scene.h"

namespace phare {

/// Of the grid, and points of a slice for each lamp.
struct FogLevel {
  std::uint32_t columns = 0, rows = 0, slices = 0, samples = 0;
};

/// In the order of the effect's levels (visual/effects.h), the first being off.
inline constexpr std::array<FogLevel, 4> kFogLevels{{{}, {59, 50, 20, 1}, {85, 70, 30, 2}, {193, 161, 96, 4}}};

static_assert(kFogNames.size() == kFogLevels.size());

/// Texels of a level's grid: cells of four rays, one more each way, at the ends of all slices.
constexpr std::uint64_t texels_of(const FogLevel& level) {
  return std::uint64_t{level.columns + 1} * (level.rows + 1) * (level.slices + 1);
}

class FogPass {
 public:
  explicit FogPass(gpu::Device& device) : device_(device) {}

  /// Before the views of a frame; the frame before is done. Grids that it did not call for are freed.
  void begin_frame();
  /// Computes the grid of a view, and has the view be lit through fog from here on. A level whose grid the device has
  /// no room for is lowered: 65,536 texels, which every device has, hold the lowest.
  void draw(gpu::FrameGraph& graph, LitScene& scene, LitView& view, std::size_t level, const ViewInput& input,
            const vk::Rect2D& area, bool hdr);

 private:
  /// Of one view.
  struct Grid {
    gpu::DeviceBuffer texels;
    vk::raii::BufferView view{nullptr};
    gpu::DescriptorSets sets{}, compute_sets{};
    vk::DescriptorSet set{}, compute_set{};
    vk::BufferView phase{};  ///< that compute_set has
  };
  /// Tables, lamps, grid, samples, whether it adds.
  using Key = std::tuple<std::size_t, std::uint32_t, FogGrid, std::uint32_t, bool>;

  Grid& grid_of(std::uint64_t texels);
  void fill_phase(const FogDroplets& droplets);
  vk::Pipeline pipeline(const LitScene& scene, const Key& key);

  gpu::Device& device_;
  vk::raii::PipelineLayout layout_{nullptr};  ///< made with the first grid
  gpu::DescriptorSets compute_layout_;        ///< of it only the layout
  std::array<vk::raii::ShaderModule, 3> modules_{nullptr, nullptr, nullptr};
  std::map<Key, vk::raii::Pipeline> pipelines_;
  std::optional<FogDroplets> droplets_;  ///< of the phase table
  gpu::HostBuffer phase_;
  vk::raii::BufferView phase_view_{nullptr};
  std::vector<std::unique_ptr<Grid>> grids_;  ///< of each view with fog
  std::size_t used_ = 0;                      ///< of them, by this frame
};

/// The sky as it comes through fog, where no surface was drawn.
class FogSky {
 public:
  explicit FogSky(gpu::Device& device) : device_(device) {}
  /// Inside a pass that has begun rendering and set its area, after everything else.
  void draw(gpu::Recorder& commands, const LitScene& scene, const LitView& view, LampOutput output, vk::Format format,
            vk::SampleCountFlagBits samples);

 private:
  using Key = std::tuple<LampOutput, vk::Format, vk::SampleCountFlagBits, FogGrid, bool>;
  gpu::Device& device_;
  /// For two lamps at most, and for more; made when called for.
  std::array<vk::raii::ShaderModule, 2> vertex_{nullptr, nullptr}, fragment_{nullptr, nullptr};
  std::map<Key, vk::raii::Pipeline> pipelines_;
};

/// fog.comp for up to 2, 4, 8 lamps.
std::span<const std::uint32_t> fog_comp(std::size_t size, bool filtered);

}  // namespace phare
