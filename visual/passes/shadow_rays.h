// Shadows by rays: the scene's triangles on the device in a tree of boxes, which the lit pass asks at every pixel
// (shaders/lib/shadow.glsl). The reference among the levels of shadows, and slow: a ray to the lamp's middle, or several
// over its opening for soft edges. It is there only while a frame asks for it.
//
// The same answer as occluder() (visual/scene/ray_hit.h). Error: places are float32 within kLargest_m of the lamp, good
// to 4e-6 m there, so an edge is off by some micrometres; within 0.002 % of the way nothing hides the point it lies
// near. Checked by tests/visual/shadow_rays_test.cpp.
#pragma once

#include <memory>
#include <vector>

#include "visual/gpu/frame_graph.h"
#include "visual/lit_scene.h"

namespace phare {

/// Texels that trees of these take at most, with what moves.
std::uint64_t ray_texels(const ShadowCasters& casters);
/// A texel buffer of a device holds so many.
bool holds_rays(std::uint64_t texels, std::uint64_t buffer_texels);

class ShadowRays {
 public:
  explicit ShadowRays(gpu::Device& device);

  /// The frame before is done. False: it asked for no rays.
  bool begin_frame();
  /// Has the view's lamps shadowed by rays from here on. The device holds them.
  void place(gpu::FrameGraph& graph, LitScene& scene, LitView& view, const ShadowLevel& level);

 private:
  void upload(const ShadowCasters& casters, const glm::dvec3& near_m, std::size_t movers);

  gpu::Device& device_;
  std::uint64_t scene_version_ = 0;
  RayTrees trees_;
  glm::dvec3 origin_m_{0.0};                          ///< that the standing tree is relative to
  std::vector<std::pair<float, float>> mesh_places_;  ///< first texel and the one after, in the buffer
  std::pair<float, float> standing_place_{};
  std::size_t room_ = 0;  ///< for so many movers
  std::unique_ptr<ShadowDepths> texels_;
  std::vector<std::unique_ptr<ShadowDepths>> replaced_;  ///< that views of this frame still read
  bool asked_ = false;                                   ///< by this frame
};

}  // namespace phare
