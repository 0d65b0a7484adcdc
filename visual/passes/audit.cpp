#include "visual/passes/audit.h"

namespace phare {

void draw_audit(gpu::FrameGraph& graph, LitScene& scene, const LitView& view, const AuditTarget& target) {
  graph.pass(
      "audit",
      {{&target.position, gpu::Use::kColourTarget, true},
       {&target.normal, gpu::Use::kColourTarget, true},
       {&target.depth, gpu::Use::kDepthTarget, true}},
      [&](gpu::Recorder& commands) {
        const auto colour = vk::ImageLayout::eColorAttachmentOptimal;
        const std::array targets{attachment(target.position, colour, vk::AttachmentLoadOp::eClear, vk::ClearValue{}),
                                 attachment(target.normal, colour, vk::AttachmentLoadOp::eClear, vk::ClearValue{})};
        const vk::RenderingAttachmentInfo depth =
            attachment(target.depth, vk::ImageLayout::eDepthStencilAttachmentOptimal, vk::AttachmentLoadOp::eClear,
                       vk::ClearDepthStencilValue{0.0f, 0});
        commands.beginRendering(vk::RenderingInfo{.renderArea = {{0, 0}, target.position.extent},
                                                  .layerCount = 1,
                                                  .colorAttachmentCount = static_cast<std::uint32_t>(targets.size()),
                                                  .pColorAttachments = targets.data(),
                                                  .pDepthAttachment = &depth});
        set_area(commands, {{0, 0}, target.position.extent}, view.geometry.mirrored());
        scene.draw(commands, view, {.output = LampOutput::kAudit, .format = kAuditFormat});
        commands.endRendering();
      });
}

}  // namespace phare
