// The lit scene's pipelines: which of its shaders a draw takes, and with what numbers.
#include <array>
#include <deque>
#include <set>
#include <span>
#include <utility>

#include "shaders/lamps_frag_2.h"
#include "shaders/lamps_frag_2_filtered.h"
#include "shaders/lamps_frag_2_filtered_shadows.h"
#include "shaders/lamps_frag_2_shadows.h"
#include "shaders/lamps_frag_4.h"
#include "shaders/lamps_frag_4_filtered.h"
#include "shaders/lamps_frag_4_filtered_shadows.h"
#include "shaders/lamps_frag_4_shadows.h"
#include "shaders/lamps_frag_8.h"
#include "shaders/lamps_frag_8_filtered.h"
#include "shaders/lamps_frag_8_filtered_shadows.h"
#include "shaders/lamps_frag_8_shadows.h"
#include "shaders/measure_vert_2.h"
#include "shaders/measure_vert_2_shadows.h"
#include "shaders/measure_vert_4.h"
#include "shaders/measure_vert_4_shadows.h"
#include "shaders/measure_vert_8.h"
#include "shaders/measure_vert_8_shadows.h"
#include "shaders/scene_vert_2.h"
#include "shaders/scene_vert_2_lit.h"
#include "shaders/scene_vert_2_lit_filtered.h"
#include "shaders/scene_vert_2_lit_filtered_shadows.h"
#include "shaders/scene_vert_2_lit_shadows.h"
#include "shaders/scene_vert_2_shadows.h"
#include "shaders/scene_vert_4.h"
#include "shaders/scene_vert_4_lit.h"
#include "shaders/scene_vert_4_lit_filtered.h"
#include "shaders/scene_vert_4_lit_filtered_shadows.h"
#include "shaders/scene_vert_4_lit_shadows.h"
#include "shaders/scene_vert_4_shadows.h"
#include "shaders/scene_vert_8.h"
#include "shaders/scene_vert_8_lit.h"
#include "shaders/scene_vert_8_lit_filtered.h"
#include "shaders/scene_vert_8_lit_filtered_shadows.h"
#include "shaders/scene_vert_8_lit_shadows.h"
#include "shaders/scene_vert_8_shadows.h"
#include "visual/lean_shaders.h"
#include "visual/lit_scene.h"
#include "visual/passes/fixed_shaders.h"

namespace phare {
namespace {

/// What water wets in the picture; what stands upright lets it run off.
bool is_ground(Surface surface) {
  return surface == Surface::kAsphalt || surface == Surface::kGrass || surface == Surface::kPaint;
}

std::span<const std::uint32_t> measure_vert(std::size_t size) {
  static const std::array<std::span<const std::uint32_t>, 6> codes{k_measure_vert_2,         k_measure_vert_4,
                                                                   k_measure_vert_8,         k_measure_vert_2_shadows,
                                                                   k_measure_vert_4_shadows, k_measure_vert_8_shadows};
  return codes[size];
}

LeanKind lean_kind(const LitVariant& variant) {
  using Surface = LeanKind::Surface;
  const MaterialKind& kind = variant.kind;
  const bool plain = kind.surface == phare::Surface::kPlain && kind.retro == RetroKind::kNone && !kind.double_sided &&
                     variant.output != LampOutput::kAudit;
  return {.surface = !kind.flat ? Surface::kSmooth
                     : plain    ? Surface::kPlain
                                : Surface::kFlat,
          .alike = variant.alike,
          .shadows = variant.shadow_maps != 0};
}

}  // namespace

LitVariant LitScene::variant_of(const LitView& view, const DrawItem& item, const LitVariant& common,
                                const LitVariant* before) const {
  const LitBy& lit = view.lit_by[item.lit_by];
  LitVariant own = variant_for(lit.tables, view, item, common);
  const auto made = [&](std::size_t tables) {
    return pipelines_.contains(tables == lit.tables ? own : variant_for(tables, view, item, common));
  };
  // Most items are as the one before.
  if (shapes_ == ShapesFrom::kPipeline || (before != nullptr && own == *before)) return own;
  const std::size_t tables = tables_for(lit, made);
  return tables == lit.tables ? own : variant_for(tables, view, item, common);
}

LitVariant LitScene::variant_for(std::size_t tables, const LitView& view, const DrawItem& item,
                                 const LitVariant& common) const {
  const LitBy& lit = view.lit_by[item.lit_by];
  LitVariant variant = common;
  variant.lamp_count = lit.lamps;
  variant.tables = tables;
  variant.colours = common.output == LampOutput::kAudit ? 0 : lit.colours;
  variant.kind = item.batch->kind;
  variant.method = view.method;
  variant.shadow_maps = item.shadowed && common.output != LampOutput::kAudit ? lit.shadow_maps : 0;
  variant.shadows = variant.shadow_maps != 0 ? view.shadows : ShadowLevel{};
  variant.bent = variant.shadow_maps != 0 && !view.shadows.by_rays() && item.batch->bent;
  if (common.output == LampOutput::kDisplay || common.output == LampOutput::kHdr ||
      common.output == LampOutput::kClipping)
    variant.fog = view.fog;
  const bool sheltered = std::exchange(variant.kind.sheltered, false);
  if (variant.output != LampOutput::kAudit && is_ground(variant.kind.surface)) variant.wet = view.wet && !sheltered;
  if (view.snow && !sheltered && variant.output != LampOutput::kAudit) {
    const bool marking = variant.kind.retro == RetroKind::kMarking;
    variant.snow = marking ? shader::kSnowOnMarking : shader::kSnowLies;
    if (marking) variant.kind.retro = RetroKind::kFacets;
  }
  variant.fixed_light = view.fixed_light && variant.output != LampOutput::kAudit;
  variant.moves = variant.fixed_light && item.moves != DrawItem::kStands;
  variant.kind.road = variant.kind.road && variant.fixed_light && view.r_table;
  if (shows_lux(variant.output)) {  // whatever the surface does with it
    variant.kind.surface = Surface::kPlain;
    variant.kind.retro = RetroKind::kNone;
    variant.colours = 0;
  }
  if (variant.output == LampOutput::kAudit) {
    const std::uint32_t look = variant.kind.look;
    variant.kind = {.double_sided = variant.kind.double_sided,
                    .flat = variant.kind.flat,
                    .look = look & shader::kLookCut ? look & ~shader::kLookRelief : 0u};
  }
  if (is_lean(variant)) {
    variant.alike = lit.alike;
    variant.bent = variant.bent && !variant.kind.flat;
  } else {
    variant.kind.flat = false;  // of no account
  }
  return variant;
}

bool LitScene::is_lean(const LitVariant& variant) const {
  return variant.lamp_count <= 2 && !reads_shapes(variant.tables) && variant.colours == 0 && variant.kind.look == 0 &&
         !variant.fixed_light && variant.fog.slices == 0 && !variant.wet && variant.snow == LitVariant::kNoSnow &&
         variant.method == Method::kFragment && !filtered() &&
         (variant.output == LampOutput::kDisplay || variant.output == LampOutput::kHdr ||
          variant.output == LampOutput::kClipping || variant.output == LampOutput::kAudit);
}

std::vector<vk::Pipeline> LitScene::pipelines(std::span<const LitVariant> variants) {
  std::vector<vk::Pipeline> all;
  all.reserve(variants.size());
  std::set<LitVariant> missing;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (i > 0 && variants[i] == variants[i - 1]) {
      all.push_back(all.back());
      continue;
    }
    const auto found = pipelines_.find(variants[i]);
    if (found == pipelines_.end()) missing.insert(variants[i]);
    all.push_back(found != pipelines_.end() ? *found->second : vk::Pipeline());
  }
  if (missing.empty()) return all;
  std::deque<Recipe> recipes;
  std::vector<const PipelineRecipe*> wanted;
  for (const LitVariant& variant : missing) {
    write_recipe(variant, recipes.emplace_back());
    wanted.push_back(&recipes.back().pipeline);
  }
  std::vector<vk::raii::Pipeline> made = make_pipelines(device_, wanted);
  auto pipeline = made.begin();
  for (const LitVariant& variant : missing) pipelines_.emplace(variant, std::move(*pipeline++));
  return pipelines(variants);
}

void LitScene::make_beside(const std::set<LitVariant>& missing) {
  rehearsal_->left += missing.size();
  if (missing.empty() || being_made_) return;
  being_made_ = std::make_unique<BeingMade>();
  BeingMade& making = *being_made_;
  std::vector<const PipelineRecipe*> wanted;
  for (const LitVariant& variant : missing) {
    making.variants.push_back(variant);
    write_recipe(variant, making.recipes.emplace_back());
    wanted.push_back(&making.recipes.back().pipeline);
  }
  making.made =
      std::async(std::launch::async, [&device = device_, wanted = std::move(wanted), stop = making.stop.get_token()] {
        return make_in_turn(device, wanted, stop);
      });
}

void LitScene::take_made() {
  if (!being_made_ || !being_made_->is_done()) return;
  const std::unique_ptr<BeingMade> done = std::move(being_made_);
  std::vector<vk::raii::Pipeline> made = done->made.get();
  for (std::size_t i = 0; i < made.size(); ++i) {
    // One of a light that was switched on meanwhile may be there.
    if (!pipelines_.emplace(done->variants[i], std::move(made[i])).second) continue;
    undrawn_.insert(done->variants[i]);
    ++*device_.pipelines_made;
  }
}

void LitScene::write_recipe(const LitVariant& variant, Recipe& to) {
  SpecConstants& numbers = to.numbers;
  numbers.put_all(0, std::array<std::uint32_t, shader::kSpecTables>{
                         variant.lamp_count, static_cast<std::uint32_t>(variant.kind.surface),
                         static_cast<std::uint32_t>(variant.kind.retro), static_cast<std::uint32_t>(variant.output),
                         variant.lamp_base, variant.colours, variant.kind.double_sided ? 2u : 1u, grain_.first_level,
                         variant.shadow_maps, variant.shadows.width, variant.shadows.height, variant.shadows.taps,
                         static_cast<std::uint32_t>(variant.method), variant.fog.lamps,
                         variant.fog.columns | variant.fog.rows << 16u, variant.fog.slices});
  const bool shown = (variant.output == LampOutput::kDisplay || variant.output == LampOutput::kClipping) &&
                     variant.method == Method::kFragment;
  numbers.put_all(shader::kSpecTables, table_words(variant.tables, shown));
  const bool textured = variant.kind.look != 0;
  if (textured) numbers.put(shader::kSpecLook, variant.kind.look);
  if (variant.wet) numbers.put(shader::kSpecWet, 1);
  if (variant.snow != LitVariant::kNoSnow) numbers.put(shader::kSpecSnow, variant.snow);
  if (variant.moves) numbers.put(shader::kSpecMoves, 1);
  if (variant.bent) numbers.put(shader::kSpecBent, 1);
  to.constants = numbers.info();
  const bool measure = variant.output == LampOutput::kMeasure;
  // By "reference" one shader serves any number of lamps: its time goes elsewhere.
  const std::size_t size = shader_for(variant.method == Method::kReference ? shader::kMaxLamps : variant.lamp_count) +
                           (variant.shadow_maps != 0 ? 3u : 0u);
  Stages stages;
  if (is_lean(variant)) {
    const LeanCode& lean = lean_code(lean_kind(variant));
    stages = {lean.vertex, {lean.fragment, *layout_}};
  } else if (textured) {
    stages = textured_stages(variant);
  } else {
    stages.fragment = variant.method == Method::kReference ? reference_stage(variant) : fragment_stage(variant, size);
    stages.vertex = measure ? measure_vert(size) : scene_vert(size, variant.method, variant.fog.slices != 0);
  }
  std::span<const vk::VertexInputAttributeDescription> attributes = std::span(kVertexAttributes).first(measure ? 2 : 3);
  PipelineRecipe& recipe = to.pipeline;
  recipe = {.vertex_code = stages.vertex,
            .fragment_code = stages.fragment.code,
            .constants = &to.constants,
            .attributes = attributes,
            .stride = sizeof(GpuVertex),
            .topology = measure ? vk::PrimitiveTopology::ePointList : vk::PrimitiveTopology::eTriangleList,
            .cull = variant.kind.double_sided || measure ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack,
            .colour = {variant.format},
            .depth = !measure,
            .depth_write = !measure && !variant.depth_done,
            .compare = variant.depth_done ? vk::CompareOp::eEqual : vk::CompareOp::eGreater,
            .samples = variant.samples,
            .layout = stages.fragment.layout};
  if (variant.output == LampOutput::kAudit) recipe.colour.push_back(variant.format);
  std::vector<vk::VertexInputAttributeDescription>& own = to.attributes;
  if (textured) {
    add_textured_vertices(variant, recipe, own);
  } else if (variant.fixed_light) {
    recipe.vertex_code = fixed_vertex(variant, size);
    recipe.attributes = variant.moves ? kProbeAttributes : kFixedAttributes;
    recipe.second_stride = variant.moves ? sizeof(FixedProbe) : sizeof(FixedVertex);
    recipe.second_by_instance = variant.moves;
    if (variant.kind.road) own.assign(kFixedAttributes.begin(), kFixedAttributes.end());
  }
  if (variant.kind.road) add_road_vertices(recipe, own);
}

LitScene::FragmentStage LitScene::fragment_stage(const LitVariant& variant, std::size_t size) {
  const bool fog = variant.fog.slices != 0;
  if (variant.fixed_light) return {fixed_frag(size, filtered(), fog), *layout_};
  if (fog) return {lamps_fog_frag(size, filtered()), *layout_};
  static const std::array<Code, 6> tables{k_lamps_frag_2,         k_lamps_frag_4,         k_lamps_frag_8,
                                          k_lamps_frag_2_shadows, k_lamps_frag_4_shadows, k_lamps_frag_8_shadows};
  static const std::array<Code, 6> filters{k_lamps_frag_2_filtered,         k_lamps_frag_4_filtered,
                                           k_lamps_frag_8_filtered,         k_lamps_frag_2_filtered_shadows,
                                           k_lamps_frag_4_filtered_shadows, k_lamps_frag_8_filtered_shadows};
  return {(filtered() ? filters : tables)[size], *layout_};
}

LitScene::Code LitScene::scene_vert(std::size_t size, Method method, bool fog) const {
  const bool by_vertex = method != Method::kFragment && method != Method::kReference;
  if (fog && size % 3 == 0) return scene_fog_vert(size != 0, by_vertex, filtered());
  static const std::array<Code, 6> plain{k_scene_vert_2,         k_scene_vert_4,         k_scene_vert_8,
                                         k_scene_vert_2_shadows, k_scene_vert_4_shadows, k_scene_vert_8_shadows};
  static const std::array<Code, 6> tables{k_scene_vert_2_lit,         k_scene_vert_4_lit,
                                          k_scene_vert_8_lit,         k_scene_vert_2_lit_shadows,
                                          k_scene_vert_4_lit_shadows, k_scene_vert_8_lit_shadows};
  static const std::array<Code, 6> filters{k_scene_vert_2_lit_filtered,         k_scene_vert_4_lit_filtered,
                                           k_scene_vert_8_lit_filtered,         k_scene_vert_2_lit_filtered_shadows,
                                           k_scene_vert_4_lit_filtered_shadows, k_scene_vert_8_lit_filtered_shadows};
  return (!by_vertex ? plain : filtered() ? filters : tables)[size];
}

}  // namespace phare
