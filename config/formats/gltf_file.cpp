// The one place where tinygltf is compiled.
#define TINYGLTF_IMPLEMENTATION
#include "config/formats/gltf_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <span>
#include <utility>

namespace phare {
namespace {

// Deeper than any real file; guards the recursion of the parser and of our own walk over the nodes.
constexpr int kMaxNesting = 128;
constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30;

Error bad(std::string place, std::string reason) {
  return Error{std::move(place), std::move(reason)};
}

// Images do not matter to us: accept them unseen.
bool ignore_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
  return true;
}

// The nesting of brackets outside strings; tinygltf converts "extras" recursively, which would exhaust the stack.
int json_nesting(std::span<const unsigned char> text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == '{' || c == '[') deepest = std::max(deepest, ++depth);
    if (c == '}' || c == ']') --depth;
  }
  return deepest;
}

// The bytes of an accessor: first element, stride and count, proven to lie inside the buffer.
struct Elements {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
};

Result<Elements> elements_of(const tinygltf::Model& model, int index, std::size_t element_bytes) {
  const std::string place = "accessor " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) return bad(place, "does not exist");
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  if (accessor.sparse.isSparse) return bad(place, "sparse accessors are not supported");
  if (accessor.bufferView < 0 || static_cast<std::size_t>(accessor.bufferView) >= model.bufferViews.size())
    return bad(place, "bufferView " + std::to_string(accessor.bufferView) + " does not exist");
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
    return bad(place, "buffer " + std::to_string(view.buffer) + " does not exist");
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;

  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    return bad(place, "its bufferView reaches beyond the buffer of " + std::to_string(data.size()) + " bytes");
  const std::size_t stride = view.byteStride == 0 ? element_bytes : view.byteStride;
  if (stride < element_bytes) return bad(place, "stride " + std::to_string(stride) + " is smaller than an element");
  if (accessor.count == 0) return Elements{data.data(), stride, 0};
  if (accessor.byteOffset > view.byteLength || view.byteLength - accessor.byteOffset < element_bytes ||
      accessor.count - 1 > (view.byteLength - accessor.byteOffset - element_bytes) / stride)
    return bad(place, std::to_string(accessor.count) + " elements do not fit into its bufferView of " +
                          std::to_string(view.byteLength) + " bytes");
  return Elements{data.data() + view.byteOffset + accessor.byteOffset, stride, accessor.count};
}

glm::dmat4 local_transform(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    glm::dmat4 matrix;
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) matrix[column][row] = node.matrix[static_cast<std::size_t>(4 * column + row)];
    return matrix;
  }
  glm::dmat4 matrix(1.0);
  if (node.rotation.size() == 4) {
    const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    matrix = glm::mat4_cast(q / glm::length(q));
  }
  if (node.scale.size() == 3)
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= node.scale[static_cast<std::size_t>(axis)];
  if (node.translation.size() == 3)
    matrix[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1.0);
  return matrix;
}

bool finite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(matrix[column][row])) return false;
  return true;
}

// Depth first; `visited` makes a node that is reached twice (glTF allows one parent) an error, so a cycle ends.
Status visit(const tinygltf::Model& model, int index, const glm::dmat4& world_from_parent,
             const std::string& parent_name, int depth, std::vector<bool>& visited, std::vector<MeshInstance>& out) {
  const std::string place = "node " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= model.nodes.size()) return bad(place, "does not exist");
  if (visited[static_cast<std::size_t>(index)]) return bad(place, "has two parents or is its own ancestor");
  if (depth > kMaxNesting) return bad(place, "is nested deeper than " + std::to_string(kMaxNesting));
  visited[static_cast<std::size_t>(index)] = true;

  const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
  const std::string& name = node.name.empty() ? parent_name : node.name;
  if (node.rotation.size() == 4 && std::ranges::all_of(node.rotation, [](double part) { return part == 0.0; }))
    return bad(place, "its rotation is 0, 0, 0, 0, which turns nowhere");
  const glm::dmat4 world_from_node = world_from_parent * local_transform(node);
  if (!finite(world_from_node)) return bad(place, "its transform is not finite");
  if (node.mesh >= 0) {
    if (static_cast<std::size_t>(node.mesh) >= model.meshes.size())
      return bad(place, "mesh " + std::to_string(node.mesh) + " does not exist");
    out.push_back(MeshInstance{name, index, node.mesh, world_from_node});
  }
  for (const int child : node.children)
    if (Status done = visit(model, child, world_from_node, name, depth + 1, visited, out); !done) return done;
  return Done{};
}

bool harmless_extension(const std::string& name) {
  return name.starts_with("KHR_materials_") || name.starts_with("KHR_texture_") || name == "KHR_lights_punctual";
}

}  // namespace

Result<tinygltf::Model> read_gltf(const std::filesystem::path& file) try {
  const std::string place = file.string();
  std::error_code code;
  if (!std::filesystem::exists(file, code)) return bad(place, "no such file");
  if (!std::filesystem::is_regular_file(file, code)) return bad(place, "is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, code);
  if (code) return bad(place, code.message());
  if (size > kMaxFileBytes) return bad(place, "is larger than 1 GiB");
  std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    return bad(place, "cannot be read");

  // GLB: 12 byte header, then a chunk of length, type and JSON; else the whole file is JSON.
  const bool binary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
  std::span<const unsigned char> json(bytes);
  if (binary) {
    if (bytes.size() < 20) return bad(place, "is cut off within its header");
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    if (length > bytes.size() - 20) return bad(place, "is cut off within its JSON chunk");
    json = json.subspan(20, length);
  }
  if (json_nesting(json) > kMaxNesting) return bad(place, "JSON is nested deeper than " + std::to_string(kMaxNesting));

  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(ignore_image, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const std::string directory = file.parent_path().string();
  const auto length = static_cast<unsigned int>(bytes.size());
  const bool loaded = binary
                          ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), length, directory)
                          : loader.LoadASCIIFromString(&model, &error, &warning,
                                                       reinterpret_cast<const char*>(bytes.data()), length, directory);
  if (!loaded) {
    while (!error.empty() && (error.back() == '\n' || error.back() == ' ')) error.pop_back();
    for (char& c : error)
      if (c == '\n') c = ' ';
    return bad(place, error.empty() ? "is not a glTF 2.0 file" : error);
  }
  for (const std::string& extension : model.extensionsRequired)
    if (!harmless_extension(extension))
      return bad(place, "requires the extension " + extension + ", which is not supported");
  return model;
} catch (const std::exception& problem) {  // out of memory, or a JSON type tinygltf did not expect
  return bad(file.string(), problem.what());
}

Result<std::vector<glm::vec3>> read_vec3(const tinygltf::Model& model, int accessor) {
  const Result<Elements> elements = elements_of(model, accessor, 3 * sizeof(float));
  if (!elements) return elements.error();
  const tinygltf::Accessor& described = model.accessors[static_cast<std::size_t>(accessor)];
  const std::string place = "accessor " + std::to_string(accessor);
  if (described.type != TINYGLTF_TYPE_VEC3 || described.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
    return bad(place, "expected VEC3 of float");
  std::vector<glm::vec3> out(elements->count);
  for (std::size_t i = 0; i < out.size(); ++i) {
    std::memcpy(&out[i], elements->first + i * elements->stride, 3 * sizeof(float));
    if (!std::isfinite(out[i].x) || !std::isfinite(out[i].y) || !std::isfinite(out[i].z))
      return bad(place, "element " + std::to_string(i) + " is not finite");
  }
  return out;
}

Result<std::vector<std::uint32_t>> read_indices(const tinygltf::Model& model, int accessor) {
  const std::string place = "accessor " + std::to_string(accessor);
  if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size()) return bad(place, "does not exist");
  const tinygltf::Accessor& described = model.accessors[static_cast<std::size_t>(accessor)];
  std::size_t width = 0;
  if (described.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) width = 1;
  if (described.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) width = 2;
  if (described.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) width = 4;
  if (width == 0 || described.type != TINYGLTF_TYPE_SCALAR) return bad(place, "expected unsigned SCALAR indices");
  const Result<Elements> elements = elements_of(model, accessor, width);
  if (!elements) return elements.error();
  std::vector<std::uint32_t> out(elements->count, 0);
  for (std::size_t i = 0; i < out.size(); ++i)
    std::memcpy(&out[i], elements->first + i * elements->stride, width);  // glTF and we are little-endian
  return out;
}

Result<std::vector<std::uint32_t>> read_triangles(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                                  std::size_t vertex_count) {
  const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
  if (mode < TINYGLTF_MODE_TRIANGLES) return std::vector<std::uint32_t>{};
  if (mode > TINYGLTF_MODE_TRIANGLE_FAN) return bad("primitive", "unknown mode " + std::to_string(mode));
  if (vertex_count > std::numeric_limits<std::uint32_t>::max()) return bad("primitive", "too many vertices");

  std::vector<std::uint32_t> list;
  if (primitive.indices >= 0) {
    Result<std::vector<std::uint32_t>> read = read_indices(model, primitive.indices);
    if (!read) return read.error();
    list = std::move(read.value());
  } else {
    list.resize(vertex_count);
    for (std::size_t i = 0; i < vertex_count; ++i) list[i] = static_cast<std::uint32_t>(i);
  }
  for (const std::uint32_t index : list)
    if (index >= vertex_count)
      return bad("accessor " + std::to_string(primitive.indices),
                 "index " + std::to_string(index) + " but only " + std::to_string(vertex_count) + " vertices");

  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (list.size() % 3 != 0) return bad("primitive", std::to_string(list.size()) + " indices are not whole triangles");
    return list;
  }
  std::vector<std::uint32_t> out;
  for (std::size_t i = 2; i < list.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      out.insert(out.end(), {list[i - 1], list[i], list[0]});
    } else {
      const bool odd = (i % 2) == 1;  // every second triangle of a strip is wound the other way
      out.insert(out.end(), {list[odd ? i - 1 : i - 2], list[odd ? i - 2 : i - 1], list[i]});
    }
  }
  return out;
}

Result<std::vector<MeshInstance>> mesh_instances(const tinygltf::Model& model) {
  std::vector<int> roots;
  if (!model.scenes.empty()) {
    const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
    if (static_cast<std::size_t>(scene) >= model.scenes.size())
      return bad("scene " + std::to_string(scene), "does not exist");
    roots = model.scenes[static_cast<std::size_t>(scene)].nodes;
  } else {
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
      for (const int child : node.children)
        if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
          is_child[static_cast<std::size_t>(child)] = true;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  std::vector<MeshInstance> out;
  std::vector<bool> visited(model.nodes.size(), false);
  for (const int root : roots)
    if (Status done = visit(model, root, world_from_gltf(), "", 0, visited, out); !done) return done.error();
  return out;
}

glm::dmat4 world_from_gltf() {
  // Columns: where glTF x, y and z point in our world.
  return glm::dmat4{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}};
}

}  // namespace phare
