#include "visual/passes/lamps.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <utility>

#include "shaders/depth_vert.h"
#include "shaders/lamps_frag_2.h"
#include "shaders/lamps_frag_4.h"
#include "shaders/lamps_frag_8.h"
#include "shaders/measure_vert_2.h"
#include "shaders/measure_vert_4.h"
#include "shaders/measure_vert_8.h"
#include "shaders/scene_vert_2.h"
#include "shaders/scene_vert_4.h"
#include "shaders/scene_vert_8.h"

namespace phare {

namespace {

// std140 and std430 agree for these: all members are 16 bytes.
static_assert(sizeof(shader::GpuLamp) == 176 && offsetof(shader::GpuLamp, guide) == 160);
static_assert(offsetof(shader::GpuFrame, exposure) == 64 && offsetof(shader::GpuFrame, lamps) == 128);
static_assert(sizeof(shader::GpuFrame) == 96 + 4 * shader::kMaxIsoluxLevels + shader::kMaxLamps * 176);
static_assert(shader::kMaxIsoluxLevels % 4 == 0);
static_assert(sizeof(shader::GpuDraw) == 32 && sizeof(shader::GpuMaterial) == 16);
static_assert(sizeof(shader::GpuSheeting) == 96 && std::tuple_size_v<decltype(Retroreflection::ln_r_a)> == 6);
static_assert(static_cast<std::uint32_t>(RetroKind::kSheeting) == shader::kRetroSheeting &&
              static_cast<std::uint32_t>(RetroKind::kMarking) == shader::kRetroMarking);
static_assert(sizeof(GpuVertex) == 28 && offsetof(GpuVertex, normal) == 12 && offsetof(GpuVertex, material) == 24);

constexpr std::array kVertexAttributes{
    vk::VertexInputAttributeDescription{
        .location = 0, .binding = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = 0},
    vk::VertexInputAttributeDescription{
        .location = 1, .binding = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = 12},
    vk::VertexInputAttributeDescription{.location = 2, .binding = 0, .format = vk::Format::eR32Uint, .offset = 24}};

constexpr auto kStages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;

vk::RenderingAttachmentInfo attachment(const gpu::Image& image, vk::ImageLayout layout, vk::AttachmentLoadOp load,
                                       vk::ClearValue clear, const gpu::Image* resolved) {
  vk::RenderingAttachmentInfo info{
      .imageView = *image.view,
      .imageLayout = layout,
      .loadOp = load,
      .storeOp = resolved != nullptr ? vk::AttachmentStoreOp::eDontCare : vk::AttachmentStoreOp::eStore,
      .clearValue = clear};
  if (resolved != nullptr) {
    info.resolveMode = vk::ResolveModeFlagBits::eAverage;
    info.resolveImageView = *resolved->view;
    info.resolveImageLayout = vk::ImageLayout::eColorAttachmentOptimal;
  }
  return info;
}

}  // namespace

LampPass::LampPass(gpu::Device& device)
    : device_(device),
      scene_vert_{gpu::make_shader(device, k_scene_vert_2), gpu::make_shader(device, k_scene_vert_4),
                  gpu::make_shader(device, k_scene_vert_8)},
      measure_vert_{gpu::make_shader(device, k_measure_vert_2), gpu::make_shader(device, k_measure_vert_4),
                    gpu::make_shader(device, k_measure_vert_8)},
      lamps_frag_{gpu::make_shader(device, k_lamps_frag_2), gpu::make_shader(device, k_lamps_frag_4),
                  gpu::make_shader(device, k_lamps_frag_8)},
      depth_vert_(gpu::make_shader(device, k_depth_vert)) {
  using Type = vk::DescriptorType;
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (const auto& [binding, type, count] :
       {std::tuple(0u, Type::eUniformBuffer, 1u), std::tuple(1u, Type::eCombinedImageSampler, shader::kMaxLamps),
        std::tuple(2u, Type::eCombinedImageSampler, shader::kMaxLamps), std::tuple(3u, Type::eUniformBuffer, 1u),
        std::tuple(4u, Type::eUniformTexelBuffer, 1u), std::tuple(5u, Type::eUniformBuffer, 1u),
        std::tuple(6u, Type::eCombinedImageSampler, shader::kMaxLamps)})
    bindings.push_back({.binding = binding, .descriptorType = type, .descriptorCount = count, .stageFlags = kStages});
  set_layout_ = vk::raii::DescriptorSetLayout(
      device.device, vk::DescriptorSetLayoutCreateInfo{.bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                                       .pBindings = bindings.data()});
  const vk::PushConstantRange push{.stageFlags = kStages, .offset = 0, .size = sizeof(shader::GpuDraw)};
  layout_ = vk::raii::PipelineLayout(device.device, vk::PipelineLayoutCreateInfo{.setLayoutCount = 1,
                                                                                 .pSetLayouts = &*set_layout_,
                                                                                 .pushConstantRangeCount = 1,
                                                                                 .pPushConstantRanges = &push});
  const std::array sizes{vk::DescriptorPoolSize{Type::eUniformBuffer, 3},
                         vk::DescriptorPoolSize{Type::eCombinedImageSampler, 3 * shader::kMaxLamps},
                         vk::DescriptorPoolSize{Type::eUniformTexelBuffer, 1}};
  pool_ = vk::raii::DescriptorPool(
      device.device, vk::DescriptorPoolCreateInfo{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                                  .maxSets = 1,
                                                  .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                                  .pPoolSizes = sizes.data()});
  vk::raii::DescriptorSets sets(
      device.device,
      vk::DescriptorSetAllocateInfo{.descriptorPool = *pool_, .descriptorSetCount = 1, .pSetLayouts = &*set_layout_});
  set_ = std::move(sets.front());
  vk::SamplerCreateInfo table{.addressModeU = vk::SamplerAddressMode::eClampToEdge,
                              .addressModeV = vk::SamplerAddressMode::eClampToEdge};
  table_sampler_ = vk::raii::Sampler(device.device, table);  // nodes are fetched, and weighed in float32
  table.magFilter = table.minFilter = vk::Filter::eLinear;
  filter_sampler_ = vk::raii::Sampler(device.device, table);
  grain_ = make_grain(device);
  frame_ = gpu::HostBuffer(device, sizeof(shader::GpuFrame), vk::BufferUsageFlagBits::eUniformBuffer, "frame");
}

void LampPass::bind(const SceneBuffers& scene, const BeamStore& beams) {
  using Type = vk::DescriptorType;
  const std::array buffers{std::pair(0u, vk::DescriptorBufferInfo{*frame_.buffer, 0, VK_WHOLE_SIZE}),
                           std::pair(3u, vk::DescriptorBufferInfo{*scene.material_buffer.buffer, 0, VK_WHOLE_SIZE}),
                           std::pair(5u, vk::DescriptorBufferInfo{*scene.sheeting_buffer.buffer, 0, VK_WHOLE_SIZE})};
  const auto layout = vk::ImageLayout::eShaderReadOnlyOptimal;
  std::array<vk::DescriptorImageInfo, shader::kMaxLamps> guides, candela, tints;
  for (std::size_t i = 0; i < beam_of_lamp_.size(); ++i) {
    guides[i] = {*table_sampler_, *beams.guide(beam_of_lamp_[i]).view, layout};
    const gpu::Image& table = beams.candela(beam_of_lamp_[i]);  // "no beam" is float32, which not every device filters
    const bool filtered = beams.beam(beam_of_lamp_[i]).filtered() && table.format != vk::Format::eR32Sfloat;
    candela[i] = {filtered ? *filter_sampler_ : *table_sampler_, *table.view, layout};
    const gpu::Image& tint = beams.tint(beam_of_lamp_[i]);
    tints[i] = {filtered && tint.format != vk::Format::eR32Sfloat ? *filter_sampler_ : *table_sampler_, *tint.view,
                layout};
  }
  std::vector<vk::WriteDescriptorSet> writes;
  for (const auto& [binding, info] : buffers)
    writes.push_back({.dstSet = *set_,
                      .dstBinding = binding,
                      .descriptorCount = 1,
                      .descriptorType = Type::eUniformBuffer,
                      .pBufferInfo = &info});
  for (const auto& [binding, infos] : {std::pair(1u, std::span<const vk::DescriptorImageInfo>(guides)),
                                       std::pair(2u, std::span<const vk::DescriptorImageInfo>(candela)),
                                       std::pair(6u, std::span<const vk::DescriptorImageInfo>(tints))})
    writes.push_back({.dstSet = *set_,
                      .dstBinding = binding,
                      .descriptorCount = static_cast<std::uint32_t>(infos.size()),
                      .descriptorType = Type::eCombinedImageSampler,
                      .pImageInfo = infos.data()});
  const vk::BufferView grain = *grain_.view;
  writes.push_back({.dstSet = *set_,
                    .dstBinding = 4,
                    .descriptorCount = 1,
                    .descriptorType = Type::eUniformTexelBuffer,
                    .pTexelBufferView = &grain});
  device_.device.updateDescriptorSets(writes, nullptr);
}

void LampPass::set_frame(const SceneBuffers& scene, BeamStore& beams, const ViewGeometry& view, const Sky& sky,
                         std::span<const PlacedLamp> lamps) {
  view_ = view;
  sky_ = sky;
  bool rebind = beams.upload();
  shader::GpuFrame frame{};
  const glm::mat4 clip = glm::mat4(view.clip_from_eye());
  for (int i = 0; i < 4; ++i) frame.clip_from_eye[i] = clip[i];
  frame.exposure = glm::vec4(sky.exposure_per_cdm2, 0.0f);
  frame.sky = sky.zenith();
  constexpr float kNowhere_lx = 1e30f;
  for (std::size_t i = 0; i < kMostIsoluxLevels; ++i)
    frame.isolux_lx[i / 4][static_cast<int>(i % 4)] =
        i < isolux_lx_.size() ? static_cast<float>(isolux_lx_[i]) : kNowhere_lx;
  lamp_count_ = lookups_ = colours_ = 0;
  std::optional<glm::vec3> first_colour;
  for (const PlacedLamp& lamp : lamps) {
    const PackedBeam& beam = beams.beam(lamp.beam);
    if (beam.dark || lamp_count_ == shader::kMaxLamps) continue;
    rebind |= std::exchange(beam_of_lamp_[lamp_count_], lamp.beam) != lamp.beam;
    lookups_ |= beam.lookup_bits() << (4 * lamp_count_);
    if (first_colour && *first_colour != beam.colour) colours_ |= 1u;
    if (beam.tinted()) colours_ |= 1u << (8 + lamp_count_);
    first_colour = beam.colour;
    shader::GpuLamp& out = frame.lamps[lamp_count_++];
    out.position = glm::vec4(glm::vec3(lamp.position_m - view.camera().eye_m), 1.0f);
    const glm::dmat3 rows = lamp.world_from_image * beam.rows;  // columns: a, b, c in the world
    out.row_a = glm::vec4(glm::vec3(rows[0]), 0.0f);
    out.row_b = glm::vec4(glm::vec3(rows[1]), 0.0f);
    out.row_c = glm::vec4(glm::vec3(rows[2]), 0.0f);
    beams.describe(lamp.beam, out);
  }
  std::memcpy(frame_.data, &frame, sizeof frame);
  if (rebind) bind(scene, beams);
}

vk::Pipeline LampPass::lit_pipeline(const Variant& variant) {
  if (const auto found = lit_.find(variant); found != lit_.end()) return *found->second;
  const std::array<std::uint32_t, 9> values{variant.lamp_count,
                                            static_cast<std::uint32_t>(variant.kind.surface),
                                            static_cast<std::uint32_t>(variant.kind.retro),
                                            static_cast<std::uint32_t>(variant.output),
                                            variant.lamp_base,
                                            variant.lookups,
                                            variant.colours,
                                            variant.kind.double_sided ? 2u : 1u,
                                            grain_.first_level};
  std::array<vk::SpecializationMapEntry, 9> entries;
  for (std::uint32_t i = 0; i < entries.size(); ++i)
    entries[i] = vk::SpecializationMapEntry{.constantID = i, .offset = 4 * i, .size = 4};
  const vk::SpecializationInfo constants{.mapEntryCount = entries.size(),
                                         .pMapEntries = entries.data(),
                                         .dataSize = sizeof values,
                                         .pData = values.data()};
  const bool measure = variant.output == LampOutput::kMeasure;
  const std::size_t size = variant.lamp_count <= 2 ? 0 : variant.lamp_count <= 4 ? 1 : 2;
  PipelineRecipe recipe{
      .vertex = measure ? *measure_vert_[size] : *scene_vert_[size],
      .fragment = *lamps_frag_[size],
      .constants = &constants,
      .attributes = std::span(kVertexAttributes).first(measure ? 2 : 3),
      .stride = sizeof(GpuVertex),
      .topology = measure ? vk::PrimitiveTopology::ePointList : vk::PrimitiveTopology::eTriangleList,
      .cull = variant.kind.double_sided || measure ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack,
      .colour = {variant.format},
      .depth = !measure,
      .depth_write = !measure && !variant.depth_done,
      .compare = variant.depth_done ? vk::CompareOp::eEqual : vk::CompareOp::eGreater,
      .samples = variant.samples,
      .layout = *layout_};
  if (variant.output == LampOutput::kAudit) recipe.colour.push_back(variant.format);
  return *lit_.emplace(variant, make_pipeline(device_, recipe)).first->second;
}

vk::Pipeline LampPass::depth_pipeline(vk::SampleCountFlagBits samples) {
  if (const auto found = depth_.find(samples); found != depth_.end()) return *found->second;
  return *depth_
              .emplace(samples, make_pipeline(device_, {.vertex = *depth_vert_,
                                                        .attributes = std::span(kVertexAttributes).first(1),
                                                        .stride = sizeof(GpuVertex),
                                                        .depth = true,
                                                        .depth_write = true,
                                                        .samples = samples,
                                                        .layout = *layout_}))
              .first->second;
}

void LampPass::draw_items(gpu::Recorder& commands, const SceneBuffers& scene, std::span<const DrawItem> items,
                          const Variant& common) {
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *set_, nullptr);
  commands.bindVertexBuffers(0, *scene.vertices.buffer, vk::DeviceSize{0});
  commands.bindIndexBuffer(*scene.indices.buffer, 0, vk::IndexType::eUint32);
  vk::Pipeline bound;
  for (const DrawItem& item : items) {
    Variant variant = common;
    variant.kind = item.batch->kind;
    if (variant.output == LampOutput::kAudit) variant.kind = {.double_sided = variant.kind.double_sided};
    const vk::Pipeline pipeline = lit_pipeline(variant);
    if (pipeline != bound) commands.bindPipeline(vk::PipelineBindPoint::eGraphics, bound = pipeline);
    commands.pushConstants<shader::GpuDraw>(*layout_, kStages, 0, item.push);
    commands.drawIndexed(item.batch->index_count, 1, item.batch->first_index, item.batch->first_vertex, 0);
  }
}

void LampPass::depth(gpu::FrameGraph& graph, gpu::Image& depth, const SceneBuffers& scene,
                     std::span<const DrawItem> items) {
  graph.pass("depth", {{&depth, gpu::Use::kDepthTarget, true}}, [&](gpu::Recorder& commands) {
    const vk::RenderingAttachmentInfo target =
        attachment(depth, vk::ImageLayout::eDepthStencilAttachmentOptimal, vk::AttachmentLoadOp::eClear,
                   vk::ClearDepthStencilValue{0.0f, 0}, nullptr);
    commands.beginRendering(
        vk::RenderingInfo{.renderArea = {{0, 0}, depth.extent}, .layerCount = 1, .pDepthAttachment = &target});
    set_area(commands, depth.extent);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, depth_pipeline(depth.samples));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *set_, nullptr);
    commands.bindVertexBuffers(0, *scene.vertices.buffer, vk::DeviceSize{0});
    commands.bindIndexBuffer(*scene.indices.buffer, 0, vk::IndexType::eUint32);
    for (const DrawItem& item : items) {
      commands.pushConstants<shader::GpuDraw>(*layout_, kStages, 0, item.push);
      commands.drawIndexed(item.batch->index_count, 1, item.batch->first_index, item.batch->first_vertex, 0);
    }
    commands.endRendering();
  });
}

void LampPass::light(gpu::FrameGraph& graph, gpu::Image& colour, gpu::Image* resolved, gpu::Image& depth,
                     bool depth_done, LampOutput output, const SceneBuffers& scene, std::span<const DrawItem> items) {
  std::vector<gpu::ImageUse> uses{{&colour, gpu::Use::kColourTarget, true},
                                  {&depth, depth_done ? gpu::Use::kDepthRead : gpu::Use::kDepthTarget, !depth_done}};
  if (resolved != nullptr) uses.push_back({resolved, gpu::Use::kColourTarget, true});
  graph.pass("lamps", uses, [&](gpu::Recorder& commands) {
    const vk::RenderingAttachmentInfo target =
        attachment(colour, vk::ImageLayout::eColorAttachmentOptimal, vk::AttachmentLoadOp::eClear,
                   SkyPass::clear_value(sky_, output, view_), resolved);
    const vk::RenderingAttachmentInfo depth_target = attachment(
        depth,
        depth_done ? vk::ImageLayout::eDepthStencilReadOnlyOptimal : vk::ImageLayout::eDepthStencilAttachmentOptimal,
        depth_done ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear, vk::ClearDepthStencilValue{0.0f, 0},
        nullptr);
    commands.beginRendering(vk::RenderingInfo{.renderArea = {{0, 0}, colour.extent},
                                              .layerCount = 1,
                                              .colorAttachmentCount = 1,
                                              .pColorAttachments = &target,
                                              .pDepthAttachment = &depth_target});
    set_area(commands, colour.extent);
    sky_pass_.draw(commands, sky_, view_, output, colour.format, colour.samples);
    draw_items(commands, scene, items,
               {.output = output,
                .lamp_count = lamp_count_,
                .lookups = lookups_,
                .colours = colours_,
                .samples = colour.samples,
                .format = colour.format,
                .depth_done = depth_done});
    commands.endRendering();
  });
}

void LampPass::measure(gpu::FrameGraph& graph, gpu::Image& lx, vk::Buffer points, std::uint32_t count,
                       std::uint32_t lamp_base) {
  graph.pass("measure", {{&lx, gpu::Use::kColourTarget, true}}, [&](gpu::Recorder& commands) {
    const vk::RenderingAttachmentInfo target = attachment(lx, vk::ImageLayout::eColorAttachmentOptimal,
                                                          vk::AttachmentLoadOp::eClear, vk::ClearValue{}, nullptr);
    commands.beginRendering(vk::RenderingInfo{
        .renderArea = {{0, 0}, lx.extent}, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &target});
    set_area(commands, lx.extent);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, lit_pipeline({.output = LampOutput::kMeasure,
                                                                          .lamp_count = lamp_count_,
                                                                          .lamp_base = lamp_base,
                                                                          .lookups = lookups_,
                                                                          .format = lx.format}));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *set_, nullptr);
    const shader::GpuDraw push{
        .origin = glm::vec4(static_cast<float>(lx.extent.width), static_cast<float>(lx.extent.height), 0, 0),
        .detail_origin = glm::vec4(0.0f)};
    commands.pushConstants<shader::GpuDraw>(*layout_, kStages, 0, push);
    commands.bindVertexBuffers(0, points, vk::DeviceSize{0});
    commands.draw(count, 1, 0, 0);
    commands.endRendering();
  });
}

void LampPass::audit(gpu::FrameGraph& graph, gpu::Image& position, gpu::Image& normal, gpu::Image& depth,
                     const SceneBuffers& scene, std::span<const DrawItem> items) {
  graph.pass(
      "audit",
      {{&position, gpu::Use::kColourTarget, true},
       {&normal, gpu::Use::kColourTarget, true},
       {&depth, gpu::Use::kDepthTarget, true}},
      [&](gpu::Recorder& commands) {
        const std::array targets{attachment(position, vk::ImageLayout::eColorAttachmentOptimal,
                                            vk::AttachmentLoadOp::eClear, vk::ClearValue{}, nullptr),
                                 attachment(normal, vk::ImageLayout::eColorAttachmentOptimal,
                                            vk::AttachmentLoadOp::eClear, vk::ClearValue{}, nullptr)};
        const vk::RenderingAttachmentInfo depth_target =
            attachment(depth, vk::ImageLayout::eDepthStencilAttachmentOptimal, vk::AttachmentLoadOp::eClear,
                       vk::ClearDepthStencilValue{0.0f, 0}, nullptr);
        commands.beginRendering(vk::RenderingInfo{.renderArea = {{0, 0}, position.extent},
                                                  .layerCount = 1,
                                                  .colorAttachmentCount = static_cast<std::uint32_t>(targets.size()),
                                                  .pColorAttachments = targets.data(),
                                                  .pDepthAttachment = &depth_target});
        set_area(commands, position.extent);
        draw_items(
            commands, scene, items,
            {.output = LampOutput::kAudit, .lamp_count = lamp_count_, .lookups = lookups_, .format = position.format});
        commands.endRendering();
      });
}

}  // namespace phare
