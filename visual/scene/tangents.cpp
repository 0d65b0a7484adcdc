#include "visual/scene/tangents.h"

#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace phare {
namespace {

/// Some direction square to the normal.
glm::dvec3 across(const glm::dvec3& normal) {
  const glm::dvec3 other = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  return glm::normalize(glm::cross(other, normal));
}

}  // namespace

glm::i8vec4 packed_tangent(const glm::vec3& tangent, float side) {
  return glm::i8vec4(glm::vec4(glm::round(127.0f * tangent), side < 0.0f ? -127.0f : 127.0f));
}

glm::i8vec4 tangent_between(const glm::i8vec4& a, const glm::i8vec4& b) {
  const glm::vec3 sum = glm::vec3(a) + glm::vec3(b);
  const float length = glm::length(sum);
  return length < 1.0f ? a : packed_tangent(sum / length, static_cast<float>(a.w));
}

std::vector<glm::i8vec4> tangents_of(std::span<const glm::dvec3> positions_m, std::span<const glm::vec3> normals,
                                     std::span<const glm::vec2> uvs, std::span<const std::uint32_t> triangles) {
  std::vector<glm::dvec3> along_u(positions_m.size(), glm::dvec3(0.0)), up(along_u);
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const std::uint32_t a = triangles[i], b = triangles[i + 1], c = triangles[i + 2];
    const glm::dvec3 ab = positions_m[b] - positions_m[a], ac = positions_m[c] - positions_m[a];
    const glm::dvec2 uv_ab = glm::dvec2(uvs[b]) - glm::dvec2(uvs[a]), uv_ac = glm::dvec2(uvs[c]) - glm::dvec2(uvs[a]);
    const double area = uv_ab.x * uv_ac.y - uv_ab.y * uv_ac.x;
    if (area == 0.0 || !std::isfinite(area)) continue;
    // By the triangle's area: of what is divided by, the sign alone.
    const double sign = area < 0.0 ? -1.0 : 1.0, size = glm::length(glm::cross(ab, ac));
    const glm::dvec3 u = sign * (ab * uv_ac.y - ac * uv_ab.y), v = sign * (ac * uv_ab.x - ab * uv_ac.x);
    if (!(glm::length(u) > 0.0) || !(glm::length(v) > 0.0)) continue;
    for (const std::uint32_t corner : {a, b, c}) {
      along_u[corner] += size * glm::normalize(u);
      up[corner] -= size * glm::normalize(v);
    }
  }
  std::vector<glm::i8vec4> tangents;
  tangents.reserve(positions_m.size());
  for (std::size_t i = 0; i < positions_m.size(); ++i) {
    const glm::dvec3 normal(normals[i]);
    glm::dvec3 tangent = along_u[i] - normal * glm::dot(normal, along_u[i]);
    const double length = glm::length(tangent);
    tangent = length > 1e-12 && std::isfinite(length) ? tangent / length : across(normal);
    const bool mirrored = glm::dot(glm::cross(normal, tangent), up[i]) < 0.0;
    tangents.push_back(packed_tangent(glm::vec3(tangent), mirrored ? -1.0f : 1.0f));
  }
  return tangents;
}

}  // namespace phare
