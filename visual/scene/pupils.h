// Pupils of animals in the world: what of a mesh has a material whose `retro` is "tapetum lucidum", piece by piece.
// Checked by tests/visual/eyeshine_test.cpp.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "visual/scene/world.h"

namespace phare {

struct Pupil {
  glm::dvec3 place_m{0.0};            ///< middle
  glm::dvec3 normal{1.0, 0.0, 0.0};   ///< unit, the way it looks
  double area_m2 = 0.0;               ///< seen from there
  const SceneMaterial* of = nullptr;  ///< lives as long as the scene
};

/// Of what stands and of what moves; both scenes outlive it.
class Pupils {
 public:
  Pupils(const Scene& standing, const Scene& meshes);

  bool none() const { return standing_.empty() && in_mesh_.empty(); }
  /// In the world as it is now.
  std::vector<Pupil> in(const World& world) const;

 private:
  struct InMesh {
    std::size_t mesh = 0;
    Pupil pupil;
  };
  std::vector<Pupil> standing_;
  std::vector<InMesh> in_mesh_;
};

}  // namespace phare
