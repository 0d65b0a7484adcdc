// One frame, top to bottom. See frame.cpp.
#pragma once

#include "visual/gpu/frame_graph.h"
#include "visual/passes/lamps.h"
#include "visual/passes/overlay.h"
#include "visual/passes/tone_mapping.h"
#include "visual/renderer.h"

namespace phare {

/// The images a frame is drawn into. Those that no effect calls for do not exist.
struct FrameTargets {
  vk::Extent2D extent{};
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  vk::Format display_format = vk::Format::eR8G8B8A8Srgb;
  gpu::Image depth;
  gpu::Image display;       ///< what is seen
  gpu::Image multisampled;  ///< only with samples > 1
  gpu::Image hdr_cdm2;      ///< only once something called for it
  gpu::Image hdr_multisampled;

  FrameTargets() = default;
  FrameTargets(gpu::Device& device, vk::Extent2D extent, vk::SampleCountFlagBits samples, vk::Format display_format);
  void make_hdr(gpu::Device& device);
};

/// Factors that take luminance to the tone curve: exposure, and the balance that makes the eye's white white.
glm::vec3 exposure_of(const FrameInput& input);

/// Which effects this frame has and why. Each line is "name on|off: reason".
struct EffectPlan {
  bool depth_first = false;  ///< a depth pass before the lamp pass
  bool hdr_image = false;    ///< an HDR image and a tone-mapping pass
  bool overlay = false;      ///< text over the picture
  std::vector<std::string> reasons{};
};
EffectPlan plan_effects(const FrameInput& input, std::uint32_t lamp_count, bool software_device);

struct FrameParts {
  gpu::Device& device;
  gpu::FrameGraph& graph;
  FrameTargets& targets;
  const SceneBuffers& scene;
  BeamStore& beams;
  LampPass& lamps;
  ToneMappingPass& tone_mapping;
  std::unique_ptr<OverlayPass>& overlay;  ///< made by the first frame that calls for it
  bool software_device = false;
};

struct FrameCounts {
  std::uint32_t draws = 0;
  std::uint32_t passes = 0;
  std::uint64_t triangles = 0;
};

/// Records the frame into the graph. Afterwards targets.display holds the picture (and targets.hdr_cdm2, if called
/// for).
FrameCounts draw_frame(FrameParts& parts, const FrameInput& input);

}  // namespace phare
