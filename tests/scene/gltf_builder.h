// Small glTF files for tests: bytes become buffer views and accessors of one buffer in a data URI.
#pragma once

#include <gtest/gtest.h>
#include <stb_image_write.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/base/base64.h"

namespace phare {

class GltfBuilder {
 public:
  using Json = nlohmann::json;

  GltfBuilder() {
    root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", Json::array({{{"nodes", {0}}}})},
            {"nodes", Json::array({{{"name", "thing"}, {"mesh", 0}}})},
            {"meshes", Json::array({{{"primitives", Json::array({{{"attributes", Json::object()}}})}}})}};
  }

  Json root;

  Json& primitive() { return root["meshes"][0]["primitives"][0]; }
  template <typename T>
  int view(const std::vector<T>& values, int stride = 0) {
    bytes_.resize((bytes_.size() + 7) / 8 * 8, '\0');
    const std::size_t offset = bytes_.size(), size = values.size() * sizeof(T);
    bytes_.resize(offset + size);
    std::memcpy(bytes_.data() + offset, values.data(), size);
    Json made = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}};
    if (stride > 0) made["byteStride"] = stride;
    root["bufferViews"].push_back(made);
    return static_cast<int>(root["bufferViews"].size()) - 1;
  }
  int accessor(int view, int component_type, std::size_t count, const char* type, bool normalized = false) {
    Json made = {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}};
    if (normalized) made["normalized"] = true;
    root["accessors"].push_back(made);
    return static_cast<int>(root["accessors"].size()) - 1;
  }
  void attribute(const char* name, int accessor) { primitive()["attributes"][name] = accessor; }
  void floats(const char* name, const std::vector<float>& values, const char* type, std::size_t components) {
    attribute(name, accessor(view(values), 5126, values.size() / components, type));
  }
  /// A square of 1 m in the plane of glTF's x and y, facing +z, with texture coordinates from its upper left corner.
  void square() {
    floats("POSITION", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
    floats("TEXCOORD_0", {0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
    primitive()["indices"] = accessor(view(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}), 5123, 6, "SCALAR");
  }
  void material(const Json& material) {
    root["materials"].push_back(material);
    primitive()["material"] = root["materials"].size() - 1;
  }

  /// An image in a buffer view, and a texture of it.
  int texture(const std::vector<unsigned char>& png) {
    root["images"].push_back({{"bufferView", view(png)}, {"mimeType", "image/png"}});
    root["textures"].push_back({{"source", root["images"].size() - 1}});
    return static_cast<int>(root["textures"].size()) - 1;
  }

  std::filesystem::path write(const std::string& name) {
    Json whole = root, buffers = Json::array();
    if (!bytes_.empty()) {
      const Json own = {{"byteLength", bytes_.size()},
                        {"uri", "data:application/octet-stream;base64," + base64(bytes_)}};
      buffers.push_back(own);
    }
    for (const Json& other : whole.value("buffers", Json::array())) buffers.push_back(other);
    if (!buffers.empty()) whole["buffers"] = buffers;
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / name;
    std::ofstream(file, std::ios::binary) << whole.dump();
    return file;
  }

 private:
  std::string bytes_;
};

/// A PNG of RGBA rows from the top.
inline std::vector<unsigned char> png_of(int width, int height, const std::vector<std::uint8_t>& rgba) {
  std::vector<unsigned char> png;
  const auto append = [](void* to, void* data, int size) {
    auto* bytes = static_cast<unsigned char*>(data);
    static_cast<std::vector<unsigned char>*>(to)->insert(static_cast<std::vector<unsigned char>*>(to)->end(), bytes,
                                                         bytes + size);
  };
  EXPECT_NE(stbi_write_png_to_func(append, &png, width, height, 4, rgba.data(), 4 * width), 0);
  return png;
}

}  // namespace phare
