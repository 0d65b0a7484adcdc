// unit: tangents of meshes, levels of detail of normals and roughness, and what shaders do with both.
#include "visual/scene/relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shaders/lib/gloss.h"
#include "tests/scene/gltf_builder.h"
#include "visual/scene/scene.h"
#include "visual/scene/tangents.h"

namespace phare {
namespace {

Scene relief_scene(GltfBuilder& file) {
  Result<Scene> scene = read_scene(file.write("phare_relief.gltf"));
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
  return scene ? *scene : Scene{};
}

/// A square with a normal texture.
GltfBuilder square_with_normals() {
  GltfBuilder file;
  file.square();
  file.material({{"name", "bark"}, {"normalTexture", {{"index", file.texture(png_of(1, 1, {128, 128, 255, 255}))}}}});
  return file;
}

TEST(ReliefTest, TangentsComeFromTextureCoordinates) {
  GltfBuilder file = square_with_normals();
  const Scene scene = relief_scene(file);
  ASSERT_FALSE(scene.looks.empty());
  EXPECT_TRUE(scene.materials.at(0).look.normal_texture);
  // u grows along glTF's x, which is ours; v falls along glTF's y, our z: the picture stands upright, seen from -y.
  for (const CornerLook& look : scene.looks) EXPECT_EQ(look.tangent, glm::i8vec4(127, 0, 0, 127));
  // Mirrored: u grows to -x.
  file = square_with_normals();
  file.floats("TEXCOORD_0", {1, 1, 0, 1, 0, 0, 1, 0}, "VEC2", 2);
  for (const CornerLook& look : relief_scene(file).looks) EXPECT_EQ(look.tangent, glm::i8vec4(-127, 0, 0, -127));
  // Without coordinates: some direction along the surface.
  file = square_with_normals();
  file.primitive()["attributes"].erase("TEXCOORD_0");
  for (const CornerLook& look : relief_scene(file).looks) {
    EXPECT_EQ(look.tangent.y, 0);
    EXPECT_NEAR(glm::length(glm::vec3(look.tangent)), 127.0f, 1.0f);
  }
}

TEST(ReliefTest, TangentsOfTheFileCountWhereItsNormalsDo) {
  GltfBuilder file = square_with_normals();
  const float s = std::sqrt(0.5f);
  file.floats("TANGENT", {s, s, 0, -1, s, s, 0, -1, s, s, 0, -1, s, s, 0, -1}, "VEC4", 4);
  for (const CornerLook& look : relief_scene(file).looks) EXPECT_EQ(look.tangent, glm::i8vec4(127, 0, 0, 127));
  file.floats("NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  for (const CornerLook& look : relief_scene(file).looks) EXPECT_EQ(look.tangent, glm::i8vec4(90, 0, 90, -127));
  file.root["nodes"][0]["scale"] = {-1, 1, 1};  // a mirror, in which right is left
  for (const CornerLook& look : relief_scene(file).looks) EXPECT_EQ(look.tangent, glm::i8vec4(-90, 0, 90, 127));
  file.floats("TANGENT", {1, 0, 0, 1}, "VEC4", 4);
  const Result<Scene> wrong = read_scene(file.write("phare_relief.gltf"));
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().text().find("as many tangents as positions"), std::string::npos) << wrong.error().text();
}

TEST(ReliefTest, WhatTheFileSaysOfRoughnessIsRead) {
  GltfBuilder file;
  file.square();
  const int texture = file.texture(png_of(1, 1, {0, 100, 200, 255}));
  file.material({{"name", "thing"},
                 {"normalTexture", {{"index", texture}, {"scale", 0.5}}},
                 {"pbrMetallicRoughness",
                  {{"metallicRoughnessTexture", {{"index", texture}}}, {"roughnessFactor", 0.25}, {"metallicFactor", 0.75}}}});
  const Scene scene = relief_scene(file);
  const PixelLook& look = scene.materials.at(0).look;
  EXPECT_EQ(look.normal_texture, look.rough_texture);
  EXPECT_EQ(look.normal_scale, 0.5f);
  EXPECT_EQ(look.roughness, 0.25f);
  EXPECT_EQ(look.metal, 0.75f);
  EXPECT_EQ(look.base, glm::vec4(1.0f));
  for (const std::string& line : scene.notes) EXPECT_EQ(line.find("not drawn"), std::string::npos) << line;
  // Laid by coordinates of its own.
  file.root["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {{"scale", {2, 2}}};
  const auto says_so = [](const Scene& of) {
    return std::ranges::any_of(of.notes, [](const std::string& line) { return line.starts_with("normal and rough"); });
  };
  EXPECT_TRUE(says_so(relief_scene(file)));
  EXPECT_FALSE(says_so(scene));
}

SceneTexture stripes(double tilt, std::uint32_t side) {
  SceneTexture texture{"stripes", side, side, {}};
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const double x = (i % 2 == 0 ? 1.0 : -1.0) * std::sin(tilt);
    for (const double part : {x, 0.0, std::cos(tilt)})
      texture.rgba.push_back(static_cast<std::uint8_t>(std::lround(127.5 * (part + 1.0))));
    texture.rgba.push_back(255);
  }
  return texture;
}

TEST(ReliefTest, LevelsKeepTheMeanNormalAndItsLength) {
  const double tilt = 0.3;
  const std::vector<NormalLevel> levels = normal_levels(stripes(tilt, 8), 1.0f);
  ASSERT_EQ(levels.size(), 4u);
  EXPECT_NEAR(glm::length(levels[0].mean_at(0, 0)), 1.0f, 0x1p-11f);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const glm::vec3 mean = levels[i].mean_at(0, 0);
    EXPECT_NEAR(mean.x, 0.0f, 1e-6f);
    EXPECT_NEAR(mean.z, std::cos(tilt), 0.002f) << i;  // bytes of the file: 1/255 of sin(0.3)
    EXPECT_EQ(levels[i].slopes(), 0.0f) << "all stripes are in it";
  }
  // Of |x| from stripe to stripe half in the mean.
  const double flat = 0.5 * std::tan(tilt), grazing = 4.0 / std::numbers::pi * flat * flat;
  EXPECT_NEAR(levels[0].slopes(), grazing, 0.03 * grazing);
  EXPECT_EQ(normal_levels(stripes(0.0, 8), 0.0f)[0].slopes(), 0.0f);
  EXPECT_GT(normal_levels(stripes(tilt, 8), 2.0f)[0].slopes(), 3.5 * grazing);
  // What is hidden in a level is what was seen of the one before, to second order in the tilt.
  const float r = glm::length(levels.back().mean_at(0, 0));
  const double square = std::tan(tilt) * std::tan(tilt);
  EXPECT_NEAR(shader::slopes_in(r), square, square * square + 0.005);
}

TEST(ReliefTest, WhatFilesSayForLevelIsLevel) {
  for (const int byte : {127, 128}) {
    const auto b = static_cast<std::uint8_t>(byte);
    const NormalLevel level = normal_levels({"level", 1, 1, {b, b, 255, 255}}, 1.0f).front();
    EXPECT_EQ(level.mean_at(0, 0), glm::vec3(0, 0, 1));
    EXPECT_EQ(level.slopes(), 0.0f);
  }
  EXPECT_GT(normal_levels({"leans", 1, 1, {140, 128, 255, 255}}, 1.0f).front().mean_at(0, 0).x, 0.08f);
}

TEST(ReliefTest, RoughnessIsAveragedBySlopes) {
  const std::vector<SceneTexture> levels =
      rough_levels({"rough", 2, 1, {0, 255, 255, 255, 0, 0, 51, 255}});
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[1].rgba[1], std::lround(255.0 * std::pow(0.5, 0.25)));
  EXPECT_EQ(levels[1].rgba[2], 153);
}

/// Smith's function for Gaussian slopes, in closed form: 1/(1 + Lambda).
TEST(ReliefTest, AllFacetsTogetherHaveTheLightOfTheSurface) {
  for (const double slopes : {0.01, 0.08, 0.5})
    for (const double degrees : {0.5, 1.24, 5.0, 20.0, 60.0, 89.0}) {
      const double cosine = std::sin(degrees * std::numbers::pi / 180.0), sine = std::sqrt(1.0 - cosine * cosine);
      // Facets of slope p toward the lamp, Gaussian with variance slopes/2: light max(cos + p·sin, 0) a base area.
      const double sigma = std::sqrt(0.5 * slopes);
      double sum = 0.0;
      constexpr int kSteps = 20000;
      for (int i = 0; i < kSteps; ++i) {
        const double p = sigma * 8.0 * ((i + 0.5) / kSteps * 2.0 - 1.0);
        const double density = std::exp(-0.5 * p * p / (sigma * sigma)) / (sigma * std::sqrt(2.0 * std::numbers::pi));
        sum += density * std::max(cosine + p * sine, 0.0) * 16.0 * sigma / kSteps;
      }
      const double left = static_cast<double>(
          shader::lit_of_facets(static_cast<float>(slopes), static_cast<float>(cosine)));
      EXPECT_NEAR(sum * left / cosine, 1.0, 0.0036) << slopes << ' ' << degrees;  // Walter et al. 2007: 0.35 %
    }
}

/// Flat tops and joints of 38°, a fifth of all, lit from all sides. At grazing light by the very definition. Higher up
/// tops and facing joints have 0.8·c + 0.2·(0.79·c + 0.61/pi), which is 1.14 at 5° with what Gaussian slopes of the same
/// grazing light leave of it. mean(n_z) of it all is left: facets are as bright as they are, and smaller from above.
TEST(ReliefTest, FlatTopsWithSteepJointsHaveTheLightOfTheSurfaceToo) {
  std::vector<glm::dvec3> normals;
  for (int i = 0; i < 40; ++i)
    normals.push_back(i < 32 ? glm::dvec3(0, 0, 1)
                             : glm::normalize(glm::dvec3(std::cos(i * std::numbers::pi / 4.0),
                                                         std::sin(i * std::numbers::pi / 4.0), 1.3)));
  double up = 0.0;
  for (const glm::dvec3& n : normals) up += n.z / 40.0;
  // Of the facets alone, as a nearest filter shows them; half of what lies between texels is less steep.
  double flat = 0.0;
  for (const glm::dvec3& n : normals) flat += std::hypot(n.x, n.y) / 40.0;
  const auto slopes = static_cast<float>(4.0 / std::numbers::pi * std::pow(flat / up, 2.0));
  for (const double degrees : {0.3, 1.24, 5.0, 20.0, 60.0}) {
    const double elevation = degrees * std::numbers::pi / 180.0, cosine = std::sin(elevation);
    double sum = 0.0;
    for (int azimuth = 0; azimuth < 360; ++azimuth) {
      const double turn = azimuth * std::numbers::pi / 180.0;
      const glm::dvec3 toward(std::cos(elevation) * std::cos(turn), std::cos(elevation) * std::sin(turn), cosine);
      for (const glm::dvec3& n : normals) sum += std::max(glm::dot(n, toward), 0.0) / (360.0 * 40.0);
    }
    const double left = sum * static_cast<double>(shader::lit_of_facets(slopes, static_cast<float>(cosine))) / cosine;
    EXPECT_GT(left, up - 0.01) << degrees;
    EXPECT_LT(left, 1.185) << degrees;
    if (degrees < 1.0) {  // where the tops' 0.88·c is a tenth of the joints' light yet, half of which is too much
      EXPECT_NEAR(left, up, 0.06);
    }
  }
}

TEST(ReliefTest, HiddenFacetsWidenTheMirror) {
  EXPECT_FLOAT_EQ(shader::facets_alpha(0.5f, 0.0f), 0.25f);
  EXPECT_FLOAT_EQ(shader::facets_alpha(0.5f, 0.1f), std::sqrt(0.0625f + 0.1f));
  EXPECT_FLOAT_EQ(shader::facets_alpha(0.0f, 0.0f), shader::kLeastAlpha);
  EXPECT_FLOAT_EQ(shader::facets_alpha(1.0f, 3.0f), 1.0f);
}

}  // namespace
}  // namespace phare
