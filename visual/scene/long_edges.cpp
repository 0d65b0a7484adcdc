#include "visual/scene/long_edges.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "config/base/conventions.h"
#include "visual/scene/refine.h"

namespace phare {

namespace {

class Halver {
 public:
  Halver(MeshCorners& corners, double longest_m) : corners_(corners), longest_m_(longest_m) {}

  bool is_short(const std::array<std::uint32_t, 3>& t) const {
    return !is_long(t[0], t[1]) && !is_long(t[1], t[2]) && !is_long(t[2], t[0]);
  }

  /// Appends the pieces of a triangle, until there are `most` indices.
  void cut(const std::array<std::uint32_t, 3>& whole, std::size_t most, std::vector<std::uint32_t>& to) {
    std::vector<std::array<std::uint32_t, 3>> left{whole};
    while (!left.empty() && to.size() <= most) {
      std::array<std::uint32_t, 3> t = left.back();
      left.pop_back();
      const int count = is_long(t[0], t[1]) + is_long(t[1], t[2]) + is_long(t[2], t[0]);
      // Turned so that the first edges are the long ones.
      while ((count == 1 && !is_long(t[0], t[1])) || (count == 2 && is_long(t[2], t[0]))) t = {t[1], t[2], t[0]};
      const auto [a, b, c] = t;
      if (count == 0) {
        to.insert(to.end(), {a, b, c});
        continue;
      }
      const std::uint32_t ab = middle(a, b);
      if (count == 1) {
        left.insert(left.end(), {{a, ab, c}, {ab, b, c}});
        continue;
      }
      const std::uint32_t bc = middle(b, c);
      left.push_back({ab, b, bc});
      if (count == 2) {
        left.insert(left.end(), {{a, ab, c}, {ab, bc, c}});
        continue;
      }
      const std::uint32_t ca = middle(c, a);
      left.insert(left.end(), {{a, ab, ca}, {ab, bc, ca}, {ca, bc, c}});
    }
  }

 private:
  bool is_long(std::uint32_t a, std::uint32_t b) const {
    return glm::distance(corners_.at[a].position, corners_.at[b].position) > longest_m_;
  }

  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto [found, first] = middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(corners_.at.size()));
    if (!first) return found->second;
    const MeshCorner &one = corners_.at[a], &other = corners_.at[b];
    MeshCorner between{0.5 * (one.position + other.position), one.normal};
    const bool on_grid = on_place_grid(one.position) == one.position && on_place_grid(other.position) == other.position;
    if (on_grid) between.position = on_place_grid(between.position);
    const glm::vec3 sum = one.normal + other.normal;
    if (one.normal != other.normal && glm::length(sum) > 0.0f) between.normal = glm::normalize(sum);
    corners_.at.push_back(between);
    if (!corners_.looks.empty()) corners_.looks.push_back(look_between(corners_.looks[a], corners_.looks[b]));
    return found->second;
  }

  MeshCorners& corners_;
  double longest_m_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

}  // namespace

double halve_long_edges(MeshCorners& corners, std::vector<std::uint32_t>& triangles) {
  constexpr std::size_t kMostAdded = 3 * (std::size_t{1} << 16);
  const std::size_t most = 2 * triangles.size() + kMostAdded, corners_before = corners.at.size();
  for (double longest_m = kLongestEdge_m;; longest_m *= 2.0) {
    Halver halver(corners, longest_m);
    std::vector<std::uint32_t> halved;
    const auto triangle = [&](std::size_t i) { return std::array{triangles[i], triangles[i + 1], triangles[i + 2]}; };
    std::size_t i = 0;
    while (i + 2 < triangles.size() && halver.is_short(triangle(i))) i += 3;
    if (i + 2 >= triangles.size()) return longest_m;  // none, as in most files: nothing is copied
    halved.assign(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(i));
    for (; i + 2 < triangles.size() && halved.size() <= most; i += 3) halver.cut(triangle(i), most, halved);
    if (halved.size() <= most) {
      triangles = std::move(halved);
      return longest_m;
    }
    corners.at.resize(corners_before);
    if (!corners.looks.empty()) corners.looks.resize(corners_before);
  }
}

}  // namespace phare
