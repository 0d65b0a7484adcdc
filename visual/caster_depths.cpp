#include "visual/caster_depths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "shaders/lamps.h"
#include "visual/clipped_triangle.h"

namespace phare {
namespace {

/// How far a triangle that is seen from both sides is moved back: by its depth's change over so many texels.
constexpr double kBackTexels = 1.5;
/// Texels of a row that are raised at once.
constexpr int kLanes = 8;
using Lanes = float __attribute__((vector_size(4 * kLanes)));
constexpr Lanes kLane{0, 1, 2, 3, 4, 5, 6, 7};

// All of it is compiled twice, once for processors that have eight lanes.
#define PHARE_WITHIN [[gnu::always_inline]] inline

using Polygon = ClippedTriangle<glm::dvec3>;

/// A side of a polygon: where it crosses a row.
struct Side {
  double x = 0.0, y = 0.0, per_row = 0.0;
  PHARE_WITHIN double across(double row) const { return x + (row - y) * per_row; }
};

/// Those on one hand of it.
struct Hand {
  std::array<Side, 3> sides{};
  std::size_t count = 0;
};

/// Texels whose middles lie between two places: the first, and the one behind the last. A little of each is far beyond
/// what any picture holds.
struct Middles {
  PHARE_WITHIN Middles(double from, double to) {
    constexpr double kFar = 1e6;
    const double first_at = std::min(std::max(from, -1.0), kFar) + 0.5;
    const int whole = static_cast<int>(first_at);
    first = whole + (first_at > whole ? 1 : 0) - 1;
    end = static_cast<int>(std::min(std::max(to, -1.0), kFar) + 0.5);
  }
  int first, end;
};

class Drawing {
 public:
  Drawing(const DepthPicture& picture, std::span<float> depths)
      : depths_(depths.data()),
        end_(depths.data() + depths.size()),
        width_(static_cast<int>(picture.width)),
        first_(static_cast<int>(picture.margin)),
        end_x_(width_ - first_),
        end_y_(static_cast<int>(picture.height) - first_),
        texels_(picture.texels),
        middle_(0.5 * picture.width, 0.5 * picture.height) {}

  PHARE_WITHIN void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, bool beside,
                        bool both_sides) const {
    const std::array<glm::dvec3, 3> triangle{a, b, c};
    Polygon polygon{{triangle[0], triangle[1], triangle[2]}, 3};
    if (beside) polygon = ahead_of<glm::dvec3>(shader::kShadowNear_m, triangle);
    if (polygon.count < 3) return;
    // 1 over the way forward is even over the lamp's view.
    const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double away = glm::dot(normal, triangle[0]);
    if (away == 0.0) return;  // the lamp sees its edge
    const glm::dvec3 per_tangent = normal * (shader::kShadowNear_m / away);
    const glm::dvec2 per_texel = glm::dvec2(-per_tangent.y, -per_tangent.z) / texels_;
    fill(polygon, {per_texel.x, per_texel.y, per_tangent.x - per_texel.x * middle_.x - per_texel.y * middle_.y},
         both_sides ? kBackTexels * std::max(std::abs(per_texel.x), std::abs(per_texel.y)) : 0.0);
  }

 private:
  // `depth`: of a texel to the right, of one down, and at the upper left corner.
  PHARE_WITHIN void fill(const Polygon& polygon, const glm::dvec3& depth, double back) const {
    std::array<glm::dvec2, 4> at;
    double nearest_per_m = 0.0;
    glm::dvec2 least(HUGE_VAL), largest(-HUGE_VAL);
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const glm::dvec3& corner = polygon.corners[i];
      const double per_m = 1.0 / corner.x;
      at[i] = middle_ - texels_ * (glm::dvec2(corner.y, corner.z) * per_m);
      nearest_per_m = std::max(nearest_per_m, per_m);
      least = glm::min(least, at[i]), largest = glm::max(largest, at[i]);
    }
    const Middles rows(least.y, largest.y), columns(least.x, largest.x);
    const int first_row = std::max(first_, rows.first), end_row = std::min(end_y_, rows.end);
    if (first_row >= end_row || columns.first >= std::min(end_x_, columns.end)) return;
    const auto most = static_cast<float>(shader::kShadowNear_m * nearest_per_m - back);
    const auto step = static_cast<float>(depth.x);
    float* const corner = depths_ + static_cast<std::ptrdiff_t>(first_row) * width_ + columns.first;
    if (polygon.count == 3 && columns.first >= first_ && columns.end <= end_x_ &&
        columns.end - columns.first <= kLanes &&
        end_ - corner >= static_cast<std::ptrdiff_t>(end_row - 1 - first_row) * width_ + kLanes) {
      const glm::dvec2 middle = glm::dvec2(columns.first, first_row) + 0.5;
      const double there = depth.x * middle.x + depth.y * middle.y + depth.z - back;
      fill_narrow(at, middle, corner, end_row - first_row, static_cast<float>(there), step, static_cast<float>(depth.y),
                  most);
      return;
    }
    // Going round it, sides on one hand lead down, those on the other up.
    Hand down, up;
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const glm::dvec2 &from = at[i], &to = at[i + 1 < polygon.count ? i + 1 : 0];
      if (from.y == to.y) continue;
      Hand& hand = to.y > from.y ? down : up;
      hand.sides[hand.count++] = {from.x, from.y, (to.x - from.x) / (to.y - from.y)};
    }
    const double somewhere = 0.5 * (std::max(least.y, 0.0) + std::min(largest.y, 2.0 * middle_.y));
    const bool down_is_left = down.sides[0].across(somewhere) < up.sides[0].across(somewhere);
    const Hand &left = down_is_left ? down : up, &right = down_is_left ? up : down;
    for (int row = first_row; row < end_row; ++row) {
      const double middle = row + 0.5;
      double from = left.sides[0].across(middle), to = right.sides[0].across(middle);
      for (std::size_t i = 1; i < left.count; ++i) from = std::max(from, left.sides[i].across(middle));
      for (std::size_t i = 1; i < right.count; ++i) to = std::min(to, right.sides[i].across(middle));
      const Middles in_row(from, to);
      const int first = std::max(first_, in_row.first), end = std::min(end_x_, in_row.end);
      if (first < end)
        raise(depths_ + static_cast<std::ptrdiff_t>(row) * width_ + first, end - first,
              static_cast<float>(depth.x * (first + 0.5) + depth.y * middle + depth.z - back), step, most);
    }
  }

  // Of a triangle no wider than the lanes, each row at once. `middle`: of the first texel, at which `texel` points and
  // has `depth`; further by `across` and `down`.
  PHARE_WITHIN void fill_narrow(const std::array<glm::dvec2, 4>& at, const glm::dvec2& middle, float* texel, int rows,
                                float depth, float across, float down, float most) const {
    const glm::dvec2 ab = at[1] - at[0], ac = at[2] - at[0];
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (area == 0.0) return;
    // Twice the area between each side and the middles, above 0 within.
    std::array<Lanes, 3> within;
    std::array<float, 3> per_row;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 along = (at[i < 2 ? i + 1 : 0] - at[i]) * (area < 0.0 ? -1.0 : 1.0), from = middle - at[i];
      within[i] = static_cast<float>(along.x * from.y - along.y * from.x) - static_cast<float>(along.y) * kLane;
      per_row[i] = static_cast<float>(along.x);
    }
    Lanes here = depth + across * kLane;
    for (int row = 0; row < rows; ++row, texel += width_) {
      Lanes held;
      std::memcpy(&held, texel, sizeof held);
      const Lanes capped = here < most ? here : Lanes{} + most;
      const Lanes raised = held > capped ? held : capped;
      const auto inside = (within[0] >= 0.0f) & (within[1] >= 0.0f) & (within[2] >= 0.0f);
      held = inside ? raised : held;
      std::memcpy(texel, &held, sizeof held);
      here += down;
      for (std::size_t i = 0; i < 3; ++i) within[i] += per_row[i];
    }
  }

  PHARE_WITHIN void raise(float* texel, int count, float depth, float step, float most) const {
    int i = 0;
    // Those behind the last stay as they are, but the picture's memory may not.
    for (; i < count && end_ - texel >= i + kLanes; i += kLanes) {
      const Lanes at = kLane + static_cast<float>(i), here = depth + step * at;
      Lanes held;
      std::memcpy(&held, texel + i, sizeof held);
      const Lanes capped = here < most ? here : Lanes{} + most;
      const Lanes raised = at < static_cast<float>(count) ? capped : held;
      held = held > raised ? held : raised;
      std::memcpy(texel + i, &held, sizeof held);
    }
    for (; i < count; ++i) texel[i] = std::max(texel[i], std::min(depth + step * static_cast<float>(i), most));
  }

  float *depths_, *end_;
  int width_, first_, end_x_, end_y_;
  glm::dvec2 texels_, middle_;
};

PHARE_WITHIN void raise_all(const DepthPicture& picture, const CastBy& cast, bool holes, std::span<float> depths) {
  const Drawing drawing(picture, depths);
  for (const WholeCasters* whole : {&cast.far_sides, &cast.both_sides})
    for (std::size_t i = 0; i < whole->bounds.size(); ++i) {
      const glm::vec3* corners = &whole->corners[3 * i];
      if (picture.shows(whole->bounds[i]))
        drawing.add(corners[0], corners[1], corners[2], whole->bounds[i].beside, whole == &cast.both_sides);
    }
  if (!holes) return;
  for (const CutCasters& cut : cast.cut)
    for (std::size_t i = 0; i < cut.bounds.size(); ++i) {
      const CutCorner* corners = &cut.corners[3 * i];
      if (picture.shows(cut.bounds[i]))
        drawing.add(corners[0].corner_m, corners[1].corner_m, corners[2].corner_m, cut.bounds[i].beside, true);
    }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void raise_by_eight(const DepthPicture& picture, const CastBy& cast, bool holes,
                                            std::span<float> depths) {
  raise_all(picture, cast, holes, depths);
}
#endif

}  // namespace

bool DepthPicture::shows(const CastBounds& triangle) const {
  if (triangle.beside) return true;
  const glm::vec2 scale(texels), size(width, height), half = 0.5f * size;
  const glm::vec2 low = half - triangle.most * scale, high = half - triangle.least * scale;
  const glm::vec2 first = glm::ceil(low - 0.5f), last = glm::floor(high - 0.5f);
  const bool holds_one = first.x <= last.x && first.y <= last.y && last.x >= 0.0f && last.y >= 0.0f &&
                         first.x < size.x && first.y < size.y;
  const bool is_read = low.x < half.x - half_unread.x || high.x > half.x + half_unread.x ||
                       low.y < half.y - half_unread.y || high.y > half.y + half_unread.y;
  return holds_one && is_read;
}

void raise_depths(const DepthPicture& picture, const CastBy& cast, bool holes, std::span<float> depths) {
#if defined(__x86_64__)
  static const bool eight = __builtin_cpu_supports("avx2");
  if (eight) return raise_by_eight(picture, cast, holes, depths);
#endif
  raise_depths_one_by_one(picture, cast, holes, depths);
}

void raise_depths_one_by_one(const DepthPicture& picture, const CastBy& cast, bool holes, std::span<float> depths) {
  raise_all(picture, cast, holes, depths);
}

}  // namespace phare
