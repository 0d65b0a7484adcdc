// The depth pass: depth of everything, no colour, so that the lit pass lights each pixel once.
#pragma once

#include <map>
#include <utility>

#include "visual/lit_scene.h"

namespace phare {

class DepthPass {
 public:
  explicit DepthPass(gpu::Device& device);

  void draw(gpu::FrameGraph& graph, LitScene& scene, const LitView& view, gpu::Image& depth,
            const vk::Rect2D& area);

 private:
  vk::Pipeline pipeline(LitScene& scene, vk::SampleCountFlagBits samples, std::uint32_t look);

  gpu::Device& device_;
  vk::raii::ShaderModule vertex_;
  vk::raii::ShaderModule cut_vertex_{nullptr}, cut_fragment_{nullptr};  ///< of surfaces with holes, when called for
  std::map<std::pair<vk::SampleCountFlagBits, std::uint32_t>, vk::raii::Pipeline> pipelines_;  ///< by look; 0: no holes
};

}  // namespace phare
