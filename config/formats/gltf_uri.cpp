#include "config/formats/gltf_uri.h"

#include <tiny_gltf.h>

#include <cctype>

namespace phare {

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

}  // namespace phare
