// One frame, top to bottom. See frame.cpp.
#pragma once

#include <functional>
#include <string>

#include "visual/frame_facts.h"
#include "visual/gpu/frame_graph.h"
#include "visual/lit_scene.h"
#include "visual/passes/depth.h"
#include "visual/passes/fog.h"
#include "visual/passes/glare.h"
#include "visual/passes/gui.h"
#include "visual/passes/lit.h"
#include "visual/passes/overlay.h"
#include "visual/passes/shadows.h"
#include "visual/passes/tone_mapping.h"
#include "visual/picture_effect.h"
#include "visual/renderer.h"

namespace phare {

/// What a frame is drawn for: size, samples a pixel, and what the display takes.
struct FrameTarget {
  vk::Extent2D extent{};
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  vk::Format display_format = vk::Format::eR8G8B8A8Unorm;
  std::string name{};  ///< before the names of its images
  bool seen = true;    ///< false: of a rehearsal, between two that are
};

/// Factors that take luminance to the tone curve: exposure, and the balance that makes the eye's white white.
glm::vec3 exposure_of(const ViewInput& input);
Sky sky_of(const ViewInput& input);

/// The frame graph's number for an effect.
constexpr gpu::Account account_of(Effect effect) {
  return static_cast<std::size_t>(effect) + 1;
}
constexpr Effect effect_of(gpu::Account account) {
  return static_cast<Effect>(account - 1);
}
static_assert(kMostEffects < gpu::kAccounts);

struct FrameParts {
  gpu::Device& device;
  gpu::FrameGraph& graph;
  const FrameTarget& target;
  LitScene& scene;
  ShadowPass& shadows;
  FogPass& fog;
  DepthPass& depth;
  LitPass& lit;
  GlarePass& glare;
  ToneMappingPass& tone_mapping;
  PictureEffects& picture_effects;
  std::unique_ptr<OverlayPass>& overlay;  ///< made by the first frame that calls for it
  GuiPass& gui;
  /// Copies a part of an image out, for view `view` of the frame.
  std::function<void(std::size_t view, gpu::Image&image, const vk::Rect2D&part)> read_image, read_hdr;
  DeviceFacts device_facts{};
};

/// Records the frame into the graph, and says what each view took. `display`: what is seen.
std::vector<ViewResult> draw_frame(FrameParts& parts, const FrameInput& input, gpu::Image*& display);

}  // namespace phare
