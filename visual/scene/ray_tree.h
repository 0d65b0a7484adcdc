// Whether anything stands between two points, asked many times: the standing scene's triangles in a tree of boxes.
// The same answer as occluder() (visual/scene/ray_hit.h) gives for what stands, in microseconds; checked against it by
// tests/scene/ray_tree_test.cpp. float64; nothing that moves is in it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "visual/scene/scene.h"

namespace phare {

class RayTree {
 public:
  RayTree() = default;
  struct Triangle {
    glm::dvec3 a, ab, ac;
    bool one_sided = true;
    std::uint32_t cut = 0;  ///< one more than which of the triangles with holes it is, as its maker counts them
  };
  /// All but paint, which lies on roads. Copies what it needs of the scene.
  explicit RayTree(const Scene& scene);
  explicit RayTree(const std::vector<Triangle>& triangles);

  /// Something stands on the way from `from_m` to `to_m`, more than `near_from_m` from the one and `near_to_m` from the
  /// other end.
  /// `leave_within_m`: a body whose back face is passed no farther than that from `from_m` does not count, for that
  /// lies within it; a surface that is seen from both sides has no back.
  bool blocked(const glm::dvec3& from_m, const glm::dvec3& to_m, double near_from_m, double near_to_m,
               double leave_within_m = 0.0) const;
  struct Met {
    double at_m = 0.0;
    bool from_behind = false;
    std::uint32_t triangle = 0;  ///< as its maker counts
  };
  /// The first that stands along a unit direction, `most_m` at most; back faces within `leave_within_m` do not count.
  std::optional<Met> first_met(const glm::dvec3& from_m, const glm::dvec3& along, double most_m,
                               double leave_within_m) const;
  /// How far from `from_m`, along a unit direction and `most_m` at most, the last back face is passed; 0: none is.
  double left_at_m(const glm::dvec3& from_m, const glm::dvec3& along, double most_m) const;

  /// Of texels().
  std::size_t texel_count() const { return 2 * boxes_.size() + 3 * triangles_.size(); }
  /// The tree in float32 for a device, relative to `origin_m`, in the order of a walk that needs no stack: of a box its
  /// low corner and the texel that goes on where it is missed, its high corner and how many triangles follow, three
  /// texels each (a corner and what `of_cut` has of the triangle with holes, 0 being none; the ways to the others);
  /// else its two children follow. Boxes are as much larger as float32 rounds. The first will be texel `first`.
  std::vector<glm::vec4> texels(const glm::dvec3& origin_m, std::size_t first,
                                std::span<const float> of_cut = {}) const;

 private:
  struct Box {
    glm::dvec3 low{0.0}, high{0.0};
    std::uint32_t first = 0;  ///< triangle, or the nearer child; the other one stands behind all of that
    std::uint32_t count = 0;  ///< of triangles; 0: two children
  };
  /// Calls met(distance, it is passed from behind, triangle) for the triangles between; true: enough, and is true then
  /// itself. It may shorten `most_m`.
  template <typename Each>
  bool each_met(const glm::dvec3& from_m, const glm::dvec3& along, double near_m, const double& most_m,
                const Each& met) const;
  std::uint32_t build(std::vector<std::uint32_t>& order, std::size_t begin, std::size_t end,
                      const std::vector<Triangle>& all, int depth);

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;  ///< of each what its maker counts it as
  std::vector<Box> boxes_;
};

}  // namespace phare
