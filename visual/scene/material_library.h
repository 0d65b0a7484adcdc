// Surfaces by name (config/materials/surfaces.toml): reflectance, detail and retroreflection, each with its source.
// For scenes that name one in their extras, and, by words in the names of materials, for scenes of others.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"
#include "visual/scene/scene.h"

namespace phare {

struct LibraryMaterial {
  std::string name;
  glm::vec3 reflectance{0.5f};  ///< diffuse rho, linear Rec. 709
  Surface surface = Surface::kPlain;
  Retroreflection retro{};
  bool r_table = false;  ///< asphalt, unless said otherwise (visual/scene/scene.h)
  std::vector<std::string> words{};  ///< lower case letters
  std::string source{};
  bool confirmed = true;
};

class MaterialLibrary {
 public:
  /// Error: file, line, reason.
  static Result<MaterialLibrary> read(const std::filesystem::path& file);
  /// That of this program.
  static Result<MaterialLibrary> read();

  /// Error: no such material, naming the nearest.
  Result<const LibraryMaterial*> named(const std::string& name) const;
  /// The first whose words fit a word of the material's name ("Road_01", "roadSurface"); nullptr: none.
  const LibraryMaterial* fitting(std::string_view material_name) const;
  const std::vector<LibraryMaterial>& all() const { return materials_; }

 private:
  std::vector<LibraryMaterial> materials_;
};

/// Error: unknown, naming those that are.
Result<Surface> surface_named(const std::string& name);

}  // namespace phare
