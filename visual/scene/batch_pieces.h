// Batches of triangles in pieces, of which a view draws some, or some in another way: those that a shadow may reach, or
// that the ground does not hide.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace phare {

/// Triangles of a batch that lie together, and a box about them relative to the batch's origin, m.
struct BatchPiece {
  glm::vec3 low_m{0.0f}, high_m{0.0f};
  std::uint32_t index_count = 0;
};

/// About so many pieces at most, and what is not cut further.
struct PieceSizes {
  std::size_t most_pieces, least_triangles;
  float small_m;
};
/// More of them tell more exactly what a shadow can reach, and each costs a test a lamp. Chosen.
inline constexpr PieceSizes kNearPieces{256, 2, 4.0f};
/// Of what is far away: a piece more to draw costs as much as some triangles. Chosen.
inline constexpr PieceSizes kFarPieces{64, 16, 8.0f};

/// Puts the triangles of a batch into the order of the pieces. `ends`: of the indices of each mesh; no piece holds
/// triangles of two: a post that stands on a road is no part of it. `place_m`: of a corner, by its index.
std::vector<BatchPiece> cut_into_pieces(std::span<std::uint32_t> indices, std::span<const std::size_t> ends,
                                        const std::function<glm::vec3(std::uint32_t)>& place_m,
                                        const PieceSizes& sizes);

}  // namespace phare
