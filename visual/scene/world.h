// What light and looks meet on their way: a scene, and what moves through it, where it is now.
#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "visual/scene/scene.h"

namespace phare {

/// Something that moves, this frame.
struct PlacedMesh {
  std::size_t mesh = 0;  ///< which node of the scene of what moves, counted in the order of its chunks
  glm::dvec3 position_m{0.0};
  glm::dmat3 world_from_mesh{1.0};
};

/// Of each node of a scene, in their order, which chunks are its own.
std::vector<std::vector<std::size_t>> chunks_by_node(const Scene& scene);

/// Both scenes outlive it.
class World {
 public:
  /// Nothing moves. Implicit: a scene is a world.
  World(const Scene& standing) : standing_(&standing) {}
  World(const Scene& standing, const Scene& meshes)
      : standing_(&standing), meshes_(&meshes), nodes_(chunks_by_node(meshes)) {}

  void move(std::vector<PlacedMesh> moving) { moving_ = std::move(moving); }
  /// Without one of what moves: what a lamp on it, or an eye in it, has around it.
  World without(std::size_t moving) const;

  const Scene& standing() const { return *standing_; }
  const std::vector<PlacedMesh>& moving() const { return moving_; }
  const Scene* meshes() const { return meshes_; }  ///< null: nothing can move
  const std::vector<std::size_t>& chunks_of(const PlacedMesh& placed) const { return nodes_[placed.mesh]; }

 private:
  const Scene* standing_;
  const Scene* meshes_ = nullptr;
  std::vector<std::vector<std::size_t>> nodes_;
  std::vector<PlacedMesh> moving_;
};

}  // namespace phare
