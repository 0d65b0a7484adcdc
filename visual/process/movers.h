// Meshes of what moves through a scene, each about its own origin: bodies of road users, one of which is the car's own,
// and the wall of the camera "wall" (tools/scene/road_users.cpp).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"
#include "visual/scene/scene.h"

namespace phare {

class Movers {
 public:
  /// As they are generated. Error: the file cannot be read.
  static Result<Movers> read();

  const Scene& meshes() const { return meshes_; }  ///< for Renderer::load_scene and World
  /// Which mesh has this name (PlacedMesh::mesh). Error: none has, and the file.
  Result<std::size_t> mesh(std::string_view name) const;

 private:
  Scene meshes_;
  std::vector<std::string> names_;  ///< as they are counted
};

}  // namespace phare
