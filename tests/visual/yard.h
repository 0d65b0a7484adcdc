// What tests of pictures draw: a road with a wall, a car's two lamps, and a beam with a cut-off.
#pragma once

#include <algorithm>
#include <cmath>

#include "visual/photometry/beam/beam_image.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {

// An uneven grid with a cut-off: the intensity jumps by a factor of 30 within 0.2° at second angle `edge_deg`.
inline IntensityTable cut_off_table(PhotometricType type, GammaAxis axis) {
  IntensityTable table;
  table.type = type;
  table.axis = axis;
  const bool c = type == PhotometricType::kC;
  const double from = c ? 0.0 : -60.0, to = c ? 360.0 : 60.0;
  for (double a = from; a <= to + 1e-9; a += c ? 4.0 : (std::abs(a) < 5.0 ? 0.25 : 2.5)) table.first_deg.push_back(a);
  const bool gamma90 = c && axis == GammaAxis::kGamma90;
  for (double v = c ? (gamma90 ? 60.0 : 0.0) : -40.0; v <= (c ? (gamma90 ? 120.0 : 80.0) : 40.0) + 1e-9;
       v += 0.1 + 0.02 * std::abs(std::sin(v)))
    table.second_deg.push_back(v);
  for (double v : table.second_deg)
    for (double h : table.first_deg) {
      const double edge = 1.0 / (1.0 + std::exp((v - (gamma90 ? 90.0 : c ? 5.0 : -0.3)) / 0.06));
      table.candela.push_back(300.0 + 20000.0 * edge * (1.2 + std::cos(h * 0.05)));
    }
  return table;
}

inline BeamImage image_of(const IntensityTable& table) {
  const AimedSource source{.table = &table};
  return compose_beam_image(std::span(&source, 1));
}

// A road 60 m long and a wall at 25 m; two lamps as on a car.
inline Scene yard() {
  Scene scene;
  scene.materials = {{.name = "road", .reflectance = glm::vec3(0.1f), .surface = Surface::kAsphalt},
                     {.name = "wall", .reflectance = glm::vec3(0.6f)}};
  auto quad = [&](const char* node, std::uint32_t material, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    SceneChunk chunk{.node = node, .material = material, .origin_m = {}, .low_m = {}, .high_m = {}};
    chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
    chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
    for (const glm::vec3& p : {corner, corner + u, corner + u + v, corner + v}) scene.vertices.push_back({p, normal});
    for (std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(i);
    chunk.index_count = 6;
    chunk.vertex_count = 4;
    chunk.low_m = glm::dvec3(glm::min(corner, corner + u + v));
    chunk.high_m = glm::dvec3(glm::max(corner, corner + u + v));
    scene.chunks.push_back(chunk);
  };
  quad("road", 0, {-5, -10, 0}, {65, 0, 0}, {0, 20, 0});
  quad("wall", 1, {25, 0, 0}, {0, -4, 0}, {0, 0, 4});
  return scene;
}

inline FrameInput driver_view() {
  FrameInput input;
  input.camera.eye_m = {-1.5, 0.37, 1.22};
  input.lamps = {{.position_m = {0, 0.6, 0.65}, .world_from_image = aim_rotation(0, -0.01, 0)},
                 {.position_m = {0, -0.6, 0.65}, .world_from_image = aim_rotation(0, -0.01, 0)}};
  return input;
}

/// A black wall across x, seen from the eye, so that all light in the picture is the air's.
inline Scene black_wall(double x_m) {
  Scene scene;
  scene.materials = {{.name = "black", .reflectance = {0.0, 0.0, 0.0}, .double_sided = true}};
  for (const auto& [y, z] :
       {std::pair(-200.0, -200.0), std::pair(200.0, -200.0), std::pair(200.0, 200.0), std::pair(-200.0, 200.0)})
    scene.vertices.push_back({glm::vec3(x_m, y, z), glm::vec3(-1, 0, 0)});
  scene.indices = {0, 2, 1, 0, 3, 2};
  scene.chunks = {
      {.node = "wall", .low_m = {x_m, -200, -200}, .high_m = {x_m, 200, 200}, .index_count = 6, .vertex_count = 4}};
  return scene;
}

}  // namespace phare
