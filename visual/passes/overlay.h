// The overlay pass: text over the finished picture, drawn by Dear ImGui: lines at the upper left, instruments at the
// lower edge, a panel. Exists once a frame had something to show. Sizes follow the height of the picture; they were
// chosen by eye at 1280 x 720.
#pragma once

#include <string>
#include <vector>

#include "visual/gpu/frame_graph.h"
#include "visual/overlay_content.h"

struct ImFont;
struct ImGuiContext;

namespace phare {

class OverlayPass {
 public:
  /// For pictures of this format; letters are made for this height.
  OverlayPass(gpu::Device& device, vk::Format format, std::uint32_t height_px);
  ~OverlayPass();
  OverlayPass(const OverlayPass&) = delete;
  OverlayPass& operator=(const OverlayPass&) = delete;

  void draw(gpu::FrameGraph& graph, gpu::Image& display, const std::vector<std::string>& lines,
            const std::vector<OverlayInstrument>& instruments, const OverlayPanel& panel, const OverlayMarks& marks,
            const OverlayRoom& room);

 private:
  gpu::Device& device_;
  vk::raii::RenderPass render_pass_{nullptr};  // Dear ImGui 1.86 knows no dynamic rendering
  ImGuiContext* context_ = nullptr;
  ImFont* text_ = nullptr;                     // of the atlas
  ImFont* title_ = nullptr;
  vk::raii::DescriptorPool pool_{nullptr};
  struct Buffers {
    vk::raii::Framebuffer picture{nullptr};
  };
  gpu::PerFrame<Buffers> framebuffer_{device_};
};

}  // namespace phare
