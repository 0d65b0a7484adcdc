// The lamp pass: every surface lit by every lamp, per pixel; the sky behind. Also its depth pass, measure and audit
// variants, which share bindings (shaders/lamps.h).
#pragma once

#include <array>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "visual/beam_store.h"
#include "visual/gpu/frame_graph.h"
#include "visual/gpu/scene_buffers.h"
#include "visual/passes/grain.h"
#include "visual/passes/pipeline.h"
#include "visual/passes/sky.h"

namespace phare {

/// What the lamp pass writes.
enum class LampOutput : std::uint32_t { kDisplay = 0, kHdr = 1, kFalseColour = 2, kMeasure = 3, kAudit = 4 };

/// Shared by all passes that read the scene and the lamps.
class LampPass {
 public:
  explicit LampPass(gpu::Device& device);

  /// Binds buffers; after load_scene. set_frame does it when a lamp got another beam.
  void bind(const SceneBuffers& scene, const BeamStore& beams);
  /// This frame's view and lamps; uploads the beams that changed.
  void set_frame(const SceneBuffers& scene, BeamStore& beams, const ViewGeometry& view, const Sky& sky,
                 std::span<const PlacedLamp> lamps);
  /// Isolux lines of false colour, lx, from the next set_frame on.
  void set_isolux(std::span<const double> levels_lx) { isolux_lx_.assign(levels_lx.begin(), levels_lx.end()); }
  std::uint32_t lamp_count() const { return lamp_count_; }

  /// Depth of everything, no colour.
  void depth(gpu::FrameGraph& graph, gpu::Image& depth, const SceneBuffers& scene, std::span<const DrawItem> items);
  /// Light of everything. `depth_done`: the depth pass ran, only equal depth is drawn. `resolved`: for multisampled
  /// targets.
  void light(gpu::FrameGraph& graph, gpu::Image& colour, gpu::Image* resolved, gpu::Image& depth, bool depth_done,
             LampOutput output, const SceneBuffers& scene, std::span<const DrawItem> items);
  /// Illuminance at points, lamps base..base+3, one pixel each.
  void measure(gpu::FrameGraph& graph, gpu::Image& lx, vk::Buffer points, std::uint32_t count, std::uint32_t lamp_base);
  /// Positions, normals and illuminance of a view.
  void audit(gpu::FrameGraph& graph, gpu::Image& position, gpu::Image& normal, gpu::Image& depth,
             const SceneBuffers& scene, std::span<const DrawItem> items);

 private:
  struct Variant {
    MaterialKind kind{};
    LampOutput output = LampOutput::kDisplay;
    std::uint32_t lamp_count = 0, lamp_base = 0, lookups = 0, colours = 0;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    vk::Format format = vk::Format::eUndefined;
    bool depth_done = false;

    friend auto operator<=>(const Variant&, const Variant&) = default;
  };
  vk::Pipeline lit_pipeline(const Variant& variant);
  vk::Pipeline depth_pipeline(vk::SampleCountFlagBits samples);
  void draw_items(gpu::Recorder& commands, const SceneBuffers& scene, std::span<const DrawItem> items,
                  const Variant& common);

  gpu::Device& device_;
  SkyPass sky_pass_{device_};
  Sky sky_;  // of the frame being recorded
  ViewGeometry view_{Camera{}, 1.0};
  vk::raii::DescriptorSetLayout set_layout_{nullptr};
  vk::raii::PipelineLayout layout_{nullptr};
  vk::raii::DescriptorPool pool_{nullptr};
  vk::raii::DescriptorSet set_{nullptr};
  vk::raii::Sampler table_sampler_{nullptr}, filter_sampler_{nullptr};
  Grain grain_;
  gpu::HostBuffer frame_;
  std::vector<double> isolux_lx_;
  std::uint32_t lamp_count_ = 0, lookups_ = 0;
  std::uint32_t colours_ = 0;  ///< as kSpecColours
  std::array<std::size_t, shader::kMaxLamps> beam_of_lamp_{};
  std::map<Variant, vk::raii::Pipeline> lit_;
  std::map<vk::SampleCountFlagBits, vk::raii::Pipeline> depth_;
  std::array<vk::raii::ShaderModule, 3> scene_vert_, measure_vert_, lamps_frag_;  ///< for up to 2, 4, 8 lamps
  vk::raii::ShaderModule depth_vert_;
};

}  // namespace phare
