#include "visual/light_peaks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "visual/shadow_casters.h"
#include "visual/tangent_cells.h"

namespace phare {
namespace {

struct Cells {
  int first = 0, end = 0;
};

/// Those between two places, with what lies beyond in the outermost.
Cells cells_between(float least, float most, int cells) {
  const float last = static_cast<float>(cells - 1);
  return {static_cast<int>(std::clamp(std::floor(least), 0.0f, last)),
          static_cast<int>(std::clamp(std::floor(most), 0.0f, last)) + 1};
}

/// Finest as those of CasterGrid: half a degree across and a sixth up.
constexpr int kColumns = 64, kRows = 64;
constexpr TangentCells kAcross{static_cast<float>(kWidestShadow), 0.3f, kColumns},
    kUp{static_cast<float>(kHighestShadow), 0.1f, kRows};

/// What is at the side of the lamp or behind it, all of which lies beyond the outermost cells, to the side it is on.
constexpr double kBeside = 1e-3;

}  // namespace

void LightPeaks::place_blocks(const BeamGrid& grid) {
  grid_ = grid;
  blocks_.clear();
  // As large as a cell at most where tables are fine, and so few that their corners' directions cost little.
  constexpr std::size_t kBlocks = 64;
  const auto ends_of = [](std::size_t nodes) {
    const std::size_t wide = (nodes - 1 + kBlocks - 1) / kBlocks;
    std::vector<std::size_t> ends;  // with the middles between: lines of a table are bent
    for (std::size_t at = 0; at + 1 < nodes; at += wide) {
      const std::size_t last = std::min(at + wide, nodes - 1);
      ends.insert(ends.end(), {at, (at + last) / 2});
    }
    ends.push_back(nodes - 1);
    return ends;
  };
  const std::vector<std::size_t> columns = ends_of(grid.first_deg.size()), rows = ends_of(grid.second_deg.size());
  struct Place {
    glm::vec2 at{0.0f};
    bool ahead = false, wide = false, high = false;
  };
  std::vector<Place> places;
  places.reserve(columns.size() * rows.size());
  for (const std::size_t row : rows)
    for (const std::size_t column : columns) {
      const TableAngles at{grid.first_deg[column], grid.second_deg[row]};
      const glm::dvec3 way =
          grid.screen_distance_m > 0.0 ? screen_direction(at) : table_direction(grid.type, grid.axis, at);
      const double ahead = std::max(way.x, kBeside);
      places.push_back({{kAcross.at(static_cast<float>(way.y / ahead)), kUp.at(static_cast<float>(way.z / ahead))},
                        way.x > 0.0,
                        std::abs(way.y) > kWidestShadow * way.x,
                        std::abs(way.z) > kHighestShadow * std::abs(way.x)});
    }
  for (std::size_t j = 0; j + 2 < rows.size(); j += 2)
    for (std::size_t i = 0; i + 2 < columns.size(); i += 2) {
      glm::vec2 least(std::numeric_limits<float>::infinity()), most(-least);
      bool ahead = false, wide = false, high = false;
      for (std::size_t row = j; row <= j + 2; ++row)
        for (std::size_t column = i; column <= i + 2; ++column) {
          const Place& place = places[row * columns.size() + column];
          least = glm::min(least, place.at), most = glm::max(most, place.at);
          ahead = ahead || place.ahead, wide = wide || place.wide, high = high || place.high;
        }
      const auto node = [](std::size_t index) { return static_cast<std::uint16_t>(index); };
      Block block{.column = node(columns[i]),
                  .last_column = node(columns[i + 2]),
                  .row = node(rows[j]),
                  .last_row = node(rows[j + 2]),
                  .wide_beyond = wide,
                  .high_beyond = high};
      if (!ahead) {
        blocks_.push_back(block);
        continue;
      }
      // Lines of the table are bent between these, by less than the block's own size; levels of beam images blur by a
      // texel, which is less than a cell.
      const glm::vec2 room = 0.5f * (most - least) + 1.0f;
      const Cells across = cells_between(least.x - room.x, most.x + room.x, kColumns),
                  up = cells_between(least.y - room.y, most.y + room.y, kRows);
      const auto cell = [](int index) { return static_cast<std::uint8_t>(index); };
      block.right = cell(across.first), block.left = cell(across.end);
      block.low = cell(up.first), block.high = cell(up.end);
      blocks_.push_back(block);
    }
}

void LightPeaks::set(const BeamImage& image) {
  most_cd_.clear();
  peak_cd_ = wide_cd_ = high_cd_ = 0.0f;
  constexpr std::size_t kMostNodes = std::numeric_limits<std::uint16_t>::max();
  if (image.dark || image.candela.empty()) return;
  if (image.first_deg.size() > kMostNodes || image.second_deg.size() > kMostNodes) {
    blocks_.clear(), grid_ = {};
    most_cd_.assign(static_cast<std::size_t>(kColumns * kRows), std::numeric_limits<float>::infinity());
    return;
  }
  if (image.type != grid_.type || image.axis != grid_.axis || image.screen_distance_m != grid_.screen_distance_m ||
      image.first_deg != grid_.first_deg || image.second_deg != grid_.second_deg)
    place_blocks(image);
  for (Block& block : blocks_) read(image, block);
  fill_cells();
}

void LightPeaks::change(const BeamImage& image, std::span<const TexelRect> changed) {
  if (image.dark || most_cd_.empty() || blocks_.empty()) {
    set(image);
    return;
  }
  // Light runs on to the nodes beside, which are the ends of other blocks.
  for (Block& block : blocks_)
    if (std::ranges::any_of(changed, [&](const TexelRect& rect) {
          return block.column < rect.end_column && block.last_column >= rect.column && block.row < rect.end_row &&
                 block.last_row >= rect.row;
        }))
      read(image, block);
  fill_cells();
}

void LightPeaks::read(const BeamImage& image, Block& block) {
  const std::size_t columns = image.first_deg.size();
  block.most_cd = 0.0f;
  for (std::size_t row = block.row; row <= block.last_row; ++row) {
    const float* const nodes = &image.candela[row * columns];
    block.most_cd = std::max(block.most_cd, *std::max_element(nodes + block.column, nodes + block.last_column + 1));
  }
}

void LightPeaks::fill_cells() {
  most_cd_.assign(static_cast<std::size_t>(kColumns * kRows), 0.0f);
  peak_cd_ = wide_cd_ = high_cd_ = 0.0f;
  for (const Block& block : blocks_) {
    peak_cd_ = std::max(peak_cd_, block.most_cd);
    if (block.wide_beyond) wide_cd_ = std::max(wide_cd_, block.most_cd);
    if (block.high_beyond) high_cd_ = std::max(high_cd_, block.most_cd);
    for (int row = block.low; row < block.high && block.most_cd > 0.0f; ++row)
      for (int column = block.right; column < block.left; ++column) {
        float& cell = most_cd_[static_cast<std::size_t>(row * kColumns + column)];
        cell = std::max(cell, block.most_cd);
      }
  }
}

glm::vec2 LightPeaks::cell_of(const glm::vec2& tangents) {
  return {kAcross.at(tangents.x), kUp.at(tangents.y)};
}

bool LightPeaks::exceeds_in(const glm::vec2& least_cell, const glm::vec2& most_cell, float cd) const {
  if (most_cd_.empty()) return false;
  const Cells across = cells_between(least_cell.x, most_cell.x, kColumns),
              up = cells_between(least_cell.y, most_cell.y, kRows);
  for (int j = up.first; j < up.end; ++j) {
    const float* const row = &most_cd_[static_cast<std::size_t>(j * kColumns)];
    if (std::any_of(row + across.first, row + across.end, [cd](float most_here) { return most_here > cd; }))
      return true;
  }
  return false;
}

}  // namespace phare
