// A road drawn with far meshes against the same road drawn whole: fewer triangles, and a picture that a person takes
// for the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "config/base/paths.h"
#include "tests/bench/straight_road.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/renderer.h"
#include "visual/scene/ray_hit.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

TEST(FarMeshes, ChangeAPictureOfTheCountryRoadLessThanOneSees) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/country_road.glb");
  const Result<IntensityTable> lamp = read_lamp(generated_dir() / "lamps/low_rht.ies", {});
  ASSERT_TRUE(scene.ok() && lamp.ok());
  Result<Renderer> renderer = Renderer::create({.width_px = 1280, .height_px = 720, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(*scene).ok());
  const AimedSource source{.table = &*lamp};
  renderer->set_beam(0, compose_beam_image(std::span(&source, 1)));
  for (const double x_m : {26.9, 300.0}) {
    FrameInput input;
    input.camera.eye_m = {x_m - 1.9, -1.2, 1.22};
    input.camera.world_from_eye = aim_rotation(0.0, -0.01, 0.0);
    for (const double y_m : {-1.0, -2.2})
      input.lamps.push_back({.position_m = {x_m, y_m, 0.65}, .world_from_image = aim_rotation(0.0, -0.01, 0.0)});
    input.want_image = true;
    const FrameResult far = renderer->draw(input);
    const Image8 from_afar = renderer->read_image();
    input.far_mesh_from_m = std::numeric_limits<double>::infinity();
    const FrameResult full = renderer->draw(input);
    const Image8 whole = renderer->read_image();
    std::size_t more_than_8 = 0;
    double sum = 0.0;
    for (std::size_t i = 0; i < whole.rgba.size(); i += 4) {
      const int difference = std::abs(static_cast<int>(whole.rgba[i + 1]) - static_cast<int>(from_afar.rgba[i + 1]));
      sum += difference;
      if (difference > 8) ++more_than_8;
    }
    const double pixels = static_cast<double>(whole.rgba.size()) / 4.0;
    std::printf("x = %.0f m: %llu triangles in place of %llu; mean %.4f of 255, %.3f %% of pixels by more than 8\n",
                x_m, static_cast<unsigned long long>(far.triangles), static_cast<unsigned long long>(full.triangles),
                sum / pixels, 100.0 * static_cast<double>(more_than_8) / pixels);
    EXPECT_LT(far.triangles, full.triangles);
    // Asked for: a tenth of a step of the display on average, and a step that one sees in one pixel of two hundred.
    EXPECT_LT(sum / pixels, 0.1);
    EXPECT_LT(static_cast<double>(more_than_8) / pixels, 0.005);
  }
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

/// Under a bright sky the ground is dark: a light pixel under a dark one is a crack through which one sees the sky.
std::vector<glm::ivec2> cracks_in(const Image8& image) {
  std::vector<glm::ivec2> cracks;
  for (int x = 0; x < image.width_px; ++x) {
    bool dark_above = false;
    for (int y = 0; y < image.height_px; ++y) {
      const auto pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) + static_cast<std::size_t>(x);
      const bool light = image.rgba[4 * pixel + 1] > 100;
      if (light && dark_above) cracks.emplace_back(x, y);
      dark_above = dark_above || !light;
    }
  }
  return cracks;
}

TEST(FarMeshes, RoadUsersAreDrawnByFewerTrianglesFromAfarAndLookTheSame) {
  const Result<Scene> users = read_scene(generated_dir() / "scenes/road_users.glb");
  ASSERT_TRUE(users.ok());
  Result<Renderer> renderer = Renderer::create({.width_px = 1280, .height_px = 720, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(bench::straight_road(), *users).ok());
  FrameInput input;
  input.sky_luminance_cdm2 = 1.0;
  input.exposure_per_cdm2 = 1.0;
  input.camera.eye_m = {10.0, 0.0, 1.22};
  input.want_image = true;
  const FrameResult road = renderer->draw(input);
  const std::size_t meshes = chunks_by_node(*users).size();
  ASSERT_GT(meshes, 3u);
  const auto drawn_at = [&](double ahead_m, double far_mesh_from_m, Image8& picture) {
    input.far_mesh_from_m = far_mesh_from_m;
    input.moving.clear();
    for (std::size_t mesh = 0; mesh < meshes; ++mesh)
      input.moving.push_back(
          {.mesh = mesh,
           .position_m =
               input.camera.eye_m +
               glm::dvec3(ahead_m, 0.05 * ahead_m * (static_cast<double>(mesh) - 0.5 * static_cast<double>(meshes)),
                          -1.22)});
    const std::uint64_t triangles = renderer->draw(input).triangles;
    picture = renderer->read_image();
    return triangles - road.triangles;
  };
  Image8 whole, from_afar;
  for (const double ahead_m : {100.0, 300.0}) {
    const std::uint64_t fewer = drawn_at(ahead_m, kFarMeshFrom_m, from_afar);
    const std::uint64_t whole_triangles = drawn_at(ahead_m, 1e6, whole);
    std::size_t changed = 0, more_than_8 = 0;
    for (std::size_t i = 0; i < whole.rgba.size(); i += 4) {
      const int difference = std::abs(static_cast<int>(whole.rgba[i + 1]) - static_cast<int>(from_afar.rgba[i + 1]));
      if (difference > 0) ++changed;
      if (difference > 8) ++more_than_8;
    }
    std::printf("%.0f m: %llu triangles in place of %llu; %zu pixels changed, %zu by more than 8 of 255\n", ahead_m,
                static_cast<unsigned long long>(fewer), static_cast<unsigned long long>(whole_triangles), changed,
                more_than_8);
    EXPECT_LT(fewer, ahead_m > 200.0 ? whole_triangles / 10 : whole_triangles / 2);
    // A pixel's error shows along outlines: of six users of 2 m by 2 m at 100 m 6·4·20 pixels; asked is under half of
    // them.
    EXPECT_LT(more_than_8, 200u) << "of 921,600";
  }
  EXPECT_EQ(drawn_at(30.0, kFarMeshFrom_m, from_afar), drawn_at(30.0, 1e6, whole)) << "near by all are drawn";
  EXPECT_EQ(from_afar.rgba, whole.rgba);
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

// A block of 96 m is drawn as its nearest thing asks for: where many stand in it, those far behind would be drawn
// whole.
TEST(FarMeshes, CarsThatStandCloseTogetherAreEachDrawnByHowFarTheyAre) {
  Result<Scene> scene = read_scene(generated_dir() / "scenes/road_users.glb");
  ASSERT_TRUE(scene.ok());
  std::vector<SceneChunk> cars;
  for (const SceneChunk& part : scene->chunks)
    for (double x_m = 4.0; part.node == "car" && x_m < 96.0; x_m += 8.0) {
      const glm::dvec3 there(x_m, 4.0, 0.0);
      cars.push_back(part);
      cars.back().origin_m += there, cars.back().low_m += there, cars.back().high_m += there;
    }
  ASSERT_FALSE(cars.empty());
  scene->chunks = std::move(cars);
  Result<Renderer> renderer = Renderer::create({.width_px = 1280, .height_px = 720, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(*scene).ok());
  FrameInput input;
  input.camera.eye_m = {-40.0, 0.0, 1.22};
  const std::uint64_t drawn = renderer->draw(input).triangles;
  input.far_mesh_from_m = std::numeric_limits<double>::infinity();
  const std::uint64_t whole = renderer->draw(input).triangles;
  std::printf("%llu triangles in place of %llu\n", static_cast<unsigned long long>(drawn),
              static_cast<unsigned long long>(whole));
  // Three of four cars stand beyond 60 m, and are drawn by less than half of their triangles (the test above).
  EXPECT_LT(drawn, whole * 5 / 8);
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

// What is behind a crack may not be drawn at all (visual/scene/horizon.h).
TEST(FarMeshes, NobodySeesTheSkyThroughTheGround) {
  const Result<Scene> read = read_scene(generated_dir() / "scenes/country_road.glb");
  ASSERT_TRUE(read.ok());
  Scene scene = *read;  // its ground alone, and black
  std::erase_if(scene.chunks, [&](const SceneChunk& chunk) {
    const Surface surface = scene.materials[chunk.material].surface;
    return surface != Surface::kAsphalt && surface != Surface::kGrass;
  });
  for (SceneMaterial& material : scene.materials) material.reflectance = glm::vec3(0.0f);
  Result<Renderer> renderer = Renderer::create({.width_px = 1280, .height_px = 720, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(scene).ok());
  FrameInput input;
  input.sky_luminance_cdm2 = 100.0;
  input.want_image = true;
  std::size_t whole_cracks = 0, pictures = 0;
  for (double x_m = 20.0; x_m < 590.0; x_m += 8.5) {
    const auto below = ray_hit(scene, {x_m, -1.2, 200.0}, {0, 0, -1}, 0.0, 500.0);
    ASSERT_TRUE(below) << x_m;
    input.camera.eye_m = {x_m, -1.2, 201.22 - below->distance_m};
    const auto seen = [&](double far_mesh_from_m) {
      input.far_mesh_from_m = far_mesh_from_m;
      renderer->draw(input);
      return cracks_in(renderer->read_image());
    };
    // Of whole meshes one sees some too: chunks round the places of the corners that they share apart.
    const std::vector<glm::ivec2> whole = seen(std::numeric_limits<double>::infinity());
    whole_cracks += whole.size(), ++pictures;
    for (const glm::ivec2& crack : seen(kFarMeshFrom_m))
      EXPECT_TRUE(std::ranges::count(whole, crack))
          << "from x = " << x_m << " m at pixel " << crack.x << ", " << crack.y;
  }
  std::printf("%zu pixels of whole meshes\n", whole_cracks);
  EXPECT_LT(whole_cracks, pictures / 4)
      << "a pixel in every fourth picture: float32 rounds a corner two ways where chunks meet";
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

/// A ridge across the way, 6 m high at 150 m, and behind it fifty plates that face the eye, one on top of another.
Scene ridge(float foot_m) {
  Scene scene;
  scene.materials = {{.name = "meadow", .reflectance = glm::vec3(0.2f), .surface = Surface::kGrass},
                     {.name = "plates", .reflectance = glm::vec3(0.8f)}};
  scene.materials[1].retro.kind = RetroKind::kSheeting;  // stays whole from afar
  const auto begin = [&](const char* node, std::uint32_t material) {
    SceneChunk chunk{.node = node, .material = material};
    chunk.low_m = glm::dvec3(1e9), chunk.high_m = glm::dvec3(-1e9);
    chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
    chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
    return chunk;
  };
  const auto add = [&](SceneChunk& chunk, const std::array<glm::vec3, 4>& corners, const glm::vec3& normal) {
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(chunk.vertex_count + i);
    for (const glm::vec3& corner : corners) {
      scene.vertices.push_back({corner, normal});
      chunk.low_m = glm::min(chunk.low_m, glm::dvec3(corner));
      chunk.high_m = glm::max(chunk.high_m, glm::dvec3(corner));
    }
    chunk.vertex_count += 4, chunk.index_count += 6;
  };
  SceneChunk ground = begin("ground", 0), plates = ground;
  const auto height = [](float x) { return std::max(0.0f, 6.0f - 0.2f * std::abs(x - 150.0f)); };
  for (float x = -50.0f; x < 400.0f; x += 5.0f)
    for (float y = -100.0f; y < 100.0f; y += 50.0f)
      add(ground,
          {glm::vec3(x, y, height(x)),
           {x + 5, y, height(x + 5)},
           {x + 5, y + 50, height(x + 5)},
           {x, y + 50, height(x)}},
          {0, 0, 1});
  scene.chunks.push_back(ground);
  plates = begin("plates", 1);
  for (int i = 0; i < 50; ++i) {
    const float low = foot_m + 0.05f * static_cast<float>(i), high = low + 0.05f;
    add(plates, {glm::vec3(260, 5, low), {260, -5, low}, {260, -5, high}, {260, 5, high}}, {-1, 0, 0});
  }
  scene.chunks.push_back(plates);
  return scene;
}

TEST(FarMeshes, WhatARidgeHidesIsNotDrawn) {
  for (const bool hidden : {true, false}) {
    Result<Renderer> renderer = Renderer::create({.width_px = 1280, .height_px = 720, .validation = true});
    ASSERT_TRUE(renderer.ok()) << renderer.error().text();
    ASSERT_TRUE(renderer->load_scene(ridge(hidden ? 0.0f : 9.0f)).ok());
    FrameInput input;
    input.camera.eye_m = {0.0, 0.0, 1.2};
    input.sky_luminance_cdm2 = 1.0;
    input.want_image = true;
    const std::uint64_t drawn = renderer->draw(input).triangles;
    const Image8 picture = renderer->read_image();
    input.far_mesh_from_m = std::numeric_limits<double>::infinity();
    const std::uint64_t whole = renderer->draw(input).triangles;
    std::size_t other = 0;
    const Image8 whole_picture = renderer->read_image();
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
      other += std::abs(int{picture.rgba[i]} - int{whole_picture.rgba[i]}) > 2 ? 1 : 0;
    EXPECT_EQ(other, 0u) << hidden;
    EXPECT_EQ(whole - drawn, hidden ? 100u : 0u);
    EXPECT_EQ(renderer->validation_messages(), 0u);
  }
}

TEST(FarMeshes, AreDrawnTogetherWhereTheDeviceTakesManyDrawsInOneCall) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/country_road.glb");
  ASSERT_TRUE(scene.ok());
  std::vector<Image8> pictures;
  std::vector<FrameResult> frames;
  for (const bool multi_draw : {true, false}) {
    Result<Renderer> renderer =
        Renderer::create({.width_px = 1280, .height_px = 720, .validation = true, .multi_draw = multi_draw});
    ASSERT_TRUE(renderer.ok()) << renderer.error().text();
    ASSERT_TRUE(renderer->load_scene(*scene).ok());
    FrameInput input;
    input.camera.eye_m = {25.0, -1.2, 1.22};
    input.sky_luminance_cdm2 = 1.0;
    input.exposure_per_cdm2 = 1.0;
    input.want_image = true;
    frames.push_back(renderer->draw(input));
    pictures.push_back(renderer->read_image());
    EXPECT_EQ(renderer->validation_messages(), 0u);
  }
  EXPECT_EQ(pictures[0].rgba, pictures[1].rgba);
  EXPECT_EQ(frames[0].triangles, frames[1].triangles);
  std::printf("%u draws of %llu triangles, one by one %u\n", frames[0].draws,
              static_cast<unsigned long long>(frames[0].triangles), frames[1].draws);
  EXPECT_LE(frames[0].draws, frames[1].draws);
  if (frames[0].draws == frames[1].draws) GTEST_SKIP() << "the device has no VK_EXT_multi_draw";
  EXPECT_LT(2 * frames[0].draws, frames[1].draws) << "what is far has one origin for all";
}

TEST(FarMeshes, BeginFartherAwayWherePixelsAreFiner) {
  const Result<Scene> scene = read_scene(generated_dir() / "scenes/country_road.glb");
  ASSERT_TRUE(scene.ok());
  Result<Renderer> renderer = Renderer::create({.width_px = 1280, .height_px = 720, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->load_scene(*scene).ok());
  FrameInput input;
  input.camera.eye_m = {25.0, -1.2, 1.22};
  const auto triangles = [&](int width_px, int height_px, double far_mesh_from_m) {
    renderer->resize(width_px, height_px);
    input.far_mesh_from_m = far_mesh_from_m;
    return renderer->draw(input).triangles;
  };
  const std::uint64_t usual = triangles(1280, 720, kFarMeshFrom_m);
  EXPECT_EQ(triangles(640, 360, kFarMeshFrom_m), usual) << "coarser pixels gain nothing: insets stay as they are";
  EXPECT_EQ(triangles(2560, 1440, kFarMeshFrom_m), triangles(1280, 720, 2.0 * kFarMeshFrom_m));
  EXPECT_GT(triangles(2560, 1440, kFarMeshFrom_m), usual);
  EXPECT_EQ(renderer->validation_messages(), 0u);
}

}  // namespace
}  // namespace phare
