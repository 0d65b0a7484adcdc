#include "tools/scene/glb_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

namespace phare::scene {

namespace {

using Json = nlohmann::ordered_json;

enum : int {
  kFloat = 5126,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kArrayBuffer = 34962,
  kElementArrayBuffer = 34963
};

glm::dvec3 gltf_axes(glm::dvec3 world) {
  return {world.x, world.z, -world.y};
}

template <typename T>
void append(std::string& bytes, const T* data, std::size_t count) {
  const std::size_t old = bytes.size();
  bytes.resize(old + count * sizeof(T));
  if (count > 0) std::memcpy(bytes.data() + old, data, count * sizeof(T));
}

/// A float without the noise of its decimals in the JSON.
Json tidy(glm::dvec3 v) {
  const auto f = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  return {f(v.x), f(v.y), f(v.z)};
}

class Writer {
 public:
  explicit Writer(const Model& model) {
    root_["asset"] = {{"version", "2.0"}, {"generator", "phare-make-scene"}};
    root_["scene"] = 0;
    root_["scenes"] = Json::array({{{"nodes", Json::array()}}});
    std::size_t used = static_cast<std::size_t>(Material::kSignBack) + 1;
    for (const Node& node : model.nodes)
      for (const auto& [material, triangles] : node.parts)
        used = std::max(used, static_cast<std::size_t>(material) + 1);
    for (const MaterialData& m : std::span(kMaterials).first(used)) {
      Json material;
      material["name"] = m.name;
      material["pbrMetallicRoughness"] = {
          {"baseColorFactor", {m.reflectance[0], m.reflectance[1], m.reflectance[2], 1.0}},
          {"metallicFactor", 0.0},
          {"roughnessFactor", 0.95}};
      if (m.double_sided) material["doubleSided"] = true;
      Json& own = material["extras"]["phare"] = {{"surface", m.surface}};
      if (*m.retro != '\0') own["retro"] = m.retro;
      if (m.retroreflection_cd_per_lx_m2 > 0.0) own["retroreflection_cd_per_lx_m2"] = m.retroreflection_cd_per_lx_m2;
      if (m.emission_cdm2 != std::array<double, 3>{}) own["emission_cdm2"] = m.emission_cdm2;
      if (m.sky_share < 1.0) own["sky_share"] = m.sky_share;
      if (!m.r_table) own["r_table"] = false;
      root_["materials"].push_back(material);
    }
    for (const Node& node : model.nodes) add(node);
    root_["buffers"] = Json::array({{{"byteLength", bin_.size()}}});
  }

  std::string bytes() const {
    std::string json = root_.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bin = bin_;
    bin.resize((bin.size() + 3) / 4 * 4, '\0');
    std::string file;
    const auto word = [&file](std::uint32_t v) { append(file, &v, 1); };  // little-endian machines, as all of ours
    word(0x46546C67);
    word(2);
    word(static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + bin.size()));
    word(static_cast<std::uint32_t>(json.size()));
    word(0x4E4F534A);
    file += json;
    word(static_cast<std::uint32_t>(bin.size()));
    word(0x004E4942);
    file += bin;
    return file;
  }

 private:
  void add(const Node& node) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const auto& [material, triangles] : node.parts) {
      for (const Triangle& t : triangles) {
        for (const glm::dvec3& p : t.corner) low = glm::min(low, p), high = glm::max(high, p);
      }
    }
    if (!(low.x <= high.x)) return;                            // an empty node has no place
    const glm::dvec3 middle = glm::round(0.5 * (low + high));  // whole metres: exact in float32

    Json primitives = Json::array();
    for (const auto& [material, triangles] : node.parts) {
      const IndexedMesh mesh = weld(triangles);
      if (mesh.indices.empty()) continue;
      std::vector<float> positions, normals;
      glm::dvec3 least(std::numeric_limits<double>::infinity()), most(-least);
      for (const Vertex& v : mesh.vertices) {
        const glm::dvec3 p = gltf_axes(v.position - middle), n = gltf_axes(v.normal);
        for (int i = 0; i < 3; ++i) {
          positions.push_back(static_cast<float>(p[i]));
          normals.push_back(static_cast<float>(n[i]));
        }
        least = glm::min(least, p), most = glm::max(most, p);
      }
      Json primitive;
      const std::size_t vertices = mesh.vertices.size();
      primitive["attributes"]["POSITION"] =
          accessor(positions.data(), positions.size(), vertices, kFloat, "VEC3", kArrayBuffer);
      root_["accessors"].back()["min"] = tidy(least);
      root_["accessors"].back()["max"] = tidy(most);
      primitive["attributes"]["NORMAL"] =
          accessor(normals.data(), normals.size(), vertices, kFloat, "VEC3", kArrayBuffer);
      const std::size_t indices = mesh.indices.size();
      if (vertices <= 0xFFFF) {
        const std::vector<std::uint16_t> narrow(mesh.indices.begin(), mesh.indices.end());
        primitive["indices"] = accessor(narrow.data(), indices, indices, kUnsignedShort, "SCALAR", kElementArrayBuffer);
      } else {
        primitive["indices"] =
            accessor(mesh.indices.data(), indices, indices, kUnsignedInt, "SCALAR", kElementArrayBuffer);
      }
      primitive["material"] = static_cast<int>(material);
      primitives.push_back(primitive);
    }
    root_["scenes"][0]["nodes"].push_back(root_["nodes"].size());
    root_["nodes"].push_back(
        {{"name", node.name}, {"mesh", root_["meshes"].size()}, {"translation", tidy(gltf_axes(middle))}});
    root_["meshes"].push_back({{"name", node.name}, {"primitives", primitives}});
  }

  template <typename T>
  std::size_t accessor(const T* data, std::size_t values, std::size_t count, int type, const char* shape, int target) {
    bin_.resize((bin_.size() + 3) / 4 * 4, '\0');
    const std::size_t offset = bin_.size();
    append(bin_, data, values);
    root_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values * sizeof(T)}, {"target", target}});
    root_["accessors"].push_back(
        {{"bufferView", root_["bufferViews"].size() - 1}, {"componentType", type}, {"count", count}, {"type", shape}});
    return root_["accessors"].size() - 1;
  }

  Json root_;
  std::string bin_;
};

}  // namespace

std::string glb_bytes(const Model& model) {
  return Writer(model).bytes();
}

}  // namespace phare::scene
