// The tone-mapping pass: HDR image in cd/m² to the display. Runs only when something calls for the HDR image; else the
// lamp pass applies the curve.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <map>

#include "visual/gpu/descriptor_sets.h"
#include "visual/gpu/frame_graph.h"

namespace phare {

/// A pass that reads the HDR image and writes a part of the picture. `first`: nothing else in the picture is to stay;
/// outside the part it becomes black. `bind`: the pipeline, and what it reads.
void map_to_display(gpu::FrameGraph& graph, const char* name, gpu::Image& hdr_cdm2, gpu::Image& display,
                    const vk::Rect2D& area, bool first, const std::function<void(gpu::Recorder&)>& bind);

class ToneMappingPass {
 public:
  explicit ToneMappingPass(gpu::Device& device);

  /// Before the views of a frame; the frame before is done.
  void begin_frame();
  /// One part of the picture, as map_to_display().
  void draw(gpu::FrameGraph& graph, gpu::Image& hdr_cdm2, gpu::Image& display, const vk::Rect2D& area, bool first,
            const glm::vec3& exposure_per_cdm2);

 private:
  gpu::Device& device_;
  gpu::DescriptorSets sets_;  ///< one a view
  vk::raii::PipelineLayout layout_{nullptr};
  vk::raii::Sampler sampler_{nullptr};
  std::map<vk::Format, vk::raii::Pipeline> pipelines_;
  vk::raii::ShaderModule vertex_{nullptr}, fragment_{nullptr};
};

}  // namespace phare
