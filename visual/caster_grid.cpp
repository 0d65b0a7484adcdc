#include "visual/caster_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "config/base/on_all_cores.h"
#include "shaders/lamps.h"
#include "visual/clipped_triangle.h"

namespace phare {
namespace {

/// Tangents of corners as they come, and the least way forward of what is ahead of the lamp.
struct Bounds {
  float right = std::numeric_limits<float>::infinity(), left = -right, low = right, high = -right, nearest_m = right;

  void add(const glm::vec3& ahead) {
    const float y = ahead.y / ahead.x, z = ahead.z / ahead.x;
    right = std::min(right, y), left = std::max(left, y);
    low = std::min(low, z), high = std::max(high, z);
    nearest_m = std::min(nearest_m, ahead.x);
  }
  /// Of an edge that passes the plane just before the lamp, the point where it does.
  void add_crossing(const glm::vec3& a, const glm::vec3& b) {
    const float near_m = shader::kShadowNear_m;
    if ((a.x < near_m) == (b.x < near_m)) return;
    const glm::vec3 at = a + (b - a) * ((near_m - a.x) / (b.x - a.x));
    add({near_m, at.y, at.z});
  }
  glm::vec2 least() const { return {right, low}; }
  glm::vec2 most() const { return {left, high}; }
};

/// A map to the tangents `half_sides` holds nothing of a triangle that is nearer: what lies far beside the axis comes
/// into it far ahead.
float begins_m(const std::array<glm::vec3, 3>& triangle, const glm::vec2& half_sides) {
  glm::vec2 nearest(std::numeric_limits<float>::infinity());
  glm::vec2 least(nearest), most(-nearest);
  for (const glm::vec3& corner : triangle) {
    const glm::vec2 beside(corner.y, corner.z);
    nearest = glm::min(nearest, glm::abs(beside)), least = glm::min(least, beside), most = glm::max(most, beside);
  }
  // With three hundredths to spare, for the texels that are weighed about a point.
  constexpr float kSpare = 0.97f;
  float begin_m = shader::kShadowNear_m;
  for (int axis = 0; axis < 2; ++axis)
    if (least[axis] > 0.0f || most[axis] < 0.0f) begin_m = std::max(begin_m, kSpare * nearest[axis] / half_sides[axis]);
  return begin_m;
}

/// p·(to the left) + q·up + r, by tangents.
struct Slope {
  float p = 0.0f, q = 0.0f, r = 0.0f;
};

/// A triangle as the lamp sees it, all of it ahead: where it is, and how near there.
struct SeenTriangle {
  SeenTriangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float nearest_m)
      : least_per_m(1.0f / std::max({a.x, b.x, c.x})), most_per_m(1.0f / nearest_m) {
    const std::array<glm::vec2, 3> at{glm::vec2(a.y, a.z) / a.x, glm::vec2(b.y, b.z) / b.x, glm::vec2(c.y, c.z) / c.x};
    // Of tangents, which are 4 at most where a triangle is whole, rounded.
    float largest = 4.0f;
    for (const glm::vec2& tangent : at) largest = std::max({largest, std::abs(tangent.x), std::abs(tangent.y)});
    const float rounding = 2.5e-6f * largest;
    const auto across = [](const glm::vec2& u, const glm::vec2& v) { return u.x * v.y - u.y * v.x; };
    const float area = across(at[1] - at[0], at[2] - at[0]);
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec2 along = (at[(i + 1) % 3] - at[i]) * (area < 0.0f ? -1.0f : 1.0f);
      const float room = rounding * (std::abs(along.x) + std::abs(along.y));
      if (std::abs(area) > 1e-7f) inside[i] = {-along.y, along.x, along.y * at[i].x - along.x * at[i].y + room};
    }
    // 1 over the way forward is even over the lamp's view.
    const glm::vec3 normal = glm::cross(b - a, c - a);
    const float away = glm::dot(normal, a);
    if (std::abs(away) > 1e-4f * glm::length(normal)) {
      const glm::vec3 each = normal * (1.001f / away);
      per_m = {each.y, each.z, each.x};
    } else {
      per_m.r = most_per_m;
    }
  }

  /// Tangents to the left between which some of it may show, from `low` to `high`; none: the first is larger.
  glm::vec2 across_between(float low, float high) const {
    constexpr float kBeyond = 1e6f;
    glm::vec2 span(-kBeyond, kBeyond);
    for (const Slope& side : inside) {
      const float rest = side.q * (side.q > 0.0f ? high : low) + side.r;
      if (side.p > 0.0f)
        span.x = std::max(span.x, -rest / side.p);
      else if (side.p < 0.0f)
        span.y = std::min(span.y, -rest / side.p);
      else if (rest < 0.0f)
        return {1.0f, 0.0f};
    }
    return glm::clamp(span, -kBeyond, kBeyond);
  }

  float least_per_m, most_per_m;
  std::array<Slope, 3> inside{};
  Slope per_m{};
};

/// Tangent above the lamp's axis up to which cells are kept apart: most of what is asked about is ground, and most of
/// what casts is leaves high above it.
constexpr float kHigh = 0.05f;

}  // namespace

BoxCorners box_corners(const glm::dmat3& image_from_world, const glm::dvec3& lamp_m, const glm::dvec3& low_m,
                       const glm::dvec3& high_m) {
  const glm::vec3 first(image_from_world * (low_m - lamp_m));
  const glm::mat3 sides(image_from_world[0] * (high_m.x - low_m.x), image_from_world[1] * (high_m.y - low_m.y),
                        image_from_world[2] * (high_m.z - low_m.z));
  BoxCorners corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = first + (i & 1 ? sides[0] : glm::vec3(0.0f)) + (i & 2 ? sides[1] : glm::vec3(0.0f)) +
                 (i & 4 ? sides[2] : glm::vec3(0.0f));
  return corners;
}

CasterGrid::CasterGrid(const CastBy& cast, const glm::dvec2& half_sides, const glm::dvec2& texel, double zoom) {
  // Texels that are weighed about a point, half of one that is added, and one for rounding.
  constexpr double kRoom_texels = 3.0;
  const auto axis = [&](double half, double finest, int cells, double of_texel) {
    return Axis{{static_cast<float>(half), static_cast<float>(finest), cells},
                static_cast<float>(kRoom_texels * of_texel),
                static_cast<float>(zoom)};
  };
  across_ = axis(half_sides.x, 0.3, kColumns, texel.x);
  up_ = axis(half_sides.y, 0.1, kRows, texel.y);
  end_row_ = std::min(kRows, static_cast<int>(up_.at(kHigh)) + 1);
  const int blocks_up = (end_row_ + kBlock - 1) / kBlock;
  per_m_.resize(static_cast<std::size_t>(blocks_up * kBlock * kColumns));
  per_m_of_block_.resize(static_cast<std::size_t>(blocks_up * (kColumns / kBlock)));
  add_in_parts(cast, half_sides);
  for (int block = 0; block < blocks_up; ++block) {
    std::array<float, kColumns> most{};
    for (int row = block * kBlock; row < (block + 1) * kBlock; ++row) {
      const float* const in_row = &per_m_[static_cast<std::size_t>(row * kColumns)];
      for (std::size_t column = 0; column < kColumns; ++column) most[column] = std::max(most[column], in_row[column]);
    }
    float* const of_block = &per_m_of_block_[static_cast<std::size_t>(block * (kColumns / kBlock))];
    for (std::size_t column = 0; column < kColumns; ++column)
      of_block[column / kBlock] = std::max(of_block[column / kBlock], most[column]);
  }
}

void CasterGrid::add_in_parts(const CastBy& cast, const glm::vec2& half_sides) {
  std::size_t triangles = cast.far_sides.bounds.size() + cast.both_sides.bounds.size();
  for (const CutCasters& cut : cast.cut) triangles += cut.bounds.size();
  const std::size_t parts = parts_of_casters(triangles);
  std::vector<CasterGrid> others(parts - 1, *this);
  on_all_cores(parts,
               [&](std::size_t part) { (part == 0 ? *this : others[part - 1]).add(cast, half_sides, part, parts); });
  for (const CasterGrid& other : others) {
    for (std::size_t i = 0; i < per_m_.size(); ++i) per_m_[i] = std::max(per_m_[i], other.per_m_[i]);
    above_per_m_ = std::max(above_per_m_, other.above_per_m_);
  }
}

void CasterGrid::add(const CastBy& cast, const glm::vec2& half_sides, std::size_t part, std::size_t parts) {
  const auto column_of = [&](float left) {
    return static_cast<int>(std::clamp(across_.at(left), 0.0f, static_cast<float>(kColumns)));
  };
  std::array<float, kColumns + 1> columns{};
  std::array<float, kRows + 1> rows{};
  for (int i = 0; i <= kColumns; ++i) columns[static_cast<std::size_t>(i)] = across_.tangent(i);
  for (int i = 0; i <= kRows; ++i) rows[static_cast<std::size_t>(i)] = up_.tangent(i);
  const auto raise = [&](const Cells& cells, float per_m) {
    for (int row = cells.first_row; row < cells.end_row; ++row)
      for (int column = cells.first_column; column < cells.end_column; ++column) {
        float& most = per_m_[static_cast<std::size_t>(row * kColumns + column)];
        most = std::max(most, per_m);
      }
  };
  const auto raise_by = [&](const SeenTriangle& seen, const Cells& cells) {
    constexpr int kNarrow = 3;  // columns that are raised sooner than it is told which of them the triangle leaves out
    const bool narrow = cells.end_column - cells.first_column <= kNarrow;
    for (int row = cells.first_row; row < cells.end_row; ++row) {
      const float low = rows[static_cast<std::size_t>(row)], high = rows[static_cast<std::size_t>(row) + 1];
      int first = cells.first_column, end = cells.end_column;
      if (!narrow) {
        const glm::vec2 span = seen.across_between(low, high);
        if (span.x > span.y) continue;
        first = std::max(first, column_of(span.x)), end = std::min(end, column_of(span.y) + 1);
      }
      const float in_row = seen.per_m.q * (seen.per_m.q > 0.0f ? high : low) + seen.per_m.r;
      const float* const side = &columns[seen.per_m.p > 0.0f ? 1 : 0];
      float* const most = &per_m_[static_cast<std::size_t>(row) * kColumns];
      for (int column = first; column < end; ++column)
        most[column] =
            std::max(most[column], std::clamp(seen.per_m.p * side[column] + in_row, seen.least_per_m, seen.most_per_m));
    }
  };
  const auto below = [this](Cells cells, float per_m) {
    if (cells.end_row > end_row_) above_per_m_ = std::max(above_per_m_, per_m), cells.end_row = end_row_;
    return cells;
  };
  const auto add_ahead = [&](const CastBounds& bounds, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const Cells cells = below(cells_of(bounds.least, bounds.most), 1.0f / bounds.nearest_m);
    constexpr int kFew = 4;
    if ((cells.end_row - cells.first_row) * (cells.end_column - cells.first_column) <= kFew)
      return raise(cells, 1.0f / bounds.nearest_m);
    raise_by(SeenTriangle(a, b, c, bounds.nearest_m), cells);
  };
  const auto add_one = [&](const CastBounds& bounds, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    if (!bounds.beside) return add_ahead(bounds, a, b, c);
    const auto clipped = ahead_of<glm::vec3>(begins_m({a, b, c}, half_sides), {a, b, c});
    for (std::size_t i = 2; i < clipped.count; ++i) {
      Bounds of;
      for (const std::size_t corner : {std::size_t{0}, i - 1, i}) of.add(clipped.corners[corner]);
      add_ahead({of.least(), of.most(), of.nearest_m}, clipped.corners[0], clipped.corners[i - 1], clipped.corners[i]);
    }
  };
  const auto of_part = [&](std::size_t count) { return std::pair(count * part / parts, count * (part + 1) / parts); };
  for (const WholeCasters* whole : {&cast.far_sides, &cast.both_sides})
    for (auto [i, end] = of_part(whole->bounds.size()); i < end; ++i) {
      const glm::vec3* corners = &whole->corners[3 * i];
      add_one(whole->bounds[i], corners[0], corners[1], corners[2]);
    }
  for (const CutCasters& cut : cast.cut)
    for (auto [i, end] = of_part(cut.bounds.size()); i < end; ++i) {
      const CutCorner* corners = &cut.corners[3 * i];
      add_one(cut.bounds[i], corners[0].corner_m, corners[1].corner_m, corners[2].corner_m);
    }
}

bool CasterGrid::may_shade(const BoxCorners& box) const {
  if (per_m_.empty()) return false;
  Bounds bounds;
  float farthest_m = 0.0f;
  bool all = true;
  for (const glm::vec3& corner : box) {
    farthest_m = std::max(farthest_m, corner.x);
    if (corner.x >= shader::kShadowNear_m)
      bounds.add(corner);
    else
      all = false;
  }
  if (!all)
    for (std::size_t i = 0; i < 8; ++i)
      for (const std::size_t side : {1u, 2u, 4u})
        if ((i & side) == 0) bounds.add_crossing(box[i], box[i | side]);
  if (bounds.nearest_m > farthest_m) return false;  // behind the lamp
  const glm::vec2 least = bounds.least(), most = bounds.most();
  const bool close = across_.close(least.x, most.x) && up_.close(least.y, most.y);
  Cells cells = cells_of({across_.widened(least.x, -1.0f, close), up_.widened(least.y, -1.0f, close)},
                         {across_.widened(most.x, 1.0f, close), up_.widened(most.y, 1.0f, close)});
  if (cells.end_row > end_row_) {
    if (above_per_m_ * farthest_m > 1.0f) return true;
    cells.end_row = end_row_;
  }
  glm::vec3 low = box[0], high = box[0];
  for (const glm::vec3& corner : box) low = glm::min(low, corner), high = glm::max(high, corner);
  // Where the box is seen in some columns or rows, it is so far forward at most: ground below the lamp is near in low
  // rows.
  const auto farthest_in = [&](const Axis& axis, int first, int end, float least_m, float most_m) {
    const float from = axis.widened(axis.tangent(first), -1.0f, close),
                to = axis.widened(axis.tangent(end), 1.0f, close);
    if (to < 0.0f) return std::min(farthest_m, std::min(least_m, 0.0f) / to);
    if (from > 0.0f) return std::min(farthest_m, std::max(most_m, 0.0f) / from);
    return farthest_m;
  };
  const auto in_block = [&](int first_row, int first_column) {
    const int end_row = std::min(first_row + kBlock, cells.end_row);
    const int begin_column = std::max(first_column, cells.first_column);
    const int end_column = std::min(first_column + kBlock, cells.end_column);
    for (int row = std::max(first_row, cells.first_row); row < end_row; ++row) {
      const float in_row_m = farthest_in(up_, row, row + 1, low.z, high.z);
      for (int column = begin_column; column < end_column; ++column) {
        const float per_m = per_m_[static_cast<std::size_t>(row * kColumns + column)];
        if (per_m * in_row_m > 1.0f && per_m * farthest_in(across_, column, column + 1, low.y, high.y) > 1.0f)
          return true;
      }
    }
    return false;
  };
  for (int row = cells.first_row / kBlock * kBlock; row < cells.end_row; row += kBlock) {
    const float in_rows_m = farthest_in(up_, row, row + kBlock, low.z, high.z);
    for (int column = cells.first_column / kBlock * kBlock; column < cells.end_column; column += kBlock)
      if (per_m_of_block_[static_cast<std::size_t>(row / kBlock * (kColumns / kBlock) + column / kBlock)] * in_rows_m >
              1.0f &&
          in_block(row, column))
        return true;
  }
  return false;
}

/// Between these the map's second picture is read, if that holds across and up: with texels to spare, which are weighed
/// about a point.
bool CasterGrid::Axis::close(float least, float most) const {
  return std::max(-least, most) < half / zoom - 4.0f * room;
}

float CasterGrid::Axis::widened(float tangent, float way, bool close) const {
  return tangent + way * (close ? room / zoom : room);
}

CasterGrid::Cells CasterGrid::cells_of(const glm::vec2& least, const glm::vec2& most) const {
  const auto within = [](float cell, int cells) {
    return static_cast<int>(std::clamp(cell, 0.0f, static_cast<float>(cells)));
  };
  return {within(across_.at(least.x), kColumns), within(across_.at(most.x) + 1.0f, kColumns),
          within(up_.at(least.y), kRows), within(up_.at(most.y) + 1.0f, kRows)};
}

}  // namespace phare
