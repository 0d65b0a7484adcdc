// glTF 2.0 files (.gltf, .glb), read with every index and range checked, so that a broken file gives an error and no
// crash. Images are not loaded. Used for the scene that is drawn and for the road that is driven on: both see the same
// triangles.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// Reads a file. The error's place is the file; the reason is tinygltf's or ours.
Result<tinygltf::Model> read_gltf(const std::filesystem::path& file);

/// Float VEC3 accessor (positions, normals), as stored: glTF axes, mesh frame, metres. Values are finite.
Result<std::vector<glm::vec3>> read_vec3(const tinygltf::Model& model, int accessor);

/// Index accessor of any unsigned width. Values are NOT yet compared with a vertex count; read_triangles does that.
Result<std::vector<std::uint32_t>> read_indices(const tinygltf::Model& model, int accessor);

/// Triangle list of a primitive, three indices each, all below vertex_count. Strips and fans are unrolled; primitives
/// of points or lines give an empty list.
Result<std::vector<std::uint32_t>> read_triangles(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                                  std::size_t vertex_count);

/// A mesh where it stands in the scene.
struct MeshInstance {
  std::string name;                 ///< of the node, else of its nearest named ancestor
  int node = -1;                    ///< index in model.nodes
  int mesh = -1;                    ///< index in model.meshes, valid
  glm::dmat4 world_from_mesh{1.0};  ///< to our z-up world (see world_from_gltf), with all node transforms
};

/// All meshes of the default scene (of every root node where the file names no scene). A node that is its own ancestor
/// or a child index out of range is an error.
Result<std::vector<MeshInstance>> mesh_instances(const tinygltf::Model& model);

/// glTF is y-up, we are z-up: world x = glTF x, world y = -glTF z, world z = glTF y.
glm::dmat4 world_from_gltf();

}  // namespace phare
