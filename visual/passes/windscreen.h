// Drops on the windscreen (visual/windscreen.h) over a view's luminance image: first the light of each from the picture
// about it, into a small image, then a disc for each that is there. Illuminance in the image's alpha stays.
// Checked by tests/visual/windscreen_test.cpp.
#pragma once

#include <span>

#include "visual/glare.h"
#include "visual/gpu/descriptor_sets.h"
#include "visual/gpu/frame_graph.h"
#include "visual/windscreen.h"

namespace phare {

class WindscreenPass {
 public:
  explicit WindscreenPass(gpu::Device& device);

  /// Before the views of a frame; the frame before is done.
  void begin_frame();
  /// `hdr_cdm2`: of a view, one sample a pixel. `lamps`: that shine into the eye.
  void draw(gpu::FrameGraph& graph, gpu::Image& hdr_cdm2, const vk::Rect2D& area, const ViewGeometry& view,
            const Windscreen& screen, const Air& air, std::span<const GlaringLamp> lamps);

 private:
  vk::DescriptorSet reads(const gpu::Image& image);

  gpu::Device& device_;
  gpu::DescriptorSets sets_;
  vk::raii::PipelineLayout light_layout_{nullptr}, layout_{nullptr};
  vk::raii::Sampler sampler_{nullptr};
  vk::raii::Pipeline light_{nullptr}, drops_{nullptr};
};

}  // namespace phare
