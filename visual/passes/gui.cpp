#include "visual/passes/gui.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>

#include "shaders/gui.h"
#include "shaders/gui_frag.h"
#include "shaders/gui_vert.h"
#include "visual/passes/pipeline.h"

namespace phare {

static_assert(sizeof(shader::GuiConstants) == 8);
static_assert(sizeof(GuiVertex) == 20);

namespace {

constexpr vk::DescriptorSetLayoutBinding kAtlas{.binding = shader::kGuiAtlas,
                                                .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                .descriptorCount = 1,
                                                .stageFlags = vk::ShaderStageFlagBits::eFragment};

constexpr std::array<vk::VertexInputAttributeDescription, 3> kAttributes{
    {{shader::kGuiPosition, 0, vk::Format::eR32G32Sfloat, offsetof(GuiVertex, x_px)},
     {shader::kGuiTexel, 0, vk::Format::eR32G32Sfloat, offsetof(GuiVertex, u_01)},
     {shader::kGuiColour, 0, vk::Format::eR8G8B8A8Unorm, offsetof(GuiVertex, srgba)}}};

/// Written anew each frame; made anew where it is too small, with room for a panel that grows a little.
void write_into(gpu::Device& device, gpu::HostBuffer& buffer, std::span<const std::byte> bytes,
                vk::BufferUsageFlags usage, const char* name) {
  if (buffer.bytes < bytes.size()) {
    buffer = gpu::HostBuffer{};
    buffer = gpu::HostBuffer(device, bytes.size() + bytes.size() / 2, usage, name);
  }
  std::memcpy(buffer.data, bytes.data(), bytes.size());
}

/// The part of the picture that a draw may touch.
vk::Rect2D scissor_of(const GuiDraw& draw, vk::Extent2D extent) {
  const auto within = [](float at_px, std::uint32_t side) {
    return static_cast<std::int32_t>(std::clamp(at_px, 0.0f, static_cast<float>(side)));
  };
  const std::int32_t left = within(draw.left_px, extent.width), top = within(draw.top_px, extent.height);
  const std::int32_t right = std::max(within(draw.right_px, extent.width), left);
  const std::int32_t bottom = std::max(within(draw.bottom_px, extent.height), top);
  return {{left, top}, {static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top)}};
}

}  // namespace

void GuiPass::make() {
  sets_ = gpu::DescriptorSets(device_, std::span(&kAtlas, 1));
  vertex_ = gpu::make_shader(device_, k_gui_vert);
  fragment_ = gpu::make_shader(device_, k_gui_frag);
  layout_ = pushing_layout(device_, sets_.layout(), vk::ShaderStageFlagBits::eVertex, sizeof(shader::GuiConstants));
  sampler_ = vk::raii::Sampler(
      device_.device, vk::SamplerCreateInfo{.magFilter = vk::Filter::eLinear, .minFilter = vk::Filter::eLinear});
}

vk::Pipeline GuiPass::pipeline(vk::Format format) {
  const auto [found, made] = pipelines_.try_emplace(format, nullptr);
  if (made)
    found->second = make_pipeline(device_, {.vertex = *vertex_,
                                            .fragment = *fragment_,
                                            .attributes = kAttributes,
                                            .stride = sizeof(GuiVertex),
                                            .colour = {format},
                                            .blend = true,
                                            .layout = *layout_});
  return *found->second;
}

void GuiPass::take_atlas(gpu::FrameGraph& graph, const std::shared_ptr<const GuiAtlas>& atlas) {
  if (atlas_ == atlas) return;
  device_.wait_for_frames();
  atlas_ = atlas;
  const vk::Extent2D extent{atlas->width_px, atlas->height_px};
  letters_ =
      gpu::Image(device_, vk::Format::eR8Unorm, extent,
                 vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, "letters of the panel");
  upload_ = gpu::HostBuffer(device_, atlas->coverage.size(), vk::BufferUsageFlagBits::eTransferSrc, "panel upload");
  std::memcpy(upload_.data, atlas->coverage.data(), atlas->coverage.size());
  graph.copy("letters of the panel", {}, [&](gpu::Recorder& commands) {
    const vk::BufferImageCopy copy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                   .imageExtent = {extent.width, extent.height, 1}};
    gpu::record_fill(commands, letters_, *upload_.buffer, std::span(&copy, 1));
  });
  sets_.clear();
  set_ = sets_.make();
  const vk::DescriptorImageInfo image{*sampler_, *letters_.view, vk::ImageLayout::eShaderReadOnlyOptimal};
  device_.device.updateDescriptorSets(
      vk::WriteDescriptorSet{.dstSet = set_,
                             .dstBinding = shader::kGuiAtlas,
                             .descriptorCount = 1,
                             .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                             .pImageInfo = &image},
      nullptr);
}

void GuiPass::draw(gpu::FrameGraph& graph, gpu::Image& display, const GuiContent& content) {
  if (content.draws.empty() || content.indices.empty()) return;
  if (!*layout_) make();
  const vk::Pipeline by = pipeline(display.format);
  take_atlas(graph, content.atlas);
  graph.count_kept(&letters_, letters_.bytes);
  auto& [vertices, indices] = *triangles_;
  write_into(device_, vertices, std::as_bytes(std::span(content.vertices)), vk::BufferUsageFlagBits::eVertexBuffer,
             "panel vertices");
  write_into(device_, indices, std::as_bytes(std::span(content.indices)), vk::BufferUsageFlagBits::eIndexBuffer,
             "panel indices");
  graph.pass(
      "gui", {{&letters_, gpu::Use::kSampled, false}, {&display, gpu::Use::kColourTarget, false}},
      [&](gpu::Recorder& commands) {
        const vk::RenderingAttachmentInfo target =
            attachment(display, vk::ImageLayout::eColorAttachmentOptimal, vk::AttachmentLoadOp::eLoad, {});
        commands.beginRendering(vk::RenderingInfo{.renderArea = {{0, 0}, display.extent},
                                                  .layerCount = 1,
                                                  .colorAttachmentCount = 1,
                                                  .pColorAttachments = &target});
        set_area(commands, display.extent);
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, by);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, set_, nullptr);
        commands.bindVertexBuffers(0, *vertices.buffer, vk::DeviceSize{0});
        commands.bindIndexBuffer(*indices.buffer, 0, vk::IndexType::eUint16);
        commands.pushConstants<shader::GuiConstants>(
            *layout_, vk::ShaderStageFlagBits::eVertex, 0,
            shader::GuiConstants{
                {2.0f / static_cast<float>(display.extent.width), 2.0f / static_cast<float>(display.extent.height)}});
        for (const GuiDraw& draw : content.draws) {
          const vk::Rect2D scissor = scissor_of(draw, display.extent);
          if (scissor.extent.width == 0 || scissor.extent.height == 0) continue;
          commands.setScissor(0, scissor);
          commands.drawIndexed(draw.indices, 1, draw.first_index, static_cast<std::int32_t>(draw.first_vertex), 0);
        }
        commands.endRendering();
      });
}

void GuiPass::hide() {
  if (!atlas_) return;
  device_.wait_for_frames();
  atlas_.reset();
  sets_.clear();
  letters_ = gpu::Image{};
  upload_ = gpu::HostBuffer{};
  triangles_.all() = {};
}

}  // namespace phare
