#include "visual/scene/ground_heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "visual/scene/refine.h"

namespace phare {

namespace {

constexpr double kLeastCell_m = 4.0;  // chosen: crests are longer, ditches about as wide
constexpr std::size_t kMostCells = 1u << 20u;
constexpr int kSamples = 4;  // each way in a cell, by which it is told whether the ground covers it
constexpr std::uint16_t kCovered = 0xffff;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Cells of the ground while it is gathered.
struct Cells {
  double cell_m;
  std::size_t columns, rows;
  std::vector<float> least_m;
  std::vector<std::uint16_t> covered;  ///< a bit for each sample

  Cells(double side_m, std::size_t across, std::size_t up)
      : cell_m(side_m), columns(across), rows(up), least_m(across * up, HUGE_VALF), covered(across * up, 0) {}

  /// A triangle, corners from the grid's corner, and whether it hides what is beneath it.
  void add(const std::array<glm::dvec3, 3>& corner, bool hides);
};

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

void Cells::add(const std::array<glm::dvec3, 3>& corner, bool hides) {
  const glm::dvec3 low = glm::min(corner[0], glm::min(corner[1], corner[2])),
                   high = glm::max(corner[0], glm::max(corner[1], corner[2]));
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double turn = normal.z < 0.0 ? -1.0 : 1.0;
  const bool upright = std::abs(normal.z) < 1e-9;
  const glm::dvec2 slope = upright ? glm::dvec2(0.0) : glm::dvec2(normal) / -normal.z;
  // Of a point: how far within each side it is, times the side's length.
  const auto within = [&](std::size_t side, const glm::dvec2& p) {
    const glm::dvec2 a(corner[side]), b(corner[(side + 1) % 3]);
    return turn * cross(b - a, p - a);
  };
  const auto cell_at = [&](double at, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(at / cell_m), 0.0, static_cast<double>(count - 1)));
  };
  for (std::size_t row = cell_at(low.y, rows); row <= cell_at(high.y, rows); ++row) {
    for (std::size_t column = cell_at(low.x, columns); column <= cell_at(high.x, columns); ++column) {
      const glm::dvec2 begin = cell_m * glm::dvec2(static_cast<double>(column), static_cast<double>(row)),
                       middle = begin + 0.5 * cell_m;
      bool beside = false;
      for (std::size_t side = 0; side < 3 && !upright; ++side) {
        const glm::dvec2 way = glm::dvec2(corner[(side + 1) % 3]) - glm::dvec2(corner[side]);
        beside = beside || within(side, middle) < -0.5 * cell_m * (std::abs(way.x) + std::abs(way.y));
      }
      if (beside) continue;
      const std::size_t cell = row * columns + column;
      const double lowest = corner[0].z + glm::dot(slope, middle - glm::dvec2(corner[0])) -
                            0.5 * cell_m * (std::abs(slope.x) + std::abs(slope.y));
      least_m[cell] = std::min(least_m[cell], static_cast<float>(upright ? low.z : std::max(low.z, lowest)));
      if (!hides || upright || covered[cell] == kCovered) continue;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const glm::dvec2 sample = begin + cell_m / kSamples * (glm::dvec2(i % kSamples, i / kSamples) + 0.5);
        if (within(0, sample) >= 0.0 && within(1, sample) >= 0.0 && within(2, sample) >= 0.0)
          covered[cell] = static_cast<std::uint16_t>(covered[cell] | 1u << i);
      }
    }
  }
}

}  // namespace

GroundHeights::GroundHeights(const Scene& scene) {
  glm::dvec3 low_m(HUGE_VAL), high_m(-HUGE_VAL);
  const auto is_ground_chunk = [&](const SceneChunk& chunk) {
    return chunk.index_count > 0 && is_ground(scene.materials[chunk.material]);
  };
  for (const SceneChunk& chunk : scene.chunks) {
    if (!is_ground_chunk(chunk)) continue;
    low_m = glm::min(low_m, chunk.low_m);
    high_m = glm::max(high_m, chunk.high_m);
  }
  if (!(low_m.x < high_m.x && low_m.y < high_m.y)) return;
  const glm::dvec2 size_m(high_m - low_m);
  cell_m_ = std::max(kLeastCell_m, std::sqrt(size_m.x * size_m.y / static_cast<double>(kMostCells)));
  // Long and narrow, there may be more for the last of a row.
  columns_ = static_cast<std::size_t>(size_m.x / cell_m_) + 1, rows_ = static_cast<std::size_t>(size_m.y / cell_m_) + 1;
  low_m_ = glm::dvec2(low_m);
  Cells cells(cell_m_, columns_, rows_);
  for (const SceneChunk& chunk : scene.chunks) {
    if (!is_ground_chunk(chunk)) continue;
    const bool both_sides = scene.materials[chunk.material].double_sided;
    const auto vertices = std::span(scene.vertices).subspan(chunk.first_vertex, chunk.vertex_count);
    const auto indices = std::span(scene.indices).subspan(chunk.first_index, chunk.index_count);
    const glm::dvec3 shift = chunk.origin_m - glm::dvec3(low_m_, 0.0);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) { return shift + glm::dvec3(vertices[indices[i + k]].position_m); };
      const std::array<glm::dvec3, 3> triangle{corner(0), corner(1), corner(2)};
      cells.add(triangle, both_sides || cross(glm::dvec2(triangle[1] - triangle[0]),
                                              glm::dvec2(triangle[2] - triangle[0])) > 0.0);
    }
  }
  least_m_.assign(columns_ * rows_, kNone);
  for (std::size_t row = 1; row + 1 < rows_; ++row) {
    for (std::size_t column = 1; column + 1 < columns_; ++column) {
      const float here_m = cells.least_m[row * columns_ + column];
      float least_m = here_m;
      bool whole = true;
      for (std::size_t k = 0; k < 9 && whole; ++k) {
        const std::size_t beside = (row + k / 3 - 1) * columns_ + column + k % 3 - 1;
        whole = cells.covered[beside] == kCovered &&
                std::abs(cells.least_m[beside] - here_m) <= static_cast<float>(cell_m_);
        least_m = std::min(least_m, cells.least_m[beside]);
      }
      if (whole) least_m_[row * columns_ + column] = least_m;
    }
  }
}

float GroundHeights::least_m(const glm::dvec2& at_m) const {
  const glm::dvec2 at = (at_m - low_m_) / cell_m_;
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < static_cast<double>(columns_) && at.y < static_cast<double>(rows_)))
    return kNone;
  return least_m_[static_cast<std::size_t>(at.y) * columns_ + static_cast<std::size_t>(at.x)];
}

}  // namespace phare
