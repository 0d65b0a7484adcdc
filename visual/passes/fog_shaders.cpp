// The shaders of fog, of each number of lamps: apart, for their code is long and few files need it.
#include "shaders/fog_comp_2.h"
#include "shaders/fog_comp_2_filtered.h"
#include "shaders/fog_comp_2_filtered_shadows.h"
#include "shaders/fog_comp_2_shadows.h"
#include "shaders/fog_comp_4.h"
#include "shaders/fog_comp_4_filtered.h"
#include "shaders/fog_comp_4_filtered_shadows.h"
#include "shaders/fog_comp_4_shadows.h"
#include "shaders/fog_comp_8.h"
#include "shaders/fog_comp_8_filtered.h"
#include "shaders/fog_comp_8_filtered_shadows.h"
#include "shaders/fog_comp_8_shadows.h"
#include "shaders/lamps_frag_2_filtered_fog.h"
#include "shaders/lamps_frag_2_filtered_shadows_fog.h"
#include "shaders/lamps_frag_2_fog.h"
#include "shaders/lamps_frag_2_shadows_fog.h"
#include "shaders/lamps_frag_4_filtered_fog.h"
#include "shaders/lamps_frag_4_filtered_shadows_fog.h"
#include "shaders/lamps_frag_4_fog.h"
#include "shaders/lamps_frag_4_shadows_fog.h"
#include "shaders/lamps_frag_8_filtered_fog.h"
#include "shaders/lamps_frag_8_filtered_shadows_fog.h"
#include "shaders/lamps_frag_8_fog.h"
#include "shaders/lamps_frag_8_shadows_fog.h"
#include "shaders/scene_vert_2_fog.h"
#include "shaders/scene_vert_2_lit_filtered_fog.h"
#include "shaders/scene_vert_2_lit_filtered_shadows_fog.h"
#include "shaders/scene_vert_2_lit_fog.h"
#include "shaders/scene_vert_2_lit_shadows_fog.h"
#include "shaders/scene_vert_2_shadows_fog.h"
#include "visual/passes/fog.h"

namespace phare {

using ShaderCode = std::span<const std::uint32_t>;

std::span<const std::uint32_t> lamps_fog_frag(std::size_t size, bool filtered) {
  static const std::array<ShaderCode, 6> tables{k_lamps_frag_2_fog,         k_lamps_frag_4_fog,
                                                k_lamps_frag_8_fog,         k_lamps_frag_2_shadows_fog,
                                                k_lamps_frag_4_shadows_fog, k_lamps_frag_8_shadows_fog};
  static const std::array<ShaderCode, 6> filters{
      k_lamps_frag_2_filtered_fog,         k_lamps_frag_4_filtered_fog,         k_lamps_frag_8_filtered_fog,
      k_lamps_frag_2_filtered_shadows_fog, k_lamps_frag_4_filtered_shadows_fog, k_lamps_frag_8_filtered_shadows_fog};
  return (filtered ? filters : tables)[size];
}

std::span<const std::uint32_t> scene_fog_vert(bool shadows, bool by_vertex, bool filtered) {
  if (!by_vertex) return shadows ? ShaderCode(k_scene_vert_2_shadows_fog) : ShaderCode(k_scene_vert_2_fog);
  if (filtered)
    return shadows ? ShaderCode(k_scene_vert_2_lit_filtered_shadows_fog) : ShaderCode(k_scene_vert_2_lit_filtered_fog);
  return shadows ? ShaderCode(k_scene_vert_2_lit_shadows_fog) : ShaderCode(k_scene_vert_2_lit_fog);
}

std::span<const std::uint32_t> fog_comp(std::size_t size, bool filtered, bool shadows) {
  static const std::array<ShaderCode, 6> tables{k_fog_comp_2,         k_fog_comp_4,         k_fog_comp_8,
                                                k_fog_comp_2_shadows, k_fog_comp_4_shadows, k_fog_comp_8_shadows};
  static const std::array<ShaderCode, 6> filters{k_fog_comp_2_filtered,         k_fog_comp_4_filtered,
                                                 k_fog_comp_8_filtered,         k_fog_comp_2_filtered_shadows,
                                                 k_fog_comp_4_filtered_shadows, k_fog_comp_8_filtered_shadows};
  return (filtered ? filters : tables)[size + (shadows ? 3 : 0)];
}

}  // namespace phare
