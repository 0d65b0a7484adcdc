// What a packed beam (beam_packing.h) is on the device, texel by texel.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "visual/beam_packing.h"

namespace phare {

TexelRect texels_about(const PackedBeam& packed, const TexelRect& nodes) {
  if (packed.filtered() || nodes.empty()) return nodes;
  return {nodes.column, nodes.row, nodes.end_column + 1, nodes.end_row + 1};
}

namespace {

// Each texel of `rect` as `put(bytes, texel)` writes it; `texel`: four nodes of a cell, or a value.
template <typename Wide, typename Value>
std::array<Value, 4> nodes_of_cell(const PackedBeam& packed, const std::vector<Value>& nodes, std::size_t column,
                                   std::size_t row) {
  const auto at = [&](std::size_t i, std::size_t j) {  // counted from the node before the first
    const bool there = i > 0 && j > 0 && i <= packed.columns && j <= packed.rows_of_candela;
    return there ? nodes[(j - 1) * packed.columns + i - 1] : Value{};
  };
  const std::array cell{at(column, row), at(column + 1, row), at(column, row + 1), at(column + 1, row + 1)};
  if (packed.column_corners.empty()) return cell;
  const auto between = [](const Wide& from, const Wide& to, double part) { return from + (to - from) * part; };
  const glm::dvec2 x = packed.column_corners[column], y = packed.row_corners[row];
  const auto corner = [&](double s, double t) {
    return static_cast<Value>(
        between(between(Wide(cell[0]), Wide(cell[1]), s), between(Wide(cell[2]), Wide(cell[3]), s), t));
  };
  return {corner(x.x, y.x), corner(x.y, y.x), corner(x.x, y.y), corner(x.y, y.y)};
}

template <typename Texel>
std::vector<std::byte> bytes_of(const TexelRect& rect, Texel&& texel) {
  std::vector<std::byte> bytes(rect.texels() * sizeof texel(rect.column, rect.row));
  std::byte* out = bytes.data();
  for (std::size_t j = rect.row; j < rect.end_row; ++j) {
    for (std::size_t i = rect.column; i < rect.end_column; ++i) {
      const auto value = texel(i, j);
      std::memcpy(out, &value, sizeof value);
      out += sizeof value;
    }
  }
  return bytes;
}

}  // namespace

std::vector<std::byte> texels_of(const PackedBeam& packed, const TexelRect& texels) {
  const auto filtered = [&](std::size_t i, std::size_t j) {
    return packed.candela[j * packed.columns + i] / packed.scale_cd;
  };
  switch (packed.level) {
    case ImageLevel::kNormalised8:
      return bytes_of(texels, [&](std::size_t i, std::size_t j) {
        return static_cast<std::uint8_t>(std::lround(255.0f * filtered(i, j)));
      });
    case ImageLevel::kHalfEven:
      return bytes_of(texels, [&](std::size_t i, std::size_t j) { return half_from_float(filtered(i, j)); });
    case ImageLevel::kHalfNodes:
      return bytes_of(texels, [&](std::size_t i, std::size_t j) {
        const auto cd = nodes_of_cell<double>(packed, packed.candela, i, j);
        std::array<std::uint16_t, 4> halves;
        std::transform(cd.begin(), cd.end(), halves.begin(),
                       [&](float value) { return half_from_float(value / packed.scale_cd); });
        return halves;
      });
    case ImageLevel::kFloatNodes:
      break;
  }
  return bytes_of(texels,
                  [&](std::size_t i, std::size_t j) { return nodes_of_cell<double>(packed, packed.candela, i, j); });
}

std::vector<std::byte> tint_texels_of(const PackedBeam& packed, const TexelRect& texels) {
  const float scale = packed.tint_scale();
  if (packed.filtered())
    return bytes_of(texels, [&](std::size_t i, std::size_t j) {
      const glm::vec2 tint = packed.tints[j * packed.columns + i] / scale;
      return std::array{half_from_float(tint.x), half_from_float(tint.y)};
    });
  const auto reds_and_blues = [&](std::size_t i, std::size_t j) {
    const auto tint = nodes_of_cell<glm::dvec2>(packed, packed.tints, i, j);
    return std::array{tint[0].x, tint[1].x, tint[2].x, tint[3].x, tint[0].y, tint[1].y, tint[2].y, tint[3].y};
  };
  if (packed.level == ImageLevel::kFloatNodes) return bytes_of(texels, reds_and_blues);
  return bytes_of(texels, [&](std::size_t i, std::size_t j) {
    const auto tint = reds_and_blues(i, j);
    std::array<std::uint16_t, 8> halves;
    std::transform(tint.begin(), tint.end(), halves.begin(),
                   [&](float value) { return half_from_float(value / scale); });
    return halves;
  });
}

}  // namespace phare
