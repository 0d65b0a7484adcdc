// Where the letters of text in the window lie.
#pragma once

#include <filesystem>
#include <string>

namespace phare {

/// A font of fonts-dejavu-core (packages.txt); empty: it is not installed, and Dear ImGui's own letters do.
inline std::string letters_file(const std::string& name) {
  const std::string path = "/usr/share/fonts/truetype/dejavu/" + name;
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) ? path : std::string();
}

}  // namespace phare
