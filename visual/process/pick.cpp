#include "visual/process/pick.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace phare {
namespace {

/// Slab test; the box is [low, high], the answer whether the ray meets it before `most_m`.
bool meets_box(const Ray& ray, const glm::dvec3& low_m, const glm::dvec3& high_m, double most_m) {
  double enter_m = 0.0, leave_m = most_m;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(ray.direction[axis]) < 1e-15) {
      if (ray.origin_m[axis] < low_m[axis] || ray.origin_m[axis] > high_m[axis]) return false;
      continue;
    }
    double a = (low_m[axis] - ray.origin_m[axis]) / ray.direction[axis];
    double b = (high_m[axis] - ray.origin_m[axis]) / ray.direction[axis];
    if (a > b) std::swap(a, b);
    enter_m = std::max(enter_m, a);
    leave_m = std::min(leave_m, b);
  }
  return enter_m <= leave_m;
}

/// Möller and Trumbore 1997. Distance along the ray, or nothing.
std::optional<double> meets_triangle(const Ray& ray, const glm::dvec3& a, const glm::dvec3& ab, const glm::dvec3& ac) {
  const glm::dvec3 p = glm::cross(ray.direction, ac);
  const double determinant = glm::dot(ab, p);
  if (std::abs(determinant) < 1e-14) return std::nullopt;
  const glm::dvec3 t = ray.origin_m - a;
  const double u = glm::dot(t, p) / determinant;
  const glm::dvec3 q = glm::cross(t, ab);
  const double v = glm::dot(ray.direction, q) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0) return std::nullopt;
  const double distance_m = glm::dot(ac, q) / determinant;
  return distance_m > 0.0 ? std::optional(distance_m) : std::nullopt;
}

}  // namespace

std::optional<MeasurePoint> pick(const Scene& scene, const Ray& ray, double most_m) {
  std::optional<MeasurePoint> nearest;
  for (const SceneChunk& chunk : scene.chunks) {
    if (!meets_box(ray, chunk.low_m, chunk.high_m, most_m)) continue;
    const Ray local{ray.origin_m - chunk.origin_m, ray.direction};
    for (std::uint32_t i = 0; i + 2 < chunk.index_count; i += 3) {
      const auto corner = [&](std::uint32_t k) {
        return glm::dvec3(scene.vertices[chunk.first_vertex + scene.indices[chunk.first_index + i + k]].position_m);
      };
      const glm::dvec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
      const std::optional<double> distance_m = meets_triangle(local, a, ab, ac);
      if (!distance_m || *distance_m >= most_m) continue;
      most_m = *distance_m;
      const glm::dvec3 normal = glm::normalize(glm::cross(ab, ac));
      nearest =
          MeasurePoint{ray.origin_m + ray.direction * most_m, glm::dot(normal, ray.direction) > 0.0 ? -normal : normal};
    }
  }
  return nearest;
}

}  // namespace phare
