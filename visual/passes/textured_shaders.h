// scene.vert and lamps.frag compiled with PHARE_TEXTURED and PHARE_RELIEF, PHARE_FIXED, or both: one size serves any
// number of lamps, for a software device takes seconds to compile each.
#pragma once

#include <cstdint>
#include <span>

namespace phare {

/// One of the two is there.
struct TexturedKind {
  bool relief = false, fixed = false;
  bool road = false;  ///< asphalt by an r-table, with fixed light
  bool reference = false, filtered = false;
};

std::span<const std::uint32_t> textured_frag(const TexturedKind& kind, bool shadows, bool fog);
std::span<const std::uint32_t> textured_vert(const TexturedKind& kind, bool by_vertex);

}  // namespace phare
