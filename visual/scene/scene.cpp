// glTF to chunks: node transforms applied, flat normals where a file has none, meshes wider than kCell_m cut on a grid.
#include "visual/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "config/base/content_hash.h"
#include "config/formats/gltf_file.h"

namespace phare {

namespace {

/// Cells are smaller than the 100 m promised for a chunk, for a triangle belongs to the cell of its middle and juts
/// out.
constexpr double kCell_m = 72.0;
constexpr double kFarthest_m = 1e8;      ///< Earth and back; beyond it a file is wrong
constexpr double kBrightest_cdm2 = 1e9;  ///< more than the sun's edge; beyond it a file is wrong
/// A small file can place one mesh many times; this many vertices (1.5 GB) are taken for an error.
constexpr std::size_t kMostVertices = std::size_t{1} << 26;

struct Corner {
  glm::dvec3 position;
  glm::dvec3 normal;
};

Result<Surface> surface_of(const std::string& name) {
  constexpr std::array<std::pair<const char*, Surface>, 5> names{{{"plain", Surface::kPlain},
                                                                  {"asphalt", Surface::kAsphalt},
                                                                  {"grass", Surface::kGrass},
                                                                  {"paint", Surface::kPaint},
                                                                  {"foliage", Surface::kFoliage}}};
  for (const auto& [known, surface] : names) {
    if (name == known) return surface;
  }
  return Error{"", "unknown surface '" + name + "'; known are plain, asphalt, grass, paint, foliage"};
}

Result<SceneMaterial> read_material(const tinygltf::Material& source) {
  SceneMaterial material;
  material.name = source.name;
  material.double_sided = source.doubleSided;
  const std::vector<double>& color = source.pbrMetallicRoughness.baseColorFactor;
  const auto bad = [&source](const std::string& what) { return Error{"", "material '" + source.name + "': " + what}; };
  if (color.size() < 3) return bad("baseColorFactor needs 4 numbers");
  for (int i = 0; i < 3; ++i) {
    const double c = color[static_cast<std::size_t>(i)];
    if (!(c >= 0.0 && c <= 1.0)) return bad("baseColorFactor is outside 0 … 1");
    material.reflectance[i] = static_cast<float>(c);
  }
  if (!source.extras.IsObject() || !source.extras.Has("phare")) return material;
  const tinygltf::Value& extras = source.extras.Get("phare");
  if (!extras.IsObject()) return bad("extras.phare is not an object");
  if (extras.Has("surface")) {
    const tinygltf::Value& name = extras.Get("surface");
    if (!name.IsString()) return bad("extras.phare.surface is not a text");
    auto surface = surface_of(name.Get<std::string>());
    if (!surface) return bad(surface.error().reason);
    material.surface = *surface;
  }
  if (extras.Has("emission_cdm2")) {
    const tinygltf::Value& given = extras.Get("emission_cdm2");
    if (!given.IsArray() || given.ArrayLen() != 3) return bad("extras.phare.emission_cdm2 is not [r, g, b]");
    for (int i = 0; i < 3; ++i) {
      const tinygltf::Value& value = given.Get(i);
      const double c = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
      if (!(c >= 0.0 && c <= kBrightest_cdm2)) return bad("extras.phare.emission_cdm2 is outside 0 … 1e9 cd/m²");
      material.emission_cdm2[i] = static_cast<float>(c);
    }
    // It is drawn as what a diffuse surface would send (visual/fixed_light.h), so none of these is quite black.
    material.reflectance = glm::max(material.reflectance, 1e-3f);
  }
  if (extras.Has("sky_share")) {
    const tinygltf::Value& given = extras.Get("sky_share");
    const double share = given.IsNumber() ? given.GetNumberAsDouble() : -1.0;
    if (!(share >= 0.0 && share <= 1.0)) return bad("extras.phare.sky_share is not a number from 0 to 1");
    material.sky_share = static_cast<float>(share);
  }
  std::string class_name;
  if (extras.Has("retro")) {
    const tinygltf::Value& name = extras.Get("retro");
    if (!name.IsString()) return bad("extras.phare.retro is not a text");
    class_name = name.Get<std::string>();
  }
  const auto figure = [&](const char* key, double most, std::optional<double>& value) -> std::string {
    if (!extras.Has(key)) return "";
    const tinygltf::Value& given = extras.Get(key);
    const double r = given.IsNumber() ? given.GetNumberAsDouble() : -1.0;
    if (!(r >= 0.0 && r <= most))
      return std::string(key) + " is not a number from 0 to " + std::to_string(std::lround(most));
    if (r > 0.0) value = r;
    return "";
  };
  std::optional<double> r_a, r_l;
  for (const std::string& wrong :
       {figure("retroreflection_cd_per_lx_m2", 1e4, r_a), figure("retroreflection_mcd_per_lx_m2", 1e5, r_l)})
    if (!wrong.empty()) return bad(wrong);
  if (r_a && r_l) return bad("a material has an R_A or an R_L, not both");
  if (!class_name.empty() || r_a || r_l) {
    auto retro = retroreflection(class_name, r_a, r_l);
    if (!retro) return bad(retro.error().reason);
    material.retro = std::move(*retro);
  }
  return material;
}

/// Chunks of one primitive: triangles by cell, corners that are equal in the file stay one vertex within a chunk.
class Cutter {
 public:
  Cutter(Scene& scene, std::string node, std::uint32_t material)
      : scene_(&scene), node_(std::move(node)), material_(material) {}

  void cut(const std::vector<Corner>& corners, const std::vector<std::uint32_t>& indices) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const std::uint32_t i : indices) {
      low = glm::min(low, corners[i].position), high = glm::max(high, corners[i].position);
    }
    const glm::dvec3 count = glm::clamp(glm::ceil((high - low) / kCell_m), 1.0, 1e5);
    const glm::dvec3 size = glm::max((high - low) / count, glm::dvec3(1e-9));
    std::map<std::array<int, 3>, std::vector<std::uint32_t>> cells;  // ordered: the same file gives the same chunks
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      const glm::dvec3 middle =
          (corners[indices[i]].position + corners[indices[i + 1]].position + corners[indices[i + 2]].position) / 3.0;
      const glm::dvec3 cell = glm::clamp(glm::floor((middle - low) / size), glm::dvec3(0.0), count - 1.0);
      auto& list = cells[{static_cast<int>(cell.x), static_cast<int>(cell.y), static_cast<int>(cell.z)}];
      list.insert(list.end(), {indices[i], indices[i + 1], indices[i + 2]});
    }
    for (const auto& [cell, list] : cells) add(corners, list);
  }

 private:
  void add(const std::vector<Corner>& corners, const std::vector<std::uint32_t>& indices) {
    SceneChunk chunk;
    chunk.node = node_;
    chunk.material = material_;
    chunk.low_m = glm::dvec3(std::numeric_limits<double>::infinity());
    chunk.high_m = -chunk.low_m;
    for (const std::uint32_t i : indices) {
      chunk.low_m = glm::min(chunk.low_m, corners[i].position);
      chunk.high_m = glm::max(chunk.high_m, corners[i].position);
    }
    chunk.origin_m = glm::round(0.5 * (chunk.low_m + chunk.high_m));
    chunk.first_vertex = static_cast<std::uint32_t>(scene_->vertices.size());
    chunk.first_index = static_cast<std::uint32_t>(scene_->indices.size());
    std::map<std::uint32_t, std::uint32_t> local;
    for (const std::uint32_t i : indices) {
      const auto next = static_cast<std::uint32_t>(scene_->vertices.size()) - chunk.first_vertex;
      const auto [at, fresh] = local.try_emplace(i, next);
      if (fresh) {
        scene_->vertices.push_back({glm::vec3(corners[i].position - chunk.origin_m), glm::vec3(corners[i].normal)});
      }
      scene_->indices.push_back(at->second);
    }
    chunk.vertex_count = static_cast<std::uint32_t>(scene_->vertices.size()) - chunk.first_vertex;
    chunk.index_count = static_cast<std::uint32_t>(indices.size());
    scene_->chunks.push_back(std::move(chunk));
  }

  Scene* scene_;
  std::string node_;
  std::uint32_t material_;
};

/// One primitive where its node puts it.
Status read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const MeshInstance& instance,
                      std::uint32_t default_material, Scene& scene) {
  const auto bad = [&instance](const std::string& what) { return Error{"", "node '" + instance.name + "': " + what}; };
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) return Done{};  // glTF 2.0, 3.7.2.1: such a primitive is not drawn
  auto positions = read_vec3(model, position->second);
  if (!positions) return bad(positions.error().text());
  auto triangles = read_triangles(model, primitive, positions->size());
  if (!triangles) return bad(triangles.error().text());
  if (triangles->empty()) return Done{};
  if (scene.vertices.size() + triangles->size() > kMostVertices) return bad("more than 67 million vertices");

  std::uint32_t material = default_material;
  if (primitive.material >= 0) {
    if (static_cast<std::size_t>(primitive.material) >= model.materials.size()) {
      return bad("material " + std::to_string(primitive.material) + " does not exist");
    }
    material = static_cast<std::uint32_t>(primitive.material);
  }

  const glm::dmat3 linear(instance.world_from_mesh);
  const double volume = glm::determinant(linear);
  // Normals go with the inverse transpose; the cofactor matrix has its direction and needs no division.
  const glm::dmat3 turn(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                        glm::cross(linear[0], linear[1]));
  std::vector<Corner> corners;
  corners.reserve(positions->size());
  for (const glm::vec3& p : *positions) {
    const glm::dvec3 world(instance.world_from_mesh * glm::dvec4(glm::dvec3(p), 1.0));
    if (!(glm::length(world) < kFarthest_m)) return bad("a vertex is not within 1e8 m of the origin");
    corners.push_back({world, glm::dvec3(0.0)});
  }
  if (volume < 0.0) {  // a mirrored node turns its triangles inside out
    for (std::size_t i = 0; i + 2 < triangles->size(); i += 3) std::swap((*triangles)[i + 1], (*triangles)[i + 2]);
  }

  bool whole = false;
  if (const auto normal = primitive.attributes.find("NORMAL"); normal != primitive.attributes.end()) {
    auto normals = read_vec3(model, normal->second);
    if (!normals) return bad(normals.error().text());
    if (normals->size() != corners.size()) return bad("as many normals as positions are needed");
    whole = true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const glm::dvec3 n = (volume < 0.0 ? -1.0 : 1.0) * (turn * glm::dvec3((*normals)[i]));
      const double length = glm::length(n);
      if (std::isfinite(length) && length > 0.0) {
        corners[i].normal = n / length;
      } else {
        whole = false;  // this file's normals are not to be trusted
      }
    }
  }
  if (!whole) {  // flat: each triangle has corners of its own
    std::vector<Corner> own;
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i + 2 < triangles->size(); i += 3) {
      const glm::dvec3 a = corners[(*triangles)[i]].position, b = corners[(*triangles)[i + 1]].position,
                       c = corners[(*triangles)[i + 2]].position;
      const glm::dvec3 area = glm::cross(b - a, c - a);
      const double length = glm::length(area);
      if (!(length > 0.0) || !std::isfinite(length)) continue;
      for (const glm::dvec3& p : {a, b, c}) {
        kept.push_back(static_cast<std::uint32_t>(own.size()));
        own.push_back({p, area / length});
      }
    }
    corners = std::move(own);
    *triangles = std::move(kept);
    if (triangles->empty()) return Done{};
  }
  Cutter(scene, instance.name, material).cut(corners, *triangles);
  return Done{};
}

}  // namespace

Result<Scene> read_scene(const std::filesystem::path& file) {
  auto model = read_gltf(file);
  if (!model) return model.error();
  const auto bad = [&file](const Error& error) { return Error{file.string(), error.text()}; };

  Scene scene;
  scene.file = file;
  auto hash = content_hash_of_file(file);
  if (!hash) return hash.error();
  scene.content_hash = *hash;

  for (const tinygltf::Material& source : model->materials) {
    auto material = read_material(source);
    if (!material) return bad(material.error());
    scene.materials.push_back(*material);
  }
  const auto default_material = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back({});  // for primitives that name none
  scene.materials.back().name = "default";

  auto instances = mesh_instances(*model);
  if (!instances) return bad(instances.error());
  for (const MeshInstance& instance : *instances) {
    for (const tinygltf::Primitive& primitive : model->meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
      if (auto status = read_primitive(*model, primitive, instance, default_material, scene); !status) {
        return bad(status.error());
      }
    }
  }
  const bool used = std::any_of(scene.chunks.begin(), scene.chunks.end(),
                                [&](const SceneChunk& chunk) { return chunk.material == default_material; });
  if (!used) scene.materials.pop_back();
  return scene;
}

}  // namespace phare
