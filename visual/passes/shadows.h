// Shadows of what stands in the light of a view's lamps: a map of depths for each lamp that something stands before,
// rendered once a view and read where the view is lit (shaders/lib/shadow.glsl).
//
// Maps hold the far sides of things (visual/shadow_casters.h), on a plane across the lamp's axis that is fitted to
// them. Error: an edge is off by half a texel, seen from the lamp; levels differ in texels. Left out: what is more than
// 75° off the lamp's axis or farther than 300 m from it, and the size of the lamp.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "visual/gpu/frame_graph.h"
#include "visual/lit_scene.h"

namespace phare {

/// Of each of the two pictures of a map. In the order of the effect's levels (visual/effects.h), the first being off.
inline constexpr std::array<ShadowLevel, 4> kShadowLevels{{{}, {1024, 512, 1}, {1024, 512, 4}, {2048, 1024, 4}}};

class ShadowPass {
 public:
  explicit ShadowPass(gpu::Device& device) : device_(device) {}

  /// Before the views of a frame; the frame before is done. Maps that it did not call for are freed.
  void begin_frame();
  /// Draws the maps of the view's lamps and has the view read them from here on.
  void draw(gpu::FrameGraph& graph, LitScene& scene, LitView& view, std::size_t level);

 private:
  vk::Pipeline pipeline(const LitScene& scene, bool both_sides);
  ShadowDepths& depths_of(std::size_t texels);

  gpu::Device& device_;
  vk::raii::ShaderModule vertex_{nullptr};  ///< made with the first map
  std::array<vk::raii::Pipeline, 2> pipelines_{nullptr, nullptr};
  std::vector<std::unique_ptr<ShadowDepths>> depths_;  ///< of each view with shadows
  std::size_t used_ = 0;                               ///< of them, by this frame
};

}  // namespace phare
