// The depth pass: depth of everything, no colour, so that the lit pass lights each pixel once.
#pragma once

#include <map>

#include "visual/lit_scene.h"

namespace phare {

class DepthPass {
 public:
  explicit DepthPass(gpu::Device& device);

  void draw(gpu::FrameGraph& graph, const LitScene& scene, const LitView& view, gpu::Image& depth,
            const vk::Rect2D& area);

 private:
  gpu::Device& device_;
  vk::raii::ShaderModule vertex_;
  std::map<vk::SampleCountFlagBits, vk::raii::Pipeline> pipelines_;
};

}  // namespace phare
