#include "visual/lit_scene.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "visual/passes/constants.h"

namespace phare {

const std::array<vk::VertexInputAttributeDescription, 3> kVertexAttributes{
    vk::VertexInputAttributeDescription{
        .location = 0, .binding = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = 0},
    vk::VertexInputAttributeDescription{
        .location = 1, .binding = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = 12},
    vk::VertexInputAttributeDescription{.location = 2, .binding = 0, .format = vk::Format::eR32Uint, .offset = 24}};

const std::array<vk::DescriptorSetLayoutBinding, 1> kShadowBindings{
    vk::DescriptorSetLayoutBinding{.binding = 0,
                                   .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                                   .descriptorCount = 1,
                                   .stageFlags = kLitStages | vk::ShaderStageFlagBits::eCompute}};

const std::array<vk::DescriptorSetLayoutBinding, 2> kFogBindings{
    vk::DescriptorSetLayoutBinding{.binding = 0,
                                   .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eFragment},
    vk::DescriptorSetLayoutBinding{.binding = 1,
                                   .descriptorType = vk::DescriptorType::eUniformTexelBuffer,
                                   .descriptorCount = 1,
                                   .stageFlags = vk::ShaderStageFlagBits::eFragment}};

namespace {

// std140 and std430 agree for these: all members are 16 bytes.
static_assert(sizeof(shader::GpuLamp) == 80 && offsetof(shader::GpuLamp, colour) == 64);
static_assert(sizeof(shader::TableShape) == 4 * shader::kSpecPerTable && offsetof(shader::TableShape, unit) == 80);
static_assert(offsetof(shader::GpuFrame, exposure) == 64 && offsetof(shader::GpuFrame, lamps) == 128);
static_assert(sizeof(shader::GpuFog) == 112 && sizeof(shader::GpuShape) == 96);
static_assert(sizeof(shader::GpuFrame) == 96 + 4 * shader::kMaxIsoluxLevels + shader::kMaxLamps * (80 + 64 + 96) +
                                              sizeof(shader::GpuFog) + 32 + 32 * shader::kMirroredLamps);
static_assert(sizeof(shader::GpuDraw) == 80 && sizeof(shader::GpuMaterial) == 16);
static_assert(sizeof(shader::GpuSheeting) == 96 && std::tuple_size_v<decltype(Retroreflection::ln_r_a)> == 6);
static_assert(static_cast<std::uint32_t>(RetroKind::kSheeting) == shader::kRetroSheeting &&
              static_cast<std::uint32_t>(RetroKind::kMarking) == shader::kRetroMarking &&
              static_cast<std::uint32_t>(RetroKind::kFacets) == shader::kRetroFacets &&
              static_cast<std::uint32_t>(RetroKind::kGrooves) == shader::kRetroGrooves);
static_assert(sizeof(GpuVertex) == 28 && offsetof(GpuVertex, normal) == 12 && offsetof(GpuVertex, material) == 24);
static_assert(shader::kMaxIsoluxLevels % 4 == 0);
static_assert(static_cast<std::uint32_t>(Method::kVertex) == shader::kMethodVertex &&
              static_cast<std::uint32_t>(Method::kVertex1998) == shader::kMethodVertex1998 &&
              static_cast<std::uint32_t>(Method::kReference) == shader::kMethodReference);

bool is_filtered(ImageLevel level) {
  return level == ImageLevel::kNormalised8 || level == ImageLevel::kHalfEven;
}

/// As shaders/lib/lamp_bindings.glsl has them.
std::vector<vk::DescriptorSetLayoutBinding> bindings(bool filtered) {
  using Type = vk::DescriptorType;
  const std::uint32_t tables = filtered ? 1u : shader::kMaxLamps, filters = filtered ? shader::kMaxLamps : 1u;
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (const auto& [binding, type, count] :
       {std::tuple(0u, Type::eUniformBufferDynamic, 1u), std::tuple(1u, Type::eUniformTexelBuffer, tables),
        std::tuple(2u, Type::eUniformTexelBuffer, tables), std::tuple(3u, Type::eUniformBuffer, 1u),
        std::tuple(4u, Type::eUniformTexelBuffer, 1u), std::tuple(5u, Type::eUniformBuffer, 1u),
        std::tuple(6u, Type::eUniformTexelBuffer, tables), std::tuple(7u, Type::eCombinedImageSampler, filters),
        std::tuple(8u, Type::eCombinedImageSampler, filters)})
    bindings.push_back({.binding = binding,
                        .descriptorType = type,
                        .descriptorCount = count,
                        .stageFlags = kLitStages | vk::ShaderStageFlagBits::eCompute});
  return bindings;
}

vk::MultiDrawIndexedInfoEXT triangles_of(const DrawItem& item) {
  return {.firstIndex = item.first_index, .indexCount = item.index_count, .vertexOffset = item.batch->first_vertex};
}

}  // namespace

LitScene::LitScene(gpu::Device& device, ImageLevel level)
    : device_(device),
      level_(level),
      beams_(device),
      grain_(make_grain(device)),
      sets_(device, bindings(is_filtered(level))),
      shadow_sets_(device, kShadowBindings),
      fog_sets_(device, kFogBindings) {
  const std::array set_layouts{sets_.layout(), shadow_sets_.layout(), fog_sets_.layout()};
  layout_ = pipeline_layout(set_layouts);
  filter_sampler_ =
      vk::raii::Sampler(device.device, vk::SamplerCreateInfo{.magFilter = vk::Filter::eLinear,
                                                             .minFilter = vk::Filter::eLinear,
                                                             .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                                             .addressModeV = vk::SamplerAddressMode::eClampToEdge});
  const vk::DeviceSize step = std::max<vk::DeviceSize>(device.properties.limits.minUniformBufferOffsetAlignment, 1);
  stride_ = (sizeof(shader::GpuFrame) + step - 1) / step * step;
}

vk::raii::PipelineLayout LitScene::pipeline_layout(std::span<const vk::DescriptorSetLayout> sets) {
  const vk::PushConstantRange push{.stageFlags = kLitStages, .offset = 0, .size = sizeof(shader::GpuDraw)};
  return vk::raii::PipelineLayout(
      device_.device, vk::PipelineLayoutCreateInfo{.setLayoutCount = static_cast<std::uint32_t>(sets.size()),
                                                   .pSetLayouts = sets.data(),
                                                   .pushConstantRangeCount = 1,
                                                   .pPushConstantRanges = &push});
}

void LitScene::set_geometry(SceneBuffers geometry, ShadowCasters casters, std::shared_ptr<const FixedLight> light) {
  being_made_.reset();
  geometry_ = std::move(geometry);
  fixed_light_ = std::move(light);
  casters_ = std::move(casters);
  ++geometry_version_;
  kept_casters_.clear();
  ++beams_made_;
}

void LitScene::set_beam(std::size_t beam, const BeamImage& image) {
  beams_.set(beam, image, level_);
  if (cones_.size() <= beam) cones_.resize(beam + 1, LightCone{.half_angle_rad = -1.0});
  beam_versions_.resize(cones_.size());
  ++beam_versions_[beam];
  cones_[beam] = light_cone(image);
  peaks_.resize(cones_.size());
  peaks_[beam].set(image);
  peaks_cd_.resize(cones_.size());
  keep_image(beam, image, {});
  peaks_cd_[beam] = image.candela.empty() ? 0.0f : *std::ranges::max_element(image.candela);
}

void LitScene::change_beam(std::size_t beam, const BeamImage& image, std::span<const TexelRect> changed) {
  beams_.change(beam, image, changed);
  ++beam_versions_[beam];
  cones_[beam] = light_cone_after(cones_[beam], image, changed);
  peaks_[beam].change(image, changed);
  if (!changed.empty()) keep_image(beam, image, changed);
  for (const TexelRect& rect : changed)
    for (std::size_t row = rect.row; row < rect.end_row; ++row)
      for (std::size_t column = rect.column; column < rect.end_column; ++column)
        peaks_cd_[beam] = std::max(peaks_cd_[beam], image.candela[row * image.first_deg.size() + column]);
}

void LitScene::begin_frame(gpu::FrameGraph& graph, ShapesFrom shapes) {
  Written& written = *written_;
  written.views = written.probes_used = 0;
  shapes_ = shapes;
  reference_begun_ = false;
  kept_casters_.begin_frame();
  if (beams_.upload(graph)) ++beams_made_;
  // A set may name a buffer or an image that is no more.
  if (std::exchange(written.names_of, beams_made_) == beams_made_ && written.set_of.size() <= kMostSets) return;
  written.set_of.clear();
  sets_.begin_frame();
}

bool LitScene::filtered() const {
  return is_filtered(level_);
}

std::vector<std::uint32_t> LitScene::table_words(std::size_t tables, bool shown) const {
  std::vector<std::uint32_t> all;
  for (shader::TableShape shape : table_shapes_[tables]) {
    const std::uint32_t kind = shape.lookup & shader::kLookupKind;
    if (shown && (kind == shader::kLookupAhead || (shape.lookup & shader::kLookupLast) != 0))
      shape.lookup |= shader::kLookupShown;
    const auto words = std::bit_cast<std::array<std::uint32_t, shader::kSpecPerTable>>(shape);
    all.insert(all.end(), words.begin(), words.end());
  }
  return all;
}

bool LitScene::reads_shapes(std::size_t tables) const {
  const std::vector<shader::TableShape>& shapes = table_shapes_[tables];
  return !shapes.empty() && (shapes.front().lookup & shader::kLookupOfFrame) != 0;
}

std::size_t LitScene::tables_of(std::vector<shader::TableShape> shapes) {
  const auto same = [&](const std::vector<shader::TableShape>& known) {
    return std::ranges::equal(std::as_bytes(std::span(known)), std::as_bytes(std::span(shapes)));
  };
  const auto found = std::ranges::find_if(table_shapes_, same);
  const auto index = static_cast<std::size_t>(found - table_shapes_.begin());
  if (found == table_shapes_.end()) table_shapes_.push_back(std::move(shapes));
  return index;
}

vk::DescriptorSet LitScene::set_of(std::size_t page, const Beams& beams) {
  const auto [found, fresh] = written_->set_of.try_emplace({page, beams});
  if (!fresh) return found->second;
  const vk::DescriptorSet set = found->second = sets_.make();
  using Type = vk::DescriptorType;
  const std::array buffers{std::tuple(0u, Type::eUniformBufferDynamic,
                                      vk::DescriptorBufferInfo{*written_->pages[page]->buffer, 0, sizeof(shader::GpuFrame)}),
                           std::tuple(3u, Type::eUniformBuffer,
                                      vk::DescriptorBufferInfo{*geometry_.material_buffer.buffer, 0, VK_WHOLE_SIZE}),
                           std::tuple(5u, Type::eUniformBuffer,
                                      vk::DescriptorBufferInfo{*geometry_.sheeting_buffer.buffer, 0, VK_WHOLE_SIZE})};
  const auto layout = vk::ImageLayout::eShaderReadOnlyOptimal;
  std::array<vk::BufferView, shader::kMaxLamps> guides, cells, tints;
  std::array<vk::DescriptorImageInfo, shader::kMaxLamps> filtered, filtered_tints;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    guides[i] = beams_.guide(beams[i]);
    cells[i] = beams_.cells(beams[i]);
    tints[i] = beams_.tint(beams[i]);
    filtered[i] = {*filter_sampler_, *beams_.filtered(beams[i]).view, layout};
    filtered_tints[i] = {*filter_sampler_, *beams_.filtered_tint(beams[i]).view, layout};
  }
  // Of what this level does not read, one.
  const std::size_t tables = is_filtered(level_) ? 1 : beams.size(), filters = is_filtered(level_) ? beams.size() : 1;
  std::vector<vk::WriteDescriptorSet> writes;
  for (const auto& [binding, type, info] : buffers)
    writes.push_back(
        {.dstSet = set, .dstBinding = binding, .descriptorCount = 1, .descriptorType = type, .pBufferInfo = &info});
  for (const auto& [binding, infos] :
       {std::pair(7u, std::span<const vk::DescriptorImageInfo>(filtered).first(filters)),
        std::pair(8u, std::span<const vk::DescriptorImageInfo>(filtered_tints).first(filters))})
    writes.push_back({.dstSet = set,
                      .dstBinding = binding,
                      .descriptorCount = static_cast<std::uint32_t>(infos.size()),
                      .descriptorType = Type::eCombinedImageSampler,
                      .pImageInfo = infos.data()});
  const vk::BufferView grain = *grain_.view;
  for (const auto& [binding, views] : {std::pair(1u, std::span<const vk::BufferView>(guides).first(tables)),
                                       std::pair(2u, std::span<const vk::BufferView>(cells).first(tables)),
                                       std::pair(4u, std::span<const vk::BufferView>(&grain, 1)),
                                       std::pair(6u, std::span<const vk::BufferView>(tints).first(tables))})
    writes.push_back({.dstSet = set,
                      .dstBinding = binding,
                      .descriptorCount = static_cast<std::uint32_t>(views.size()),
                      .descriptorType = Type::eUniformTexelBuffer,
                      .pTexelBufferView = views.data()});
  device_.device.updateDescriptorSets(writes, nullptr);
  return set;
}

void LitScene::bind(gpu::Recorder& commands, const LitBy& lit_by) const {
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, lit_by.set, lit_by.data_at);
}

void LitScene::bind(gpu::Recorder& commands, const LitView& view) const {
  bind(commands, view.lit_by.front());
  commands.bindVertexBuffers(0, *geometry_.vertices.buffer, vk::DeviceSize{0});
  commands.bindIndexBuffer(*geometry_.indices.buffer, 0, vk::IndexType::eUint32);
}

void LitScene::bind_shadows(gpu::Recorder& commands, const LitView& view) const {
  if (view.depths != nullptr)
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 1, view.depths->set, nullptr);
}

void LitScene::bind_fog(gpu::Recorder& commands, const LitView& view) const {
  if (view.fog_set) commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 2, view.fog_set, nullptr);
}

void LitScene::push(vk::CommandBuffer commands, const shader::GpuDraw& draw) const {
  commands.pushConstants<shader::GpuDraw>(*layout_, kLitStages, 0, draw);
}

std::vector<LitVariant> LitScene::variants_of(const LitView& view, std::span<const DrawItem> items,
                                              const LitVariant& common) const {
  std::vector<LitVariant> variants;
  variants.reserve(items.size());
  for (const DrawItem& item : items)
    variants.push_back(variant_of(view, item, common, variants.empty() ? nullptr : &variants.back()));
  return variants;
}

std::vector<DrawItem> LitScene::shadowed_next(const LitView& view) {
  std::vector<DrawItem> items;
  if (view.depths == nullptr) return items;
  for (DrawItem item : view.items)
    if (!std::exchange(item.shadowed, true)) items.push_back(item);
  return items;
}

void LitScene::prepare(const LitView& view, const LitVariant& common) {
  std::vector<LitVariant> variants = variants_of(view, view.items, common);
  std::ranges::copy(variants_of(view, shadowed_next(view), common), std::back_inserter(variants));
  if (!rehearsal_) {
    (void)pipelines(variants);
    return;
  }
  std::set<LitVariant> missing;
  std::ranges::copy_if(variants, std::inserter(missing, missing.end()),
                       [&](const LitVariant& variant) { return !pipelines_.contains(variant); });
  make_beside(missing);
}

std::vector<DrawItem> LitScene::rehearsed(const LitView& view, const LitVariant& common) {
  std::vector<DrawItem> all = view.items;
  std::ranges::copy(shadowed_next(view), std::back_inserter(all));
  const std::vector<LitVariant> variants = variants_of(view, all, common);
  std::set<LitVariant> missing, waiting;
  std::vector<DrawItem> drawn;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!pipelines_.contains(variants[i])) {
      missing.insert(variants[i]);
    } else if (undrawn_.contains(variants[i])) {
      if (drawn.size() < rehearsal_->most) {
        drawn.push_back(all[i]);
        undrawn_.erase(variants[i]);
      } else {
        waiting.insert(variants[i]);
      }
    }
  }
  rehearsal_->left += waiting.size();
  make_beside(missing);
  return drawn;
}

void LitScene::draw(gpu::Recorder& commands, const LitView& view, const LitVariant& common) {
  if (rehearsal_) {
    const std::vector<DrawItem> items = rehearsed(view, common);
    draw_items(commands, view, items, variants_of(view, items, common));
    return;
  }
  std::vector<LitVariant> variants = variants_of(view, view.items, common);
  std::ranges::copy(variants_of(view, shadowed_next(view), common), std::back_inserter(variants));
  draw_items(commands, view, view.items, variants);
}

void LitScene::draw_items(gpu::Recorder& commands, const LitView& view, std::span<const DrawItem> items,
                          std::span<const LitVariant> variants) {
  if (items.empty()) return;
  const std::vector<vk::Pipeline> wanted = pipelines(variants);
  bind(commands, view);
  bind_shadows(commands, view);
  bind_fog(commands, view);
  const bool by_reference = view.method == Method::kReference;
  if (by_reference) bind_reference(commands, view, view.lit_by.front());
  std::size_t lit_by = 0;
  bool plain = true;  // the vertices are bound as those without a look take them
  vk::Pipeline bound;
  vk::Buffer bound_light;
  std::vector<vk::MultiDrawIndexedInfoEXT> run;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const DrawItem& item = items[i];
    const LitVariant& variant = variants[i];
    const bool look = variant.kind.look != 0, apart = look || variant.kind.road;
    if (item.lit_by != std::exchange(lit_by, item.lit_by)) {
      bind(commands, view.lit_by[lit_by]);
      if (by_reference) bind_reference(commands, view, view.lit_by[lit_by]);
    }
    if (wanted[i] != bound) commands.bindPipeline(vk::PipelineBindPoint::eGraphics, bound = wanted[i]);
    push(commands, by_reference ? reference_draw(item) : item.push);
    if (look) {
      bind_look(commands, *item.batch, by_reference);
      bound_light = nullptr;
      if (variant.fixed_light) bind_fixed_light_of_look(commands, view, item);
    } else if (variant.kind.road) {
      bound_light = nullptr;
    } else {
      if (variant.fixed_light) bind_fixed_light(commands, view, item, bound_light);
      if (!plain) bind_vertices(commands);
    }
    if (variant.kind.road) bind_road(commands, *item.batch);
    plain = !apart;
    if (apart || variant.moves || by_reference) {
      commands.drawIndexed(item.index_count, 1, item.first_index, apart ? 0 : item.batch->first_vertex,
                           variant.moves ? probe_in_page(view, item) : 0);
      continue;
    }
    // With those that follow and differ in their triangles alone.
    run = {triangles_of(item)};
    while (i + 1 < items.size() && wanted[i + 1] == bound && items[i + 1].lit_by == lit_by &&
           items[i + 1].is_placed_as(item))
      run.push_back(triangles_of(items[++i]));
    commands.drawIndexed(run);
  }
}

}  // namespace phare
