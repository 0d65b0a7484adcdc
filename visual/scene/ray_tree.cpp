#include "visual/scene/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

namespace phare {
namespace {

constexpr std::size_t kInLeaf = 4;
constexpr int kDeepest = 60;  ///< halves of any number of triangles; the stack below holds them

}  // namespace

RayTree::RayTree(const Scene& scene) {
  std::vector<Triangle> all;
  for (const SceneChunk& chunk : scene.chunks) {
    if (scene.materials[chunk.material].surface == Surface::kPaint) continue;
    for (std::uint32_t i = 0; i + 2 < chunk.index_count; i += 3) {
      const auto corner = [&](std::uint32_t k) {
        return chunk.origin_m +
               glm::dvec3(scene.vertices[chunk.first_vertex + scene.indices[chunk.first_index + i + k]].position_m);
      };
      const glm::dvec3 a = corner(0);
      all.push_back({a, corner(1) - a, corner(2) - a, !scene.materials[chunk.material].double_sided});
    }
  }
  *this = RayTree(all);
}

RayTree::RayTree(const std::vector<Triangle>& all) {
  if (all.empty()) return;
  std::vector<std::uint32_t> order(all.size());
  std::iota(order.begin(), order.end(), 0u);
  triangles_.reserve(all.size());
  order_.reserve(all.size());
  boxes_.reserve(all.size());
  build(order, 0, order.size(), all, 0);
}

std::uint32_t RayTree::build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end,
                             const std::vector<Triangle>& all, int depth) {
  const auto self = static_cast<std::uint32_t>(boxes_.size());
  boxes_.emplace_back();
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low), low_middle(low), high_middle(-low);
  const auto middle = [&](std::uint32_t i) { return all[i].a + (all[i].ab + all[i].ac) / 3.0; };
  for (std::size_t i = begin; i < end; ++i) {
    const Triangle& t = all[order[i]];
    for (const glm::dvec3& p : {t.a, t.a + t.ab, t.a + t.ac}) low = glm::min(low, p), high = glm::max(high, p);
    low_middle = glm::min(low_middle, middle(order[i])), high_middle = glm::max(high_middle, middle(order[i]));
  }
  boxes_[self].low = low, boxes_[self].high = high;
  const glm::dvec3 size = high_middle - low_middle;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (end - begin <= kInLeaf || depth >= kDeepest || !(size[axis] > 0.0)) {
    boxes_[self].first = static_cast<std::uint32_t>(triangles_.size());
    boxes_[self].count = static_cast<std::uint32_t>(end - begin);
    for (std::size_t i = begin; i < end; ++i) triangles_.push_back(all[order[i]]), order_.push_back(order[i]);
    return self;
  }
  const std::size_t half = begin + (end - begin) / 2;
  std::nth_element(order.begin() + static_cast<std::ptrdiff_t>(begin),
                   order.begin() + static_cast<std::ptrdiff_t>(half), order.begin() + static_cast<std::ptrdiff_t>(end),
                   [&](std::uint32_t a, std::uint32_t b) { return middle(a)[axis] < middle(b)[axis]; });
  build(order, begin, half, all, depth + 1);  // stands right behind this box
  boxes_[self].first = build(order, half, end, all, depth + 1);
  return self;
}

std::vector<glm::vec4> RayTree::texels(const glm::dvec3& origin_m, std::size_t first,
                                       std::span<const float> of_cut) const {
  std::vector<glm::vec4> texels;
  texels.reserve(texel_count());
  // Boxes stand in the order of the walk already. Where one ends is known when those within it are written.
  std::vector<std::pair<std::size_t, std::size_t>> open;  // its texel, and the box behind all of it
  const auto close = [&](std::size_t before) {
    while (!open.empty() && open.back().second <= before) {
      texels[open.back().first].w = static_cast<float>(first + texels.size());
      open.pop_back();
    }
  };
  for (std::size_t at = 0; at < boxes_.size(); ++at) {
    close(at);
    const Box& box = boxes_[at];
    const glm::vec3 low(box.low - origin_m), high(box.high - origin_m);
    const glm::vec3 slack = 2e-7f * glm::max(glm::abs(low), glm::abs(high)) + 1e-6f;
    std::size_t last = at;  // of the boxes within it
    while (boxes_[last].count == 0) last = boxes_[last].first;
    open.emplace_back(texels.size(), last + 1);
    texels.emplace_back(low - slack, 0.0f);
    texels.emplace_back(high + slack, static_cast<float>(box.count));
    for (std::uint32_t i = box.first; box.count > 0 && i < box.first + box.count; ++i) {
      const Triangle& t = triangles_[i];
      texels.emplace_back(glm::vec3(t.a - origin_m), t.cut > 0 && t.cut <= of_cut.size() ? of_cut[t.cut - 1] : 0.0f);
      texels.emplace_back(glm::vec3(t.ab), 0.0f);
      texels.emplace_back(glm::vec3(t.ac), 0.0f);
    }
  }
  close(boxes_.size());
  return texels;
}

template <typename Each>
bool RayTree::each_met(const glm::dvec3& from_m, const glm::dvec3& along, double near_m, const double& most_m,
                       const Each& met) const {
  if (boxes_.empty() || !(most_m > near_m)) return false;
  const glm::dvec3 inverse = 1.0 / along;  // an axis it does not go along: infinite, as wanted
  struct Entered {
    std::uint32_t box;
    double at_m;  ///< infinity: it is missed
  };
  const auto enter = [&](std::uint32_t at) {
    const Box& box = boxes_[at];
    double enter_m = near_m, leave_m = most_m;
    for (int axis = 0; axis < 3; ++axis) {
      const bool back = inverse[axis] < 0.0;
      // NaN, on a face of a box that the ray lies in: as the second argument it leaves what there is.
      enter_m = std::max(enter_m, ((back ? box.high : box.low)[axis] - from_m[axis]) * inverse[axis]);
      leave_m = std::min(leave_m, ((back ? box.low : box.high)[axis] - from_m[axis]) * inverse[axis]);
    }
    return Entered{at, enter_m > leave_m ? std::numeric_limits<double>::infinity() : enter_m};
  };
  std::array<Entered, 2 * kDeepest> stack;
  std::size_t top = 0;
  if (const Entered all = enter(0); all.at_m <= most_m) stack[top++] = all;
  while (top > 0) {
    const Entered here = stack[--top];
    if (here.at_m > most_m) continue;  // it has become shorter
    const Box& box = boxes_[here.box];
    if (box.count == 0) {
      Entered first = enter(here.box + 1), second = enter(box.first);
      if (second.at_m < first.at_m) std::swap(first, second);
      if (second.at_m <= most_m) stack[top++] = second;
      if (first.at_m <= most_m) stack[top++] = first;
      continue;
    }
    for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {  // Möller and Trumbore 1997
      const Triangle& t = triangles_[i];
      const glm::dvec3 p = glm::cross(along, t.ac);
      const double determinant = glm::dot(t.ab, p);
      if (std::abs(determinant) < 1e-14) continue;
      const glm::dvec3 s = from_m - t.a;
      const double u = glm::dot(s, p) / determinant;
      if (u < 0.0 || u > 1.0) continue;
      const glm::dvec3 q = glm::cross(s, t.ab);
      const double v = glm::dot(along, q) / determinant;
      if (v < 0.0 || u + v > 1.0) continue;
      const double met_m = glm::dot(t.ac, q) / determinant;
      if (met_m > near_m && met_m < most_m && met(met_m, t.one_sided && determinant < 0.0, i)) return true;
    }
  }
  return false;
}

bool RayTree::blocked(const glm::dvec3& from_m, const glm::dvec3& to_m, double near_from_m, double near_to_m,
                      double leave_within_m) const {
  const glm::dvec3 way = to_m - from_m;
  const double length_m = glm::length(way);
  if (!(length_m - near_to_m > near_from_m)) return false;
  return each_met(
      from_m, way / length_m, near_from_m, length_m - near_to_m,
      [&](double met_m, bool from_behind, std::uint32_t) { return !from_behind || met_m > leave_within_m; });
}

std::optional<RayTree::Met> RayTree::first_met(const glm::dvec3& from_m, const glm::dvec3& along, double most_m,
                                               double leave_within_m) const {
  std::optional<Met> first;
  each_met(from_m, along, 0.0, most_m, [&](double met_m, bool from_behind, std::uint32_t i) {
    if (!from_behind || met_m > leave_within_m) first = {met_m, from_behind, order_[i]}, most_m = met_m;
    return false;
  });
  return first;
}

double RayTree::left_at_m(const glm::dvec3& from_m, const glm::dvec3& along, double most_m) const {
  double last_m = 0.0;
  each_met(from_m, along, 0.0, most_m, [&](double met_m, bool from_behind, std::uint32_t) {
    if (from_behind) last_m = std::max(last_m, met_m);
    return false;
  });
  return last_m;
}

}  // namespace phare
