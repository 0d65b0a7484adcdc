#include "visual/passes/depth.h"

#include "shaders/depth_cut_frag.h"
#include "shaders/depth_cut_vert.h"
#include "shaders/depth_vert.h"
#include "visual/passes/constants.h"

namespace phare {

DepthPass::DepthPass(gpu::Device& device) : device_(device), vertex_(gpu::make_shader(device, k_depth_vert)) {}

vk::Pipeline DepthPass::pipeline(LitScene& scene, vk::SampleCountFlagBits samples, std::uint32_t look) {
  const auto found = pipelines_.find({samples, look});
  if (found != pipelines_.end()) return *found->second;
  PipelineRecipe recipe{.vertex = *vertex_,
                        .attributes = std::span(kVertexAttributes).first(1),
                        .stride = sizeof(GpuVertex),
                        .depth = true,
                        .depth_write = true,
                        .samples = samples,
                        .layout = look == 0 ? scene.layout() : scene.textured_layout()};
  const std::array attributes{kTexturedAttributes[0], kTexturedAttributes[3], kTexturedAttributes[4]};
  SpecConstants numbers;
  numbers.put(shader::kSpecLook, look);
  const vk::SpecializationInfo constants = numbers.info();
  if (look != 0) {
    if (!*cut_vertex_) cut_vertex_ = gpu::make_shader(device_, k_depth_cut_vert);
    if (!*cut_fragment_) cut_fragment_ = gpu::make_shader(device_, k_depth_cut_frag);
    recipe.vertex = *cut_vertex_;
    recipe.fragment = *cut_fragment_;
    recipe.constants = &constants;
    recipe.attributes = attributes;
    recipe.second_stride = sizeof(GpuCornerLook);
  }
  return *pipelines_.emplace(std::pair(samples, look), make_pipeline(device_, recipe)).first->second;
}

void DepthPass::draw(gpu::FrameGraph& graph, LitScene& scene, const LitView& view, gpu::Image& depth,
                     const vk::Rect2D& area) {
  graph.pass("depth", {{&depth, gpu::Use::kDepthTarget, true}}, [&](gpu::Recorder& commands) {
    const vk::RenderingAttachmentInfo target =
        attachment(depth, vk::ImageLayout::eDepthStencilAttachmentOptimal, vk::AttachmentLoadOp::eClear,
                   vk::ClearDepthStencilValue{0.0f, 0});
    commands.beginRendering(vk::RenderingInfo{.renderArea = area, .layerCount = 1, .pDepthAttachment = &target});
    set_area(commands, area, view.geometry.mirrored());
    scene.bind(commands, view);
    vk::Pipeline bound;
    bool plain = true;
    for (const DrawItem& item : view.items) {
      const std::uint32_t look =
          item.batch->kind.look & shader::kLookCut ? item.batch->kind.look & ~shader::kLookRelief : 0;
      const vk::Pipeline wanted = pipeline(scene, depth.samples, look);
      if (wanted != bound) commands.bindPipeline(vk::PipelineBindPoint::eGraphics, bound = wanted);
      scene.push(commands, item.push);
      if (look != 0) scene.bind_look(commands, *item.batch);
      if (look == 0 && !plain) scene.bind_vertices(commands);
      plain = look == 0;
      commands.drawIndexed(item.index_count, 1, item.first_index, plain ? item.batch->first_vertex : 0, 0);
    }
    commands.endRendering();
  });
}

}  // namespace phare
