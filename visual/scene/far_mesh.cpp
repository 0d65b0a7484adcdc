#include "visual/scene/far_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace phare {

namespace {

void thin_leaves(FarMesh& mesh, std::uint32_t share) {
  FarMesh far;
  const float grow = std::sqrt(static_cast<float>(share));
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += std::size_t{3} * share) {
    std::array<SceneVertex, 3> leaf{mesh.vertices[mesh.indices[i]], mesh.vertices[mesh.indices[i + 1]],
                                    mesh.vertices[mesh.indices[i + 2]]};
    const glm::vec3 middle = (leaf[0].position_m + leaf[1].position_m + leaf[2].position_m) / 3.0f;
    for (SceneVertex& vertex : leaf) {
      vertex.position_m = middle + grow * (vertex.position_m - middle);
      far.indices.push_back(static_cast<std::uint32_t>(far.vertices.size()));
      far.vertices.push_back(vertex);
    }
  }
  mesh = std::move(far);
}

// Keeps the vertices that are still used, in their order.
void drop_unused(FarMesh& mesh) {
  std::vector<std::uint32_t> place(mesh.vertices.size(), ~0u);
  std::vector<SceneVertex> kept;
  for (std::uint32_t& index : mesh.indices) {
    if (place[index] == ~0u) {
      place[index] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(mesh.vertices[index]);
    }
    index = place[index];
  }
  mesh.vertices = std::move(kept);
}

void simplify(FarMesh& mesh, float error_m) {
  const float* positions = &mesh.vertices.front().position_m.x;
  const float scale = meshopt_simplifyScale(positions, mesh.vertices.size(), sizeof(SceneVertex));
  if (!(scale > 0.0f)) return;
  std::vector<std::uint32_t> indices(mesh.indices.size());
  indices.resize(meshopt_simplify(indices.data(), mesh.indices.data(), mesh.indices.size(), positions,
                                  mesh.vertices.size(), sizeof(SceneVertex), std::size_t{3},
                                  std::min(1.0f, error_m / scale), 0u, nullptr));
  mesh.indices = std::move(indices);
  drop_unused(mesh);
}

}  // namespace

FarMesh far_mesh(const Scene& scene, const SceneChunk& chunk, std::size_t level, double from_m) {
  FarMesh mesh;
  const auto vertex = scene.vertices.begin() + static_cast<std::ptrdiff_t>(chunk.first_vertex);
  mesh.vertices.assign(vertex, vertex + static_cast<std::ptrdiff_t>(chunk.vertex_count));
  const auto index = scene.indices.begin() + static_cast<std::ptrdiff_t>(chunk.first_index);
  mesh.indices.assign(index, index + static_cast<std::ptrdiff_t>(chunk.index_count));
  const SceneMaterial& material = scene.materials[chunk.material];
  if (mesh.indices.empty() || material.retro.kind != RetroKind::kNone) return mesh;
  switch (material.surface) {
    case Surface::kFoliage:
      thin_leaves(mesh, kFarLevels[level].leaves_per_leaf);
      break;
    case Surface::kAsphalt:
    case Surface::kGrass:
      simplify(mesh, static_cast<float>(kFarGroundError_rad * from_m));
      break;
    case Surface::kPlain:
      simplify(mesh, static_cast<float>(kFarThingError_rad * from_m));
      break;
    case Surface::kPaint:
      if (level + 1 == kFarLevels.size()) simplify(mesh, static_cast<float>(kFarGroundError_rad * from_m));
      break;
  }
  return mesh;
}

}  // namespace phare
