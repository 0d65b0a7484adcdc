// scene.vert and lamps.frag compiled with PHARE_FIXED: for scenes with light that does not change
// (visual/fixed_light.h). `size`: for up to 2, 4, 8 lamps; the same with shadows, as LitScene has them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace phare {

std::span<const std::uint32_t> fixed_frag(std::size_t size, bool filtered, bool fog);
std::span<const std::uint32_t> fixed_frag_reference(bool shadows, bool fog);
/// Fog is passed by vertices for two lamps at most; of more it is that of clear air.
std::span<const std::uint32_t> fixed_vert(std::size_t size, bool by_vertex, bool filtered, bool fog);
/// The same for asphalt by an r-table (PHARE_ROAD).
std::span<const std::uint32_t> road_vert(std::size_t size, bool by_vertex, bool filtered, bool fog);

}  // namespace phare
