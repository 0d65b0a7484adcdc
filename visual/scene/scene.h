// A scene as drawn: triangles in chunks with bounds, materials. Read from glTF by tinygltf; docs/scenes.md says what of
// it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/gtc/type_precision.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"
#include "visual/scene/retro.h"
#include "visual/scene/texture.h"

namespace phare {

enum class Surface : std::uint32_t { kPlain = 0, kAsphalt = 1, kGrass = 2, kPaint = 3, kFoliage = 4 };

/// What a material has at every pixel, beside a reflectance that is the same all over. Most have none of it, and are
/// drawn without.
struct PixelLook {
  glm::vec4 base{1.0f};             ///< times base texture and colour at the corner: rho, linear Rec. 709; opacity
  glm::vec3 emitted_cdm2{0.0f};     ///< times emissive texture; Rec. 709, luminance by 0.2126, 0.7152, 0.0722
  std::optional<std::size_t> base_texture{}, emissive_texture{};  ///< in Scene::textures
  TextureSampler sampler{};
  std::optional<float> cut_below{};  ///< where opacity is less, there is nothing (glTF's alphaMode MASK)
  bool corner_colours = false;       ///< of glTF's COLOR_0
  bool unlit = false;                ///< emits base texture and corner colours, by emitted_cdm2
  std::optional<std::size_t> normal_texture{}, rough_texture{};  ///< glTF's; of the second green: roughness, blue: metal
  float normal_scale = 1.0f;          ///< of the normal texture's x and y
  float roughness = 1.0f, metal = 1.0f;  ///< times the texture's, 0 to 1

  bool relief() const { return normal_texture || rough_texture; }
  bool none() const {
    return !base_texture && !emissive_texture && !cut_below && !corner_colours && !relief() &&
           emitted_cdm2 == glm::vec3(0.0f);
  }
};

struct SceneMaterial {
  std::string name;
  glm::vec3 reflectance{0.5f};        ///< diffuse rho, linear Rec. 709; of a texture its mean
  Surface surface = Surface::kPlain;  ///< which procedural detail
  Retroreflection retro{};            ///< sheeting, markings; most materials have none
  bool r_table = false;  ///< under lamps above it luminance follows a road's r-table (visual/fixed_light.h)
  bool double_sided = false;
  PixelLook look{};
  glm::vec3 emission_cdm2{0.0f};  ///< what it sends out by itself, every way alike: cd/m², linear Rec. 709
  float sky_share = 1.0f;         ///< of the sky's light that reaches it: 0 inside a tunnel
};

/// Vertices are relative to `origin_m`, so float32 serves anywhere in the world.
struct SceneVertex {
  glm::vec3 position_m;
  glm::vec3 normal;
};

/// The same corner, of materials that have a look at every pixel.
struct CornerLook {
  glm::vec2 uv{0.0f};                   ///< of the material's textures, their transform done
  glm::u16vec4 colour{65535};  ///< linear, 65535 is 1
  glm::i8vec4 tangent{0};      ///< of materials with relief(): visual/scene/tangents.h
};

/// Triangles of one material that are drawn or culled together.
struct SceneChunk {
  std::string node;  ///< name of the glTF node, "road…", "tree…"
  std::uint32_t material = 0;
  glm::dvec3 origin_m{0.0};
  glm::dvec3 low_m{0.0}, high_m{0.0};              ///< bounds in the world
  std::uint32_t first_index = 0, index_count = 0;  ///< in Scene::indices; indices are relative to first_vertex
  std::uint32_t first_vertex = 0, vertex_count = 0;
  std::optional<std::uint32_t> first_look{};  ///< in Scene::looks, one for each vertex; none: the material has no look
};

/// A lamp that stands in the file's scene (visual/scene/scene_lights.h).
struct SceneLight {
  enum class Kind : std::uint8_t { kPoint, kSpot, kDirectional, kProfile };
  std::string name;
  Kind kind = Kind::kPoint;
  glm::dvec3 position_m{0.0};
  glm::dmat3 world_from_light{1.0};  ///< columns: where it looks, left, up
  glm::vec3 colour{1.0f};            ///< linear Rec. 709, times what follows
  double intensity = 1.0;            ///< cd; directional: lx on a plane that faces it; profile: times its candela
  double range_m = std::numeric_limits<double>::infinity();  ///< beyond it there is no light
  double inner_rad = 0.0, outer_rad = 0.7853981633974483;    ///< of a spot's cone; glTF's default
  std::size_t profile = 0;                                   ///< in Scene::light_profiles
};

/// A photometry file that lamps of the scene shine by.
struct LightProfile {
  std::string name;              ///< the file, or where in the scene's file it stands
  std::filesystem::path file{};  ///< empty: within the scene's file
  std::string bytes{};
};

struct Scene {
  std::filesystem::path file;
  std::string content_hash;  ///< of the file and of what lies beside it (config/formats/gltf_uri.h)
  std::vector<SceneMaterial> materials;
  std::vector<SceneVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<SceneChunk> chunks;
  std::vector<CornerLook> looks{};
  std::vector<SceneTexture> textures{};
  std::vector<SceneLight> lights{};
  std::vector<LightProfile> light_profiles{};
  std::vector<std::string> notes{};  ///< what of the file is not drawn as it says, a line each, each said once
};

/// Each triangle's corners have one normal, that of its plane: what float32 makes of corners aside, a lamp is equally
/// far before every point of it.
bool is_flat(std::span<const SceneVertex> vertices, std::span<const std::uint32_t> indices);

/// A corner's normal leans by more than 3° from that of its triangle's plane, so a lamp may stand behind the plane and
/// before the corner.
bool is_bent(std::span<const SceneVertex> vertices, std::span<const std::uint32_t> indices);

/// What a material emits, of a texture its mean; cd/m², Rec. 709.
glm::vec3 mean_emitted_cdm2(const Scene& scene, const SceneMaterial& material);

/// Called now and then with what is done, 0 to 1, and what is being done.
using Progress = std::function<void(double done_01, std::string_view what)>;

/// Reads .gltf or .glb. World frame: x = gltf x, y = -gltf z, z = gltf y. Big meshes are cut into chunks of at most 100
/// m.
Result<Scene> read_scene(const std::filesystem::path& file, const Progress& progress = {});

}  // namespace phare
