// Shadows in fog: of what stands in a beam, the light that air scatters to the eye from behind it, against float64.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "tests/visual/shape.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/passes/fog.h"
#include "visual/photometry/table/fog.h"

namespace phare {
namespace {

constexpr std::size_t kFog = static_cast<std::size_t>(Effect::kFog);
constexpr std::size_t kShadows = static_cast<std::size_t>(Effect::kShadows);

std::size_t level_named(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(kFogNames, name) - kFogNames.begin());
}

struct Box {
  glm::dvec3 low_m{0.0}, high_m{0.0};

  /// Where the way from `from` by `way` (1: at its end) is within, as shares of it; none: the first beyond the second.
  std::pair<double, double> within(const glm::dvec3& from, const glm::dvec3& way) const {
    double first = 0.0, last = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (low_m[axis] - from[axis]) / way[axis], b = (high_m[axis] - from[axis]) / way[axis];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    return {first, last};
  }
  bool is_between(const glm::dvec3& from, const glm::dvec3& to) const {
    const auto [first, last] = within(from, to - from);
    return first < last;
  }
};

class FogShadows : public SharedRenderer {
 protected:
  static constexpr double kWall_m = 40.0;
  static constexpr double kSky_m = 300.0;  // beyond it at a visibility of 80 m 1e-5 is left of what is scattered there

  void SetUp() override {
    SharedRenderer::SetUp();
    if (renderer == nullptr) return;
    table_ = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
    renderer->set_beam(0, image_of(table_));
    // A black box in the beams, before a black wall: all light in the picture is the air's.
    Shape shape;
    shape.box(box_.low_m, box_.high_m);
    shape.quad({kWall_m, 200, -200}, {kWall_m, -200, -200}, {kWall_m, -200, 200}, {kWall_m, 200, 200});
    ASSERT_TRUE(renderer->load_scene(shape.scene({.name = "black", .reflectance = {0.0, 0.0, 0.0}})).ok());
  }

  /// Seen from the side of the road.
  static FrameInput from_beside(std::string_view level) {
    FrameInput input;
    input.camera.eye_m = {4.0, 9.0, 1.5};
    input.camera.world_from_eye = aim_rotation(-0.57, -0.05, 0.0);
    for (const double y_m : {0.6, -0.6})
      input.lamps.push_back({.position_m = {0.0, y_m, 0.65}, .world_from_image = aim_rotation(0.0, -0.01, 0.0)});
    input.sky_luminance_cdm2 = 0.0;
    input.air.visibility_m = 80.0;
    input.want_hdr = true;
    input.effects[kFog] = level_named(level);
    return input;
  }

  /// Float64: what each lamp gives along the parts of the way that it sees.
  double expected_cdm2(const FrameInput& input, const Ray& ray, double length_m) const {
    double sum = 0.0;
    for (const PlacedLamp& lamp : input.lamps) {
      const PlacedSource source{&table_, lamp.position_m, lamp.world_from_image};
      const auto to = [&](double way_m) {
        return airlight_cdm2(std::span(&source, 1), extinction_per_m(*input.air.visibility_m), input.air.droplets,
                             ray.origin_m, ray.direction, way_m);
      };
      const auto dark_at = [&](double way_m) {
        return box_.is_between(ray.origin_m + ray.direction * way_m, lamp.position_m);
      };
      sum += to(length_m);
      // Of the shadow of a body without hollows a ray crosses one stretch at most.
      constexpr int kPlaces = 2000;
      std::optional<int> first, last;
      for (int i = 0; i <= kPlaces; ++i) {
        if (!dark_at(length_m * i / kPlaces)) continue;
        if (!first) first = i;
        last = i;
      }
      if (!first) continue;
      const auto edge = [&](double lit, double dark) {
        for (int i = 0; i < 40; ++i) (dark_at(0.5 * (lit + dark)) ? dark : lit) = 0.5 * (lit + dark);
        return dark;
      };
      const double step_m = length_m / kPlaces;
      const double from_m = *first == 0 ? 0.0 : edge(step_m * (*first - 1), step_m * *first);
      const double to_m = *last == kPlaces ? length_m : edge(step_m * (*last + 1), step_m * *last);
      sum -= to(to_m) - to(from_m);
    }
    return sum;
  }

  struct Off {
    double share = 0.0;  ///< of all light that is in a wrong place
    double total = 0.0;  ///< of all light, too much or too little
    double p95 = 0.0;    ///< relative, of rays with a hundredth of the brightest and more
    std::size_t rays = 0;
  };
  /// `open`: no wall ends the rays, but the sky.
  Off off(const FrameInput& input, bool open = false) {
    renderer->draw(input);
    const ImageF image = renderer->read_hdr();
    const ViewGeometry view(input.camera, double{1} * image.width_px / image.height_px);
    std::vector<std::pair<double, double>> rays;
    for (int y = 3; y < image.height_px; y += 7)
      for (int x = 2; x < image.width_px; x += 7) {
        const Ray ray = view.ray_through(x, y, image.width_px, image.height_px);
        double length_m = open ? kSky_m : (kWall_m - ray.origin_m.x) / ray.direction.x;
        const auto [hit, out] = box_.within(ray.origin_m, ray.direction * length_m);
        if (hit < out) length_m *= hit;
        const float* rgb = &image.rgba[4 * static_cast<std::size_t>(y * image.width_px + x)];
        rays.emplace_back(expected_cdm2(input, ray, length_m), 0.2126 * static_cast<double>(rgb[0]) +
                                                                   0.7152 * static_cast<double>(rgb[1]) +
                                                                   0.0722 * static_cast<double>(rgb[2]));
      }
    double light = 0.0, wrong = 0.0, more = 0.0, brightest = 0.0;
    for (const auto& [expected, found] : rays) {
      light += expected;
      wrong += std::abs(found - expected);
      more += found - expected;
      brightest = std::max(brightest, expected);
    }
    std::vector<double> relative;
    for (const auto& [expected, found] : rays)
      if (expected >= 0.01 * brightest) relative.push_back(std::abs(found / expected - 1.0));
    std::ranges::sort(relative);
    const Off off{wrong / light, more / light, relative[relative.size() * 95 / 100], rays.size()};
    std::printf("%s: %zu rays, %.2g of the light in a wrong place, in all %+.2g, 95 %% of rays within %.2g\n",
                std::string(kFogNames[*input.effects[kFog]]).c_str(), off.rays, off.share, off.total, off.p95);
    return off;
  }

  Box box_{{10.0, -1.3, -0.5}, {11.0, 0.4, 2.0}};
  IntensityTable table_;
};

TEST_F(FogShadows, BehindABoxTheAirIsAsDarkAsInFloat64) {
  const Off without = off(from_beside("medium")), shadowed = off(from_beside("shadowed")),
            finest = off(from_beside("finest"));
  // More than one ray in twenty passes the box's shadow, and finds light there: what the test is for.
  EXPECT_GT(without.p95, 0.3);
  // Off as the levels are in open air (tests/visual/fog_test.cpp): medium's grid by 5 %, finest's by 0.6 %.
  EXPECT_LE(shadowed.p95, 0.05);
  EXPECT_LE(shadowed.share, 0.01);
  EXPECT_LE(finest.p95, 0.006);
  EXPECT_LE(finest.share, 0.001);
}

/// The beams pass through the picture and fall on nothing in it; what stands in them is beside it.
TEST_F(FogShadows, InLightThatFallsOnNothingInView) {
  Shape shape;
  shape.box(box_.low_m, box_.high_m);
  ASSERT_TRUE(renderer->load_scene(shape.scene({.name = "black", .reflectance = {0.0, 0.0, 0.0}})).ok());
  const auto across = [](std::string_view level) {
    FrameInput input = from_beside(level);
    input.camera.eye_m = {20.0, 9.0, 0.8};
    input.camera.world_from_eye = aim_rotation(-0.5 * std::numbers::pi, 0.0, 0.0);
    return input;
  };
  const FrameResult drawn = renderer->draw(across("shadowed"));
  EXPECT_EQ(drawn.views.front().lamps, 0u) << "nothing in view is lit";
  EXPECT_TRUE(drawn.effects.on(Effect::kShadows)) << drawn.effects[Effect::kShadows].reason;
  EXPECT_FALSE(renderer->draw(across("medium")).effects.on(Effect::kShadows)) << "nobody sees them";
  const Off without = off(across("medium"), true), shadowed = off(across("shadowed"), true);
  EXPECT_GT(without.share, 0.1);
  EXPECT_LE(shadowed.share, 0.01);
  FrameInput by_rays = across("shadowed");
  by_rays.effects[kShadows] = kRayShadows;
  EXPECT_LE(off(by_rays, true).share, 0.01);
}

/// Surfaces by rays: the air has maps all the same.
TEST_F(FogShadows, StayWhereSurfacesAreShadowedByRays) {
  FrameInput input = from_beside("shadowed");
  input.effects[kShadows] = kRayShadows;
  EXPECT_LE(off(input).p95, 0.05);
}

/// With shadows the grid comes from what stands in the light, too: kept while nothing moves in the world.
TEST_F(FogShadows, TheGridIsKeptWhileAllStandsStill) {
  FrameInput input = from_beside("shadowed");
  const auto computed = [&] { return renderer->draw(input).effect_costs[kFog].passes == 1; };
  const auto drive_on = [&] {
    input.camera.eye_m.x += 0.1;
    for (PlacedLamp& lamp : input.lamps) lamp.position_m.x += 0.1;
  };
  EXPECT_TRUE(computed());
  EXPECT_FALSE(computed()) << "the same frame once more";
  input.effects[kShadows] = 3;
  EXPECT_TRUE(computed()) << "finer maps";
  EXPECT_FALSE(computed());
  drive_on();
  EXPECT_TRUE(computed()) << "nearer to the box";
  input.effects[kFog] = level_named("medium");
  EXPECT_TRUE(computed());
  drive_on();
  EXPECT_FALSE(computed()) << "a level without shadows";
  // Where nothing stands in the light shadows cost nothing.
  input.effects[kFog] = level_named("shadowed");
  input.effects[kShadows] = 0;
  EXPECT_TRUE(computed());
  drive_on();
  EXPECT_FALSE(computed()) << "no shadows are drawn";
  ASSERT_TRUE(renderer->load_scene(black_wall(-kWall_m)).ok());
  input.effects[kShadows].reset();
  computed();
  drive_on();
  EXPECT_FALSE(computed()) << "all there is is behind the eye";
}

}  // namespace
}  // namespace phare
