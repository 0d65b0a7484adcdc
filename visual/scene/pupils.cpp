#include "visual/scene/pupils.h"

#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tuple>

namespace phare {
namespace {

/// Triangles that share a corner's place are one pupil.
void add_pupils(const Scene& scene, const SceneChunk& chunk, std::vector<Pupil>& found) {
  const SceneMaterial& material = scene.materials[chunk.material];
  if (material.retro.kind != RetroKind::kPupil) return;
  std::map<std::tuple<float, float, float>, std::size_t> corner_at;
  std::vector<std::size_t> group;  // of corners: toward the first of each
  const auto first_of = [&](std::size_t corner) {
    while (group[corner] != corner) corner = group[corner];
    return corner;
  };
  struct Flat {
    std::size_t corner;
    glm::dvec3 middle_m, area_m2;
  };
  std::vector<Flat> triangles;
  for (std::uint32_t i = 0; i + 2 < chunk.index_count; i += 3) {
    std::array<glm::dvec3, 3> at{};
    std::array<std::size_t, 3> corners{};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const glm::vec3& p =
          scene.vertices[chunk.first_vertex + scene.indices[chunk.first_index + i + k]].position_m;
      const auto [place, fresh] = corner_at.try_emplace({p.x, p.y, p.z}, group.size());
      if (fresh) group.push_back(group.size());
      corners[k] = place->second;
      at[k] = chunk.origin_m + glm::dvec3(p);
    }
    for (const std::size_t other : {corners[1], corners[2]}) group[first_of(other)] = first_of(corners[0]);
    triangles.push_back({corners[0], (at[0] + at[1] + at[2]) / 3.0, 0.5 * glm::cross(at[1] - at[0], at[2] - at[0])});
  }
  std::map<std::size_t, std::pair<glm::dvec3, glm::dvec3>> sums;  // middles by area, areas with their directions
  std::map<std::size_t, double> areas_m2;
  for (const Flat& triangle : triangles) {
    const double area_m2 = glm::length(triangle.area_m2);
    auto& [middle, area] = sums.try_emplace(first_of(triangle.corner), 0.0, 0.0).first->second;
    middle += area_m2 * triangle.middle_m, area += triangle.area_m2;
    areas_m2[first_of(triangle.corner)] += area_m2;
  }
  for (const auto& [corner, sum] : sums) {
    const double area_m2 = glm::length(sum.second);
    if (area_m2 > 0.0) found.push_back({sum.first / areas_m2[corner], sum.second / area_m2, area_m2, &material});
  }
}

}  // namespace

Pupils::Pupils(const Scene& standing, const Scene& meshes) {
  for (const SceneChunk& chunk : standing.chunks) add_pupils(standing, chunk, standing_);
  const auto nodes = chunks_by_node(meshes);
  for (std::size_t mesh = 0; mesh < nodes.size(); ++mesh)
    for (const std::size_t chunk : nodes[mesh]) {
      std::vector<Pupil> found;
      add_pupils(meshes, meshes.chunks[chunk], found);
      for (const Pupil& pupil : found) in_mesh_.push_back({mesh, pupil});
    }
}

std::vector<Pupil> Pupils::in(const World& world) const {
  std::vector<Pupil> pupils = standing_;
  for (const PlacedMesh& placed : world.moving())
    for (const InMesh& known : in_mesh_) {
      if (known.mesh != placed.mesh) continue;
      Pupil pupil = known.pupil;
      pupil.place_m = placed.position_m + placed.world_from_mesh * pupil.place_m;
      pupil.normal = placed.world_from_mesh * pupil.normal;
      pupils.push_back(pupil);
    }
  return pupils;
}

}  // namespace phare
