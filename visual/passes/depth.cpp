#include "visual/passes/depth.h"

#include "shaders/depth_vert.h"

namespace phare {

DepthPass::DepthPass(gpu::Device& device) : device_(device), vertex_(gpu::make_shader(device, k_depth_vert)) {}

void DepthPass::draw(gpu::FrameGraph& graph, const LitScene& scene, const LitView& view, gpu::Image& depth,
                     const vk::Rect2D& area) {
  auto found = pipelines_.find(depth.samples);
  if (found == pipelines_.end())
    found = pipelines_
                .emplace(depth.samples, make_pipeline(device_, {.vertex = *vertex_,
                                                                .attributes = std::span(kVertexAttributes).first(1),
                                                                .stride = sizeof(GpuVertex),
                                                                .depth = true,
                                                                .depth_write = true,
                                                                .samples = depth.samples,
                                                                .layout = scene.layout()}))
                .first;
  graph.pass("depth", {{&depth, gpu::Use::kDepthTarget, true}}, [&](gpu::Recorder& commands) {
    const vk::RenderingAttachmentInfo target =
        attachment(depth, vk::ImageLayout::eDepthStencilAttachmentOptimal, vk::AttachmentLoadOp::eClear,
                   vk::ClearDepthStencilValue{0.0f, 0});
    commands.beginRendering(vk::RenderingInfo{.renderArea = area, .layerCount = 1, .pDepthAttachment = &target});
    set_area(commands, area, view.geometry.mirrored());
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *found->second);
    scene.bind(commands, view);
    for (const DrawItem& item : view.items) {
      scene.push(commands, item.push);
      commands.drawIndexed(item.batch->index_count, 1, item.first_index, item.batch->first_vertex, 0);
    }
    commands.endRendering();
  });
}

}  // namespace phare
