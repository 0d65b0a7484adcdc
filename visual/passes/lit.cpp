#include "visual/passes/lit.h"

namespace phare {

void LitPass::draw(gpu::FrameGraph& graph, LitScene& scene, const LitView& view, const LitTarget& target,
                   LampOutput output) {
  const bool done = target.depth_done;
  const vk::Rect2D whole{{0, 0}, target.colour.extent};
  const bool black_around = target.black_around && target.area != whole;
  std::vector<gpu::ImageUse> uses{{&target.colour, gpu::Use::kColourTarget, !target.keep || target.resolved != nullptr},
                                  {&target.depth, done ? gpu::Use::kDepthRead : gpu::Use::kDepthTarget, !done}};
  if (target.resolved != nullptr) uses.push_back({target.resolved, gpu::Use::kColourTarget, !target.keep});
  graph.pass("lamps", uses, [&](gpu::Recorder& commands) {
    const vk::ClearValue background = SkyPass::clear_value(view.sky, output, view.geometry);
    const vk::ClearValue black = vk::ClearColorValue(std::array{0.0f, 0.0f, 0.0f, 1.0f});
    const vk::RenderingAttachmentInfo colour =
        attachment(target.colour, vk::ImageLayout::eColorAttachmentOptimal, vk::AttachmentLoadOp::eClear,
                   black_around ? black : background, target.resolved);
    const vk::RenderingAttachmentInfo depth = attachment(
        target.depth,
        done ? vk::ImageLayout::eDepthStencilReadOnlyOptimal : vk::ImageLayout::eDepthStencilAttachmentOptimal,
        done ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear, vk::ClearDepthStencilValue{0.0f, 0});
    commands.beginRendering(vk::RenderingInfo{.renderArea = black_around ? whole : target.area,
                                              .layerCount = 1,
                                              .colorAttachmentCount = 1,
                                              .pColorAttachments = &colour,
                                              .pDepthAttachment = &depth});
    if (black_around)
      commands.clearAttachments(
          vk::ClearAttachment{.aspectMask = vk::ImageAspectFlagBits::eColor, .clearValue = background},
          vk::ClearRect{.rect = target.area, .layerCount = 1});
    set_area(commands, target.area, view.geometry.mirrored());
    const bool foggy = view.fog.slices != 0;
    if (!foggy) sky_.draw(commands, view.sky, view.geometry, output, target.colour.format, target.colour.samples);
    scene.draw(
        commands, view,
        {.output = output, .samples = target.colour.samples, .format = target.colour.format, .depth_done = done});
    if (foggy) fog_sky_.draw(commands, scene, view, output, target.colour.format, target.colour.samples);
    if (!view.pupils.empty())
      eyeshine_.draw(commands, view, target.area, output, target.colour.format, target.colour.samples);
    if (!view.spray_by.empty())
      spray_.draw(commands, scene, view, target.colour.format, target.colour.samples);
    if (view.drops_count > 0)
      drops_.draw(commands, scene, view, target.area, target.colour.format, target.colour.samples);
    commands.endRendering();
  });
}

}  // namespace phare
