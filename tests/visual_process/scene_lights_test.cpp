// unit: lamps of a glTF file (KHR_lights_punctual, EXT_lights_ies) against closed forms, and what is wrong with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/scene/gltf_builder.h"
#include "visual/fixed_light.h"

namespace phare {
namespace {

using Json = nlohmann::json;

/// Turns -z down, as lamps over a road look; y to glTF's -z, which is our y.
const Json kDown = {-std::numbers::sqrt2 / 2.0, 0.0, 0.0, std::numbers::sqrt2 / 2.0};

/// A square somewhere, and a lamp at glTF (10, 4, 5): ours (10, -5, 4).
GltfBuilder file_with(const Json& light) {
  GltfBuilder file;
  file.square();
  file.root["extensionsUsed"] = {"KHR_lights_punctual"};
  file.root["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
  file.root["nodes"].push_back({{"name", "mast"},
                                {"translation", {10, 4, 5}},
                                {"rotation", kDown},
                                {"scale", {3, 3, 3}},
                                {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  file.root["scenes"][0]["nodes"].push_back(1);
  return file;
}

const glm::dvec3 kLamp(10, -5, 4), kUp(0, 0, 1);

FixedLight light_of(GltfBuilder& file) {
  const Result<Scene> scene = read_scene(file.write("phare_lights.gltf"));
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
  if (!scene) return {};
  for (const std::string& note : scene->notes) EXPECT_EQ(note.find("not read"), std::string::npos) << note;
  auto light = FixedLight::of(*scene, {}, std::nullopt);
  EXPECT_TRUE(light) << (light ? "" : light.error().text());
  return light ? std::move(*light) : FixedLight{};
}

std::string refusal(GltfBuilder& file) {
  const Result<Scene> scene = read_scene(file.write("phare_lights.gltf"));
  if (!scene) return scene.error().text();
  const auto light = FixedLight::of(*scene, {}, std::nullopt);
  return light ? "was read" : light.error().text();
}

/// In float64 throughout, but for intensities and angles of the file's text and colours in float32.
constexpr double kExact = 1e-6;

TEST(SceneLights, APointShinesByItsCandelaWithinItsRange) {
  GltfBuilder file = file_with({{"type", "point"}, {"intensity", 320}, {"name", "bulb"}});
  const FixedLight light = light_of(file);
  EXPECT_EQ(light.street_lamps(), 1u);
  EXPECT_TRUE(light.any());
  EXPECT_NEAR(light.lux_at({10, -5, 0}, kUp), 320.0 / 16.0, kExact);
  EXPECT_NEAR(light.lux_at({13, -5, 0}, kUp), 320.0 / 25.0 * 0.8, kExact);
  EXPECT_NEAR(light.lux_at({10, -5, 8}, -kUp), 320.0 / 16.0, kExact) << "every way";
  Json& lamp = file.root["extensions"]["KHR_lights_punctual"]["lights"][0];
  lamp["range"] = 4.5;
  EXPECT_NEAR(light_of(file).lux_at({10, -5, 0}, kUp), 320.0 / 16.0, kExact);
  EXPECT_EQ(light_of(file).lux_at({13, -5, 0}, kUp), 0.0);
  lamp["color"] = {0.5, 1.0, 0.0};
  const double of_white = 0.2126 * 0.5 + 0.7152;
  EXPECT_NEAR(light_of(file).lux_at({10, -5, 0}, kUp), 20.0 * of_white, 20.0 * kExact);
  const FixedVertex vertex = light_of(file).at({10, -5, 0}, kUp, SceneMaterial{});
  EXPECT_NEAR(vertex.light.x, 10.0f, 1e-5f);
  EXPECT_NEAR(vertex.light.y, 20.0f, 1e-5f);
  EXPECT_NEAR(vertex.light.z, 0.0f, 1e-5f);
  lamp["color"] = {0, 0, 0};
  EXPECT_FALSE(light_of(file).any());
}

TEST(SceneLights, ASpotHasTheConeOfTheExtension) {
  for (const bool given : {false, true}) {
    Json lamp = {{"type", "spot"}, {"intensity", 1000}};
    if (given) lamp["spot"] = {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.9}};
    GltfBuilder file = file_with(lamp);
    const FixedLight light = light_of(file);
    const double inner = given ? 0.2 : 0.0, outer = given ? 0.9 : std::numbers::pi / 4.0;
    for (const double angle : {0.0, 0.1, 0.3, 0.7, 0.85, 0.95}) {
      const glm::dvec3 way(std::sin(angle), 0.0, -std::cos(angle));
      const double scale = 1.0 / (std::cos(inner) - std::cos(outer)),
                   part = std::clamp(std::cos(angle) * scale - std::cos(outer) * scale, 0.0, 1.0);
      EXPECT_NEAR(light.lux_at(kLamp + 3.0 * way, -way), 1000.0 / 9.0 * part * part, 1e-4) << angle;
    }
    EXPECT_EQ(light.lux_at({10, -5, 8}, -kUp), 0.0) << "behind it";
  }
}

TEST(SceneLights, ADirectionalLightHasItsLuxEverywhere) {
  GltfBuilder file = file_with({{"type", "directional"}, {"intensity", 0.25}});
  const FixedLight light = light_of(file);
  EXPECT_EQ(light.street_lamps(), 0u);
  EXPECT_EQ(light.directional(), 1u);
  EXPECT_NEAR(light.lux_at({100, 70, 3}, kUp), 0.25, kExact);
  EXPECT_NEAR(light.lux_at({100, 70, 3}, {0.6, 0.0, 0.8}), 0.2, kExact);
  EXPECT_EQ(light.lux_at({100, 70, 3}, -kUp), 0.0);
  const auto shares = light.shares_at({0, 0, 0}, kUp);
  ASSERT_EQ(shares.size(), 1u);
  EXPECT_FALSE(shares[0].lamp);
  EXPECT_TRUE(shares[0].directional);
}

std::string street_side() {
  std::string text = "IESNA:LM-63-2002\n[TEST] even\n[MANUFAC] Phare\nTILT=NONE\n1 -1 1 2 9 1 2 0 0 0\n1 1 0\n0 90\n";
  for (int c = 0; c <= 360; c += 45) text += std::to_string(c) + (c < 360 ? " " : "\n");
  for (int c = 0; c <= 360; c += 45) text += c == 90 ? "1000 1000\n" : "0 0\n";
  return text;
}

GltfBuilder file_with_profile(const Json& profile, const Json& instance) {
  GltfBuilder file = file_with({{"type", "point"}});
  file.root["extensionsUsed"] = {"EXT_lights_ies"};
  file.root["extensions"] = {{"EXT_lights_ies", {{"lights", Json::array({profile})}}}};
  file.root["nodes"][1]["extensions"] = {{"EXT_lights_ies", instance}};
  return file;
}

TEST(SceneLights, AProfileShinesByItsOwnFile) {
  const std::string text = street_side();
  std::ofstream(std::filesystem::path(testing::TempDir()) / "phare street.ies") << text;
  const Json instance = {{"light", 0}, {"multiplier", 0.5}};
  std::vector<GltfBuilder> files;
  files.push_back(file_with_profile({{"uri", "phare%20street.ies"}}, instance));
  files.push_back(file_with_profile({{"uri", "data:application/x-ies-lm-63;base64," + base64(text)}}, instance));
  files.push_back(file_with_profile(Json::object(), instance));
  files.back().root["extensions"]["EXT_lights_ies"]["lights"][0] = {
      {"bufferView", files.back().view(std::vector<char>(text.begin(), text.end()))},
      {"mimeType", "application/x-ies-lm-63"}};
  for (GltfBuilder& file : files) {
    const FixedLight light = light_of(file);
    ASSERT_EQ(light.street_lamps(), 1u);
    const glm::dvec3 aside(0.0, 0.6, -0.8);  // gamma 36.9°, toward where the node's y looks: C 90
    EXPECT_NEAR(light.lux_at(kLamp + 2.0 * aside, -aside), 0.5 * 1000.0 / 4.0, kExact);
    for (const glm::dvec3& dark : {glm::dvec3(0.0, -0.6, -0.8), {0.6, 0.0, -0.8}, {-0.6, 0.0, -0.8}})
      EXPECT_EQ(light.lux_at(kLamp + 2.0 * dark, -dark), 0.0);
  }
  // C runs from the node's x to its y: 45° between the planes there is half of both.
  const glm::dvec3 between(0.6 * std::sin(std::numbers::pi / 8), 0.6 * std::cos(std::numbers::pi / 8), -0.8);
  EXPECT_NEAR(light_of(files[0]).lux_at(kLamp + 2.0 * between, -between), 62.5, 1e-4);
}

TEST(SceneLights, WhatIsWrongIsSaidWithItsPlace) {
  const auto wrong = [](const char* key, const Json& value) {
    GltfBuilder file = file_with({{"type", "spot"}});
    file.root["extensions"]["KHR_lights_punctual"]["lights"][0][key] = value;
    const std::string reason = refusal(file);
    EXPECT_NE(reason.find("phare_lights.gltf: KHR_lights_punctual: light 0: "), std::string::npos) << reason;
    return reason;
  };
  EXPECT_NE(wrong("intensity", -1).find("intensity"), std::string::npos);
  EXPECT_NE(wrong("intensity", "bright").find("intensity"), std::string::npos);
  EXPECT_NE(wrong("type", "area").find("none of point"), std::string::npos);
  EXPECT_NE(wrong("color", {1, 1}).find("color"), std::string::npos);
  EXPECT_NE(wrong("color", {1, 1, 7}).find("color"), std::string::npos);
  EXPECT_NE(wrong("range", 0).find("range"), std::string::npos);
  EXPECT_NE(wrong("spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.4}}).find("not less"), std::string::npos);
  EXPECT_NE(wrong("spot", {{"outerConeAngle", 2.0}}).find("outerConeAngle"), std::string::npos);

  GltfBuilder file = file_with({{"type", "point"}});
  file.root["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 3;
  EXPECT_NE(refusal(file).find("node 'mast': KHR_lights_punctual: light 3 does not exist"), std::string::npos)
      << refusal(file);
  file.root["nodes"][1]["extensions"]["KHR_lights_punctual"] = Json::object();
  EXPECT_NE(refusal(file).find("light is not an index"), std::string::npos);
  file = file_with({{"type", "point"}});
  file.root["nodes"][1]["scale"] = {0, 0, 0};
  EXPECT_NE(refusal(file).find("node 'mast': its transform leaves"), std::string::npos) << refusal(file);
  file.root["extensions"]["KHR_lights_punctual"]["lights"] = 7;
  EXPECT_NE(refusal(file).find("KHR_lights_punctual: lights is not a list"), std::string::npos) << refusal(file);

  const auto profile = [](const Json& lights, const Json& instance) {
    GltfBuilder wrong_file = file_with_profile(lights, instance);
    return refusal(wrong_file);
  };
  const Json first = {{"light", 0}};
  EXPECT_NE(profile({{"uri", "none.ies"}}, first).find("none.ies: no such file"), std::string::npos);
  EXPECT_NE(profile({{"name", "none"}}, first).find("EXT_lights_ies: light 0: has neither uri nor bufferView"),
            std::string::npos);
  EXPECT_NE(profile({{"bufferView", 70}}, first).find("bufferView 70 does not exist"), std::string::npos);
  EXPECT_NE(profile({{"uri", "data:,what"}}, first).find("no base64"), std::string::npos);
  const Json good = {{"uri", "data:application/x-ies-lm-63;base64," + base64(street_side())}};
  EXPECT_EQ(profile(good, first), "was read");
  EXPECT_NE(profile(good, {{"light", 0}, {"multiplier", -2}}).find("node 'mast': EXT_lights_ies: multiplier"),
            std::string::npos);
  const std::string broken = profile({{"uri", "data:x/y;base64," + base64("IESNA:LM-63-2002\nTILT=NONE\n1 -1")}}, first);
  EXPECT_NE(broken.find("phare_lights.gltf: EXT_lights_ies: light 0:"), std::string::npos) << broken;
}

}  // namespace
}  // namespace phare
