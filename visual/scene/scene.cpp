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

#include "config/formats/gltf_file.h"
#include "config/formats/gltf_uri.h"
#include "visual/scene/long_edges.h"
#include "visual/scene/materials.h"
#include "visual/scene/scene_lights.h"
#include "visual/scene/tangents.h"

namespace phare {

namespace {

/// Cells are smaller than the 100 m promised for a chunk, for a triangle belongs to the cell of its middle and juts
/// out.
constexpr double kCell_m = 72.0;
constexpr double kFarthest_m = 1e8;  ///< Earth and back; beyond it a file is wrong
/// A small file can place one mesh many times; this many vertices (1.5 GB) are taken for an error.
constexpr std::size_t kMostVertices = std::size_t{1} << 26;

/// Chunks of one primitive: triangles by cell, corners that are equal in the file stay one vertex within a chunk.
class Cutter {
 public:
  Cutter(Scene& scene, std::string node, std::uint32_t material)
      : scene_(&scene), node_(std::move(node)), material_(material), look_(!scene.materials[material].look.none()) {}

  void cut(const MeshCorners& all, const std::vector<std::uint32_t>& indices) {
    const std::vector<MeshCorner>& corners = all.at;
    place_.assign(corners.size(), kNowhere);
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
    for (auto& [cell, list] : cells) {
      add(all, list);
      list = {};
    }
  }

 private:
  static constexpr std::uint32_t kNowhere = ~0u;

  void add(const MeshCorners& all, const std::vector<std::uint32_t>& indices) {
    const std::vector<MeshCorner>& corners = all.at;
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
    if (look_) chunk.first_look = static_cast<std::uint32_t>(scene_->looks.size());
    for (const std::uint32_t i : indices) {
      if (place_[i] == kNowhere) {
        place_[i] = static_cast<std::uint32_t>(scene_->vertices.size()) - chunk.first_vertex;
        scene_->vertices.push_back({glm::vec3(corners[i].position - chunk.origin_m), corners[i].normal});
        if (look_) scene_->looks.push_back(all.looks[i]);
      }
      scene_->indices.push_back(place_[i]);
    }
    for (const std::uint32_t i : indices) place_[i] = kNowhere;
    chunk.vertex_count = static_cast<std::uint32_t>(scene_->vertices.size()) - chunk.first_vertex;
    chunk.index_count = static_cast<std::uint32_t>(indices.size());
    scene_->chunks.push_back(std::move(chunk));
  }

  Scene* scene_;
  std::string node_;
  std::uint32_t material_;
  bool look_;
  std::vector<std::uint32_t> place_;  ///< of a corner within the chunk
};

/// Which material of the scene a primitive has; `default_material`: where it names none.
Result<std::uint32_t> material_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                  std::uint32_t default_material) {
  if (primitive.material < 0) return default_material;
  if (static_cast<std::size_t>(primitive.material) >= model.materials.size())
    return Error{"", "material " + std::to_string(primitive.material) + " does not exist"};
  return static_cast<std::uint32_t>(primitive.material);
}

/// Colours at corners multiply reflectance; where all are white there are none.
struct ColourSum {
  glm::dvec3 sum{0.0};
  double count = 0.0;
  bool coloured = false;
};

Status sum_colours(const tinygltf::Model& model, const std::vector<MeshInstance>& instances,
                   std::uint32_t default_material, std::vector<ColourSum>& sums) {
  std::vector<bool> seen(model.meshes.size(), false);
  for (const MeshInstance& instance : instances) {
    if (seen[static_cast<std::size_t>(instance.mesh)]) continue;
    seen[static_cast<std::size_t>(instance.mesh)] = true;
    for (const tinygltf::Primitive& primitive : model.meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
      const auto given = primitive.attributes.find("COLOR_0");
      if (given == primitive.attributes.end()) continue;
      const auto bad = [&](const Error& error) { return Error{"", "node '" + instance.name + "': " + error.text()}; };
      const Result<std::uint32_t> material = material_of(model, primitive, default_material);
      if (!material) return bad(material.error());
      const Result<std::vector<glm::vec4>> colours = read_vec4(model, given->second);
      if (!colours) return bad(colours.error());
      ColourSum& sum = sums[*material];
      for (const glm::vec4& colour : *colours) {
        sum.coloured |= colour != glm::vec4(1.0f);
        sum.sum += glm::dvec3(glm::clamp(glm::vec3(colour), 0.0f, 1.0f));
      }
      sum.count += static_cast<double>(colours->size());
    }
  }
  return Done{};
}

/// Room for what the file says it has, so that nothing is copied while it grows.
void reserve_for(const tinygltf::Model& model, const std::vector<MeshInstance>& instances, Scene& scene) {
  std::size_t bytes = 0;  // what a broken file says beyond them it has not
  for (const tinygltf::Buffer& buffer : model.buffers) bytes += buffer.data.size();
  const auto count = [&](int accessor) {
    const bool there = accessor >= 0 && static_cast<std::size_t>(accessor) < model.accessors.size();
    return there ? std::min(model.accessors[static_cast<std::size_t>(accessor)].count, bytes) : 0;
  };
  std::size_t vertices = 0, indices = 0;
  for (const MeshInstance& instance : instances)
    for (const tinygltf::Primitive& primitive : model.meshes[static_cast<std::size_t>(instance.mesh)].primitives)
      if (const auto position = primitive.attributes.find("POSITION"); position != primitive.attributes.end()) {
        vertices += count(position->second);
        indices += count(primitive.indices);
      }
  scene.vertices.reserve(std::min(vertices, kMostVertices));
  scene.indices.reserve(std::min(indices, kMostVertices));
}

/// Texture coordinates and colours of the corners; those that a primitive has not are 0 and white.
Status read_looks(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const ReadMaterial& material,
                  MeshCorners& corners) {
  corners.looks.resize(corners.at.size());
  const auto attribute = [&](const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
  };
  const PixelLook& look = material.material.look;
  const int uv = attribute("TEXCOORD_" + std::to_string(material.uv_set)), colour = attribute("COLOR_0");
  if (uv >= 0 && (look.base_texture || look.emissive_texture || look.relief())) {
    const Result<std::vector<glm::vec2>> read = read_vec2(model, uv);
    if (!read) return read.error();
    if (read->size() != corners.at.size()) return Error{"", "as many texture coordinates as positions are needed"};
    for (std::size_t i = 0; i < read->size(); ++i)
      corners.looks[i].uv = glm::vec2(material.uv_from_file * glm::dvec3(glm::dvec2((*read)[i]), 1.0));
  }
  if (colour >= 0 && look.corner_colours) {
    const Result<std::vector<glm::vec4>> read = read_vec4(model, colour);
    if (!read) return read.error();
    if (read->size() != corners.at.size()) return Error{"", "as many colours as positions are needed"};
    for (std::size_t i = 0; i < read->size(); ++i)
      corners.looks[i].colour = glm::u16vec4(glm::clamp((*read)[i], 0.0f, 1.0f) * 65535.0f + 0.5f);
  }
  return Done{};
}

/// Those of the file, turned by its node; where it has none, from the texture coordinates. `own`: its normals are taken,
/// without which its tangents do not count (glTF 2.0, 3.7.2.1).
Status read_tangents(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const glm::dmat3& turn,
                     bool own, MeshCorners& corners, const std::vector<std::uint32_t>& triangles) {
  const auto given = primitive.attributes.find("TANGENT");
  if (own && given != primitive.attributes.end()) {
    const Result<std::vector<glm::vec4>> read = read_vec4(model, given->second);
    if (!read) return read.error();
    if (read->size() != corners.at.size()) return Error{"", "as many tangents as positions are needed"};
    const double side = glm::determinant(turn) < 0.0 ? -1.0 : 1.0;
    bool whole = true;
    for (std::size_t i = 0; i < read->size(); ++i) {
      const glm::dvec3 tangent = turn * glm::dvec3((*read)[i]);
      const double length = glm::length(tangent);
      whole = whole && length > 0.0 && std::isfinite(length);
      if (whole)
        corners.looks[i].tangent =
            packed_tangent(glm::vec3(tangent / length), static_cast<float>(side * static_cast<double>((*read)[i].w)));
    }
    if (whole) return Done{};
  }
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;
  for (const MeshCorner& corner : corners.at) positions.push_back(corner.position), normals.push_back(corner.normal);
  for (const CornerLook& look : corners.looks) uvs.push_back(look.uv);
  const std::vector<glm::i8vec4> tangents = tangents_of(positions, normals, uvs, triangles);
  for (std::size_t i = 0; i < tangents.size(); ++i) corners.looks[i].tangent = tangents[i];
  return Done{};
}

/// One primitive where its node puts it.
Status read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const MeshInstance& instance,
                      const std::vector<ReadMaterial>& materials, Scene& scene, SceneNotes& notes) {
  const auto bad = [&instance](const std::string& what) { return Error{"", "node '" + instance.name + "': " + what}; };
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) return Done{};  // glTF 2.0, 3.7.2.1: such a primitive is not drawn
  auto positions = read_vec3(model, position->second);
  if (!positions) return bad(positions.error().text());
  auto triangles = read_triangles(model, primitive, positions->size());
  if (!triangles) return bad(triangles.error().text());
  if (triangles->empty()) return Done{};
  if (scene.vertices.size() + triangles->size() > kMostVertices) return bad("more than 67 million vertices");

  const auto material = material_of(model, primitive, static_cast<std::uint32_t>(materials.size() - 1));
  if (!material) return bad(material.error().text());

  const glm::dmat3 linear(instance.world_from_mesh);
  const double volume = glm::determinant(linear);
  // Normals go with the inverse transpose; the cofactor matrix has its direction and needs no division.
  const glm::dmat3 turn(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                        glm::cross(linear[0], linear[1]));
  MeshCorners corners;
  corners.at.reserve(positions->size());
  for (const glm::vec3& p : *positions) {
    const glm::dvec3 world(instance.world_from_mesh * glm::dvec4(glm::dvec3(p), 1.0));
    if (!(glm::length(world) < kFarthest_m)) return bad("a vertex is not within 1e8 m of the origin");
    corners.at.push_back({world});
  }
  *positions = {};
  const PixelLook& look = materials[*material].material.look;
  const std::string laid_by = "TEXCOORD_" + std::to_string(materials[*material].uv_set);
  if ((look.base_texture || look.emissive_texture || look.relief()) && !primitive.attributes.contains(laid_by))
    notes.add("textures have no coordinates to lie by: one texel is everywhere", instance.name);
  if (!look.none())
    if (Status done = read_looks(model, primitive, materials[*material], corners); !done)
      return bad(done.error().text());
  if (volume < 0.0) {  // a mirrored node turns its triangles inside out
    for (std::size_t i = 0; i + 2 < triangles->size(); i += 3) std::swap((*triangles)[i + 1], (*triangles)[i + 2]);
  }

  bool whole = false;
  if (const auto normal = primitive.attributes.find("NORMAL"); normal != primitive.attributes.end()) {
    auto normals = read_vec3(model, normal->second);
    if (!normals) return bad(normals.error().text());
    if (normals->size() != corners.at.size()) return bad("as many normals as positions are needed");
    whole = true;
    for (std::size_t i = 0; i < corners.at.size(); ++i) {
      const glm::dvec3 n = (volume < 0.0 ? -1.0 : 1.0) * (turn * glm::dvec3((*normals)[i]));
      const double length = glm::length(n);
      if (std::isfinite(length) && length > 0.0) {
        corners.at[i].normal = glm::vec3(n / length);
      } else {
        whole = false;  // this file's normals are not to be trusted
      }
    }
  }
  if (!whole) {  // flat: each triangle has corners of its own
    MeshCorners own;
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i + 2 < triangles->size(); i += 3) {
      const auto at = [&](std::size_t k) { return corners.at[(*triangles)[i + k]].position; };
      const glm::dvec3 area = glm::cross(at(1) - at(0), at(2) - at(0));
      const double length = glm::length(area);
      if (!(length > 0.0) || !std::isfinite(length)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        kept.push_back(static_cast<std::uint32_t>(own.at.size()));
        own.at.push_back({at(k), glm::vec3(area / length)});
        if (!corners.looks.empty()) own.looks.push_back(corners.looks[(*triangles)[i + k]]);
      }
    }
    corners = std::move(own);
    *triangles = std::move(kept);
    if (triangles->empty()) return Done{};
  }
  if (materials[*material].material.look.relief())
    if (Status done = read_tangents(model, primitive, linear, whole, corners, *triangles); !done)
      return bad(done.error().text());
  if (const double longest_m = halve_long_edges(corners, *triangles); longest_m > kLongestEdge_m)
    notes.add("triangles stay up to " + std::to_string(static_cast<long long>(longest_m)) +
                  " m long, and light on them may be off by more than stated",
              instance.name);
  Cutter(scene, instance.name, *material).cut(corners, *triangles);
  return Done{};
}

}  // namespace

bool is_flat(std::span<const SceneVertex> vertices, std::span<const std::uint32_t> indices) {
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const SceneVertex &a = vertices[indices[i]], &b = vertices[indices[i + 1]], &c = vertices[indices[i + 2]];
    if (a.normal != b.normal || a.normal != c.normal) return false;
    // MeshCorners are rounded where they stand, a normal's parts to 2^-24 of its length.
    const glm::vec3 largest = glm::max(glm::abs(a.position_m), glm::max(glm::abs(b.position_m), glm::abs(c.position_m)));
    const double side_m = glm::max(glm::length(b.position_m - a.position_m), glm::length(c.position_m - a.position_m));
    const double rounding_m = 0x1p-23 * (glm::length(largest) + side_m);
    for (const SceneVertex* corner : {&b, &c})
      if (!(std::abs(glm::dot(glm::dvec3(a.normal), glm::dvec3(corner->position_m) - glm::dvec3(a.position_m))) <=
            2.0 * rounding_m))
        return false;
  }
  return true;
}

bool is_bent(std::span<const SceneVertex> vertices, std::span<const std::uint32_t> indices) {
  const float least_cos = std::cos(glm::radians(3.0f));
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const SceneVertex &a = vertices[indices[i]], &b = vertices[indices[i + 1]], &c = vertices[indices[i + 2]];
    const glm::vec3 across = glm::cross(b.position_m - a.position_m, c.position_m - a.position_m);
    const float twice_m2 = glm::length(across);
    for (const SceneVertex* corner : {&a, &b, &c})
      if (glm::dot(corner->normal, across) < least_cos * twice_m2 * glm::length(corner->normal)) return true;
  }
  return false;
}

glm::vec3 mean_emitted_cdm2(const Scene& scene, const SceneMaterial& material) {
  const PixelLook& look = material.look;
  if (look.emitted_cdm2 == glm::vec3(0.0f) || !look.emissive_texture) return look.emitted_cdm2;
  return look.emitted_cdm2 * glm::vec3(mean_of(scene.textures[*look.emissive_texture]));
}

Result<Scene> read_scene(const std::filesystem::path& file, const Progress& progress) {
  const std::string what = "reading " + file.filename().string();
  const auto tell = [&](double done_01) {
    if (progress) progress(done_01, what);
  };
  tell(0.0);
  auto model = read_gltf(file, GltfImages::kKeep);
  if (!model) return model.error();
  const auto bad = [&file](const Error& error) { return Error{file.string(), error.text()}; };

  Scene scene;
  scene.file = file;
  auto hash = content_hash_of_gltf(file);
  if (!hash) return hash.error();
  scene.content_hash = *hash;

  // Materials, the last for primitives that name none.
  const Result<MaterialLibrary> library = MaterialLibrary::read();
  if (!library) return library.error();
  SceneNotes notes;
  note_what_is_not_read(*model, notes);
  MaterialReader reader(*model, file, *library, scene, notes);
  std::vector<ReadMaterial> materials;
  for (const tinygltf::Material& source : model->materials) {
    auto material = reader.read(source);
    if (!material) return bad(material.error());
    materials.push_back(std::move(*material));
  }
  const auto default_material = static_cast<std::uint32_t>(materials.size());
  materials.emplace_back().material.name = "default";

  if (Status done = read_scene_lights(*model, file.parent_path(), scene); !done) return bad(done.error());
  auto instances = mesh_instances(*model);
  if (!instances) return bad(instances.error());
  std::vector<ColourSum> colours(materials.size());
  if (Status done = sum_colours(*model, *instances, default_material, colours); !done) return bad(done.error());
  for (std::size_t i = 0; i < materials.size(); ++i) {
    SceneMaterial& material = materials[i].material;
    if (colours[i].coloured) {
      material.look.corner_colours = true;
      material.look.base = glm::vec4(material.look.base_texture || material.look.unlit ? glm::vec3(material.look.base)
                                                                                       : material.reflectance,
                                     material.look.base.w);
      material.reflectance *= glm::vec3(colours[i].sum / colours[i].count);
    } else if (!material.look.base_texture && !material.look.unlit) {
      material.look.base = glm::vec4(material.reflectance, material.look.base.w);
    }
    scene.materials.push_back(material);
  }

  reserve_for(*model, *instances, scene);
  // What there is to do by now, and what of it is done, in meshes.
  for (std::size_t i = 0; i < instances->size(); ++i) {
    const MeshInstance& instance = (*instances)[i];
    tell(0.2 + 0.8 * static_cast<double>(i) / static_cast<double>(instances->size()));
    for (const tinygltf::Primitive& primitive : model->meshes[static_cast<std::size_t>(instance.mesh)].primitives)
      if (Status done = read_primitive(*model, primitive, instance, materials, scene, notes); !done)
        return bad(done.error());
  }
  tell(1.0);
  const bool used = std::any_of(scene.chunks.begin(), scene.chunks.end(),
                                [&](const SceneChunk& chunk) { return chunk.material == default_material; });
  if (!used) scene.materials.pop_back();
  scene.notes = notes.lines();
  return scene;
}

}  // namespace phare
