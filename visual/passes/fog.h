// Fog with the beams visible in it: the light of every lamp that the air of a view scatters toward the eye, once
// (visual/photometry/table/fog.h has the model, in float64), computed for a grid of rays and slices and read where the
// view is lit (shaders/lib/fog.glsl). Surfaces and sky are dimmed by the way through the fog, and lamps by theirs.
//
// The grid depends on lamps and eye, not on what they see: while a car's own lamps shine as they did, it is kept from
// frame to frame, and a frame costs no more than reading it. At levels with shadows it depends on what stands in the
// light, too, and is kept only while all of that, lamps and eye stay where they are in the world.
//
// Error: of the sums over each slice (points for each lamp, even in the angle at the lamp), of interpolation between
// rays and slices, and of shadows that begin or end within a step, by places on its way; levels differ in all of them.
// Left out: shadows at levels without, those of lamps that light no surface in view, and of lamps of several colours
// where in the fog each colour is. Checked by tests/visual/fog_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "visual/gpu/frame_graph.h"
#include "visual/lit_scene.h"

namespace phare {

/// Of the grid; steps of a slice for each lamp, at least, and how wide they are at the lamp, at most; of the columns
/// those that lie about lamps in view: many of few, so that own beams and what is beside a lamp are off alike. Places
/// on the way of a step that are looked up in shadow maps; 0: the fog has no shadows.
struct FogLevel {
  std::uint32_t columns = 0, rows = 0, slices = 0, steps = 0;
  float widest_deg = 0.0f;
  double columns_of_peaks = 0.0;
  std::uint32_t shadow_places = 0;
};

/// In the order of the effect's levels (visual/effects.h), the first being off.
inline constexpr std::array<FogLevel, 6> kFogLevels{{{},
                                                     {48, 64, 20, 1, 12.0f, 0.65},
                                                     {84, 96, 24, 1, 4.0f, 0.75},
                                                     {161, 253, 96, 4, 1.0f, 0.55},
                                                     {84, 96, 24, 1, 4.0f, 0.75, 3},
                                                     {207, 325, 122, 6, 0.6f, 0.55, 4}}};

static_assert(kFogNames.size() == kFogLevels.size());

/// Whether fog has shadows at a level of the effect.
constexpr bool has_shadows(std::size_t fog_level) {
  return kFogLevels[fog_level].shadow_places > 0;
}

/// Texels of a level's grid: cells of four rays, one more each way, in each slice.
constexpr std::uint64_t texels_of(const FogLevel& level) {
  return std::uint64_t{level.columns + 1} * (level.rows + 1) * level.slices;
}
static_assert(texels_of(kFogLevels[1]) <= 65536, "what every device has room for");
static_assert(16 * texels_of(kFogLevels.back()) <= std::uint64_t{1} << 27, "the least maxStorageBufferRange");

class FogPass {
 public:
  explicit FogPass(gpu::Device& device) : device_(device) {}

  /// Before the views of a frame; the frame before is done. Grids that it did not call for are freed.
  void begin_frame();
  /// Computes the grid of a view, if it is not as it was, and has the view be lit through fog from here on. A level
  /// whose grid the device has no room for is lowered: 65,536 texels, which every device has, hold the lowest.
  /// `hdr`: it is lit in cd/m². `drops`: near ones are drawn one by one, and left out of the grid.
  void draw(gpu::FrameGraph& graph, LitScene& scene, LitView& view, std::size_t level, const ViewInput& input,
            const vk::Rect2D& area, bool hdr, bool drops);

 private:
  /// What the grid is computed from, as the eye sees it.
  struct Source {
    Air air{};
    bool drops = false;
    std::size_t level = 0;
    vk::Rect2D area{};
    struct Lamp {
      std::size_t beam = 0;
      std::uint64_t version = 0;
      double body_m = 0.0;

      friend bool operator==(const Lamp&, const Lamp&) = default;
    };
    std::vector<Lamp> lamps{};
    std::vector<glm::dvec3> ways{};   ///< of rays and lamps, m
    std::uint64_t scene = 0;          ///< with shadows: its version
    ShadowLevel shadows{};            ///< of the maps
    std::vector<glm::dvec3> world{};  ///< with shadows: where the eye and what moves are, m, and how they are turned
    bool same(const Source& other) const;
  };
  /// Of one view.
  struct Grid {
    gpu::DeviceBuffer texels;
    vk::raii::BufferView view{nullptr};
    gpu::HostBuffer places;  ///< as shaders/fog.h has them
    vk::raii::BufferView places_view{nullptr};
    gpu::DescriptorSets sets{}, compute_sets{};
    vk::DescriptorSet set{}, compute_set{};
    std::optional<Source> source{};  ///< of what the texels hold
  };
  /// Tables (LitScene::key_for), lamps, grid, level, whether it adds, maps of the lamps (as kSpecShadowMaps) and
  /// theirs.
  using Key = std::tuple<std::size_t, std::uint32_t, FogGrid, std::size_t, bool, std::uint32_t, ShadowLevel>;

  static Source source_of(const LitScene& scene, const LitView& view, std::size_t level, bool drops,
                          const ViewInput& input, const vk::Rect2D& area);
  void make(Grid& grid, std::uint64_t texels, std::uint64_t places);
  void fill_phase(const Air& air);
  vk::Pipeline pipeline(const LitScene& scene, const Key& key);

  gpu::Device& device_;
  vk::raii::PipelineLayout layout_{nullptr};  ///< made with the first grid
  gpu::DescriptorSets compute_layout_;        ///< of it only the layout
  std::map<Key, vk::raii::Pipeline> pipelines_;
  std::optional<Air> phase_of_;  ///< of the phase table
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
  vk::raii::ShaderModule vertex_{nullptr}, fragment_{nullptr};  ///< made when called for
  std::map<Key, vk::raii::Pipeline> pipelines_;
};

/// fog.comp for up to 2, 4, 8 lamps.
std::span<const std::uint32_t> fog_comp(std::size_t size, bool filtered, bool shadows);

}  // namespace phare
