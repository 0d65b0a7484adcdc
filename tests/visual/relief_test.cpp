// reference: normals, roughness and metal of glTF's textures under a lamp are what glTF 2.0 says of them, computed here
// again in float64; lux stays that of the surface; and who has none of it pays nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <random>

#include "tests/visual/textured_wall.h"
#include "visual/fixed_light.h"
#include "visual/scene/relief.h"
#include "visual/scene/tangents.h"

namespace phare {
namespace {

// Of the wall as the eye sees it: tangent to the right, bitangent up, normal toward the eye.
const glm::dvec3 kRight(0, -1, 0), kUp(0, 0, 1), kFront(-1, 0, 0);

Scene relief_wall(const SceneMaterial& material, std::vector<SceneTexture> textures, double at_m = kWall_m) {
  Scene scene = wall(material, std::move(textures), at_m);
  for (CornerLook& look : scene.looks) look.tangent = packed_tangent(glm::vec3(kRight), 1.0f);
  return scene;
}

SceneMaterial plain_material() {
  SceneMaterial material{.name = "relief", .reflectance = glm::vec3(0.5f)};
  material.look.base = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
  material.look.sampler.nearest = true;
  return material;
}

glm::u8vec4 normal_byte(const glm::dvec3& n) {
  return glm::u8vec4(glm::round((glm::dvec4(n, 1.0) + glm::dvec4(1, 1, 1, 0)) * glm::dvec4(127.5, 127.5, 127.5, 255.0)));
}

glm::dvec3 normal_of(glm::u8vec4 texel) {
  return glm::normalize(glm::dvec3(texel) / 127.5 - 1.0);
}

glm::dvec3 in_world(const glm::dvec3& n) { return n.x * kRight + n.y * kUp + n.z * kFront; }

/// Smith's masking of Gaussian slopes, exactly; `slopes`: mean square of both.
double smith(double slopes, double cosine) {
  const double a = cosine / std::sqrt((1.0 - cosine * cosine) * slopes);
  const double lambda = 0.5 * (std::exp(-a * a) / (a * std::sqrt(std::numbers::pi)) - std::erfc(a));
  return 1.0 / (1.0 + lambda);
}
constexpr double kFit = 0.0036;  // of the rational form that shaders have (Walter et al. 2007: 0.35 %)

class Relief : public Textured {};

TEST_F(Relief, ANormalTextureTurnsTheLightAndNotTheLux) {
  // Four texels of 4 m, each tilted another way.
  const std::array<glm::dvec3, 4> tilted{glm::dvec3(0.4, 0.1, 0), {-0.4, -0.1, 0}, {0.1, 0.5, 0}, {-0.1, -0.5, 0}};
  SceneTexture normals{"normals", 2, 2, {}};
  std::array<glm::dvec3, 4> n;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::u8vec4 texel = normal_byte(glm::normalize(tilted[i] + glm::dvec3(0, 0, 1)));
    for (int c = 0; c < 4; ++c) normals.rgba.push_back(texel[c]);
    n[i] = normal_of(texel);
  }
  const double slopes = static_cast<double>(normal_levels(normals, 1.0f, true).front().slopes());
  SceneMaterial material = plain_material();
  material.look.normal_texture = 0;
  const double lamp_y_m = 3.0;
  const ImageF picture = drawn(view(relief_wall(material, {normals}), lamp_y_m));
  std::array<int, 4> met{};
  for (int y = 20; y < 160; y += 9)
    for (int x = 70; x < 250; x += 9) {
      const Pixel seen = pixel(picture, x, y);
      const glm::dvec2 texel((4.0 - seen.at_m.x) / 4.0, (4.0 - seen.at_m.y) / 4.0);
      if (std::abs(texel.x - 1.0) < 0.05 || std::abs(texel.y - 1.0) < 0.05 || texel.x < 0.02 || texel.y < 0.02 ||
          texel.x > 1.98 || texel.y > 1.98)
        continue;
      const std::size_t which = (texel.x > 1.0 ? 1u : 0u) + (texel.y > 1.0 ? 2u : 0u);
      ++met[which];
      const glm::dvec3 to_lamp(-kWall_m, lamp_y_m - seen.at_m.x, -seen.at_m.y), toward = glm::normalize(to_lamp);
      const double normal_lx = kLamp_cd / glm::dot(to_lamp, to_lamp), cosine = toward.x * -1.0;
      const double lx = normal_lx * std::max(glm::dot(in_world(n[which]), toward), 0.0) * smith(slopes, cosine);
      EXPECT_NEAR(seen.cdm2.y / (0.5 * kColour.y * lx / std::numbers::pi), 1.0, kTolerance + kFit)
          << x << ' ' << y;
      EXPECT_NEAR(seen.lx / wall_lx(seen.at_m, lamp_y_m), 1.0, kTolerance);
    }
  for (const int count : met) EXPECT_GT(count, 20);
}

/// Of one lamp that stands in the scene whence its light comes is (to the lamp)/(how far it is before the wall), which
/// is linear on the wall, so corners keep it exactly; lux, interpolated, is taken as the pixel has it.
TEST_F(Relief, ALampOfTheSceneIsTurnedAsThoseOfTheCarAre) {
  const std::array<glm::dvec3, 4> tilted{glm::dvec3(0.4, 0.1, 0), {-0.4, -0.1, 0}, {0.1, 0.5, 0}, {-0.1, -0.5, 0}};
  SceneTexture normals{"normals", 2, 2, {}};
  std::array<glm::dvec3, 4> n;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::u8vec4 texel = normal_byte(glm::normalize(tilted[i] + glm::dvec3(0, 0, 1)));
    for (int c = 0; c < 4; ++c) normals.rgba.push_back(texel[c]);
    n[i] = normal_of(texel);
  }
  const double slopes = static_cast<double>(normal_levels(normals, 1.0f, true).front().slopes());
  SceneMaterial material = plain_material();
  material.look.normal_texture = 0;
  Scene scene = relief_wall(material, {normals});
  const glm::dvec3 bulb_m(kWall_m - 6.0, 2.0, 1.0);
  scene.lights.push_back({.name = "bulb", .position_m = bulb_m, .intensity = 4000.0});
  auto light = FixedLight::of(scene, {}, std::nullopt);
  ASSERT_TRUE(light);
  FrameInput input = view(scene);
  input.lamps.clear();
  ASSERT_TRUE(renderer->load_scene(scene, Scene{}, std::make_shared<const FixedLight>(std::move(*light))));
  const ImageF picture = drawn(input);
  double strongest = 0.0;
  int met = 0;
  for (int y = 20; y < 160; y += 9)
    for (int x = 70; x < 250; x += 9) {
      const Pixel seen = pixel(picture, x, y);
      const glm::dvec2 texel((4.0 - seen.at_m.x) / 4.0, (4.0 - seen.at_m.y) / 4.0);
      if (std::abs(texel.x - 1.0) < 0.05 || std::abs(texel.y - 1.0) < 0.05 || texel.x < 0.02 || texel.y < 0.02 ||
          texel.x > 1.98 || texel.y > 1.98)
        continue;
      ++met;
      const std::size_t which = (texel.x > 1.0 ? 1u : 0u) + (texel.y > 1.0 ? 2u : 0u);
      const glm::dvec3 toward = glm::normalize(bulb_m - glm::dvec3(kWall_m, seen.at_m));
      const double cosine = glm::dot(toward, kFront);
      const double turned = std::max(glm::dot(in_world(n[which]), toward), 0.0) / cosine * smith(slopes, cosine);
      EXPECT_NEAR(seen.cdm2.y / (0.5 * seen.lx * turned / std::numbers::pi), 1.0, 2.0 * kTolerance + kFit)
          << x << ' ' << y;
      strongest = std::max(strongest, std::abs(turned - 1.0));
    }
  EXPECT_GT(met, 100);
  EXPECT_GT(strongest, 0.2) << "there is something to be told apart";
}

/// Of all lamps that shine on a corner together; none of what has one number for both sides, or shines itself.
TEST_F(Relief, CornersKeepWhenceLampsOfTheSceneShine) {
  SceneMaterial material = plain_material();
  material.look.normal_texture = 0;
  Scene scene = wall(material, {chess(1, {128, 128, 255, 255}, {128, 128, 255, 255})});
  const std::array<glm::dvec3, 2> bulbs_m{glm::dvec3(kWall_m - 6.0, 2.0, 1.0), glm::dvec3(kWall_m - 2.0, -3.0, 2.0)};
  for (const glm::dvec3& bulb_m : bulbs_m)
    scene.lights.push_back({.name = "bulb", .position_m = bulb_m, .intensity = 4000.0});
  auto light = FixedLight::of(scene, {}, std::nullopt);
  ASSERT_TRUE(light);
  const glm::dvec3 at_m(kWall_m, 1.0, -2.0), facet = glm::normalize(glm::dvec3(-1.0, 0.2, 0.3));
  double on_facet_lx = 0.0, on_wall_lx = 0.0;
  for (const glm::dvec3& bulb_m : bulbs_m) {
    const glm::dvec3 way = bulb_m - at_m;
    on_facet_lx += 4000.0 * glm::dot(way, facet) / std::pow(glm::length(way), 3.0);
    on_wall_lx += 4000.0 * glm::dot(way, kFront) / std::pow(glm::length(way), 3.0);
  }
  FixedWay way(9.0f);
  EXPECT_NEAR(static_cast<double>(light->at(at_m, kFront, material, nullptr, &way).light.w), on_wall_lx, 1e-5);
  EXPECT_NEAR(on_wall_lx * glm::dot(glm::dvec3(way), facet), on_facet_lx, 1e-5 * on_facet_lx);
  EXPECT_NEAR(glm::dot(glm::dvec3(way), kFront), 1.0, 1e-6);
  light->at(at_m, -kFront, material, nullptr, &way);
  EXPECT_EQ(way, glm::vec3(-kFront)) << "in the dark";
  material.double_sided = true;
  light->at(at_m, kFront, material, nullptr, &way);
  EXPECT_EQ(way, glm::vec3(0.0f));
  material.double_sided = false;
  material.emission_cdm2 = glm::vec3(1.0f);
  light->at(at_m, kFront, material, nullptr, &way);
  EXPECT_EQ(way, glm::vec3(0.0f));
}

/// What moves has the surface's own light of lamps of the scene; so has what is rough alone, also where it is curved.
TEST_F(Relief, WhatNoLampOfTheSceneTurnsIsAsBrightAsWithoutIt) {
  const SceneTexture tilted{"tilted", 1, 1, {180, 128, 200, 255}};
  for (const bool moves : {true, false}) {
    std::array<Pixel, 2> seen;
    for (const bool turned : {false, true}) {
      SceneMaterial material = with_texture(glm::vec4(1.0f));
      if (turned) material.look.rough_texture = 1;
      if (turned && moves) material.look.normal_texture = 1;
      const SceneTexture grey = chess(1, {188, 188, 188, 255}, {188, 188, 188, 255});
      Scene drawn_so = relief_wall(material, {grey, tilted}, moves ? 0.0 : kWall_m);
      if (!moves)  // as if bulged
        for (SceneVertex& vertex : drawn_so.vertices)
          vertex.normal = glm::normalize(glm::vec3(-1.0f, 0.2f * vertex.position_m.y, 0.2f * vertex.position_m.z));
      Scene stands = moves ? wall({.name = "plain"}, {}, 30.0, false) : drawn_so;
      stands.lights.push_back({.name = "bulb", .position_m = {2.0, 1.0, 3.0}, .intensity = 4000.0});
      auto light = FixedLight::of(stands, {}, std::nullopt);
      ASSERT_TRUE(light);
      FrameInput input = view(stands);
      input.lamps.clear();
      if (moves) input.moving = {{0, {kWall_m, 0, 0}}};
      ASSERT_TRUE(renderer->load_scene(stands, moves ? drawn_so : Scene{},
                                       std::make_shared<const FixedLight>(std::move(*light))));
      seen[turned ? 1 : 0] = pixel(drawn(input), 150, 80);
    }
    EXPECT_GT(seen[0].cdm2.y, 1.0);
    EXPECT_NEAR(seen[1].cdm2.y / seen[0].cdm2.y, 1.0, kTolerance) << moves;
    EXPECT_NEAR(seen[1].lx / seen[0].lx, 1.0, kTolerance) << moves;
  }
}

/// Not what has textures but no relief, nor a relief where nothing shines.
TEST_F(Relief, OnlyUnderLampsOfTheSceneItKeepsWhenceTheyShine) {
  const SceneTexture picture = chess(1, {128, 128, 255, 255}, {128, 128, 255, 255});
  const auto bytes = [&](bool relief, bool lamp) {
    SceneMaterial material = with_texture(glm::vec4(1.0f));
    if (relief) material.look.normal_texture = 0;
    Scene scene = relief_wall(material, {picture});
    // Many corners, for memory is counted in blocks.
    while (scene.vertices.size() < 40000) {
      const std::size_t count = scene.vertices.size();
      for (std::size_t i = 0; i < count; ++i) {
        scene.vertices.push_back(scene.vertices[i]);
        scene.looks.push_back(scene.looks[i]);
      }
    }
    scene.chunks[0].vertex_count = static_cast<std::uint32_t>(scene.vertices.size());
    if (lamp) scene.lights.push_back({.name = "bulb", .position_m = {2.0, 1.0, 3.0}, .intensity = 4000.0});
    auto light = FixedLight::of(scene, {}, std::nullopt);
    EXPECT_TRUE(light);
    FrameInput input = view(scene);
    EXPECT_TRUE(renderer->load_scene(scene, Scene{}, std::make_shared<const FixedLight>(std::move(*light))));
    for (int i = 0; i < 3; ++i) drawn(input);
    return static_cast<double>(renderer->device_memory_bytes());
  };
  const double of_lamp = bytes(false, true) - bytes(false, false), with_relief = bytes(true, true) - bytes(true, false);
  EXPECT_GT(with_relief - of_lamp, 40000.0 * sizeof(FixedWay));
}

TEST_F(Relief, OnTheAverageALowLampGivesWhatItGivesTheSurface) {
  // Gaussian slopes of 0.2 each way; the lamp half a metre before the wall, 5° and less over it.
  std::mt19937 random(7);
  std::normal_distribution<double> slope(0.0, 0.2);
  SceneTexture normals{"normals", 64, 64, {}};
  for (int i = 0; i < 64 * 64; ++i) {
    const glm::u8vec4 texel = normal_byte(glm::normalize(glm::dvec3(slope(random), slope(random), 1.0)));
    for (int c = 0; c < 4; ++c) normals.rgba.push_back(texel[c]);
  }
  SceneMaterial material = plain_material();
  material.look.normal_texture = 0;
  for (const bool nearest : {true, false}) {
    material.look.sampler.nearest = nearest;
    FrameInput input = view(relief_wall(material, {normals}));
    input.lamps[0].position_m = {kWall_m - 0.5, -7.0, 0.0};
    input.lamps[0].world_from_image = glm::dmat3{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};  // looks along y
    const ImageF picture = drawn(input);
    double luminous = 0.0, lux = 0.0;
    for (int y = 30; y < 150; ++y)
      for (int x = 80; x < 240; ++x) {
        const Pixel seen = pixel(picture, x, y);
        luminous += seen.cdm2.y / kColour.y * std::numbers::pi / 0.5;
        lux += seen.lx;
      }
    // 2,000 texels are seen: their mean is 2 % off by chance; facets are seen as large as their base is, not as they
    // are: mean(n_z) = 0.963 of it, more where what lies between texels is smoother.
    EXPECT_GT(lux, 0.0);
    EXPECT_GT(luminous / lux, 0.963 - 0.02 - kFit) << nearest;
    EXPECT_LT(luminous / lux, 1.0 + 0.02 + kFit) << nearest;
  }
}

TEST_F(Relief, FarAwayItIsTheMeanOfItsFacets) {
  SceneTexture normals{"normals", 512, 512, {}};
  const double tilt = std::numbers::pi / 6.0;
  for (int i = 0; i < 512 * 512; ++i) {
    const glm::u8vec4 texel = normal_byte({(i % 2 == 0 ? 1.0 : -1.0) * std::sin(tilt), 0.0, std::cos(tilt)});
    for (int c = 0; c < 4; ++c) normals.rgba.push_back(texel[c]);
  }
  SceneMaterial material = plain_material();
  material.look.normal_texture = 0;
  material.look.sampler.nearest = false;
  FrameInput input = view(relief_wall(material, {normals}, 200.0));
  input.far_mesh_from_m = std::numeric_limits<double>::infinity();
  const Pixel seen = pixel(drawn(input), 159, 89, 200.0);
  // The file's own rounding to bytes: half of 1/127.5 of sin(30°) and cos(30°), 0.001 of the mean.
  EXPECT_NEAR(seen.cdm2.y / (0.5 * kColour.y * kLamp_cd / 4e4 / std::numbers::pi), std::cos(tilt), 0.001 + kTolerance);
}

/// glTF 2.0, appendix B.3, on its own.
glm::dvec3 by_gltf(const glm::dvec3& base, double roughness, double metal, const glm::dvec3& n, const glm::dvec3& l,
                   const glm::dvec3& v) {
  const glm::dvec3 h = glm::normalize(l + v);
  const double a2 = std::pow(roughness, 4.0), nl = glm::dot(n, l), nv = glm::dot(n, v), nh = glm::dot(n, h);
  const double d = a2 / (std::numbers::pi * std::pow(nh * nh * (a2 - 1.0) + 1.0, 2.0));
  const double g = 2.0 * nl / (nl + std::sqrt(a2 + (1.0 - a2) * nl * nl)) * 2.0 * nv /
                   (nv + std::sqrt(a2 + (1.0 - a2) * nv * nv));
  // Its text allows the joint form, which ours is: 1/G - 1 is the sum of both.
  const double joint = 1.0 / (0.5 * std::sqrt(a2 + (1.0 - a2) * nl * nl) / nl +
                              0.5 * std::sqrt(a2 + (1.0 - a2) * nv * nv) / nv);
  EXPECT_LE(g, joint + 1e-12);
  const double specular = d * joint / (4.0 * nl * nv), rise = std::pow(1.0 - glm::dot(v, h), 5.0);
  const double layer = 0.04 + 0.96 * rise;
  const glm::dvec3 dielectric = base / std::numbers::pi * (1.0 - layer) + specular * layer;
  const glm::dvec3 metallic = specular * (base + (1.0 - base) * rise);
  return glm::mix(dielectric, metallic, metal);
}

TEST_F(Relief, RoughnessAndMetalAreThoseOfGltf) {
  for (const auto& [rough, metal] : {std::pair(200, 0), {100, 0}, {120, 255}, {220, 255}, {150, 128}}) {
    SceneTexture texture{"rough", 1, 1,
                         {0, static_cast<std::uint8_t>(rough), static_cast<std::uint8_t>(metal), 255}};
    SceneMaterial material = plain_material();
    material.look.base = {0.8f, 0.5f, 0.2f, 1.0f};
    material.look.rough_texture = 0;
    material.look.roughness = 0.9f;
    const double lamp_y_m = 4.0;
    const ImageF picture = drawn(view(relief_wall(material, {texture}), lamp_y_m));
    double brightest = 0.0;
    for (int y = 40; y < 140; y += 10)
      for (int x = 80; x < 240; x += 8) {
        const Pixel seen = pixel(picture, x, y);
        const glm::dvec3 at(kWall_m, seen.at_m.x, seen.at_m.y), to_lamp = glm::dvec3(0, lamp_y_m, 0) - at;
        const glm::dvec3 expected = by_gltf({0.8, 0.5, 0.2}, 0.9 * rough / 255.0, metal / 255.0, kFront,
                                            glm::normalize(to_lamp), glm::normalize(-at)) *
                                    wall_lx(seen.at_m, lamp_y_m);
        brightest = std::max(brightest, expected.y);
        for (int c = 0; c < 3; ++c)
          // float32 in 1 - cos² of the half way, at alpha 0.12: 2^-23/0.015 four times.
          EXPECT_NEAR(seen.cdm2[c] / (kColour[c] * expected[c]), 1.0, kTolerance + 1e-4)
              << rough << ' ' << metal << ' ' << x << ' ' << y << ' ' << c;
        EXPECT_NEAR(seen.lx / wall_lx(seen.at_m, lamp_y_m), 1.0, kTolerance);
      }
    EXPECT_GT(brightest, 0.0);
  }
}

TEST_F(Relief, TheBackOfASurfaceHasItsNormalTurnedRound) {
  SceneTexture normals{"normals", 1, 1, {}};
  const glm::u8vec4 texel = normal_byte(glm::normalize(glm::dvec3(0.5, 0.2, 1.0)));
  for (int c = 0; c < 4; ++c) normals.rgba.push_back(texel[c]);
  SceneMaterial material = plain_material();
  material.look.normal_texture = 0;
  material.double_sided = true;
  Scene scene = relief_wall(material, {normals});
  for (SceneVertex& vertex : scene.vertices) vertex.normal = {1, 0, 0};  // looks away
  std::swap(scene.indices[1], scene.indices[2]);
  std::swap(scene.indices[4], scene.indices[5]);
  const Pixel seen = pixel(drawn(view(scene, 3.0)), 120, 60);
  const glm::dvec3 n = normal_of(texel), back(1, 0, 0), up = glm::cross(back, kRight);
  const glm::dvec3 shaded = -(n.x * kRight + n.y * up + n.z * back);
  const glm::dvec3 to_lamp(-kWall_m, 3.0 - seen.at_m.x, -seen.at_m.y), toward = glm::normalize(to_lamp);
  const double slopes = static_cast<double>(normal_levels(normals, 1.0f, true).front().slopes());
  const double lx = kLamp_cd / glm::dot(to_lamp, to_lamp) * glm::dot(shaded, toward) * smith(slopes, -toward.x);
  EXPECT_NEAR(seen.cdm2.y / (0.5 * kColour.y * lx / std::numbers::pi), 1.0, kTolerance + kFit);
}

TEST_F(Relief, EveryMethodNumberOfLampsAndWeatherShowsIt) {
  // Level normals (128 of 255 is taken for that): what a picture without them shows.
  SceneMaterial material = with_texture(glm::vec4(1.0f));
  const SceneTexture grey = chess(1, {188, 188, 188, 255}, {188, 188, 188, 255});
  SceneMaterial relief = material;
  relief.look.normal_texture = 1;
  const SceneTexture level{"level", 1, 1, {128, 128, 255, 255}};
  const auto look = [&](const SceneMaterial& of, std::size_t lamps, Method method, double visibility_m, bool shadows) {
    Scene scene = relief_wall(of, {grey, level});
    if (shadows) {  // a post before the wall
      const Scene post = wall({.name = "post"}, {}, 5.0, false);
      scene.materials.push_back(post.materials[0]);
      scene.chunks.push_back(post.chunks[0]);
      scene.chunks[1].material = 1;
      scene.chunks[1].first_vertex = 4;
      scene.chunks[1].first_index = 6;
      for (SceneVertex vertex : post.vertices) {
        vertex.position_m.y = 0.05f * vertex.position_m.y + 1.0f;
        scene.vertices.push_back(vertex);
      }
      scene.indices.insert(scene.indices.end(), post.indices.begin(), post.indices.end());
    }
    return pixel(drawn(lit_by(view(scene), lamps, method, visibility_m)), 150, 80);
  };
  struct Case {
    std::size_t lamps;
    Method method;
    double visibility_m;
    bool shadows;
  };
  for (const auto& [lamps, method, visibility_m, shadows] :
       {Case{1, Method::kFragment, 0.0, true}, Case{1, Method::kFragment, 80.0, false},
        Case{3, Method::kFragment, 0.0, false}, Case{1, Method::kVertex, 0.0, false},
        Case{1, Method::kReference, 0.0, false}}) {
    if (method == Method::kReference && renderer->no_reference()) continue;
    const Pixel turned = look(relief, lamps, method, visibility_m, shadows),
                other = look(material, lamps, method, visibility_m, shadows);
    EXPECT_NEAR(turned.cdm2.y / other.cdm2.y, 1.0, kTolerance)
        << lamps << " lamps, method " << static_cast<int>(method) << ", " << visibility_m << " m";
    EXPECT_NEAR(turned.lx / other.lx, 1.0, kTolerance);
  }
}

TEST_F(Relief, ATexturedSceneWithoutItPaysNothingForIt) {
  const SceneTexture picture = chess(64, {255, 255, 255, 255}, {0, 0, 0, 255});
  const SceneMaterial material = with_texture(glm::vec4(1.0f));
  FrameInput input = view(wall(material, {picture}));
  for (int i = 0; i < 3; ++i) drawn(input);  // what the tests before called for is freed
  const FrameResult without = last;
  const std::uint64_t bytes = renderer->device_memory_bytes();
  SceneMaterial relief = material;
  relief.look.normal_texture = relief.look.rough_texture = 1;
  const SceneTexture level{"level", 64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 128)};
  input = view(relief_wall(relief, {picture, level}));
  drawn(input);
  EXPECT_GT(renderer->device_memory_bytes(), bytes + 64 * 64 * (8 + 4));
  EXPECT_EQ(last.draws, without.draws);
  EXPECT_EQ(last.pass_count, without.pass_count);
  EXPECT_EQ(last.images, without.images);
  input = view(wall(material, {picture}));
  for (int i = 0; i < 3; ++i) drawn(input);
  EXPECT_EQ(renderer->device_memory_bytes(), bytes);
  EXPECT_EQ(last.pipelines_made, 0u);
}

}  // namespace
}  // namespace phare
