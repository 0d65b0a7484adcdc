#include "config/formats/gltf_uri.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>

#include "config/base/content_hash.h"

namespace phare {
namespace {

using Json = nlohmann::json;

/// The file's JSON, of a .glb its first chunk; discarded where it is none.
Json json_of_gltf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 20> head{};
  stream.read(head.data(), head.size());
  if (stream.gcount() == head.size() && std::memcmp(head.data(), "glTF", 4) == 0) {
    std::uint32_t length = 0;
    std::memcpy(&length, head.data() + 12, 4);
    std::error_code failed;
    if (length > std::filesystem::file_size(file, failed) || failed) return Json(Json::value_t::discarded);
    std::string text(length, ' ');
    stream.read(text.data(), length);
    return Json::parse(text, nullptr, false);
  }
  stream.clear();
  stream.seekg(0);
  return Json::parse(stream, nullptr, false);
}

constexpr const char* kBuffers = "/buffers";

/// What entries of a list name by uri, each once.
void add_files(const Json& root, const char* list, std::vector<std::filesystem::path>& files) {
  const Json::json_pointer at(list);
  if (!root.is_object() || !root.contains(at) || !root[at].is_array()) return;
  for (const Json& one : root[at]) {
    if (!one.is_object() || !one.contains("uri") || !one["uri"].is_string()) continue;
    const std::string uri = one["uri"].get<std::string>();
    if (uri.empty() || is_data_uri(uri)) continue;
    const std::filesystem::path file = decoded_uri(uri);
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  }
}

std::vector<std::filesystem::path> files_of(const Json& root) {
  std::vector<std::filesystem::path> files;
  for (const char* list : {kBuffers, "/images", "/extensions/EXT_lights_ies/lights"}) add_files(root, list, files);
  return files;
}

}  // namespace

bool is_data_uri(const std::string& uri) {
  return uri.starts_with("data:");
}

std::string decoded_uri(const std::string& uri) {
  const auto is_digit = [&](std::size_t i) { return std::isxdigit(static_cast<unsigned char>(uri[i])) != 0; };
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() && is_digit(i + 1) && is_digit(i + 2);
    out += escape ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (escape) i += 2;
  }
  return out;
}

std::optional<std::vector<unsigned char>> bytes_of_data_uri(const std::string& uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos || !uri.substr(0, comma).ends_with(";base64")) return std::nullopt;
  // Of tinygltf's own media types, which are all that it undoes.
  std::vector<unsigned char> bytes;
  std::string media_type;
  if (!tinygltf::DecodeDataURI(&bytes, media_type,
                               "data:application/octet-stream;base64" + uri.substr(comma), 0, false))
    return std::nullopt;
  return bytes;
}

std::vector<std::filesystem::path> files_beside(const std::filesystem::path& gltf) {
  return files_of(json_of_gltf(gltf));
}

std::vector<std::filesystem::path> buffers_beside(const Json& root) {
  std::vector<std::filesystem::path> files;
  add_files(root, kBuffers, files);
  return files;
}

Result<std::string> content_hash_of_gltf(const std::filesystem::path& gltf) {
  Result<std::string> own = content_hash_of_file(gltf);
  if (!own) return own;
  const Json root = json_of_gltf(gltf);
  const std::vector<std::filesystem::path> beside = files_of(root);
  if (beside.empty()) return own;
  std::vector<std::filesystem::path> buffers;
  add_files(root, kBuffers, buffers);
  std::string all = *own;
  for (const std::filesystem::path& file : beside) {
    std::error_code failed;
    const std::filesystem::path whole = gltf.parent_path() / file;
    std::string hash = "none";
    if (std::filesystem::is_regular_file(whole, failed) || std::ranges::find(buffers, file) != buffers.end()) {
      Result<std::string> of_file = content_hash_of_file(whole);
      if (!of_file) return of_file;
      hash = *of_file;
    }
    all += "\n" + file.generic_string() + " " + hash;
  }
  return content_hash(std::as_bytes(std::span(all)));
}

}  // namespace phare
