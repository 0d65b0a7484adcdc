// What tests of fog on the device share: two low beams in fog, and each ray of a picture held to float64.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/passes/fog.h"
#include "visual/photometry/table/fog.h"

namespace phare {

inline std::size_t fog() {
  return static_cast<std::size_t>(Effect::kFog);
}

/// Half of a headlamp's lens: rays nearer to its middle end at it.
inline constexpr double kLens_m = 0.05;

class FogOnDevice : public SharedRenderer {
 protected:
  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer == nullptr) return;
    table_ = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
    renderer->set_beam(0, image_of(table_));
  }

  /// Two low beams ahead of a driver, in fog.
  static FrameInput foggy(double visibility_m) {
    FrameInput input;
    input.camera.eye_m = {-1.9, 0.3, 1.22};
    for (const double y_m : {0.6, -0.6})
      input.lamps.push_back({.position_m = {0.0, y_m, 0.65}, .world_from_image = aim_rotation(0.0, -0.01, 0.0)});
    input.sky_luminance_cdm2 = 0.0;
    input.air.visibility_m = visibility_m;
    input.want_hdr = true;
    return input;
  }
  std::vector<PlacedSource> sources(const FrameInput& input) const {
    std::vector<PlacedSource> placed;
    for (const PlacedLamp& lamp : input.lamps) placed.push_back({&table_, lamp.position_m, lamp.world_from_image});
    return placed;
  }

  /// Float64: what each lamp gives along the way, less what it would give within its car's body, seen from behind.
  static double expected_cdm2(const FrameInput& input, const std::vector<PlacedSource>& sources, const phare::Ray& ray,
                              double length_m) {
    double sum = 0.0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const auto to = [&](double way_m) {
        return airlight_cdm2(std::span(&sources[i], 1), input.air, ray.origin_m, ray.direction, way_m);
      };
      sum += to(length_m);
      const glm::dvec3 lamp = input.lamps[i].position_m - ray.origin_m;
      const double along_m = glm::dot(lamp, ray.direction), aside_m = glm::length(glm::cross(lamp, ray.direction));
      const double body_m = input.lamps[i].body_m;
      if (aside_m >= body_m || glm::dot(lamp, input.lamps[i].world_from_image[0]) <= 0.0) continue;
      const double half_m = std::sqrt(body_m * body_m - aside_m * aside_m);
      sum -= to(along_m + half_m) - to(along_m - half_m);
    }
    return sum;
  }

  /// Of rays through the middle of pixels of a black wall across x, the worst and the 95 % relative difference from
  /// float64. Of rays with less than a hundredth of the brightest nobody sees the difference.
  std::array<double, 3> off(const FrameInput& input, double wall_x_m) {
    EXPECT_TRUE(renderer->load_scene(black_wall(wall_x_m)).ok());
    renderer->draw(input);
    const ImageF image = renderer->read_hdr();
    const ViewGeometry view(input.camera, double{1} * image.width_px / image.height_px);
    const std::vector<PlacedSource> lamps = sources(input);
    struct Ray {
      double expected, found, aside_m;
      int x, y;
    };
    std::vector<Ray> rays;
    for (int y = 3; y < image.height_px; y += 10)
      for (int x = 2; x < image.width_px; x += 13) {
        const phare::Ray ray = view.ray_through(x, y, image.width_px, image.height_px);
        const double length_m = (wall_x_m - input.camera.eye_m.x) / ray.direction.x;
        const double expected = expected_cdm2(input, lamps, ray, length_m);
        const float* rgb = &image.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
                                            static_cast<std::size_t>(x))];
        const double found = 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
                             0.0722 * static_cast<double>(rgb[2]);
        double aside_m = 1e9;
        for (const PlacedLamp& lamp : input.lamps)
          aside_m = std::min(aside_m, glm::length(glm::cross(lamp.position_m - ray.origin_m, ray.direction)));
        rays.push_back({expected, found, aside_m, x, y});
      }
    const auto brightest_of = [](const std::vector<Ray>& all) {
      double most = 0.0;
      for (const Ray& ray : all)
        if (ray.aside_m >= 0.5) most = std::max(most, ray.expected);
      return most;
    };
    const double brightest = brightest_of(rays);
    std::vector<double> offs, beside;
    const Ray* worst = &rays.front();
    double worst_off = 0.0;
    for (const Ray& ray : rays) {
      if (ray.expected < 0.01 * brightest || ray.aside_m < kLens_m) continue;
      if (ray.aside_m < 0.5) {
        beside.push_back(std::abs(ray.found / ray.expected - 1.0));
        continue;
      }
      offs.push_back(std::abs(ray.found / ray.expected - 1.0));
      if (offs.back() > worst_off) worst_off = offs.back(), worst = &ray;
    }
    std::ranges::sort(offs);
    const double most = offs[offs.size() * 95 / 100];
    std::printf(
        "visibility %g m, wall at %g m: %zu rays, worst %.2g (%d, %d: %.3g, not %.3g cd/m²), 95 %% within %.2g\n",
        *input.air.visibility_m, wall_x_m, offs.size(), worst_off, worst->x, worst->y, worst->found, worst->expected,
        most);
    std::ranges::sort(beside);
    if (!beside.empty())
      std::printf("  beside lamps: %zu rays, worst %.2g, median %.2g\n", beside.size(), beside.back(),
                  beside[beside.size() / 2]);
    return {worst_off, most, beside.empty() ? 0.0 : beside.back()};
  }

  IntensityTable table_;
};

}  // namespace phare
