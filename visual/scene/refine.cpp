#include "visual/scene/refine.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <span>
#include <utility>

#include "visual/scene/tangents.h"

namespace phare {
namespace {

using Triangles = std::vector<std::uint32_t>;

}  // namespace

CornerLook look_between(const CornerLook& a, const CornerLook& b) {
  return {0.5f * (a.uv + b.uv), glm::u16vec4((glm::uvec4(a.colour) + glm::uvec4(b.colour)) / 2u),
          tangent_between(a.tangent, b.tangent)};
}

namespace {

/// Cuts each triangle of `indices` once; `vertices`, and `looks` where there are some, gain the middles of the sides.
Triangles cut(std::span<const std::uint32_t> indices, std::vector<SceneVertex>& vertices,
              std::vector<CornerLook>& looks) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(vertices.size()));
    if (fresh) {
      vertices.push_back({0.5f * (vertices[a].position_m + vertices[b].position_m),
                          glm::normalize(vertices[a].normal + vertices[b].normal)});
      if (!looks.empty()) looks.push_back(look_between(looks[a], looks[b]));
    }
    return found->second;
  };
  Triangles finer;
  finer.reserve(4 * indices.size());
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    const std::uint32_t a = indices[t], b = indices[t + 1], c = indices[t + 2];
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
  }
  return finer;
}

}  // namespace

Scene refined(const Scene& scene, int times, const std::function<bool(const SceneMaterial&)>& which) {
  Scene result;
  result.file = scene.file;
  result.content_hash = scene.content_hash;
  result.materials = scene.materials;
  result.textures = scene.textures;
  result.lights = scene.lights;
  result.light_profiles = scene.light_profiles;
  result.notes = scene.notes;
  for (SceneChunk chunk : scene.chunks) {
    const auto index = scene.indices.begin() + chunk.first_index;
    const auto vertex = scene.vertices.begin() + chunk.first_vertex;
    Triangles indices(index, index + chunk.index_count);
    std::vector<SceneVertex> vertices(vertex, vertex + chunk.vertex_count);
    std::vector<CornerLook> looks;
    if (chunk.first_look) {
      const auto look = scene.looks.begin() + *chunk.first_look;
      looks.assign(look, look + chunk.vertex_count);
      chunk.first_look = static_cast<std::uint32_t>(result.looks.size());
    }
    for (int i = 0; i < (which(scene.materials[chunk.material]) ? times : 0); ++i)
      indices = cut(indices, vertices, looks);
    chunk.first_index = static_cast<std::uint32_t>(result.indices.size());
    chunk.first_vertex = static_cast<std::uint32_t>(result.vertices.size());
    chunk.index_count = static_cast<std::uint32_t>(indices.size());
    chunk.vertex_count = static_cast<std::uint32_t>(vertices.size());
    result.indices.insert(result.indices.end(), indices.begin(), indices.end());
    result.vertices.insert(result.vertices.end(), vertices.begin(), vertices.end());
    result.looks.insert(result.looks.end(), looks.begin(), looks.end());
    result.chunks.push_back(chunk);
  }
  return result;
}

bool is_ground(const SceneMaterial& material) {
  return material.surface == Surface::kAsphalt || material.surface == Surface::kGrass ||
         material.surface == Surface::kPaint;
}

}  // namespace phare
