#include "visual/scene/batch_pieces.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>

namespace phare {

namespace {

struct PieceTriangle {
  std::array<std::uint32_t, 3> corners{};
  glm::vec3 low_m{0.0f}, high_m{0.0f};

  glm::vec3 middle_m() const { return 0.5f * (low_m + high_m); }
};

BatchPiece around(std::span<const PieceTriangle> triangles) {
  BatchPiece piece{glm::vec3(1e30f), glm::vec3(-1e30f)};
  for (const PieceTriangle& triangle : triangles) {
    piece.low_m = glm::min(piece.low_m, triangle.low_m);
    piece.high_m = glm::max(piece.high_m, triangle.high_m);
  }
  piece.index_count = static_cast<std::uint32_t>(3 * triangles.size());
  return piece;
}

// Halves them across their longer side until they are few or small; the triangles come to lie in the order of the
// pieces.
void halve(std::span<PieceTriangle> triangles, std::size_t few, float small_m, std::vector<BatchPiece>& pieces) {
  const BatchPiece all = around(triangles);
  const glm::vec3 size_m = all.high_m - all.low_m;
  if (triangles.size() <= few || std::max(size_m.x, size_m.y) <= small_m) {
    pieces.push_back(all);
    return;
  }
  glm::vec3 low_m(1e30f), high_m(-1e30f);
  for (const PieceTriangle& triangle : triangles) {
    low_m = glm::min(low_m, triangle.middle_m());
    high_m = glm::max(high_m, triangle.middle_m());
  }
  const int axis = high_m.x - low_m.x >= high_m.y - low_m.y ? 0 : 1;
  const std::size_t half = (triangles.size() / 2 + 1) / 2 * 2;  // what was a quad stays one
  std::ranges::stable_sort(triangles, {}, [axis](const PieceTriangle& triangle) { return triangle.middle_m()[axis]; });
  halve(triangles.first(half), few, small_m, pieces);
  halve(triangles.subspan(half), few, small_m, pieces);
}

}  // namespace

std::vector<BatchPiece> cut_into_pieces(std::span<std::uint32_t> indices, std::span<const std::size_t> ends,
                                        const std::function<glm::vec3(std::uint32_t)>& place_m,
                                        const PieceSizes& sizes) {
  const std::size_t few =
      std::max(sizes.least_triangles, (indices.size() / 3 + sizes.most_pieces - 1) / sizes.most_pieces);
  std::vector<BatchPiece> pieces;
  std::vector<PieceTriangle> triangles;
  std::size_t i = 0;
  for (const std::size_t end : ends) {
    triangles.clear();
    const std::size_t first = i;
    for (; i < end; i += 3) {
      const glm::vec3 a = place_m(indices[i]), b = place_m(indices[i + 1]), c = place_m(indices[i + 2]);
      triangles.push_back(
          {{indices[i], indices[i + 1], indices[i + 2]}, glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
    }
    if (triangles.empty()) continue;
    halve(triangles, few, sizes.small_m, pieces);
    auto to = indices.begin() + static_cast<std::ptrdiff_t>(first);
    for (const PieceTriangle& triangle : triangles) to = std::ranges::copy(triangle.corners, to).out;
  }
  return pieces;
}

}  // namespace phare
