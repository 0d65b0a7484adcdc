// A scene of a few triangles of one material, for tests.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "visual/scene/scene.h"

namespace phare {

/// Triangles of one material, as a scene.
class Shape {
 public:
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const auto first = static_cast<std::uint32_t>(scene_.vertices.size());
    for (const glm::dvec3& corner : {a, b, c, d}) scene_.vertices.push_back({glm::vec3(corner), glm::vec3(normal)});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) scene_.indices.push_back(first + i);
  }
  void box(const glm::dvec3& low, const glm::dvec3& high) {
    const auto at = [&](int i) {
      return glm::dvec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    };
    quad(at(0), at(4), at(6), at(2));
    quad(at(1), at(3), at(7), at(5));
    quad(at(0), at(1), at(5), at(4));
    quad(at(2), at(6), at(7), at(3));
    quad(at(0), at(2), at(3), at(1));
    quad(at(4), at(5), at(7), at(6));
  }
  Scene scene(bool double_sided = false) { return scene({.name = "grey", .double_sided = double_sided}); }
  Scene scene(const SceneMaterial& material) {
    scene_.materials = {material};
    SceneChunk chunk{.node = "shape", .low_m = glm::dvec3(1e9), .high_m = glm::dvec3(-1e9)};
    for (const SceneVertex& vertex : scene_.vertices) {
      chunk.low_m = glm::min(chunk.low_m, glm::dvec3(vertex.position_m));
      chunk.high_m = glm::max(chunk.high_m, glm::dvec3(vertex.position_m));
    }
    chunk.index_count = static_cast<std::uint32_t>(scene_.indices.size());
    chunk.vertex_count = static_cast<std::uint32_t>(scene_.vertices.size());
    scene_.chunks = {chunk};
    return scene_;
  }

 private:
  Scene scene_;
};

}  // namespace phare
