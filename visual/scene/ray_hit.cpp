#include "visual/scene/ray_hit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace phare {
namespace {

/// Slab test; the box is [low, high], the answer whether the ray meets it before `most_m`.
bool meets_box(const glm::dvec3& origin_m, const glm::dvec3& direction, const glm::dvec3& low_m,
               const glm::dvec3& high_m, double most_m) {
  double enter_m = 0.0, leave_m = most_m;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < 1e-15) {
      if (origin_m[axis] < low_m[axis] || origin_m[axis] > high_m[axis]) return false;
      continue;
    }
    double a = (low_m[axis] - origin_m[axis]) / direction[axis];
    double b = (high_m[axis] - origin_m[axis]) / direction[axis];
    if (a > b) std::swap(a, b);
    enter_m = std::max(enter_m, a);
    leave_m = std::min(leave_m, b);
  }
  return enter_m <= leave_m;
}

/// How far away, and the shares of the second and third corner.
struct TriangleHit {
  double distance_m, second, third;
};

std::optional<TriangleHit> meets_triangle(const glm::dvec3& origin_m, const glm::dvec3& direction, const glm::dvec3& a,
                                          const glm::dvec3& ab, const glm::dvec3& ac) {
  const glm::dvec3 p = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, p);
  if (std::abs(determinant) < 1e-14) return std::nullopt;
  const glm::dvec3 t = origin_m - a;
  const double u = glm::dot(t, p) / determinant;
  const glm::dvec3 q = glm::cross(t, ab);
  const double v = glm::dot(direction, q) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0) return std::nullopt;
  return TriangleHit{glm::dot(ac, q) / determinant, u, v};
}

/// Whether the ray goes through a hole of the surface there.
bool through_hole(const Scene& scene, const SceneChunk& chunk, std::uint32_t first_corner, const TriangleHit& hit) {
  const PixelLook& look = scene.materials[chunk.material].look;
  if (!look.cut_below || !look.base_texture || !chunk.first_look) return false;
  const auto uv = [&](std::uint32_t k) {
    return glm::dvec2(scene.looks[*chunk.first_look + scene.indices[chunk.first_index + first_corner + k]].uv);
  };
  const glm::dvec2 at = uv(0) * (1.0 - hit.second - hit.third) + uv(1) * hit.second + uv(2) * hit.third;
  const double opacity = texel_at(scene.textures[*look.base_texture], look.sampler, at).w;
  return opacity * static_cast<double>(look.base.w) < static_cast<double>(*look.cut_below);
}

/// Of one chunk, nearer than `most_m`, which comes down to where it is met.
template <typename Which>
void meet_chunk(std::optional<RayHit>& nearest, const Scene& scene, const SceneChunk& chunk, const glm::dvec3& origin_m,
                const glm::dvec3& direction, double least_m, double& most_m, const Which& which) {
  if (!which(scene.materials[chunk.material])) return;
  if (!meets_box(origin_m, direction, chunk.low_m, chunk.high_m, most_m)) return;
  const glm::dvec3 local_m = origin_m - chunk.origin_m;
  for (std::uint32_t i = 0; i + 2 < chunk.index_count; i += 3) {
    const auto corner = [&](std::uint32_t k) {
      return glm::dvec3(scene.vertices[chunk.first_vertex + scene.indices[chunk.first_index + i + k]].position_m);
    };
    const glm::dvec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
    const std::optional<TriangleHit> hit = meets_triangle(local_m, direction, a, ab, ac);
    if (!hit || hit->distance_m <= least_m || hit->distance_m >= most_m) continue;
    if (through_hole(scene, chunk, i, *hit)) continue;
    most_m = hit->distance_m;
    const glm::dvec3 normal = glm::normalize(glm::cross(ab, ac));
    nearest = RayHit{most_m, glm::dot(normal, direction) > 0.0 ? -normal : normal, &chunk, &scene};
  }
}

/// As ray_hit(), among the chunks whose material `which` takes.
template <typename Which>
std::optional<RayHit> hit_among(const World& world, const glm::dvec3& origin_m, const glm::dvec3& direction,
                                double least_m, double most_m, const Which& which) {
  std::optional<RayHit> nearest;
  for (const SceneChunk& chunk : world.standing().chunks)
    meet_chunk(nearest, world.standing(), chunk, origin_m, direction, least_m, most_m, which);
  for (const PlacedMesh& placed : world.moving()) {
    // Turned to where the mesh was made: distances stay.
    const glm::dmat3 mesh_from_world = glm::transpose(placed.world_from_mesh);
    const glm::dvec3 from_m = mesh_from_world * (origin_m - placed.position_m), along = mesh_from_world * direction;
    const double before_m = most_m;
    for (const std::size_t chunk : world.chunks_of(placed))
      meet_chunk(nearest, *world.meshes(), world.meshes()->chunks[chunk], from_m, along, least_m, most_m, which);
    if (most_m < before_m) nearest->normal = placed.world_from_mesh * nearest->normal;
  }
  return nearest;
}

}  // namespace

std::optional<RayHit> ray_hit(const World& world, const glm::dvec3& origin_m, const glm::dvec3& direction,
                              double least_m, double most_m) {
  return hit_among(world, origin_m, direction, least_m, most_m, [](const SceneMaterial&) { return true; });
}

const SceneChunk* occluder(const World& world, const glm::dvec3& lamp_m, const glm::dvec3& point_m) {
  constexpr double kOwnSurface_m = 1e-3;
  const glm::dvec3 way = lamp_m - point_m;
  const double distance_m = glm::length(way);
  if (distance_m <= 2.0 * kOwnSurface_m) return nullptr;
  const std::optional<RayHit> hit =
      hit_among(world, point_m, way / distance_m, kOwnSurface_m, distance_m - kOwnSurface_m,
                [](const SceneMaterial& material) { return material.surface != Surface::kPaint; });
  return hit ? hit->chunk : nullptr;
}

const std::string& name_of(const SceneChunk& chunk) {
  static const std::string nameless = "something without a name";
  return chunk.node.empty() ? nameless : chunk.node;
}

}  // namespace phare
