#include "visual/light_peaks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "visual/shadow_casters.h"

namespace phare {
namespace {

/// Tangents to cells of one side, of so many about the axis: finer there. As CasterGrid has them.
struct Axis {
  float half, finest;
  int cells;

  float at(float tangent) const {
    const float middle = 0.5f * static_cast<float>(cells);
    return middle + middle * (half + finest) / half * tangent / (std::abs(tangent) + finest);
  }
};

struct Cells {
  int first = 0, end = 0;
};

/// Those between two places, with what lies beyond in the outermost.
Cells cells_between(float least, float most, int cells) {
  const float last = static_cast<float>(cells - 1);
  return {static_cast<int>(std::clamp(std::floor(least), 0.0f, last)),
          static_cast<int>(std::clamp(std::floor(most), 0.0f, last)) + 1};
}

constexpr Axis kAcross{static_cast<float>(kWidestShadow), 0.3f, 64}, kUp{static_cast<float>(kHighestShadow), 0.1f, 64};

/// What is at the side of the lamp or behind it, all of which lies beyond the outermost cells, to the side it is on.
constexpr double kBeside = 1e-3;

}  // namespace

LightPeaks::LightPeaks(const BeamImage& image) {
  if (image.dark || image.candela.empty()) return;
  most_cd_.resize(static_cast<std::size_t>(kColumns * kRows));
  raise(image, {0, 0, image.first_deg.size(), image.second_deg.size()});
}

void LightPeaks::raise(const BeamImage& image, std::span<const TexelRect> changed) {
  if (most_cd_.empty()) {
    *this = LightPeaks(image);
    return;
  }
  for (const TexelRect& rect : changed) raise(image, rect);
}

void LightPeaks::raise(const BeamImage& image, const TexelRect& rect) {
  if (rect.empty()) return;
  const std::size_t columns = image.first_deg.size(), rows = image.second_deg.size();
  // Blocks of nodes, few enough that their corners' directions cost little. Light between nodes is theirs, so a block
  // ends where the next begins, and one reaches past the rectangle.
  const std::size_t first_column = rect.column == 0 ? 0 : rect.column - 1, first_row = rect.row == 0 ? 0 : rect.row - 1;
  const std::size_t end_column = std::min(rect.end_column, columns - 1), end_row = std::min(rect.end_row, rows - 1);
  constexpr std::size_t kBlocks = 64;
  const std::size_t wide = (end_column - first_column + kBlocks) / kBlocks,
                    high = (end_row - first_row + kBlocks) / kBlocks;
  const auto place_of = [&](std::size_t column, std::size_t row) {
    const TableAngles at{image.first_deg[column], image.second_deg[row]};
    const glm::dvec3 way =
        image.screen_distance_m > 0.0 ? screen_direction(at) : table_direction(image.type, image.axis, at);
    const double ahead = std::max(way.x, kBeside);
    return std::pair(
        glm::vec2(kAcross.at(static_cast<float>(way.y / ahead)), kUp.at(static_cast<float>(way.z / ahead))),
        way.x > 0.0);
  };
  for (std::size_t row = first_row; row < end_row; row += high)
    for (std::size_t column = first_column; column < end_column; column += wide) {
      const std::size_t last_row = std::min(row + high, end_row), last_column = std::min(column + wide, end_column);
      float most_cd = 0.0f;
      for (std::size_t j = row; j <= last_row; ++j)
        for (std::size_t i = column; i <= last_column; ++i) most_cd = std::max(most_cd, image.candela[j * columns + i]);
      if (most_cd == 0.0f) continue;
      glm::vec2 least(std::numeric_limits<float>::infinity()), most(-least);
      bool ahead = false;
      for (const std::size_t j : {row, (row + last_row) / 2, last_row})
        for (const std::size_t i : {column, (column + last_column) / 2, last_column}) {
          const auto [place, is_ahead] = place_of(i, j);
          least = glm::min(least, place), most = glm::max(most, place);
          ahead = ahead || is_ahead;
        }
      if (!ahead) continue;
      // Lines of the table are bent between these, by less than the block's own size; levels of beam images blur by a
      // texel, which is less than a cell.
      const glm::vec2 room = 0.5f * (most - least) + 1.0f;
      const Cells across = cells_between(least.x - room.x, most.x + room.x, kColumns),
                  up = cells_between(least.y - room.y, most.y + room.y, kRows);
      for (int j = up.first; j < up.end; ++j)
        for (int i = across.first; i < across.end; ++i) {
          float& cell = most_cd_[static_cast<std::size_t>(j * kColumns + i)];
          cell = std::max(cell, most_cd);
        }
    }
}

bool LightPeaks::exceeds(const glm::vec2& least, const glm::vec2& most, float cd) const {
  if (most_cd_.empty()) return false;
  const Cells across = cells_between(kAcross.at(least.x), kAcross.at(most.x), kColumns),
              up = cells_between(kUp.at(least.y), kUp.at(most.y), kRows);
  for (int j = up.first; j < up.end; ++j) {
    const float* const row = &most_cd_[static_cast<std::size_t>(j * kColumns)];
    if (std::any_of(row + across.first, row + across.end, [cd](float most_here) { return most_here > cd; }))
      return true;
  }
  return false;
}

}  // namespace phare
