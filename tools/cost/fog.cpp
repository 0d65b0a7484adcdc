#include "tools/cost/fog.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/table/fog.h"
#include "visual/scene/scene.h"

namespace phare::cost {
namespace {

constexpr double kWall_m = 40.0;

Scene black_wall() {
  Scene scene;
  scene.materials = {{.name = "black", .reflectance = {0.0, 0.0, 0.0}, .double_sided = true}};
  for (const auto& [y, z] :
       {std::pair(-200.0, -200.0), std::pair(200.0, -200.0), std::pair(200.0, 200.0), std::pair(-200.0, 200.0)})
    scene.vertices.push_back({glm::vec3(kWall_m, y, z), glm::vec3(-1, 0, 0)});
  scene.indices = {0, 2, 1, 0, 3, 2};
  scene.chunks = {{.node = "wall",
                   .low_m = {kWall_m, -200, -200},
                   .high_m = {kWall_m, 200, 200},
                   .index_count = 6,
                   .vertex_count = 4}};
  return scene;
}

}  // namespace

std::vector<FogErrors> fog_errors(Renderer& renderer, const IntensityTable& table, const Air& air, PictureSize size,
                                  int step_px) {
  std::vector<FogErrors> errors;
  if (!renderer.load_scene(black_wall())) return errors;
  const AimedSource source{.table = &table};
  renderer.set_beam(0, compose_beam_image(std::span(&source, 1)));
  FrameInput input;
  input.camera.eye_m = {-1.9, 0.37, 1.22};
  for (const double y_m : {0.6, -0.6})
    input.lamps.push_back({.position_m = {0.0, y_m, 0.65}, .world_from_image = aim_rotation(0.0, -0.01, 0.0)});
  input.sky_luminance_cdm2 = 0.0;
  input.air = air;
  input.want_hdr = true;
  std::vector<PlacedSource> lamps;
  for (const PlacedLamp& lamp : input.lamps) lamps.push_back({&table, lamp.position_m, lamp.world_from_image});

  struct Pixel {
    std::size_t at;
    double exact_cdm2;
  };
  std::vector<Pixel> pixels;
  double brightest_cdm2 = 0.0, sum_cdm2 = 0.0;
  const ViewGeometry view(input.camera, double{1} * size.width_px / size.height_px);
  for (int y = step_px / 3; y < size.height_px; y += step_px)
    for (int x = step_px / 2; x < size.width_px; x += step_px) {
      const Ray ray = view.ray_through(x, y, size.width_px, size.height_px);
      double aside_m = HUGE_VAL;
      for (const PlacedLamp& lamp : input.lamps)
        aside_m = std::min(aside_m, glm::length(glm::cross(lamp.position_m - ray.origin_m, ray.direction)));
      if (aside_m < 0.5) continue;  // beside a lamp itself; between such rays no grid has what is there
      const double length_m = (kWall_m - input.camera.eye_m.x) / ray.direction.x;
      const double exact = airlight_cdm2(lamps, air, ray.origin_m, ray.direction, length_m);
      pixels.push_back(
          {static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width_px) + static_cast<std::size_t>(x), exact});
      brightest_cdm2 = std::max(brightest_cdm2, exact);
      sum_cdm2 += exact;
    }
  const EffectRow& row = effect_table()[static_cast<std::size_t>(Effect::kFog)];
  for (std::size_t level = 0; level < row.levels.size(); ++level) {
    FogErrors& of_level = errors.emplace_back();
    ImageF image;
    if (level > 0) {
      input.effects[static_cast<std::size_t>(Effect::kFog)] = level;
      renderer.draw(input);
      image = renderer.read_hdr();
    }
    double off_cdm2 = 0.0;
    for (const Pixel& pixel : pixels) {
      // Without the effect the air adds nothing.
      const float* rgb = level == 0 ? nullptr : &image.rgba[4 * pixel.at];
      const double found = rgb == nullptr
                               ? 0.0
                               : 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
                                     0.0722 * static_cast<double>(rgb[2]);
      off_cdm2 += std::abs(found - pixel.exact_cdm2);
      if (pixel.exact_cdm2 >= 0.01 * brightest_cdm2) of_level.differences.push_back(found / pixel.exact_cdm2 - 1.0);
    }
    of_level.misplaced = sum_cdm2 > 0.0 ? off_cdm2 / sum_cdm2 : 0.0;
  }
  return errors;
}

}  // namespace phare::cost
