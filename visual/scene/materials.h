// Materials of a glTF file: its own numbers and pictures, what its extras say, and what the library knows by name.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <map>
#include <string>
#include <vector>

#include "config/formats/gltf_file.h"
#include "visual/scene/material_library.h"
#include "visual/scene/scene.h"

namespace phare {

/// What of a file is not drawn as it says: a line for each reason, however many materials it is true of.
class SceneNotes {
 public:
  void add(const std::string& reason, const std::string& what);
  /// "normal textures are not drawn: 'bark', 'stone' and 3 more"
  std::vector<std::string> lines() const;

 private:
  std::map<std::string, std::vector<std::string>> of_;
};

/// A material, and which texture coordinates its textures are laid by.
struct ReadMaterial {
  SceneMaterial material;
  int uv_set = 0;                 ///< TEXCOORD_n
  glm::dmat3 uv_from_file{1.0};  ///< KHR_texture_transform
};

class MaterialReader {
 public:
  /// Both outlive it. Textures go into `scene`, `notes` says what is not drawn.
  MaterialReader(const tinygltf::Model& model, const std::filesystem::path& file, const MaterialLibrary& library,
                 Scene& scene, SceneNotes& notes)
      : model_(model), folder_(file.parent_path()), library_(library), scene_(scene), notes_(notes) {}

  /// Error: the material and what is wrong with it.
  Result<ReadMaterial> read(const tinygltf::Material& source);

 private:
  Status read_extras(const tinygltf::Material& source, ReadMaterial& read);
  void read_look(const tinygltf::Material& source, ReadMaterial& read);
  void read_relief(const tinygltf::Material& source, ReadMaterial& read);
  void note_what_is_left_out(const tinygltf::Material& source);
  /// Nothing: there is none, or it cannot be had, which is noted.
  template <typename Info>
  std::optional<std::size_t> texture_of(const Info& info, const std::string& material, TextureSampler& sampler);
  std::optional<std::size_t> image_of(int image);

  const tinygltf::Model& model_;
  std::filesystem::path folder_;
  const MaterialLibrary& library_;
  Scene& scene_;
  SceneNotes& notes_;
  std::map<int, std::optional<std::size_t>> images_;  ///< of the file, where they lie among the scene's textures
};

/// Extensions, animations and the like of the file as a whole.
void note_what_is_not_read(const tinygltf::Model& model, SceneNotes& notes);

}  // namespace phare
