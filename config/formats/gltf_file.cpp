// The one place where tinygltf is compiled.
#define TINYGLTF_IMPLEMENTATION
#include "config/formats/gltf_file.h"
#undef TINYGLTF_IMPLEMENTATION

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <span>
#include <utility>

#include "config/base/input_files.h"
#include "config/formats/gltf_meshopt.h"
#include "config/formats/gltf_shapes.h"

namespace phare {
namespace {

// Deeper than any real file; guards the recursion of the parser and of our own walk over the nodes.
constexpr int kMaxNesting = 128;
constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30;

Error bad(std::string place, std::string reason) {
  return Error{std::move(place), std::move(reason)};
}

// Images are not decoded here. Where they are wanted, those that the JSON itself holds are kept as they come; of others
// the model says where they lie.
bool keep_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                int size, void* wanted) {
  if (wanted != nullptr && image->bufferView < 0) image->image.assign(bytes, bytes + size);
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
             const std::string& parent_name, int depth, std::vector<bool>& visited, std::vector<NodeInstance>& out) {
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
  if (node.mesh >= 0 && static_cast<std::size_t>(node.mesh) >= model.meshes.size())
    return bad(place, "mesh " + std::to_string(node.mesh) + " does not exist");
  out.push_back({name, index, world_from_node});
  for (const int child : node.children)
    if (Status done = visit(model, child, world_from_node, name, depth + 1, visited, out); !done) return done;
  return Done{};
}

// Without them the triangles are the same: what of them is not drawn is named (visual/scene/scene.h).
bool of_looks_only(const std::string& name) {
  return name.starts_with("KHR_materials_") || name.starts_with("KHR_texture_") || name == "EXT_texture_webp" ||
         name == "KHR_lights_punctual" || name == "EXT_lights_ies";
}

/// nlohmann-json's words begin with a name of its exception that says nothing to a reader: "[json.exception.…] ".
std::string without_exception(std::string words) {
  if (words.starts_with("[json.exception.")) words.erase(0, words.find(']') + 1);
  return words.substr(std::min(words.find_first_not_of(' '), words.size()));
}

bool is_read(const std::string& name) {
  return of_looks_only(name) || name == "KHR_mesh_quantization" || name == kMeshoptExtension;
}

}  // namespace

Result<tinygltf::Model> read_gltf(const std::filesystem::path& file, GltfImages images) try {
  const std::string place = file.string();
  if (const std::string why = why_no_file(file); !why.empty()) return bad(place, why);
  std::error_code code;
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
    std::uint32_t version = 0, whole = 0, length = 0;
    std::memcpy(&version, bytes.data() + 4, 4);
    std::memcpy(&whole, bytes.data() + 8, 4);
    std::memcpy(&length, bytes.data() + 12, 4);
    if (version != 2) return bad(place, "is a GLB of version " + std::to_string(version) + "; version 2 is read");
    if (whole > bytes.size())
      return bad(place, "is cut off: its header says " + std::to_string(whole) + " bytes, there are " +
                            std::to_string(bytes.size()));
    if (std::memcmp(bytes.data() + 16, "JSON", 4) != 0) return bad(place, "its first chunk is not JSON");
    if (length > bytes.size() - 20) return bad(place, "is cut off within its JSON chunk");
    if (whole < 20 || length > whole - 20)
      return bad(place, "its header says " + std::to_string(whole) + " bytes, of which its JSON chunk alone takes " +
                            std::to_string(std::uint64_t{20} + length));
    json = json.subspan(20, length);
  }
  if (json_nesting(json) > kMaxNesting) return bad(place, "JSON is nested deeper than " + std::to_string(kMaxNesting));

  if (json.empty()) return bad(place, "is empty");
  const std::string_view text(reinterpret_cast<const char*>(json.data()), json.size());
  if (Status fit = check_gltf_shapes(text, file.parent_path()); !fit) return bad(place, fit.error().text());

  if (Status done = stand_in_for_what_is_left_out(bytes, binary); !done) return bad(place, done.error().text());

  tinygltf::TinyGLTF loader;
  bool wanted = true;
  loader.SetImageLoader(keep_image, images == GltfImages::kKeep ? &wanted : nullptr);
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
    return bad(place, "is not a glTF 2.0 file" + (error.empty() ? error : ": " + without_exception(error)));
  }
  for (const std::string& extension : model.extensionsRequired)
    if (!is_read(extension)) return bad(place, "requires the extension " + extension + ", which is not supported");
  if (Status done = unpack_meshopt(model); !done) return bad(place, done.error().text());
  return model;
} catch (const std::exception& problem) {  // out of memory, or a JSON type tinygltf did not expect
  return bad(file.string(), without_exception(problem.what()));
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

Result<std::vector<NodeInstance>> node_instances(const tinygltf::Model& model) {
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
  std::vector<NodeInstance> out;
  std::vector<bool> visited(model.nodes.size(), false);
  for (const int root : roots)
    if (Status done = visit(model, root, world_from_gltf(), "", 0, visited, out); !done) return done.error();
  return out;
}

Result<std::vector<MeshInstance>> mesh_instances(const tinygltf::Model& model) {
  Result<std::vector<NodeInstance>> nodes = node_instances(model);
  if (!nodes) return nodes.error();
  std::vector<MeshInstance> out;
  for (const NodeInstance& node : *nodes)
    if (const int mesh = model.nodes[static_cast<std::size_t>(node.node)].mesh; mesh >= 0)
      out.push_back({node.name, node.node, mesh, node.world_from_node});
  return out;
}

glm::dmat4 world_from_gltf() {
  // Columns: where glTF x, y and z point in our world.
  return glm::dmat4{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}};
}

}  // namespace phare
