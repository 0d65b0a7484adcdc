#include "visual/frame.h"

namespace phare {

FrameCounts draw_frame(FrameParts& parts, const FrameInput& input) {
  FrameTargets& targets = parts.targets;
  const double aspect = static_cast<double>(targets.extent.width) / static_cast<double>(targets.extent.height);

  // What is seen, by which lamps.
  const std::vector<DrawItem> items = parts.scene.visible(input.camera, aspect, input.far_mesh_from_m);
  parts.lamps.set_frame(parts.scene, parts.beams, input.camera, aspect, exposure_of(input), input.sky_luminance_cdm2,
                        input.lamps);

  // What this frame calls for.
  const EffectPlan plan = plan_effects(input, parts.lamps.lamp_count(), parts.software_device);
  if (plan.hdr_image) targets.make_hdr(parts.device);
  const bool multisampled = targets.samples != vk::SampleCountFlagBits::e1;
  gpu::Image& light = plan.hdr_image ? targets.hdr_cdm2 : targets.display;
  gpu::Image& light_multisampled = plan.hdr_image ? targets.hdr_multisampled : targets.multisampled;
  const LampOutput output = plan.hdr_image                     ? LampOutput::kHdr
                            : input.view == View::kFalseColour ? LampOutput::kFalseColour
                                                               : LampOutput::kDisplay;

  // Depth of everything, so that each pixel is lit once.
  if (plan.depth_first) parts.lamps.depth(parts.graph, targets.depth, parts.scene, items);

  // Every surface under every lamp; the sky behind.
  parts.lamps.light(parts.graph, multisampled ? light_multisampled : light, multisampled ? &light : nullptr,
                    targets.depth, plan.depth_first, output, parts.scene, items);

  // From cd/m² to the display. Without an HDR image the lamp pass has done it.
  if (plan.hdr_image) parts.tone_mapping.draw(parts.graph, targets.hdr_cdm2, targets.display, exposure_of(input));

  // What the driver is told besides.
  if (plan.overlay) {
    if (!parts.overlay)
      parts.overlay = std::make_unique<OverlayPass>(parts.device, targets.display_format, targets.extent.height);
    parts.overlay->draw(parts.graph, targets.display, input.overlay, input.instruments, input.panel);
  }

  FrameCounts counts{.passes =
                         1u + (plan.overlay ? 1u : 0u) + (plan.depth_first ? 1u : 0u) + (plan.hdr_image ? 1u : 0u)};
  counts.draws = static_cast<std::uint32_t>(items.size()) * (plan.depth_first ? 2 : 1) + 1 + (plan.hdr_image ? 1 : 0);
  for (const DrawItem& item : items) counts.triangles += item.batch->index_count / 3;
  return counts;
}

glm::vec3 exposure_of(const FrameInput& input) {
  return static_cast<float>(input.exposure_per_cdm2) / black_body_colour(input.adaptation_k);
}

EffectPlan plan_effects(const FrameInput& input, std::uint32_t lamp_count, bool software_device) {
  EffectPlan plan;
  // On a software device vertices cost as much as pixels and chunks come near ones first, so few pixels are lit twice.
  plan.depth_first = !software_device && lamp_count > 0;
  plan.reasons.push_back(
      plan.depth_first ? "depth first on: lamps are lit, and vertices are cheap on this device"
      : lamp_count == 0
          ? "depth first off: no lamp is lit, a pixel drawn twice costs nothing"
          : "depth first off: on a software device the second pass over the vertices costs more than it saves");
  plan.hdr_image = input.want_hdr && input.view == View::kPhoto;
  plan.reasons.push_back(plan.hdr_image
                             ? "tone mapping pass on: the HDR image is called for"
                             : "tone mapping pass off: nothing reads the HDR image, the lamp pass applies the curve");
  plan.overlay = !input.overlay.empty() || !input.instruments.empty() || !input.panel.empty();
  plan.reasons.push_back(plan.overlay ? "overlay on: there are lines to show" : "overlay off: nothing to show");
  return plan;
}

FrameTargets::FrameTargets(gpu::Device& device, vk::Extent2D extent_, vk::SampleCountFlagBits samples_,
                           vk::Format display_format_)
    : extent(extent_), samples(samples_), display_format(display_format_) {
  using Usage = vk::ImageUsageFlagBits;
  depth = gpu::Image(device, vk::Format::eD32Sfloat, extent, Usage::eDepthStencilAttachment, "depth", samples);
  display = gpu::Image(device, display_format, extent, Usage::eColorAttachment | Usage::eTransferSrc, "display");
  if (samples != vk::SampleCountFlagBits::e1)
    multisampled = gpu::Image(device, display_format, extent, Usage::eColorAttachment, "display multisampled", samples);
}

void FrameTargets::make_hdr(gpu::Device& device) {
  if (*hdr_cdm2.image) return;
  using Usage = vk::ImageUsageFlagBits;
  // 16-bit float holds 6e-8 to 65504: a retroreflector at 5 m under 40,000 cd gives 1e5 cd/m² and is clipped there; all
  // else fits.
  const vk::Format format = vk::Format::eR16G16B16A16Sfloat;
  hdr_cdm2 =
      gpu::Image(device, format, extent, Usage::eColorAttachment | Usage::eSampled | Usage::eTransferSrc, "hdr_cdm2");
  if (samples != vk::SampleCountFlagBits::e1)
    hdr_multisampled = gpu::Image(device, format, extent, Usage::eColorAttachment, "hdr_cdm2 multisampled", samples);
}

}  // namespace phare
