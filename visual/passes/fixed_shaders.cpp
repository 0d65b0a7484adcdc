// The lit shaders for a scene with light that does not change: apart, for their code is long and one file needs it.
#include "visual/passes/fixed_shaders.h"

#include "shaders/fixed_frag_2.h"
#include "shaders/fixed_frag_2_filtered.h"
#include "shaders/fixed_frag_2_filtered_fog.h"
#include "shaders/fixed_frag_2_filtered_shadows.h"
#include "shaders/fixed_frag_2_filtered_shadows_fog.h"
#include "shaders/fixed_frag_2_fog.h"
#include "shaders/fixed_frag_2_shadows.h"
#include "shaders/fixed_frag_2_shadows_fog.h"
#include "shaders/fixed_frag_4.h"
#include "shaders/fixed_frag_4_filtered.h"
#include "shaders/fixed_frag_4_filtered_fog.h"
#include "shaders/fixed_frag_4_filtered_shadows.h"
#include "shaders/fixed_frag_4_filtered_shadows_fog.h"
#include "shaders/fixed_frag_4_fog.h"
#include "shaders/fixed_frag_4_shadows.h"
#include "shaders/fixed_frag_4_shadows_fog.h"
#include "shaders/fixed_frag_8.h"
#include "shaders/fixed_frag_8_filtered.h"
#include "shaders/fixed_frag_8_filtered_fog.h"
#include "shaders/fixed_frag_8_filtered_shadows.h"
#include "shaders/fixed_frag_8_filtered_shadows_fog.h"
#include "shaders/fixed_frag_8_fog.h"
#include "shaders/fixed_frag_8_shadows.h"
#include "shaders/fixed_frag_8_shadows_fog.h"
#include "shaders/fixed_frag_reference.h"
#include "shaders/fixed_frag_reference_fog.h"
#include "shaders/fixed_frag_reference_shadows.h"
#include "shaders/fixed_frag_reference_shadows_fog.h"
#include "shaders/fixed_vert_2.h"
#include "shaders/fixed_vert_2_fog.h"
#include "shaders/fixed_vert_2_lit.h"
#include "shaders/fixed_vert_2_lit_filtered.h"
#include "shaders/fixed_vert_2_lit_filtered_fog.h"
#include "shaders/fixed_vert_2_lit_filtered_shadows.h"
#include "shaders/fixed_vert_2_lit_filtered_shadows_fog.h"
#include "shaders/fixed_vert_2_lit_fog.h"
#include "shaders/fixed_vert_2_lit_shadows.h"
#include "shaders/fixed_vert_2_lit_shadows_fog.h"
#include "shaders/fixed_vert_2_shadows.h"
#include "shaders/fixed_vert_2_shadows_fog.h"
#include "shaders/fixed_vert_4.h"
#include "shaders/fixed_vert_4_lit.h"
#include "shaders/fixed_vert_4_lit_filtered.h"
#include "shaders/fixed_vert_4_lit_filtered_shadows.h"
#include "shaders/fixed_vert_4_lit_shadows.h"
#include "shaders/fixed_vert_4_shadows.h"
#include "shaders/fixed_vert_8.h"
#include "shaders/fixed_vert_8_lit.h"
#include "shaders/fixed_vert_8_lit_filtered.h"
#include "shaders/fixed_vert_8_lit_filtered_shadows.h"
#include "shaders/fixed_vert_8_lit_shadows.h"
#include "shaders/fixed_vert_8_shadows.h"
#include "shaders/road_vert_2.h"
#include "shaders/road_vert_2_fog.h"
#include "shaders/road_vert_2_lit.h"
#include "shaders/road_vert_2_lit_filtered.h"
#include "shaders/road_vert_2_lit_filtered_fog.h"
#include "shaders/road_vert_2_lit_filtered_shadows.h"
#include "shaders/road_vert_2_lit_filtered_shadows_fog.h"
#include "shaders/road_vert_2_lit_fog.h"
#include "shaders/road_vert_2_lit_shadows.h"
#include "shaders/road_vert_2_lit_shadows_fog.h"
#include "shaders/road_vert_2_shadows.h"
#include "shaders/road_vert_2_shadows_fog.h"
#include "shaders/road_vert_4.h"
#include "shaders/road_vert_4_lit.h"
#include "shaders/road_vert_4_lit_filtered.h"
#include "shaders/road_vert_4_lit_filtered_shadows.h"
#include "shaders/road_vert_4_lit_shadows.h"
#include "shaders/road_vert_4_shadows.h"
#include "shaders/road_vert_8.h"
#include "shaders/road_vert_8_lit.h"
#include "shaders/road_vert_8_lit_filtered.h"
#include "shaders/road_vert_8_lit_filtered_shadows.h"
#include "shaders/road_vert_8_lit_shadows.h"
#include "shaders/road_vert_8_shadows.h"

namespace phare {

using Code = std::span<const std::uint32_t>;

std::span<const std::uint32_t> fixed_frag(std::size_t size, bool filtered, bool fog) {
  static const std::array<Code, 6> codes{k_fixed_frag_2,         k_fixed_frag_4,         k_fixed_frag_8,
                                         k_fixed_frag_2_shadows, k_fixed_frag_4_shadows, k_fixed_frag_8_shadows};
  static const std::array<Code, 6> codes_fog{k_fixed_frag_2_fog,         k_fixed_frag_4_fog,
                                             k_fixed_frag_8_fog,         k_fixed_frag_2_shadows_fog,
                                             k_fixed_frag_4_shadows_fog, k_fixed_frag_8_shadows_fog};
  static const std::array<Code, 6> codes_filtered{k_fixed_frag_2_filtered,         k_fixed_frag_4_filtered,
                                                  k_fixed_frag_8_filtered,         k_fixed_frag_2_filtered_shadows,
                                                  k_fixed_frag_4_filtered_shadows, k_fixed_frag_8_filtered_shadows};
  static const std::array<Code, 6> codes_filtered_fog{
      k_fixed_frag_2_filtered_fog,         k_fixed_frag_4_filtered_fog,         k_fixed_frag_8_filtered_fog,
      k_fixed_frag_2_filtered_shadows_fog, k_fixed_frag_4_filtered_shadows_fog, k_fixed_frag_8_filtered_shadows_fog};
  if (fog) return (filtered ? codes_filtered_fog : codes_fog)[size];
  return (filtered ? codes_filtered : codes)[size];
}

std::span<const std::uint32_t> fixed_frag_reference(bool shadows, bool fog) {
  static const std::array<Code, 4> codes{k_fixed_frag_reference, k_fixed_frag_reference_shadows,
                                         k_fixed_frag_reference_fog, k_fixed_frag_reference_shadows_fog};
  return codes[(shadows ? 1u : 0u) + (fog ? 2u : 0u)];
}

std::span<const std::uint32_t> fixed_vert(std::size_t size, bool by_vertex, bool filtered, bool fog) {
  static const std::array<Code, 6> codes{k_fixed_vert_2,         k_fixed_vert_4,         k_fixed_vert_8,
                                         k_fixed_vert_2_shadows, k_fixed_vert_4_shadows, k_fixed_vert_8_shadows};
  static const std::array<Code, 2> codes_fog{k_fixed_vert_2_fog, k_fixed_vert_2_shadows_fog};
  static const std::array<Code, 6> codes_lit{k_fixed_vert_2_lit,         k_fixed_vert_4_lit,
                                             k_fixed_vert_8_lit,         k_fixed_vert_2_lit_shadows,
                                             k_fixed_vert_4_lit_shadows, k_fixed_vert_8_lit_shadows};
  static const std::array<Code, 2> codes_lit_fog{k_fixed_vert_2_lit_fog, k_fixed_vert_2_lit_shadows_fog};
  static const std::array<Code, 6> codes_lit_filtered{
      k_fixed_vert_2_lit_filtered,         k_fixed_vert_4_lit_filtered,         k_fixed_vert_8_lit_filtered,
      k_fixed_vert_2_lit_filtered_shadows, k_fixed_vert_4_lit_filtered_shadows, k_fixed_vert_8_lit_filtered_shadows};
  static const std::array<Code, 2> codes_lit_filtered_fog{k_fixed_vert_2_lit_filtered_fog,
                                                          k_fixed_vert_2_lit_filtered_shadows_fog};
  if (fog && size % 3 == 0)
    return (!by_vertex ? codes_fog : filtered ? codes_lit_filtered_fog : codes_lit_fog)[size / 3];
  return (!by_vertex ? codes : filtered ? codes_lit_filtered : codes_lit)[size];
}

std::span<const std::uint32_t> road_vert(std::size_t size, bool by_vertex, bool filtered, bool fog) {
  static const std::array<Code, 6> codes{k_road_vert_2,         k_road_vert_4,         k_road_vert_8,
                                         k_road_vert_2_shadows, k_road_vert_4_shadows, k_road_vert_8_shadows};
  static const std::array<Code, 2> codes_fog{k_road_vert_2_fog, k_road_vert_2_shadows_fog};
  static const std::array<Code, 6> codes_lit{k_road_vert_2_lit,         k_road_vert_4_lit,
                                             k_road_vert_8_lit,         k_road_vert_2_lit_shadows,
                                             k_road_vert_4_lit_shadows, k_road_vert_8_lit_shadows};
  static const std::array<Code, 2> codes_lit_fog{k_road_vert_2_lit_fog, k_road_vert_2_lit_shadows_fog};
  static const std::array<Code, 6> codes_lit_filtered{
      k_road_vert_2_lit_filtered,         k_road_vert_4_lit_filtered,         k_road_vert_8_lit_filtered,
      k_road_vert_2_lit_filtered_shadows, k_road_vert_4_lit_filtered_shadows, k_road_vert_8_lit_filtered_shadows};
  static const std::array<Code, 2> codes_lit_filtered_fog{k_road_vert_2_lit_filtered_fog,
                                                          k_road_vert_2_lit_filtered_shadows_fog};
  if (fog && size % 3 == 0)
    return (!by_vertex ? codes_fog : filtered ? codes_lit_filtered_fog : codes_lit_fog)[size / 3];
  return (!by_vertex ? codes : filtered ? codes_lit_filtered : codes_lit)[size];
}

}  // namespace phare
