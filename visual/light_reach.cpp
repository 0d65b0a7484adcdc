#include "visual/light_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace phare {
namespace {

constexpr double kPi = std::numbers::pi, kRadPerDeg = kPi / 180.0;
constexpr LightCone kEverywhere{{1.0, 0.0, 0.0}, kPi};
constexpr LightCone kDark{{1.0, 0.0, 0.0}, -1.0};

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Of nodes that shine; empty: none does.
TexelRect lit_nodes(const BeamImage& image, const TexelRect& within) {
  const std::size_t columns = image.first_deg.size();
  TexelRect lit{columns, image.second_deg.size(), 0, 0};
  for (std::size_t j = within.row; j < within.end_row; ++j) {
    const float* row = &image.candela[j * columns];
    const float* const end = row + within.end_column;
    const float* first = std::find_if(row + within.column, end, [](float cd) { return cd != 0.0f; });
    if (first == end) continue;
    const float* last = end;
    while (last[-1] == 0.0f) --last;
    lit.column = std::min(lit.column, static_cast<std::size_t>(first - row));
    lit.end_column = std::max(lit.end_column, static_cast<std::size_t>(last - row));
    lit.row = std::min(lit.row, j);
    lit.end_row = j + 1;
  }
  return lit;
}

struct Samples {
  std::vector<glm::dvec3> directions;
  double between_rad = 0.0;  ///< every direction of the rectangle is as near as this to a sample
};

/// Directions all over a rectangle of nodes, one node and a 256th of the table wider on every side.
Samples directions_in(const BeamImage& image, const TexelRect& lit) {
  constexpr std::size_t kSide = 48;
  const auto ends = [](const std::vector<double>& nodes_deg, std::size_t first, std::size_t end) {
    const double more_deg = (nodes_deg.back() - nodes_deg.front()) / 256.0;
    return std::pair(nodes_deg[first == 0 ? 0 : first - 1] - more_deg,
                     nodes_deg[std::min(end, nodes_deg.size() - 1)] + more_deg);
  };
  const auto [first_low, first_high] = ends(image.first_deg, lit.column, lit.end_column);
  const auto [second_low, second_high] = ends(image.second_deg, lit.row, lit.end_row);
  const bool screen = image.screen_distance_m > 0.0;
  const double widest_deg = std::max({-first_low, first_high, -second_low, second_high});
  if (screen && widest_deg > 60.0) return {};  // far out on a screen angles say little
  Samples samples;
  const double step_first = (first_high - first_low) / (kSide - 1),
               step_second = (second_high - second_low) / (kSide - 1);
  for (std::size_t j = 0; j < kSide; ++j)
    for (std::size_t i = 0; i < kSide; ++i) {
      const TableAngles at{first_low + step_first * static_cast<double>(i),
                           second_low + step_second * static_cast<double>(j)};
      samples.directions.push_back(screen ? screen_direction(at) : table_direction(image.type, image.axis, at));
    }
  // On the sphere no step is longer than in its angles; on a screen, at most twice within 60°.
  samples.between_rad = 0.5 * std::hypot(step_first, step_second) * kRadPerDeg * (screen ? 2.0 : 1.0);
  return samples;
}

double half_angle_about(const glm::dvec3& axis, const Samples& samples) {
  double farthest = 0.0;
  for (const glm::dvec3& direction : samples.directions) farthest = std::max(farthest, angle_between(axis, direction));
  return std::min(farthest + samples.between_rad, kPi);
}

/// Unit normals of planes through the tip that have the whole cone, below 90°, on their other side.
std::vector<glm::dvec3> planes_behind(const LightCone& cone) {
  constexpr int kAround = 16;
  const glm::dvec3 any = std::abs(cone.axis.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 aside = glm::normalize(glm::cross(cone.axis, any)), across = glm::cross(cone.axis, aside);
  const double c = std::cos(cone.half_angle_rad), s = std::sin(cone.half_angle_rad);
  std::vector<glm::dvec3> normals{-cone.axis};
  for (int i = 0; i < kAround; ++i) {
    const double turn = 2.0 * kPi * i / kAround;
    normals.push_back(-s * cone.axis + c * (std::cos(turn) * aside + std::sin(turn) * across));
  }
  return normals;
}

}  // namespace

LightCone light_cone(const BeamImage& image) {
  if (image.dark || image.candela.empty()) return kDark;
  const TexelRect lit = lit_nodes(image, {0, 0, image.first_deg.size(), image.second_deg.size()});
  if (lit.empty()) return kDark;
  const Samples samples = directions_in(image, lit);
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& direction : samples.directions) sum += direction;
  if (samples.directions.empty() || glm::length(sum) < 1e-3 * static_cast<double>(samples.directions.size()))
    return kEverywhere;
  const glm::dvec3 axis = glm::normalize(sum);
  return {axis, half_angle_about(axis, samples)};
}

LightCone light_cone_after(const LightCone& before, const BeamImage& image, std::span<const TexelRect> changed) {
  LightCone cone = before;
  for (const TexelRect& rect : changed) {
    const TexelRect lit = lit_nodes(image, rect);
    if (lit.empty()) continue;
    if (cone.half_angle_rad < 0.0) return light_cone(image);
    const Samples samples = directions_in(image, lit);
    if (samples.directions.empty()) return kEverywhere;
    cone.half_angle_rad = std::max(cone.half_angle_rad, half_angle_about(cone.axis, samples));
  }
  return cone;
}

bool LampReach::meets(const ViewGeometry& view) const {
  if (cone.half_angle_rad < 0.0) return false;
  // Two convex bodies are apart if a plane is between them: one side of the view …
  for (const glm::dvec4& plane : view.inward()) {
    const glm::dvec3 normal(plane);
    const double tip = glm::dot(normal, tip_m - view.camera().eye_m) + plane.w;
    if (tip < 0.0 && angle_between(normal, cone.axis) - cone.half_angle_rad >= 0.5 * kPi) return false;
  }
  const std::array<Ray, 4> edges = view.edges();
  // A cone beyond 90° leaves one of darkness, which is convex: it holds the view if it holds its edges.
  if (cone.half_angle_rad >= 0.5 * kPi) {
    const double dark_rad = kPi - cone.half_angle_rad;
    return !std::ranges::all_of(edges, [&](const Ray& edge) {
      return angle_between(edge.origin_m - tip_m, -cone.axis) < dark_rad &&
             angle_between(edge.direction, -cone.axis) < dark_rad;
    });
  }
  // … or one that touches the cone at its tip.
  for (const glm::dvec3& normal : planes_behind(cone)) {
    const bool apart = std::ranges::all_of(edges, [&](const Ray& edge) {
      return glm::dot(normal, edge.origin_m - tip_m) >= 0.0 && glm::dot(normal, edge.direction) >= 0.0;
    });
    if (apart) return false;
  }
  return true;
}

bool LampReach::meets(const glm::dvec3& low_m, const glm::dvec3& high_m) const {
  if (cone.half_angle_rad < 0.0) return false;
  const glm::dvec3 to_centre = 0.5 * (low_m + high_m) - tip_m;
  const double radius_m = 0.5 * glm::length(high_m - low_m), distance_m = glm::length(to_centre);
  if (distance_m <= radius_m) return true;
  if (angle_between(to_centre, cone.axis) <= cone.half_angle_rad + std::asin(radius_m / distance_m)) return true;
  return false;
}

}  // namespace phare
