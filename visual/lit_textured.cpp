// The lit scene's surfaces that look otherwise at every pixel: their shaders, made when a draw first calls for one, and
// what is bound for them.
#include <array>
#include <span>

#include "shaders/lamps_frag_2_filtered_fog_textured.h"
#include "shaders/lamps_frag_2_filtered_shadows_fog_textured.h"
#include "shaders/lamps_frag_2_filtered_shadows_textured.h"
#include "shaders/lamps_frag_2_filtered_textured.h"
#include "shaders/lamps_frag_2_fog_textured.h"
#include "shaders/lamps_frag_2_shadows_fog_textured.h"
#include "shaders/lamps_frag_2_shadows_textured.h"
#include "shaders/lamps_frag_2_textured.h"
#include "shaders/lamps_frag_8_filtered_fog_textured.h"
#include "shaders/lamps_frag_8_filtered_shadows_fog_textured.h"
#include "shaders/lamps_frag_8_filtered_shadows_textured.h"
#include "shaders/lamps_frag_8_filtered_textured.h"
#include "shaders/lamps_frag_8_fog_textured.h"
#include "shaders/lamps_frag_8_shadows_fog_textured.h"
#include "shaders/lamps_frag_8_shadows_textured.h"
#include "shaders/lamps_frag_8_textured.h"
#include "shaders/lamps_frag_reference_fog_textured.h"
#include "shaders/lamps_frag_reference_shadows_fog_textured.h"
#include "shaders/lamps_frag_reference_shadows_textured.h"
#include "shaders/lamps_frag_reference_textured.h"
#include "shaders/scene_vert_2_fog_textured.h"
#include "shaders/scene_vert_2_lit_filtered_fog_textured.h"
#include "shaders/scene_vert_2_lit_filtered_shadows_fog_textured.h"
#include "shaders/scene_vert_2_lit_filtered_shadows_textured.h"
#include "shaders/scene_vert_2_lit_filtered_textured.h"
#include "shaders/scene_vert_2_lit_fog_textured.h"
#include "shaders/scene_vert_2_lit_shadows_fog_textured.h"
#include "shaders/scene_vert_2_lit_shadows_textured.h"
#include "shaders/scene_vert_2_lit_textured.h"
#include "shaders/scene_vert_2_shadows_fog_textured.h"
#include "shaders/scene_vert_2_shadows_textured.h"
#include "shaders/scene_vert_2_textured.h"
#include "shaders/scene_vert_8_lit_filtered_textured.h"
#include "shaders/scene_vert_8_lit_textured.h"
#include "shaders/scene_vert_8_textured.h"
#include "visual/lit_scene.h"
#include "visual/passes/textured_shaders.h"

namespace phare {
namespace {

using Code = std::span<const std::uint32_t>;

/// Bits of the index: shadows, fog, filtered, many lamps.
Code frag_of(bool shadows, bool fog, bool filtered, bool many) {
  static const std::array<Code, 16> codes{k_lamps_frag_2_textured,
                                          k_lamps_frag_2_shadows_textured,
                                          k_lamps_frag_2_fog_textured,
                                          k_lamps_frag_2_shadows_fog_textured,
                                          k_lamps_frag_2_filtered_textured,
                                          k_lamps_frag_2_filtered_shadows_textured,
                                          k_lamps_frag_2_filtered_fog_textured,
                                          k_lamps_frag_2_filtered_shadows_fog_textured,
                                          k_lamps_frag_8_textured,
                                          k_lamps_frag_8_shadows_textured,
                                          k_lamps_frag_8_fog_textured,
                                          k_lamps_frag_8_shadows_fog_textured,
                                          k_lamps_frag_8_filtered_textured,
                                          k_lamps_frag_8_filtered_shadows_textured,
                                          k_lamps_frag_8_filtered_fog_textured,
                                          k_lamps_frag_8_filtered_shadows_fog_textured};
  return codes[(shadows ? 1u : 0u) + (fog ? 2u : 0u) + (filtered ? 4u : 0u) + (many ? 8u : 0u)];
}

/// Of two lamps; bits of the index: shadows, fog, by vertex, and of these filtered.
Code vert_of_two(bool shadows, bool fog, bool by_vertex, bool filtered) {
  static const std::array<Code, 12> codes{k_scene_vert_2_textured,
                                          k_scene_vert_2_shadows_textured,
                                          k_scene_vert_2_fog_textured,
                                          k_scene_vert_2_shadows_fog_textured,
                                          k_scene_vert_2_lit_textured,
                                          k_scene_vert_2_lit_shadows_textured,
                                          k_scene_vert_2_lit_fog_textured,
                                          k_scene_vert_2_lit_shadows_fog_textured,
                                          k_scene_vert_2_lit_filtered_textured,
                                          k_scene_vert_2_lit_filtered_shadows_textured,
                                          k_scene_vert_2_lit_filtered_fog_textured,
                                          k_scene_vert_2_lit_filtered_shadows_fog_textured};
  return codes[(shadows ? 1u : 0u) + (fog ? 2u : 0u) + (by_vertex ? filtered ? 8u : 4u : 0u)];
}

Code reference_frag_of(bool shadows, bool fog) {
  static const std::array<Code, 4> codes{k_lamps_frag_reference_textured, k_lamps_frag_reference_shadows_textured,
                                         k_lamps_frag_reference_fog_textured,
                                         k_lamps_frag_reference_shadows_fog_textured};
  return codes[(shadows ? 1u : 0u) + (fog ? 2u : 0u)];
}

}  // namespace

static_assert(sizeof(GpuCornerLook) == 16 && offsetof(GpuCornerLook, colour) == 8 && sizeof(shader::GpuLook) == 32 &&
              sizeof(shader::GpuRelief) == 16);

namespace {

// Of the buffers: vertices, looks, fixed light, tangents, what asphalt keeps (visual/lit_fixed.cpp), and whence light
// comes on reliefs.
constexpr std::uint32_t kLooksAt = 1, kLightAt = 2, kTangentsAt = 3, kWaysAt = 5;

vk::VertexInputAttributeDescription attribute(std::uint32_t location, std::uint32_t binding, vk::Format format,
                                              std::uint32_t offset) {
  return {.location = location, .binding = binding, .format = format, .offset = offset};
}

}  // namespace

const std::array<vk::VertexInputAttributeDescription, 5> kTexturedAttributes{
    kVertexAttributes[0], kVertexAttributes[1], kVertexAttributes[2],
    attribute(3, kLooksAt, vk::Format::eR32G32Sfloat, 0), attribute(4, kLooksAt, vk::Format::eR16G16B16A16Unorm, 8)};

/// As shaders/scene.vert and lib/textured.glsl have them.
void LitScene::add_textured_vertices(const LitVariant& variant, PipelineRecipe& recipe,
                                     std::vector<vk::VertexInputAttributeDescription>& attributes) {
  attributes.assign(kVertexAttributes.begin(), kVertexAttributes.end());
  std::uint32_t next = 3;
  if (variant.fixed_light) {
    attributes.push_back(attribute(next++, kLightAt, vk::Format::eR32G32B32A32Sfloat, 0));
    attributes.push_back(attribute(next++, kLightAt, vk::Format::eR32Sfloat, variant.moves ? 28 : 16));
    attributes.push_back(variant.moves ? attribute(next++, kLightAt, vk::Format::eR32G32B32Sfloat, 16)
                                       : attribute(next++, kLightAt, vk::Format::eR32Sfloat, 16));
    recipe.third_stride = variant.moves ? sizeof(FixedProbe) : sizeof(FixedVertex);
    recipe.third_by_instance = variant.moves;
  }
  attributes.push_back(attribute(next++, kLooksAt, vk::Format::eR32G32Sfloat, 0));
  attributes.push_back(attribute(next++, kLooksAt, vk::Format::eR16G16B16A16Unorm, 8));
  recipe.second_stride = sizeof(GpuCornerLook);
  if (variant.kind.look & shader::kLookRelief) {
    attributes.push_back(attribute(next++, kTangentsAt, vk::Format::eR8G8B8A8Snorm, 0));
    recipe.fourth_stride = sizeof(CornerLook::tangent);
    if (variant.fixed_light) {
      constexpr std::uint32_t kWayIn = 11;
      // Not read of what moves.
      attributes.push_back(attribute(kWayIn, variant.moves ? kLightAt : kWaysAt, vk::Format::eR32G32B32Sfloat, 0));
      recipe.sixth_stride = variant.moves ? 0u : sizeof(FixedWay);
    }
  }
  recipe.attributes = attributes;
}

struct LitScene::Textured {
  vk::raii::PipelineLayout layout{nullptr}, reference_layout{nullptr};
};

void LitScene::TexturedDeleter::operator()(Textured* textured) const {
  delete textured;
}

LitScene::Textured& LitScene::textured() {
  if (textured_) return *textured_;
  textured_.reset(new Textured);
  const std::array layouts{sets_.layout(), shadow_sets_.layout(), fog_sets_.layout(), geometry_.textures.layout()};
  textured_->layout = pipeline_layout(layouts);
  return *textured_;
}

vk::PipelineLayout LitScene::textured_layout() {
  return *textured().layout;
}

LitScene::Stages LitScene::textured_stages(const LitVariant& variant) {
  const bool reference = variant.method == Method::kReference, many = reference || variant.lamp_count > 2;
  const bool shadows = variant.shadow_maps != 0, fog = variant.fog.slices != 0;
  const bool by_vertex = !reference && variant.method != Method::kFragment;
  static const std::array<Code, 3> of_many{k_scene_vert_8_textured, k_scene_vert_8_lit_textured,
                                           k_scene_vert_8_lit_filtered_textured};
  const TexturedKind apart{.relief = (variant.kind.look & shader::kLookRelief) != 0,
                           .fixed = variant.fixed_light,
                           .road = variant.kind.road,
                           .reference = reference,
                           .filtered = filtered()};
  const bool is_apart = apart.relief || apart.fixed;
  const Code vertex =
      is_apart ? textured_vert(apart, by_vertex)
      : many ? of_many[by_vertex ? filtered() ? 2u : 1u : 0u] : vert_of_two(shadows, fog, by_vertex, filtered());
  if (!reference)
    return {
        vertex,
        {is_apart ? textured_frag(apart, shadows, fog) : frag_of(shadows, fog, filtered(), many), *textured().layout}};
  Textured& own = textured();
  if (!*own.reference_layout) {
    const std::array layouts{sets_.layout(), shadow_sets_.layout(), fog_sets_.layout(), reference_layout(),
                             geometry_.textures.layout()};
    own.reference_layout = pipeline_layout(layouts);
  }
  return {vertex,
          {is_apart ? textured_frag(apart, shadows, fog) : reference_frag_of(shadows, fog), *own.reference_layout}};
}

void LitScene::bind_look(gpu::Recorder& commands, const SceneBatch& batch, bool reference) {
  const vk::PipelineLayout layout = reference ? *textured().reference_layout : *textured().layout;
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, reference ? 4 : 3,
                              geometry_.textures.set(batch.look_of), nullptr);
  const std::array buffers{*geometry_.vertices.buffer, *geometry_.looks.buffer};
  const std::array<vk::DeviceSize, 2> offsets{static_cast<vk::DeviceSize>(batch.first_vertex) * sizeof(GpuVertex),
                                              static_cast<vk::DeviceSize>(batch.first_look) * sizeof(GpuCornerLook)};
  commands.bindVertexBuffers(0, buffers, offsets);
  if (batch.kind.look & shader::kLookRelief)
    commands.bindVertexBuffers(kTangentsAt, *geometry_.tangents.buffer,
                               static_cast<vk::DeviceSize>(batch.first_tangent) * sizeof(CornerLook::tangent));
}

void LitScene::bind_fixed_light_of_look(gpu::Recorder& commands, const LitView& view, const DrawItem& item) const {
  if (item.moves != DrawItem::kStands)
    commands.bindVertexBuffers(kLightAt, *written_->probes[(view.first_probe + item.moves) / kProbesInPage]->buffer,
                               vk::DeviceSize{0});
  else
    commands.bindVertexBuffers(kLightAt, *geometry_.fixed_light.buffer,
                               static_cast<vk::DeviceSize>(item.batch->first_vertex) * sizeof(FixedVertex));
  if (item.moves == DrawItem::kStands && (item.batch->kind.look & shader::kLookRelief) != 0)
    commands.bindVertexBuffers(kWaysAt, *geometry_.ways.buffer,
                               static_cast<vk::DeviceSize>(item.batch->first_tangent) * sizeof(FixedWay));
}

void LitScene::bind_vertices(gpu::Recorder& commands) const {
  commands.bindVertexBuffers(0, *geometry_.vertices.buffer, vk::DeviceSize{0});
}

}  // namespace phare
