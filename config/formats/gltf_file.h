// glTF 2.0 files (.gltf, .glb), read with every index and range checked, so that a broken file gives an error and no
// crash. Used for the scene that is drawn and for the road that is driven on: both see the same triangles. Read: all of
// glTF 2.0's accessors, sparse ones too, KHR_mesh_quantization, EXT_meshopt_compression. docs/scenes.md has the whole
// list.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

enum class GltfImages {
  kLeave,  ///< not looked at
  kKeep    ///< encoded bytes of those in data URIs stay in tinygltf::Image::image
};

/// Reads a file. The error's place is the file; the reason is tinygltf's or ours.
Result<tinygltf::Model> read_gltf(const std::filesystem::path& file, GltfImages images = GltfImages::kLeave);

/// The view's bytes, proven to lie inside its buffer.
Result<std::span<const unsigned char>> bytes_of_view(const tinygltf::Model& model, int view);

/// VEC3 accessor (positions, normals), as stored: glTF axes, mesh frame, metres; of float or, by KHR_mesh_quantization,
/// of 8 or 16 bit, normalized or not. Values are finite.
Result<std::vector<glm::vec3>> read_vec3(const tinygltf::Model& model, int accessor);

/// VEC2 accessor (texture coordinates), likewise.
Result<std::vector<glm::vec2>> read_vec2(const tinygltf::Model& model, int accessor);

/// VEC3 or VEC4 accessor (colours), likewise; of three components the fourth is 1.
Result<std::vector<glm::vec4>> read_vec4(const tinygltf::Model& model, int accessor);

/// Index accessor of any unsigned width. Values are NOT yet compared with a vertex count; read_triangles does that.
Result<std::vector<std::uint32_t>> read_indices(const tinygltf::Model& model, int accessor);

/// Triangle list of a primitive, three indices each, all below vertex_count. Strips and fans are unrolled; primitives
/// of points or lines give an empty list.
Result<std::vector<std::uint32_t>> read_triangles(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                                  std::size_t vertex_count);

/// A node where it stands in the scene.
struct NodeInstance {
  std::string name;                 ///< of the node, else of its nearest named ancestor
  int node = -1;                    ///< index in model.nodes
  glm::dmat4 world_from_node{1.0};  ///< as MeshInstance has it
};

/// All nodes of the default scene, with or without a mesh; errors as of mesh_instances().
Result<std::vector<NodeInstance>> node_instances(const tinygltf::Model& model);

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
