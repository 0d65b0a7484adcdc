#include "visual/passes/measure.h"

namespace phare {

void measure_points(gpu::FrameGraph& graph, LitScene& scene, const LitView& view, gpu::Image& lx, vk::Buffer points,
                    std::uint32_t count, std::uint32_t lamp_base) {
  graph.pass("measure", {{&lx, gpu::Use::kColourTarget, true}}, [&](gpu::Recorder& commands) {
    const vk::RenderingAttachmentInfo target =
        attachment(lx, vk::ImageLayout::eColorAttachmentOptimal, vk::AttachmentLoadOp::eClear, vk::ClearValue{});
    commands.beginRendering(vk::RenderingInfo{
        .renderArea = {{0, 0}, lx.extent}, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &target});
    set_area(commands, lx.extent);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics,
                          scene.pipeline({.output = LampOutput::kMeasure,
                                          .lamp_count = view.lit_by.front().lamps,
                                          .lamp_base = lamp_base,
                                          .tables = view.lit_by.front().tables,
                                          .shadow_maps = view.lit_by.front().shadow_maps,
                                          .shadows = view.shadows,
                                          .method = view.method,
                                          .format = lx.format}));
    scene.bind(commands, view);
    scene.bind_shadows(commands, view);
    if (view.method == Method::kReference) scene.bind_reference(commands, view, view.lit_by.front());
    scene.push(commands,
               {.origin = glm::vec4(static_cast<float>(lx.extent.width), static_cast<float>(lx.extent.height), 0, 0),
                .detail_origin = glm::vec4(0.0f),
                .turn = {}});
    commands.bindVertexBuffers(0, points, vk::DeviceSize{0});
    commands.draw(count, 1, 0, 0);
    commands.endRendering();
  });
}

}  // namespace phare
