// The overlay pass: lines of text over the finished picture, drawn by Dear ImGui. Exists once a frame had lines to
// show.
#pragma once

#include <string>
#include <vector>

#include "visual/gpu/frame_graph.h"

namespace phare {

class OverlayPass {
 public:
  /// For pictures of this format.
  OverlayPass(gpu::Device& device, vk::Format format);
  ~OverlayPass();
  OverlayPass(const OverlayPass&) = delete;
  OverlayPass& operator=(const OverlayPass&) = delete;

  void draw(gpu::FrameGraph& graph, gpu::Image& display, const std::vector<std::string>& lines);

 private:
  gpu::Device& device_;
  vk::raii::RenderPass render_pass_{nullptr};  // Dear ImGui 1.86 knows no dynamic rendering
  vk::raii::DescriptorPool pool_{nullptr};
  vk::raii::Framebuffer framebuffer_{nullptr};  // of the newest frame, which is waited for before the next
};

}  // namespace phare
