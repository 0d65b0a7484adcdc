// Apart, for their code is long and one file needs it.
#include "visual/passes/textured_shaders.h"

#include <array>

#include "shaders/lamps_frag_8_filtered_fog_textured_fixed.h"
#include "shaders/lamps_frag_8_filtered_fog_textured_relief.h"
#include "shaders/lamps_frag_8_filtered_fog_textured_relief_fixed.h"
#include "shaders/lamps_frag_8_filtered_shadows_fog_textured_fixed.h"
#include "shaders/lamps_frag_8_filtered_shadows_fog_textured_relief.h"
#include "shaders/lamps_frag_8_filtered_shadows_fog_textured_relief_fixed.h"
#include "shaders/lamps_frag_8_filtered_shadows_textured_fixed.h"
#include "shaders/lamps_frag_8_filtered_shadows_textured_relief.h"
#include "shaders/lamps_frag_8_filtered_shadows_textured_relief_fixed.h"
#include "shaders/lamps_frag_8_filtered_textured_fixed.h"
#include "shaders/lamps_frag_8_filtered_textured_relief.h"
#include "shaders/lamps_frag_8_filtered_textured_relief_fixed.h"
#include "shaders/lamps_frag_8_fog_textured_fixed.h"
#include "shaders/lamps_frag_8_fog_textured_relief.h"
#include "shaders/lamps_frag_8_fog_textured_relief_fixed.h"
#include "shaders/lamps_frag_8_shadows_fog_textured_fixed.h"
#include "shaders/lamps_frag_8_shadows_fog_textured_relief.h"
#include "shaders/lamps_frag_8_shadows_fog_textured_relief_fixed.h"
#include "shaders/lamps_frag_8_shadows_textured_fixed.h"
#include "shaders/lamps_frag_8_shadows_textured_relief.h"
#include "shaders/lamps_frag_8_shadows_textured_relief_fixed.h"
#include "shaders/lamps_frag_8_textured_fixed.h"
#include "shaders/lamps_frag_8_textured_relief.h"
#include "shaders/lamps_frag_8_textured_relief_fixed.h"
#include "shaders/lamps_frag_reference_fog_textured_fixed.h"
#include "shaders/lamps_frag_reference_fog_textured_relief.h"
#include "shaders/lamps_frag_reference_fog_textured_relief_fixed.h"
#include "shaders/lamps_frag_reference_shadows_fog_textured_fixed.h"
#include "shaders/lamps_frag_reference_shadows_fog_textured_relief.h"
#include "shaders/lamps_frag_reference_shadows_fog_textured_relief_fixed.h"
#include "shaders/lamps_frag_reference_shadows_textured_fixed.h"
#include "shaders/lamps_frag_reference_shadows_textured_relief.h"
#include "shaders/lamps_frag_reference_shadows_textured_relief_fixed.h"
#include "shaders/lamps_frag_reference_textured_fixed.h"
#include "shaders/lamps_frag_reference_textured_relief.h"
#include "shaders/lamps_frag_reference_textured_relief_fixed.h"
#include "shaders/road_vert_8_lit_filtered_textured_fixed.h"
#include "shaders/road_vert_8_lit_filtered_textured_relief_fixed.h"
#include "shaders/road_vert_8_lit_textured_fixed.h"
#include "shaders/road_vert_8_lit_textured_relief_fixed.h"
#include "shaders/road_vert_8_textured_fixed.h"
#include "shaders/road_vert_8_textured_relief_fixed.h"
#include "shaders/scene_vert_8_lit_filtered_textured_fixed.h"
#include "shaders/scene_vert_8_lit_filtered_textured_relief.h"
#include "shaders/scene_vert_8_lit_filtered_textured_relief_fixed.h"
#include "shaders/scene_vert_8_lit_textured_fixed.h"
#include "shaders/scene_vert_8_lit_textured_relief.h"
#include "shaders/scene_vert_8_lit_textured_relief_fixed.h"
#include "shaders/scene_vert_8_textured_fixed.h"
#include "shaders/scene_vert_8_textured_relief.h"
#include "shaders/scene_vert_8_textured_relief_fixed.h"

namespace phare {
namespace {

using Code = std::span<const std::uint32_t>;

/// Which of the three: relief, fixed light, both.
std::size_t which_of(const TexturedKind& kind) {
  return kind.relief ? kind.fixed ? 2u : 0u : 1u;
}

}  // namespace

std::span<const std::uint32_t> textured_frag(const TexturedKind& kind, bool shadows, bool fog) {
  static const std::array<Code, 12> reference{
      k_lamps_frag_reference_textured_relief,
      k_lamps_frag_reference_shadows_textured_relief,
      k_lamps_frag_reference_fog_textured_relief,
      k_lamps_frag_reference_shadows_fog_textured_relief,
      k_lamps_frag_reference_textured_fixed,
      k_lamps_frag_reference_shadows_textured_fixed,
      k_lamps_frag_reference_fog_textured_fixed,
      k_lamps_frag_reference_shadows_fog_textured_fixed,
      k_lamps_frag_reference_textured_relief_fixed,
      k_lamps_frag_reference_shadows_textured_relief_fixed,
      k_lamps_frag_reference_fog_textured_relief_fixed,
      k_lamps_frag_reference_shadows_fog_textured_relief_fixed};
  static const std::array<Code, 12> filtered{
      k_lamps_frag_8_filtered_textured_relief,
      k_lamps_frag_8_filtered_shadows_textured_relief,
      k_lamps_frag_8_filtered_fog_textured_relief,
      k_lamps_frag_8_filtered_shadows_fog_textured_relief,
      k_lamps_frag_8_filtered_textured_fixed,
      k_lamps_frag_8_filtered_shadows_textured_fixed,
      k_lamps_frag_8_filtered_fog_textured_fixed,
      k_lamps_frag_8_filtered_shadows_fog_textured_fixed,
      k_lamps_frag_8_filtered_textured_relief_fixed,
      k_lamps_frag_8_filtered_shadows_textured_relief_fixed,
      k_lamps_frag_8_filtered_fog_textured_relief_fixed,
      k_lamps_frag_8_filtered_shadows_fog_textured_relief_fixed};
  static const std::array<Code, 12> tables{
      k_lamps_frag_8_textured_relief,
      k_lamps_frag_8_shadows_textured_relief,
      k_lamps_frag_8_fog_textured_relief,
      k_lamps_frag_8_shadows_fog_textured_relief,
      k_lamps_frag_8_textured_fixed,
      k_lamps_frag_8_shadows_textured_fixed,
      k_lamps_frag_8_fog_textured_fixed,
      k_lamps_frag_8_shadows_fog_textured_fixed,
      k_lamps_frag_8_textured_relief_fixed,
      k_lamps_frag_8_shadows_textured_relief_fixed,
      k_lamps_frag_8_fog_textured_relief_fixed,
      k_lamps_frag_8_shadows_fog_textured_relief_fixed};
  const std::size_t at = 4 * which_of(kind) + (shadows ? 1u : 0u) + (fog ? 2u : 0u);
  return (kind.reference ? reference : kind.filtered ? filtered : tables)[at];
}

std::span<const std::uint32_t> textured_vert(const TexturedKind& kind, bool by_vertex) {
  static const std::array<Code, 9> codes{
      k_scene_vert_8_textured_relief,
      k_scene_vert_8_lit_textured_relief,
      k_scene_vert_8_lit_filtered_textured_relief,
      k_scene_vert_8_textured_fixed,
      k_scene_vert_8_lit_textured_fixed,
      k_scene_vert_8_lit_filtered_textured_fixed,
      k_scene_vert_8_textured_relief_fixed,
      k_scene_vert_8_lit_textured_relief_fixed,
      k_scene_vert_8_lit_filtered_textured_relief_fixed};
  static const std::array<Code, 6> codes_road{
      k_road_vert_8_textured_fixed,
      k_road_vert_8_lit_textured_fixed,
      k_road_vert_8_lit_filtered_textured_fixed,
      k_road_vert_8_textured_relief_fixed,
      k_road_vert_8_lit_textured_relief_fixed,
      k_road_vert_8_lit_filtered_textured_relief_fixed};
  const std::size_t method = by_vertex ? kind.filtered ? 2u : 1u : 0u;
  if (kind.road) return codes_road[3 * (which_of(kind) - 1) + method];
  return codes[3 * which_of(kind) + method];
}

}  // namespace phare
