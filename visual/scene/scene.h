// A scene as drawn: triangles in chunks with bounds, materials. Read from glTF by tinygltf.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "visual/scene/retro.h"

namespace phare {

enum class Surface : std::uint32_t { kPlain = 0, kAsphalt = 1, kGrass = 2, kPaint = 3, kFoliage = 4 };

struct SceneMaterial {
  std::string name;
  glm::vec3 reflectance{0.5f};        ///< diffuse rho, linear Rec. 709
  Surface surface = Surface::kPlain;  ///< which procedural detail
  Retroreflection retro{};            ///< sheeting, markings; most materials have none
  bool double_sided = false;
  glm::vec3 emission_cdm2{0.0f};  ///< what it sends out by itself, every way alike: cd/m², linear Rec. 709
  float sky_share = 1.0f;         ///< of the sky's light that reaches it: 0 inside a tunnel
};

/// Vertices are relative to `origin_m`, so float32 serves anywhere in the world.
struct SceneVertex {
  glm::vec3 position_m;
  glm::vec3 normal;
};

/// Triangles of one material that are drawn or culled together.
struct SceneChunk {
  std::string node;  ///< name of the glTF node, "road…", "tree…"
  std::uint32_t material = 0;
  glm::dvec3 origin_m{0.0};
  glm::dvec3 low_m{0.0}, high_m{0.0};              ///< bounds in the world
  std::uint32_t first_index = 0, index_count = 0;  ///< in Scene::indices; indices are relative to first_vertex
  std::uint32_t first_vertex = 0, vertex_count = 0;
};

struct Scene {
  std::filesystem::path file;
  std::string content_hash;
  std::vector<SceneMaterial> materials;
  std::vector<SceneVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<SceneChunk> chunks;
};

/// Reads .gltf or .glb. World frame: x = gltf x, y = -gltf z, z = gltf y. Big meshes are cut into chunks of at most 100
/// m.
Result<Scene> read_scene(const std::filesystem::path& file);

}  // namespace phare
