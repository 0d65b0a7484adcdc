#include "config/formats/gltf_meshopt.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace phare {
namespace {

/// A packed file may say that it is much more: this much is taken for an error.
constexpr std::size_t kMostUnpacked = std::size_t{1} << 30;

std::size_t number_of(const tinygltf::Value& object, const char* key) {
  if (!object.Has(key) || !object.Get(key).IsNumber()) return 0;
  const double value = object.Get(key).GetNumberAsDouble();
  return value > 0.0 && value < 4e9 ? static_cast<std::size_t>(value) : 0;
}

std::string text_of(const tinygltf::Value& object, const char* key, const char* otherwise) {
  return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : otherwise;
}

void put_word(std::vector<unsigned char>& into, std::size_t at, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  std::memcpy(&into[at], &word, 4);
}

struct Packed {
  std::span<const unsigned char> bytes;
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
};

/// What is wrong with it; empty: nothing.
std::string wrong_with(const Packed& packed, std::size_t view_bytes) {
  const bool attributes = packed.mode == "ATTRIBUTES";
  if (!attributes && packed.mode != "TRIANGLES" && packed.mode != "INDICES") return "unknown mode " + packed.mode;
  if (packed.count == 0 || packed.stride == 0 || packed.count > kMostUnpacked / packed.stride)
    return "has no elements, or more than a GiB of them";
  if (packed.count * packed.stride != view_bytes) return "its elements are not as long as the view";
  if (attributes && (packed.stride % 4 != 0 || packed.stride > 256))
    return "its byteStride is no multiple of 4 to 256";
  if (!attributes && packed.stride != 2 && packed.stride != 4) return "its indices are neither 2 nor 4 bytes long";
  if (packed.mode == "TRIANGLES" && packed.count % 3 != 0) return "its indices are not whole triangles";
  if (packed.filter == "NONE") return "";
  if (!attributes) return "filter " + packed.filter + " of what are no attributes";
  if (packed.filter == "OCTAHEDRAL")
    return packed.stride == 4 || packed.stride == 8 ? "" : "its filter needs 4 or 8 bytes";
  if (packed.filter == "QUATERNION") return packed.stride == 8 ? "" : "its filter needs 8 bytes";
  return packed.filter == "EXPONENTIAL" ? "" : "unknown filter " + packed.filter;
}

bool unpack(const Packed& packed, std::vector<unsigned char>& out) {
  out.resize(packed.count * packed.stride);
  const auto* bytes = packed.bytes.data();
  const std::size_t size = packed.bytes.size();
  if (packed.mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(out.data(), packed.count, packed.stride, bytes, size) == 0;
  if (packed.mode == "INDICES")
    return meshopt_decodeIndexSequence(out.data(), packed.count, packed.stride, bytes, size) == 0;
  if (meshopt_decodeVertexBuffer(out.data(), packed.count, packed.stride, bytes, size) != 0) return false;
  if (packed.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), packed.count, packed.stride);
  if (packed.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), packed.count, packed.stride);
  if (packed.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), packed.count, packed.stride);
  return true;
}

}  // namespace

Status stand_in_for_what_is_left_out(std::vector<unsigned char>& file, bool glb) {
  std::size_t begin = 0, length = file.size();
  if (glb) {
    std::uint32_t word = 0;
    std::memcpy(&word, file.data() + 12, 4);
    begin = 20, length = word;
  }
  const std::string_view text(reinterpret_cast<const char*>(file.data()) + begin, length);
  if (text.find(kMeshoptExtension) == std::string_view::npos && text.find("KHR_lights_punctual") == text.npos)
    return Done{};
  nlohmann::json root = nlohmann::json::parse(text, nullptr, false);
  if (root.is_discarded() || !root.is_object()) return Done{};  // tinygltf says what is wrong with it
  bool changed = false;
  if (const auto buffers = root.find("buffers"); buffers != root.end() && buffers->is_array())
    for (nlohmann::json& buffer : *buffers) {
      if (!buffer.is_object() || buffer.contains("uri")) continue;
      const nlohmann::json extension =
          buffer.value("extensions", nlohmann::json::object()).value(kMeshoptExtension, nlohmann::json::object());
      if (!extension.is_object() || !extension.value("fallback", false)) continue;
      buffer["uri"] = "data:application/octet-stream;base64,AA==";
      buffer["byteLength"] = 1;
      changed = true;
    }
  const nlohmann::json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
  if (root.contains(lights) && root[lights].is_array())
    for (nlohmann::json& light : root[lights]) {
      const bool spot = light.is_object() && light.contains("type") && light["type"] == "spot";
      if (!spot || light.contains("spot")) continue;
      light["spot"] = nlohmann::json::object();
      changed = true;
    }
  if (!changed) return Done{};
  std::string json = root.dump();
  if (!glb) {
    file.assign(json.begin(), json.end());
    return Done{};
  }
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::vector<unsigned char> whole(20);
  std::memcpy(whole.data(), file.data(), 20);
  whole.insert(whole.end(), json.begin(), json.end());
  whole.insert(whole.end(), file.begin() + static_cast<std::ptrdiff_t>(begin + length), file.end());
  put_word(whole, 8, whole.size());
  put_word(whole, 12, json.size());
  file = std::move(whole);
  return Done{};
}

Status unpack_meshopt(tinygltf::Model& model) {
  std::size_t unpacked = 0;
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    tinygltf::BufferView& view = model.bufferViews[i];
    const auto extension = view.extensions.find(kMeshoptExtension);
    if (extension == view.extensions.end()) continue;
    const auto bad = [i](const std::string& reason) {
      return Error{"bufferView " + std::to_string(i), std::string(kMeshoptExtension) + ": " + reason};
    };
    const tinygltf::Value& object = extension->second;
    if (!object.IsObject()) return bad("is not an object");
    const bool named = object.Has("buffer") && object.Get("buffer").IsInt();
    const int buffer = named ? object.Get("buffer").GetNumberAsInt() : -1;
    if (buffer < 0 || static_cast<std::size_t>(buffer) >= model.buffers.size())
      return bad("buffer " + std::to_string(buffer) + " does not exist");
    const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(buffer)].data;
    const std::size_t offset = number_of(object, "byteOffset"), length = number_of(object, "byteLength");
    if (offset > data.size() || length > data.size() - offset)
      return bad("reaches beyond the buffer of " + std::to_string(data.size()) + " bytes");
    const Packed packed{std::span(data).subspan(offset, length), number_of(object, "count"),
                        number_of(object, "byteStride"), text_of(object, "mode", "(none)"),
                        text_of(object, "filter", "NONE")};
    if (const std::string reason = wrong_with(packed, view.byteLength); !reason.empty()) return bad(reason);
    unpacked += view.byteLength;
    if (unpacked > kMostUnpacked) return bad("the file unpacks to more than a GiB");
    tinygltf::Buffer own;
    if (!unpack(packed, own.data)) return bad("its bytes are not what meshoptimizer packs");
    view.buffer = static_cast<int>(model.buffers.size());
    view.byteOffset = 0;
    model.buffers.push_back(std::move(own));
  }
  return Done{};
}

}  // namespace phare
