// URIs of glTF files (glTF 2.0, 2.8): paths beside the file, with escapes, or the data themselves.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace phare {

bool is_data_uri(const std::string& uri);

/// Escapes like %20 undone; others stay as they are.
std::string decoded_uri(const std::string& uri);

/// Of base64. Nothing: it is none.
std::optional<std::vector<unsigned char>> bytes_of_data_uri(const std::string& uri);

}  // namespace phare
