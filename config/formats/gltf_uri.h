// URIs of glTF files (glTF 2.0, 2.8): paths beside the file, with escapes, or the data themselves; and which files a
// scene is made of.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

bool is_data_uri(const std::string& uri);

/// Escapes like %20 undone; others stay as they are.
std::string decoded_uri(const std::string& uri);

/// Of base64. Nothing: it is none.
std::optional<std::vector<unsigned char>> bytes_of_data_uri(const std::string& uri);

/// What a .gltf or .glb names beside itself: buffers, images, photometry (EXT_lights_ies), as paths from its folder,
/// each once, in the file's order. Of a file that is none there is nothing.
std::vector<std::filesystem::path> files_beside(const std::filesystem::path& gltf);

/// Of its JSON the buffers alone.
std::vector<std::filesystem::path> buffers_beside(const nlohmann::json& root);

/// Of the file where it names none (as `sha256sum` says), else of it and of all of those, by name; a picture or
/// photometry that is not there counts as not there. Error: a file that cannot be read, a buffer that is not there.
Result<std::string> content_hash_of_gltf(const std::filesystem::path& gltf);

}  // namespace phare
