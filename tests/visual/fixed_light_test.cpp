// Light that does not change, on the device: street lamps, surfaces that shine by themselves, wet ground's mirror, what
// moves; and no work where none of it is.
#include "visual/fixed_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>

#include "shaders/lib/road.h"
#include "shaders/lib/wet.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

class FixedLightOnDevice : public SharedRenderer {};

/// 1000 cd every way below the horizon.
fs::path street_lamps(const std::vector<glm::dvec3>& at) {
  const fs::path folder(testing::TempDir()), file = folder / "fixed_light.toml";
  std::ofstream(folder / "fixed_light.ies") << "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n"
                                               "1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n1000 1000\n";
  std::ofstream text(file);
  text << "fineness = \"fine\"\n[[luminaire]]\nname = \"even\"\nfile = \"" << (folder / "fixed_light.ies").string()
       << "\"\ncolour_temperature_k = 4000\n";
  for (const glm::dvec3& p : at)
    text << "[[lamp]]\nluminaire = \"even\"\nposition_m = [" << p.x << ", " << p.y << ", " << p.z << "]\n";
  return file;
}

std::shared_ptr<const FixedLight> light_of(const Scene& scene, const std::vector<glm::dvec3>& lamps) {
  auto light = FixedLight::of(scene, lamps.empty() ? fs::path() : street_lamps(lamps), std::nullopt);
  EXPECT_TRUE(light) << light.error().text();
  return std::make_shared<const FixedLight>(std::move(*light));
}

FrameInput dark_view() {
  FrameInput input = driver_view();
  input.lamps.clear();
  input.sky_luminance_cdm2 = 0.0;
  input.want_hdr = true;
  input.adaptation_k = 4000.0;
  return input;
}

/// The pixel and where its ray meets the plane z = 0.
struct Seen {
  glm::vec4 pixel;
  glm::dvec3 at;
};
Seen seen_at(const Renderer& renderer, const FrameInput& input, int x, int y) {
  const ImageF picture = renderer.read_hdr();
  const float* p = &picture.rgba[4 * static_cast<std::size_t>(y * picture.width_px + x)];
  const ViewGeometry view(input.camera, static_cast<double>(picture.width_px) / picture.height_px);
  const glm::dvec3 way(view.direction_from_clip() * glm::dvec4(2.0 * (x + 0.5) / picture.width_px - 1.0,
                                                               2.0 * (y + 0.5) / picture.height_px - 1.0, 1.0, 0.0));
  const glm::dvec3 along = glm::normalize(way);
  return {{p[0], p[1], p[2], p[3]}, input.camera.eye_m + along * (input.camera.eye_m.z / -along.z)};
}

double luminance(const glm::vec4& p) {
  return 0.2126 * static_cast<double>(p.x) + 0.7152 * static_cast<double>(p.y) + 0.0722 * static_cast<double>(p.z);
}

TEST_F(FixedLightOnDevice, TheRoadHasTheLuxAndTheLuminanceOfItsLamps) {
  Scene scene = yard();
  scene.materials[0].surface = Surface::kPlain;  // no grain: luminance is rho·E/pi
  const auto light = light_of(scene, {{8, 5, 8}, {20, -5, 8}});
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, light));
  const FrameInput input = dark_view();
  const FrameResult result = renderer->draw(input);
  EXPECT_EQ(result.effects[Effect::kFixedLight].reason, "2 street lamps");
  for (const auto& [x, y] : {std::pair(60, 150), std::pair(160, 130), std::pair(250, 170), std::pair(120, 110)}) {
    const Seen seen = seen_at(*renderer, input, x, y);
    const double exact = light->lux_at(seen.at, {0, 0, 1});
    ASSERT_GT(exact, 1.0);
    // The level's tolerance at the middle of a side, 4/3 of it within, and half floats of the image (2^-11).
    EXPECT_NEAR(static_cast<double>(seen.pixel.w), exact, exact * (4.0 / 3.0 * kBakeLevels[2].tolerance + 5e-4));
    const double rho = 0.1;
    EXPECT_NEAR(luminance(seen.pixel), static_cast<double>(seen.pixel.w) * rho / std::numbers::pi,
                2e-3 * luminance(seen.pixel));
  }
}

TEST_F(FixedLightOnDevice, HundredsOfLampsAreNoDrawAndNoPassMore) {
  const Scene scene = yard();
  std::vector<glm::dvec3> many;
  for (int i = 0; i < 400; ++i) many.push_back({-20.0 + i % 40 * 2.5, i / 40 * 2.0 - 9.0, 7.0});
  FrameResult of[2];
  FrameInput input = driver_view();
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  for (const bool hundreds : {false, true}) {
    ASSERT_TRUE(
        renderer->load_scene(scene, Scene{}, light_of(scene, hundreds ? many : std::vector<glm::dvec3>{{8, 5, 8}})));
    renderer->draw(input);
    of[hundreds ? 1 : 0] = renderer->draw(input);
  }
  EXPECT_EQ(of[1].effects[Effect::kFixedLight].reason, "400 street lamps");
  EXPECT_EQ(of[1].draws, of[0].draws);
  EXPECT_EQ(of[1].pass_count, of[0].pass_count);
  EXPECT_EQ(of[1].image_bytes, of[0].image_bytes);
  EXPECT_EQ(of[1].pipelines_made, 0u);
}

TEST_F(FixedLightOnDevice, WhereNothingShinesThereIsNothingOfIt) {
  const Scene scene = yard();
  FrameInput input = driver_view();
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  ASSERT_TRUE(renderer->load_scene(scene));
  renderer->draw(input);
  renderer->draw(input);
  ASSERT_TRUE(renderer->load_scene(scene));  // what the tests before have left is gone
  const FrameResult plain = renderer->draw(input);
  const std::uint64_t plain_bytes = renderer->device_memory_bytes();
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, light_of(scene, {})));
  const FrameResult none = renderer->draw(input);
  EXPECT_EQ(none.draws, plain.draws);
  EXPECT_EQ(none.triangles, plain.triangles);
  EXPECT_EQ(none.pass_count, plain.pass_count);
  EXPECT_EQ(none.image_bytes, plain.image_bytes);
  EXPECT_EQ(none.pipelines_made, 0u) << "the same pipelines";
  EXPECT_EQ(renderer->device_memory_bytes(), plain_bytes);
  EXPECT_FALSE(none.effects.on(Effect::kFixedLight));
  // Switched off by the user: its pipelines are those of a scene without.
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, light_of(scene, {{8, 5, 8}})));
  input.effects[static_cast<std::size_t>(Effect::kFixedLight)] = 0;
  const FrameResult off = renderer->draw(input);
  EXPECT_EQ(off.pipelines_made, 0u);
  EXPECT_EQ(off.draws, plain.draws);
}

/// A slab 5 m above: there is no lamp, and it is a roof only where something says that the sky does not reach it.
TEST(FixedLight, ARoofIsWhatStandsAboveWhereTheSkyDoesNotReach) {
  Scene scene;
  scene.materials = {{.name = "slab"}};
  for (const glm::vec3& corner : {glm::vec3(0, 0, 5), {10, 0, 5}, {10, 10, 5}, {0, 10, 5}})
    scene.vertices.push_back({corner, {0, 0, -1}});
  scene.indices = {0, 2, 1, 0, 3, 2};
  SceneChunk slab{.node = "slab"};
  slab.index_count = 6, slab.vertex_count = 4;
  slab.low_m = {0, 0, 5}, slab.high_m = {10, 10, 5};
  scene.chunks = {slab};
  EXPECT_FALSE(light_of(scene, {})->roofed({5, 5, 1}));
  scene.materials[0].sky_share = 0.0f;
  const auto light = light_of(scene, {});
  EXPECT_TRUE(light->roofed({5, 5, 1}));
  EXPECT_FALSE(light->roofed({5, 5, 6})) << "above it";
  EXPECT_FALSE(light->roofed({11, 5, 1})) << "beside it";
}

TEST_F(FixedLightOnDevice, ASurfaceThatShinesHasItsLuminanceAndARoofKeepsTheSkyOut) {
  Scene scene = yard();
  for (SceneMaterial& material : scene.materials) material.surface = Surface::kPlain;
  scene.materials[0].sky_share = 0.0f;
  scene.materials[1].emission_cdm2 = {20.0f, 10.0f, 5.0f};
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, light_of(scene, {})));
  FrameInput input = dark_view();
  input.sky_luminance_cdm2 = 0.5;
  input.camera.eye_m = {10.0, -2.0, 1.5};
  input.camera.world_from_eye = aim_rotation(0.0, 0.0, 0.0);
  const FrameResult result = renderer->draw(input);
  EXPECT_EQ(result.effects[Effect::kFixedLight].reason, "1 luminous material, a roof over the road");
  const glm::vec4 wall = seen_at(*renderer, input, 160, 85).pixel, road = seen_at(*renderer, input, 160, 170).pixel;
  // Of the sky the wall has a part besides: half of the dome, 0.5 cd/m² and three times that at the horizon.
  EXPECT_GT(wall.x, 20.0f - 0.02f);
  EXPECT_LT(wall.x, 20.0f + 0.6f * 3.0f * 0.5f * 1.0f + 0.02f);
  EXPECT_GT(wall.x - wall.z, 14.0f) << "its own colour";
  EXPECT_EQ(wall.w, 0.0f) << "no illuminance";
  EXPECT_EQ(luminance(road), 0.0);
}

/// E = L·Ω, Ω = 2π(1 - cos 0.259°) sr: 0.2 lx are 3118 cd/m² of the disc; colour of 4100 K by its luminance. Half
/// floats hold it within 2^-11. The road has E·sin(elevation), and beside the disc there is the sky alone.
TEST_F(FixedLightOnDevice, TheMoonIsADiscAndLightsTheRoad) {
  Scene scene = yard();
  scene.materials[0].surface = Surface::kPlain;
  const MoonConfig moon{.azimuth_rad = 0.0, .elevation_rad = 0.2, .illuminance_lx = 0.2};
  auto light = FixedLight::of(scene, {}, moon);
  ASSERT_TRUE(light);
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, std::make_shared<const FixedLight>(std::move(*light))));
  FrameInput input = dark_view();
  input.camera.fov_horizontal_rad = 0.1;  // the disc is 29 pixels wide
  input.camera.world_from_eye = aim_rotation(0.0, 0.2, 0.0);
  const FrameResult result = renderer->draw(input);
  EXPECT_EQ(result.effects[Effect::kFixedLight].reason, "the moon");
  const double steradians = 2.0 * std::numbers::pi * (1.0 - std::cos(0.00452));
  EXPECT_NEAR(luminance(seen_at(*renderer, input, 160, 90).pixel), 0.2 / steradians, 2e-3 * 0.2 / steradians);
  EXPECT_EQ(luminance(seen_at(*renderer, input, 185, 90).pixel), 0.0);
  EXPECT_GT(luminance(seen_at(*renderer, input, 171, 90).pixel), 0.0);
  input = dark_view();
  input.camera.world_from_eye = aim_rotation(0.0, -0.3, 0.0);
  renderer->draw(input);
  const Seen road = seen_at(*renderer, input, 20, 120);
  EXPECT_NEAR(static_cast<double>(road.pixel.w), 0.2 * std::sin(0.2), 1e-3 * 0.2);
}

/// A wet level road under one lamp: the film's lobe at the place of the ground where the lamp is mirrored, in float64.
TEST_F(FixedLightOnDevice, WetGroundMirrorsTheLamp) {
  Scene scene = yard();
  scene.chunks.pop_back();  // no wall
  const auto light = light_of(scene, {{25, 0.37, 8}});
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, light));
  FrameInput input = dark_view();
  input.lamps = driver_view().lamps;  // ground is wet for lamps; these are dark
  BeamImage dark = image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0));
  for (float& cd : dark.candela) cd *= 1e-6f;
  renderer->set_beam(0, dark);
  input.effects[static_cast<std::size_t>(Effect::kWetGround)] = 2;
  const FrameResult result = renderer->draw(input);
  ASSERT_EQ(result.effects.level(Effect::kWetGround), 2u);
  // Straight ahead, between eye and lamp: find the brightest row of the middle column.
  double best = 0.0;
  Seen brightest{};
  for (int y = 95; y < 178; ++y) {
    const Seen seen = seen_at(*renderer, input, 160, y);
    if (luminance(seen.pixel) > best) best = luminance(seen.pixel), brightest = seen;
  }
  const glm::dvec3 eye = input.camera.eye_m, lamp{25, 0.37, 8};
  const glm::dvec3 to_lamp = lamp - brightest.at, toward_lamp = glm::normalize(to_lamp),
                   toward_eye = glm::normalize(eye - brightest.at), half = glm::normalize(toward_lamp + toward_eye);
  const double lx = 1000.0 * toward_lamp.z / glm::dot(to_lamp, to_lamp);
  const double lobe = static_cast<double>(
      shader::water_lobe(0.05f, static_cast<float>(toward_lamp.z), static_cast<float>(toward_eye.z),
                         static_cast<float>(half.z), static_cast<float>(glm::dot(half, toward_eye))));
  // What the wet asphalt itself sends is below 2 % of it; a pixel's middle is taken for its ray, as the shader does.
  const double body = 0.06 * light->lux_at(brightest.at, {0, 0, 1}) / std::numbers::pi;
  EXPECT_GT(best, 5.0 * body);
  EXPECT_NEAR(best, lx * lobe + 0.5 * body, 0.5 * body + 0.01 * lx * lobe);
  input.effects[static_cast<std::size_t>(Effect::kWetGround)] = 0;
  renderer->draw(input);
  EXPECT_LT(luminance(seen_at(*renderer, input, 160, 120).pixel), 0.2 * best);
}

TEST_F(FixedLightOnDevice, WhatMovesIsLitWhereItIs) {
  Scene board;
  board.materials = {{.name = "board", .reflectance = glm::vec3(0.5f)}};
  for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
    board.vertices.push_back({glm::vec3(x, y, 0), glm::vec3(0, 0, 1)});
  board.indices = {0, 1, 2, 0, 2, 3};
  board.chunks = {{.node = "board", .low_m = {-1, -1, 0}, .high_m = {1, 1, 0}, .index_count = 6, .vertex_count = 4}};
  const Scene scene = yard();
  const auto light = light_of(scene, {{8, 0, 8}});
  ASSERT_TRUE(renderer->load_scene(scene, board, light));
  FrameInput input = dark_view();
  const glm::dvec3 at{8, 0.37, 0.5};
  input.moving = {{0, at}, {9, at}};  // one that is unknown, too
  renderer->draw(input);
  const ImageF picture = renderer->read_hdr();
  // In the middle column, the row in which it lies.
  const double down = std::atan2(1.22 - 0.5, 9.5), half_fov = 0.5 * 1.0471975511965976;
  const int y = static_cast<int>(90.0 + 160.0 * std::tan(down) / std::tan(half_fov));
  const float* p = &picture.rgba[4 * static_cast<std::size_t>(y * picture.width_px + 160)];
  const FixedProbe probe = light->probe(at);
  const double lx = static_cast<double>(probe.light.w) * (0.25 + static_cast<double>(probe.way.z));
  EXPECT_NEAR(static_cast<double>(p[3]), lx, 1e-3 * lx);
  EXPECT_NEAR(lx, light->lux_at(at, {0, 0, 1}), 0.25 * static_cast<double>(probe.light.w));
}

/// L = Σ E·q by the table's lobes in float64, from an eye low over the road. Tolerance: as of lux, and twice that for
/// luminance seen from far away. Near the eye the azimuth of sight changes between corners: a Lorentzian of half width
/// w is off by (Δ/2w)² of its peak in the middle of Δ; sides of 1.5 m are left whole, and the sharpest streak here, of
/// the lamp at 52 m, has w 0.087. So it is 5 % at 40 m and 19 % at 20 m; nearer than 10 m it is not asked.
TEST_F(FixedLightOnDevice, AsphaltHasTheLuminanceOfItsRTable) {
  Scene scene = yard();
  scene.chunks.pop_back();                       // no wall
  scene.materials[0].surface = Surface::kPlain;  // no grain
  scene.materials[0].r_table = true;
  const std::vector<glm::dvec3> lamps{{20, 5, 8}, {40, -5, 8}, {52, 5, 8}};
  const auto light = light_of(scene, lamps);
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, light));
  FrameInput input = dark_view();
  input.camera.eye_m = {-4.0, 0.0, 1.0};
  input.camera.fov_horizontal_rad = 0.6;
  const FrameResult result = renderer->draw(input);
  EXPECT_EQ(result.effects[Effect::kAsphalt].reason, "street lamps or the moon shine on asphalt");
  const RoadLobes asphalt = RoadLobes::asphalt();
  int tried = 0;
  double brightest = 0.0;
  for (int y = 99; y < 145; y += 3)
    for (int x = 40; x < 300; x += 20) {
      const Seen seen = seen_at(*renderer, input, x, y);
      if (seen.at.x > 55.0 || std::abs(seen.at.y) > 9.0 || seen.at.x - input.camera.eye_m.x < 10.0) continue;
      const glm::dvec3 way = glm::normalize(seen.at - input.camera.eye_m);
      double by_table = 0.0;
      for (const glm::dvec3& lamp : lamps) {
        const glm::dvec3 to = lamp - seen.at;
        const double level_m = std::hypot(to.x, to.y), r2 = glm::dot(to, to), tangent = level_m / to.z;
        const double cos_beta = (to.x * way.x + to.y * way.y) / (level_m * std::hypot(way.x, way.y));
        by_table += 1000.0 * to.z / (r2 * std::sqrt(r2)) * std::pow(1.0 + tangent * tangent, 1.5) *
                    asphalt.at(tangent).r_per_sr(cos_beta);
      }
      const double rho = 0.1, diffuse = light->lux_at(seen.at, {0, 0, 1}) * rho / std::numbers::pi;
      const double share = static_cast<double>(shader::by_the_table(static_cast<float>(-way.z)));
      const double exact = diffuse + share * (by_table - diffuse);
      const double corners_rad = 1.5 / glm::distance(seen.at, input.camera.eye_m);
      const double near = share * std::min(std::pow(corners_rad / (2.0 * 0.087), 2.0), 0.5);
      EXPECT_NEAR(luminance(seen.pixel), exact, exact * (4.0 * kBakeLevels[2].tolerance + near)) << x << ' ' << y;
      EXPECT_NEAR(static_cast<double>(seen.pixel.w), light->lux_at(seen.at, {0, 0, 1}),
                  (4.0 / 3.0 * kBakeLevels[2].tolerance + 5e-4) * static_cast<double>(seen.pixel.w))
          << "lux are what they are";
      brightest = std::max(brightest, exact / diffuse);
      ++tried;
    }
  EXPECT_GT(tried, 40);
  EXPECT_GT(brightest, 2.0);
  // Set to be diffuse, and from above.
  input.effects[static_cast<std::size_t>(Effect::kAsphalt)] = 0;
  renderer->draw(input);
  Seen seen = seen_at(*renderer, input, 160, 110);
  EXPECT_NEAR(luminance(seen.pixel), static_cast<double>(seen.pixel.w) * 0.1 / std::numbers::pi,
              2e-3 * luminance(seen.pixel));
  input.effects = {};
  input.camera.eye_m = {20.0, 0.0, 30.0};
  input.camera.world_from_eye = aim_rotation(0.0, -1.5, 0.0);
  renderer->draw(input);
  seen = seen_at(*renderer, input, 100, 60);
  EXPECT_NEAR(luminance(seen.pixel), static_cast<double>(seen.pixel.w) * 0.1 / std::numbers::pi,
              5e-3 * luminance(seen.pixel));
}

/// No draw, no pass, no image; what is no asphalt, or not lit, keeps none of it.
TEST_F(FixedLightOnDevice, AnRTableIsNoDrawAndNoPassMore) {
  Scene scene = yard();
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  FrameInput input = driver_view();
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, light_of(scene, {{8, 5, 8}})));
  const FrameResult diffuse = renderer->draw(input);
  EXPECT_EQ(diffuse.effects[Effect::kAsphalt].reason, "no street lamp and no moon shines on asphalt");
  ASSERT_TRUE(renderer->load_scene(scene));
  renderer->draw(input);
  renderer->draw(input);
  ASSERT_TRUE(renderer->load_scene(scene));  // what was there before is gone
  renderer->draw(input);
  const std::uint64_t bytes = renderer->device_memory_bytes();
  scene.materials[0].r_table = true;
  ASSERT_TRUE(renderer->load_scene(scene));
  const FrameResult dark = renderer->draw(input);
  EXPECT_FALSE(dark.effects.on(Effect::kAsphalt));
  EXPECT_EQ(dark.pipelines_made, 0u);
  EXPECT_EQ(renderer->device_memory_bytes(), bytes);
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, light_of(scene, {{8, 5, 8}})));
  const FrameResult by_table = renderer->draw(input);
  EXPECT_TRUE(by_table.effects.on(Effect::kAsphalt));
  EXPECT_EQ(by_table.draws, diffuse.draws);
  EXPECT_EQ(by_table.pass_count, diffuse.pass_count);
  EXPECT_EQ(by_table.image_bytes, diffuse.image_bytes);
  input.effects[static_cast<std::size_t>(Effect::kAsphalt)] = 0;
  EXPECT_EQ(renderer->draw(input).pipelines_made, 0u) << "those of diffuse ground";
}

/// Every shader that is made for it, under validation; what is interpolated is no method's matter.
TEST_F(FixedLightOnDevice, EveryMethodLevelAndAirDrawsIt) {
  Scene scene = yard();
  scene.materials[0].r_table = true;
  Scene board;
  board.materials = {{.name = "board"}};
  board.vertices = {{{0, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 0, 1}}, {{0, 1, 0}, {0, 0, 1}}};
  board.indices = {0, 1, 2};
  board.chunks = {{.node = "board", .low_m = {0, 0, 0}, .high_m = {1, 1, 0}, .index_count = 3, .vertex_count = 3}};
  for (const ImageLevel level : {ImageLevel::kFloatNodes, ImageLevel::kHalfEven}) {
    Result<Renderer> made =
        Renderer::create({.width_px = 160, .height_px = 90, .validation = true, .beam_level = level});
    ASSERT_TRUE(made);
    ASSERT_TRUE(made->load_scene(scene, board, light_of(scene, {{8, 5, 8}, {20, -5, 8}})));
    made->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
    for (const Method method : {Method::kFragment, Method::kVertex, Method::kVertex1998, Method::kReference}) {
      if (method == Method::kReference && (made->no_reference() || level != ImageLevel::kFloatNodes)) continue;
      for (const std::size_t lamps : {2u, 8u})
        for (const bool fog : {false, true}) {
          // Of eight lamps one method, for it takes a software device seconds to compile each of these.
          if (lamps == 8 && (method != Method::kFragment || level != ImageLevel::kFloatNodes)) continue;
          if (method == Method::kReference && fog) continue;
          FrameInput input = driver_view();
          input.method = method;
          input.lamps.resize(lamps, input.lamps.front());
          input.moving = {{0, {6, 0, 1}}};
          if (fog) input.air.visibility_m = 100.0;
          input.effects[static_cast<std::size_t>(Effect::kShadows)] = fog ? 0 : 1;
          const FrameResult drawn = made->draw(input);
          EXPECT_TRUE(drawn.effects.on(Effect::kFixedLight) && drawn.effects.on(Effect::kAsphalt));
        }
    }
    EXPECT_EQ(made->validation_messages(), 0u);
  }
}

}  // namespace
}  // namespace phare
