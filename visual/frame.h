// One frame, top to bottom. See frame.cpp.
#pragma once

#include "visual/effects.h"
#include "visual/gpu/frame_graph.h"
#include "visual/passes/lamps.h"
#include "visual/passes/overlay.h"
#include "visual/passes/tone_mapping.h"
#include "visual/renderer.h"

namespace phare {

/// What a frame is drawn for: size, samples a pixel, and what the display takes.
struct FrameTarget {
  vk::Extent2D extent{};
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  vk::Format display_format = vk::Format::eR8G8B8A8Unorm;

  double aspect() const { return static_cast<double>(extent.width) / static_cast<double>(extent.height); }
};

/// Factors that take luminance to the tone curve: exposure, and the balance that makes the eye's white white.
glm::vec3 exposure_of(const FrameInput& input);

struct FrameParts {
  gpu::Device& device;
  gpu::FrameGraph& graph;
  const FrameTarget& target;
  const SceneBuffers& scene;
  BeamStore& beams;
  LampPass& lamps;
  ToneMappingPass& tone_mapping;
  std::unique_ptr<OverlayPass>& overlay;  ///< made by the first frame that calls for it
  bool software_device = false;
};

struct DrawnFrame {
  EffectPlan effects;
  gpu::Image* display = nullptr;   ///< what is seen
  gpu::Image* hdr_cdm2 = nullptr;  ///< only if called for
};

/// Records the frame into the graph.
DrawnFrame draw_frame(FrameParts& parts, const FrameInput& input);

}  // namespace phare
