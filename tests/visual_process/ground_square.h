// A scene of one square of ground, 200 m wide and level, at z = 2 m.
#pragma once

#include <string>

#include "visual/scene/scene.h"

namespace phare {

/// About (x_m, 0, 2), as a node of this name.
inline Scene ground_square(double x_m, const std::string& node = "") {
  Scene scene;
  scene.materials.resize(1);
  for (const glm::vec3 corner : {glm::vec3{-100, -100, 0}, {100, -100, 0}, {100, 100, 0}, {-100, 100, 0}})
    scene.vertices.push_back({corner, {0, 0, 1}});
  scene.indices = {0, 1, 2, 0, 2, 3};
  SceneChunk chunk;
  chunk.node = node;
  chunk.origin_m = {x_m, 0.0, 2.0};
  chunk.low_m = {x_m - 100.0, -100.0, 2.0};
  chunk.high_m = {x_m + 100.0, 100.0, 2.0};
  chunk.index_count = 6;
  chunk.vertex_count = 4;
  scene.chunks.push_back(chunk);
  return scene;
}

}  // namespace phare
