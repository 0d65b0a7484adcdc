// The glare pass: HDR image in cd/m² to the display, with the light that lamps scatter in the eye of who looks at the
// picture. In place of the tone-mapping pass, and only where a lamp shines into the eye (visual/glare.h). The HDR image
// stays what the scene is.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <vector>

#include "visual/glare.h"
#include "visual/gpu/descriptor_sets.h"
#include "visual/gpu/frame_graph.h"

namespace phare {

class GlarePass {
 public:
  explicit GlarePass(gpu::Device& device) : device_(device) {}

  /// Before the views of a frame; the frame before is done.
  void begin_frame();
  /// One part of the picture, as ToneMappingPass::draw. `sources`: kMostGlaringLamps at most.
  void draw(gpu::FrameGraph& graph, gpu::Image& hdr_cdm2, gpu::Image& display, const vk::Rect2D& area, bool first,
            const glm::vec3& exposure_per_cdm2, const ViewGeometry& view, std::span<const GlaringLamp> sources,
            const Viewer& viewer);

 private:
  void make();
  vk::Pipeline pipeline(vk::Format format, std::uint32_t lamps);

  gpu::Device& device_;
  gpu::DescriptorSets sets_;  ///< one a view; the pass has nothing before its first
  gpu::PerFrame<std::vector<std::unique_ptr<gpu::HostBuffer>>> data_{device_};
  std::size_t used_ = 0;  ///< of data_, in this frame
  vk::raii::PipelineLayout layout_{nullptr};
  vk::raii::Sampler sampler_{nullptr};
  std::map<std::pair<vk::Format, std::uint32_t>, vk::raii::Pipeline> pipelines_;  ///< by format and lamps summed
  vk::raii::ShaderModule vertex_{nullptr}, fragment_{nullptr};
};

}  // namespace phare
