#include "visual/frame.h"

#include "visual/frame_facts.h"

namespace phare {
namespace {

using Usage = vk::ImageUsageFlagBits;

// 16-bit float holds 6e-8 to 65504: a retroreflector at 5 m under 40,000 cd gives 1e5 cd/m² and is clipped there; all
// else fits.
constexpr vk::Format kHdrFormat = vk::Format::eR16G16B16A16Sfloat;

}  // namespace

DrawnFrame draw_frame(FrameParts& parts, const FrameInput& input) {
  const FrameTarget& target = parts.target;
  const auto image = [&](const char* name, vk::Format format, vk::ImageUsageFlags usage,
                         vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1) {
    return &parts.graph.image(name, {format, target.extent, usage, samples});
  };

  // What is seen, by which lamps.
  const ViewGeometry view(input.camera, target.aspect());
  const std::vector<DrawItem> items = parts.scene.visible(view, input.far_mesh_from_m);
  parts.lamps.set_isolux(input.isolux_lx);
  parts.lamps.set_frame(parts.scene, parts.beams, view, {exposure_of(input), input.sky_luminance_cdm2}, input.lamps);

  // What this frame calls for, and the images that takes.
  DrawnFrame drawn{.effects =
                       plan_effects(facts_of(input, parts.lamps.lamp_count(), parts.software_device), input.effects)};
  drawn.display = image("display", target.display_format, Usage::eColorAttachment | Usage::eTransferSrc);
  gpu::Image* depth = image("depth", vk::Format::eD32Sfloat, Usage::eDepthStencilAttachment, target.samples);
  gpu::Image* light = drawn.display;
  LampOutput output = input.view == View::kFalseColour ? LampOutput::kFalseColour : LampOutput::kDisplay;
  if (drawn.effects.on(Effect::kHdrImage)) {
    light = drawn.hdr_cdm2 =
        image("hdr_cdm2", kHdrFormat, Usage::eColorAttachment | Usage::eSampled | Usage::eTransferSrc);
    output = LampOutput::kHdr;
  }
  gpu::Image* samples = nullptr;
  if (target.samples != vk::SampleCountFlagBits::e1)
    samples = image("samples", light->format, Usage::eColorAttachment, target.samples);

  // Depth of everything, so that each pixel is lit once.
  const bool depth_done = drawn.effects.on(Effect::kDepthFirst);
  if (depth_done) parts.lamps.depth(parts.graph, *depth, parts.scene, items);

  // Every surface under every lamp; the sky behind.
  parts.lamps.light(parts.graph, samples != nullptr ? *samples : *light, samples != nullptr ? light : nullptr, *depth,
                    depth_done, output, parts.scene, items);

  // From cd/m² to the display. Without an HDR image the lamp pass has done it.
  if (drawn.effects.on(Effect::kHdrImage))
    parts.tone_mapping.draw(parts.graph, *drawn.hdr_cdm2, *drawn.display, exposure_of(input));

  // What the driver is told besides.
  if (drawn.effects.on(Effect::kOverlay)) {
    if (!parts.overlay)
      parts.overlay = std::make_unique<OverlayPass>(parts.device, target.display_format, target.extent.height);
    parts.overlay->draw(parts.graph, *drawn.display, input.overlay, input.instruments, input.panel);
  }
  return drawn;
}

glm::vec3 exposure_of(const FrameInput& input) {
  return static_cast<float>(input.exposure_per_cdm2) / input.white.value_or(black_body_colour(input.adaptation_k));
}

}  // namespace phare
