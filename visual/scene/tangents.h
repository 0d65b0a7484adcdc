// Tangent frames for normal textures, as glTF 2.0 has them (3.7.2.1, TANGENT): the tangent points to where u grows, the
// bitangent is cross(normal, tangent)·w and points to the upper edge of the picture, where v falls. Of files without
// TANGENT they come from positions and texture coordinates; not by MikkTSpace's rules for which corners share one, so a
// texture baked by those may be off where a mesh's pictures meet mirrored. Pure. Checked by tests/scene/relief_test.cpp.
#pragma once

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace phare {

/// xyz of a unit vector in steps of 1/127 (0.3° off at most), w: ±127, the side of the bitangent.
glm::i8vec4 packed_tangent(const glm::vec3& tangent, float side);

/// Of the middle between two corners.
glm::i8vec4 tangent_between(const glm::i8vec4& a, const glm::i8vec4& b);

/// Of each corner the mean of its triangles', square to its normal. Where texture coordinates say no direction, any
/// one. `triangles`: three corners each.
std::vector<glm::i8vec4> tangents_of(std::span<const glm::dvec3> positions_m, std::span<const glm::vec3> normals,
                                     std::span<const glm::vec2> uvs, std::span<const std::uint32_t> triangles);

}  // namespace phare
