// The gui pass: the panel over the finished picture, text of the overlay included. It knows triangles and letters
// (visual/gui_content.h), not who laid them out. Nothing before the first frame with a panel; in a frame without one
// nothing but the pipeline is left.
#pragma once

#include <map>
#include <memory>

#include "visual/gpu/descriptor_sets.h"
#include "visual/gpu/frame_graph.h"
#include "visual/gui_content.h"

namespace phare {

class GuiPass {
 public:
  explicit GuiPass(gpu::Device& device) : device_(device) {}

  void draw(gpu::FrameGraph& graph, gpu::Image& display, const GuiContent& content);
  /// No panel in this frame: letters and triangles are freed.
  void hide();

 private:
  void make();
  vk::Pipeline pipeline(vk::Format format);
  void take_atlas(gpu::FrameGraph& graph, const std::shared_ptr<const GuiAtlas>& atlas);

  gpu::Device& device_;
  gpu::DescriptorSets sets_;
  vk::raii::PipelineLayout layout_{nullptr};
  vk::raii::Sampler sampler_{nullptr};
  vk::raii::ShaderModule vertex_{nullptr}, fragment_{nullptr};
  std::map<vk::Format, vk::raii::Pipeline> pipelines_;
  // While a panel is shown.
  std::shared_ptr<const GuiAtlas> atlas_;
  gpu::Image letters_;
  gpu::HostBuffer upload_;
  struct Triangles {
    gpu::HostBuffer vertices, indices;
  };
  gpu::PerFrame<Triangles> triangles_{device_};
  vk::DescriptorSet set_{};
};

}  // namespace phare
