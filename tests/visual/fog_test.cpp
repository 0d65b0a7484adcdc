// Fog on the device: its grid is kept, surfaces and sky are seen through it, and there is nothing at all where the air
// is clear. Its rays: fog_rays_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <tuple>

#include "tests/visual/foggy.h"

namespace phare {
namespace {

/// Lamps and eye that move together see the same fog: the grid is kept. It is computed anew once any of what it comes
/// from is another.
TEST_F(FogOnDevice, TheGridIsKeptWhileACarsLampsShineAsTheyDid) {
  ASSERT_TRUE(renderer->load_scene(black_wall(40.0)).ok());
  FrameInput input = foggy(80.0);
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  const auto passes = [&] { return renderer->draw(input).pass_count; };
  input.air.visibility_m.reset();
  passes();
  const auto clear = passes();
  renderer->set_beam(0, image_of(table_));
  const auto upload = passes() - clear;
  input.air.visibility_m = 80.0;
  const auto computed = passes(), kept = computed - 1;
  EXPECT_EQ(passes(), kept) << "the same frame once more";
  const ImageF before = renderer->read_hdr();
  // Driven on, into a curve, over a crest.
  const glm::dmat3 turn = aim_rotation(0.4, 0.02, 0.01);
  const glm::dvec3 way{1234.5, -67.8, 9.0};
  const auto moved = [&](const FrameInput& from) {
    FrameInput to = from;
    to.camera.eye_m = way + turn * from.camera.eye_m;
    to.camera.world_from_eye = turn * from.camera.world_from_eye;
    for (PlacedLamp& lamp : to.lamps) {
      lamp.position_m = way + turn * lamp.position_m;
      lamp.world_from_image = turn * lamp.world_from_image;
    }
    return to;
  };
  input = moved(input);
  EXPECT_EQ(passes(), kept) << "the car has moved";
  // The wall is far behind, so rays go on; above the horizon little of their light comes from beyond it.
  const ImageF after = renderer->read_hdr();
  const std::size_t texel = 4 * (60 * 320 + 160) + 1;
  ASSERT_GT(before.rgba[texel], 0.0f);
  EXPECT_NEAR(after.rgba[texel] / before.rgba[texel], 1.0f, 0.1f);

  input.lamps[1].world_from_image = input.lamps[1].world_from_image * aim_rotation(0.0, 0.0005, 0.0);
  EXPECT_EQ(passes(), computed) << "a lamp's aim";
  EXPECT_EQ(passes(), kept);
  input.lamps[0].position_m.z += 0.001;
  EXPECT_EQ(passes(), computed) << "a lamp's place";
  input.air.visibility_m = 70.0;
  EXPECT_EQ(passes(), computed) << "visibility";
  input.air.droplets.henyey_greenstein_g = 0.8;
  EXPECT_EQ(passes(), computed) << "droplets";
  input.effects[fog()] = 1;
  EXPECT_EQ(passes(), computed) << "level";
  input.camera.fov_horizontal_rad *= 0.9;
  EXPECT_EQ(passes(), computed) << "the eye's field";
  EXPECT_EQ(passes(), kept);
  renderer->set_beam(0, image_of(table_));
  renderer->draw(input);  // uploads the beam in a pass of its own
  input.lamps.pop_back();
  EXPECT_EQ(passes(), computed) << "a lamp goes out";
  EXPECT_EQ(passes(), kept);
  renderer->set_beam(0, image_of(table_));
  EXPECT_EQ(passes(), computed + upload) << "a beam";
  EXPECT_EQ(passes(), kept);
}

/// Clear air costs nothing: passes, draws, images, bytes and the picture are those of a renderer that never saw fog.
TEST_F(FogOnDevice, ClearAirCostsNothingBeforeAndAfter) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  FrameInput input = foggy(80.0);
  input.want_hdr = false;
  input.want_image = true;
  const auto clear_air = [&] {
    FrameInput clear = input;
    clear.air.visibility_m.reset();
    FrameResult result = renderer->draw(clear);
    renderer->draw(clear);  // what the frame before left is gone
    return std::tuple(result.pass_count, result.draws, result.triangles, result.images, result.image_bytes,
                      renderer->device_memory_bytes(), renderer->read_image().rgba);
  };
  const auto before = clear_air();
  const FrameResult fog_frame = renderer->draw(input);
  EXPECT_EQ(kFogNames[fog_frame.effects.level(Effect::kFog)], "medium");
  EXPECT_EQ(fog_frame.effects[Effect::kFog].reason, "visibility 80 m between the eye and what it sees");
  EXPECT_EQ(fog_frame.pass_count, std::get<0>(before) + 1) << "the grid";
  EXPECT_EQ(fog_frame.effect_costs[fog()].passes, 1u);
  EXPECT_GE(fog_frame.effect_costs[fog()].bytes, 16 * texels_of(kFogLevels[2]));
  EXPECT_EQ(fog_frame.other_cost.passes, std::get<0>(before));
  EXPECT_NE(renderer->read_image().rgba, std::get<6>(before)) << "within one frame";
  const std::uint64_t in_fog = renderer->device_memory_bytes();
  const auto after = clear_air();
  EXPECT_EQ(std::get<0>(after), std::get<0>(before));
  EXPECT_EQ(std::get<1>(after), std::get<1>(before));
  EXPECT_EQ(std::get<2>(after), std::get<2>(before));
  EXPECT_EQ(std::get<3>(after), std::get<3>(before));
  EXPECT_EQ(std::get<4>(after), std::get<4>(before));
  EXPECT_EQ(std::get<6>(after), std::get<6>(before)) << "to the bit";
  // The phase function stays, 23 KB; the grid is freed.
  EXPECT_LT(std::get<5>(after), in_fog - 1000000);

  input.effects[fog()] = 0;
  const FrameResult off = renderer->draw(input);
  EXPECT_EQ(off.pass_count, std::get<0>(before));
  EXPECT_EQ(renderer->read_image().rgba, std::get<6>(before)) << "switched off";
}

/// A grey wall lit through fog: Lambert's luminance, dimmed on both ways, and the fog's own.
TEST_F(FogOnDevice, SurfacesAreDimmedOnBothWays) {
  constexpr double kWall_m = 25.0, kRho = 0.5;
  Scene wall = black_wall(kWall_m);
  wall.materials[0].reflectance = glm::vec3(kRho);
  ASSERT_TRUE(renderer->load_scene(wall).ok());
  FrameInput input = foggy(60.0);
  input.effects[fog()] = 3;
  renderer->draw(input);
  const ImageF image = renderer->read_hdr();
  const ViewGeometry view(input.camera, 320.0 / 180.0);
  const double sigma = extinction_per_m(*input.air.visibility_m);
  double worst = 0.0;
  std::size_t rays = 0;
  for (int y = 5; y < 180; y += 17)
    for (int x = 5; x < 320; x += 31) {
      const Ray ray = view.ray_through(x, y, 320, 180);
      const double length_m = (kWall_m - input.camera.eye_m.x) / ray.direction.x;
      const glm::dvec3 point = ray.origin_m + ray.direction * length_m;
      // Beside the lamps the grid is off by more, see above.
      if (std::ranges::any_of(input.lamps, [&](const PlacedLamp& lamp) {
            return glm::length(glm::cross(lamp.position_m - ray.origin_m, ray.direction)) < 0.5;
          }))
        continue;
      ++rays;
      double expected = airlight_cdm2(sources(input), sigma, {}, ray.origin_m, ray.direction, length_m);
      for (const PlacedSource& lamp : sources(input))
        expected += kRho / 3.14159265358979 *
                    illuminance_lx(lamp.position_m, lamp.world_from_lamp, table_, 1.0, point, {-1, 0, 0}) *
                    transmittance(sigma, glm::length(point - lamp.position_m) + length_m);
      const float* rgb = &image.rgba[4 * static_cast<std::size_t>(y * 320 + x)];
      const double found = 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
                           0.0722 * static_cast<double>(rgb[2]);
      worst = std::max(worst, std::abs(found / expected - 1.0));
    }
  std::printf("wall through fog: worst relative difference %.2g\n", worst);
  EXPECT_GT(rays, 50u);
  // Half floats 0.05 %, the rest the fog's own light half a metre beside a lamp, where the grid is at its worst: 1.2 %.
  EXPECT_LE(worst, 0.015);
}

/// The sky comes through thin fog and not through thick, and no step shows where surfaces end: far ground and sky are
/// alike where fog hides both.
TEST_F(FogOnDevice, TheSkyFadesIntoTheFog) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  const auto sky_pixel = [&](std::optional<double> visibility_m) {
    FrameInput input = foggy(80.0);
    input.lamps.clear();
    input.air.visibility_m = visibility_m;
    input.sky_luminance_cdm2 = 0.01;
    renderer->draw(input);
    return renderer->read_hdr().rgba[4 * (10 * 320 + 20) + 1];
  };
  const float clear = sky_pixel(std::nullopt), thin = sky_pixel(1e5), thick = sky_pixel(50.0);
  EXPECT_GT(clear, 0.01f);
  EXPECT_NEAR(thin, clear * 0.9141f + 0.5f * 0.01f * 0.0859f, 0.01f * clear);  // 3 km: exp(−0.0899)
  EXPECT_NEAR(thick, 0.5f * 0.01f, 1e-4f) << "the fog under it";
}

TEST_F(FogOnDevice, StaysFiniteWhereItIsHard) {
  ASSERT_TRUE(renderer->load_scene(yard()).ok());
  for (const double visibility_m : {1.0, 30.0, 1e5})
    for (const glm::dvec3& at_m : {glm::dvec3(-1.9, 0.3, 1.22), glm::dvec3(-1.9, 0.3, 1.2201),
                                   glm::dvec3(-5.0, 0.3, 1.22), glm::dvec3(20.0, 0.3, 1.22)}) {
      FrameInput input = foggy(visibility_m);
      input.lamps[0].position_m = at_m;
      if (at_m.x > 0.0) input.lamps[0].world_from_image = aim_rotation(3.14159265, 0.0, 0.0);
      renderer->draw(input);
      for (const float value : renderer->read_hdr().rgba) {
        ASSERT_TRUE(std::isfinite(value)) << visibility_m << " m, lamp at " << at_m.x;
        ASSERT_GE(value, 0.0f);
      }
    }
}

/// More lamps than the grid is computed with at a time, more views, and parts of the picture: each ray as bright as
/// alone.
TEST_F(FogOnDevice, ManyLampsAndViewsAddUp) {
  ASSERT_TRUE(renderer->load_scene(black_wall(40.0)).ok());
  FrameInput two = foggy(80.0), twelve = two;
  for (int i = 0; i < 5; ++i)
    for (const PlacedLamp& lamp : two.lamps) twelve.lamps.push_back(lamp);
  renderer->draw(two);
  const ImageF once = renderer->read_hdr();
  ViewInput beside = two;
  beside.own_picture = {200, 100};
  beside.part = {0.25, 0.0, 0.5, 1.0};
  twelve.more_views = {beside};
  renderer->draw(twelve);
  const ImageF sixfold = renderer->read_hdr();
  double worst = 0.0;
  for (std::size_t i = 1; i < once.rgba.size(); i += 4) {
    if (once.rgba[i] < 1e-4f) continue;
    worst = std::max(worst, std::abs(static_cast<double>(sixfold.rgba[i] / once.rgba[i]) / 6.0 - 1.0));
  }
  EXPECT_LE(worst, 0.01);  // the weights near lamps differ: eight of twelve
  ASSERT_TRUE(renderer->load_scene(black_wall(40.0)).ok());
  FrameInput alone = two;
  alone.more_views = {beside};
  renderer->draw(alone);
  const ImageF part = renderer->read_hdr(1);
  EXPECT_EQ(part.width_px, 100);
  renderer->draw(two);
  EXPECT_EQ(renderer->read_hdr().rgba, once.rgba);
}

}  // namespace
}  // namespace phare
