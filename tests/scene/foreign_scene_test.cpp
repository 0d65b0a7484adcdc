// unit: what of other people's glTF files is read: every way to store a number, pictures, light of their own, names.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/paths.h"
#include "tests/scene/gltf_builder.h"
#include "visual/scene/long_edges.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

using Json = nlohmann::json;

Scene scene_of(GltfBuilder& file) {
  Result<Scene> scene = read_scene(file.write("phare_foreign.gltf"));
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
  return scene ? *scene : Scene{};
}

std::string reason_of(GltfBuilder& file) {
  const Result<Scene> scene = read_scene(file.write("phare_foreign_wrong.gltf"));
  return scene ? "was read" : scene.error().text();
}

/// In the world: x = glTF x, y = -glTF z, z = glTF y.
std::vector<glm::dvec3> corners_of(const Scene& scene) {
  std::vector<glm::dvec3> corners;
  for (const SceneChunk& chunk : scene.chunks)
    for (std::uint32_t i = 0; i < chunk.index_count; ++i)
      corners.push_back(
          chunk.origin_m +
          glm::dvec3(scene.vertices[chunk.first_vertex + scene.indices[chunk.first_index + i]].position_m));
  return corners;
}

bool noted(const Scene& scene, const std::string& text) {
  return std::ranges::any_of(scene.notes,
                             [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

TEST(ForeignScene, QuantizedNumbersOfEveryKind) {
  // The same triangle, (0,0,0) (1,0,0) (0,-1,0) in glTF, stored in integers; by normalized ones 1 is their largest.
  const auto read = [](auto one, int type, bool normalized) {
    using T = decltype(one);
    GltfBuilder file;
    const int stride = sizeof(T) == 4 ? 12 : sizeof(T) == 1 ? 4 : 8;
    std::vector<T> values(static_cast<std::size_t>(3 * stride) / sizeof(T), T{0});
    values[static_cast<std::size_t>(stride) / sizeof(T)] = one;
    values[2 * static_cast<std::size_t>(stride) / sizeof(T) + 1] = one;
    file.attribute("POSITION", file.accessor(file.view(values, stride), type, 3, "VEC3", normalized));
    file.root["extensionsUsed"] = file.root["extensionsRequired"] = Json::array({"KHR_mesh_quantization"});
    const double scale = 0x1p-10;  // small enough to stay one triangle, and a power of two rounds nothing
    file.root["nodes"][0]["scale"] = {scale, scale, scale};
    const std::vector<glm::dvec3> corners = corners_of(scene_of(file));
    EXPECT_EQ(corners.size(), 3u);
    return corners.size() == 3 ? glm::dvec2(corners[1].x, corners[2].z) / scale : glm::dvec2(0.0);
  };
  EXPECT_EQ(read(std::int8_t{127}, 5120, true), glm::dvec2(1, 1));
  EXPECT_EQ(read(std::int8_t{-128}, 5120, true), glm::dvec2(-1, -1));  // glTF 2.0, 3.11: no less than -1
  EXPECT_EQ(read(std::int8_t{-128}, 5120, false), glm::dvec2(-128, -128));
  EXPECT_EQ(read(std::uint8_t{255}, 5121, true), glm::dvec2(1, 1));
  EXPECT_EQ(read(std::uint8_t{200}, 5121, false), glm::dvec2(200, 200));
  EXPECT_EQ(read(std::int16_t{-32768}, 5122, true), glm::dvec2(-1, -1));
  EXPECT_EQ(read(std::int16_t{-300}, 5122, false), glm::dvec2(-300, -300));
  EXPECT_EQ(read(std::uint16_t{65535}, 5123, true), glm::dvec2(1, 1));
  EXPECT_EQ(read(std::uint16_t{60000}, 5123, false), glm::dvec2(60000, 60000));
  EXPECT_EQ(read(0.25f, 5126, false), glm::dvec2(0.25, 0.25));
}

TEST(ForeignScene, NormalsOfBytes) {
  GltfBuilder file;
  file.square();
  const std::vector<std::int8_t> normals{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0};
  file.attribute("NORMAL", file.accessor(file.view(normals, 4), 5120, 4, "VEC3", true));
  const Scene scene = scene_of(file);
  ASSERT_EQ(scene.vertices.size(), 4u);  // not cut up into triangles of their own: the normals were taken
  for (const SceneVertex& vertex : scene.vertices) EXPECT_EQ(vertex.normal, glm::vec3(0, -1, 0));
}

TEST(ForeignScene, SparseNumbersReplaceSome) {
  for (const bool over_zeros : {false, true}) {
    GltfBuilder file;
    const std::vector<float> all{0, 0, 0, 9, 9, 9, 0, 1, 0}, one{1, 0, 0};
    const int base = file.view(all);
    const int indices = file.view(std::vector<std::uint16_t>{1}), values = file.view(one);
    const int accessor = file.accessor(base, 5126, 3, "VEC3");
    Json& made = file.root["accessors"][static_cast<std::size_t>(accessor)];
    made["sparse"] = {{"count", 1},
                      {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                      {"values", {{"bufferView", values}}}};
    if (over_zeros) {
      made.erase("bufferView");
      made["sparse"]["count"] = 2;
      made["sparse"]["indices"]["bufferView"] = file.view(std::vector<std::uint16_t>{1, 2});
      made["sparse"]["values"]["bufferView"] = file.view(std::vector<float>{1, 0, 0, 0, 1, 0});
    }
    file.attribute("POSITION", accessor);
    const std::vector<glm::dvec3> corners = corners_of(scene_of(file));
    ASSERT_EQ(corners.size(), 3u) << over_zeros;
    EXPECT_EQ(corners[1], glm::dvec3(1, 0, 0)) << over_zeros;
    EXPECT_EQ(corners[2], glm::dvec3(0, 0, 1)) << over_zeros;
    made["sparse"]["indices"]["bufferView"] = file.view(std::vector<std::uint16_t>{7, 8});
    EXPECT_NE(reason_of(file).find("sparse"), std::string::npos) << reason_of(file);
    made["sparse"]["count"] = 100;
    EXPECT_NE(reason_of(file).find("sparse"), std::string::npos) << reason_of(file);
  }
}

TEST(ForeignScene, StripsAndFansKeepTheirSide) {
  for (const int mode : {4, 5, 6}) {
    GltfBuilder file;
    file.floats("POSITION", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3", 3);
    const std::vector<std::vector<std::uint16_t>> indices{{0, 1, 2, 1, 3, 2}, {0, 1, 2, 3}, {0, 1, 3, 2}};
    const auto& own = indices[static_cast<std::size_t>(mode - 4)];
    file.primitive()["indices"] = file.accessor(file.view(own), 5123, own.size(), "SCALAR");
    file.primitive()["mode"] = mode;
    const std::vector<glm::dvec3> corners = corners_of(scene_of(file));
    ASSERT_EQ(corners.size(), 6u) << mode;
    for (std::size_t i = 0; i < 6; i += 3)  // all look along glTF's z, which is our -y
      EXPECT_LT(glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]).y, -0.9) << mode;
  }
}

/// A fan of triangles about the origin with normals, both as floats and packed by meshoptimizer.
struct PackedFan {
  GltfBuilder plain, packed;
  int positions = 0, normals = 0, triangles = 0;  ///< views of `packed`
};

template <typename T>
int packed_view(GltfBuilder& file, const std::vector<T>& values, std::size_t count, const char* mode,
                const char* filter = "NONE") {
  const std::size_t stride = values.size() * sizeof(T) / count;
  std::vector<unsigned char> bytes;
  if (std::string(mode) == "ATTRIBUTES") {
    bytes.resize(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), count, stride));
  } else {
    const std::vector<unsigned int> indices(values.begin(), values.end());
    const bool triangles = std::string(mode) == "TRIANGLES";
    bytes.resize(triangles ? meshopt_encodeIndexBufferBound(count, 4096)
                           : meshopt_encodeIndexSequenceBound(count, 4096));
    bytes.resize(triangles ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), count)
                           : meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), count));
  }
  const int view = file.view(bytes);
  Json& made = file.root["bufferViews"][static_cast<std::size_t>(view)];
  Json extension = {{"buffer", 0},           {"byteOffset", made["byteOffset"]}, {"byteLength", bytes.size()},
                    {"byteStride", stride},  {"count", count},                   {"mode", mode}};
  if (std::string(filter) != "NONE") extension["filter"] = filter;
  made = {{"buffer", 1}, {"byteLength", count * stride}, {"extensions", {{"EXT_meshopt_compression", extension}}}};
  if (std::string(mode) == "ATTRIBUTES") made["byteStride"] = stride;
  return view;
}

void add_fallback(GltfBuilder& file) {
  file.root["extensionsUsed"] = file.root["extensionsRequired"] =
      Json::array({"EXT_meshopt_compression", "KHR_mesh_quantization"});
  file.root["buffers"] = Json::array(
      {{{"byteLength", 100000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}});
}

PackedFan packed_fan(bool sequence) {
  PackedFan fan;
  constexpr std::size_t kRim = 24;
  std::vector<float> positions{0, 0, 0}, normals;
  std::vector<std::uint16_t> triangles;
  for (std::size_t i = 0; i < kRim; ++i) {
    const double turn = 2.0 * 3.14159265 * static_cast<double>(i) / kRim;
    positions.insert(positions.end(), {static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn)), 0.0f});
    triangles.insert(triangles.end(),
                     {0, static_cast<std::uint16_t>(1 + i), static_cast<std::uint16_t>(1 + (i + 1) % kRim)});
  }
  for (std::size_t i = 0; i < positions.size() / 3; ++i) normals.insert(normals.end(), {0.6f, 0.0f, 0.8f, 0.0f});
  std::vector<float> three;
  for (std::size_t i = 0; i < normals.size(); i += 4)
    three.insert(three.end(), {normals[i], normals[i + 1], normals[i + 2]});
  fan.plain.floats("POSITION", positions, "VEC3", 3);
  fan.plain.floats("NORMAL", three, "VEC3", 3);
  fan.plain.primitive()["indices"] = fan.plain.accessor(fan.plain.view(triangles), 5123, triangles.size(), "SCALAR");

  const std::size_t count = positions.size() / 3;
  std::vector<unsigned int> exponents(positions.size());
  meshopt_encodeFilterExp(exponents.data(), count, 12, 15, positions.data());
  std::vector<std::int16_t> octahedral(4 * count);
  meshopt_encodeFilterOct(octahedral.data(), count, 8, 16, normals.data());
  GltfBuilder& file = fan.packed;
  fan.positions = packed_view(file, exponents, count, "ATTRIBUTES", "EXPONENTIAL");
  fan.normals = packed_view(file, octahedral, count, "ATTRIBUTES", "OCTAHEDRAL");
  fan.triangles = packed_view(file, triangles, triangles.size(), sequence ? "INDICES" : "TRIANGLES");
  file.attribute("POSITION", file.accessor(fan.positions, 5126, count, "VEC3"));
  file.attribute("NORMAL", file.accessor(fan.normals, 5122, count, "VEC3", true));
  file.primitive()["indices"] = file.accessor(fan.triangles, 5123, triangles.size(), "SCALAR");
  add_fallback(file);
  return fan;
}

TEST(ForeignScene, WhatMeshoptimizerPackedIsTheSame) {
  for (const bool sequence : {false, true}) {
    PackedFan fan = packed_fan(sequence);
    const Scene plain = scene_of(fan.plain), packed = scene_of(fan.packed);
    const std::vector<glm::dvec3> a = corners_of(plain), b = corners_of(packed);
    ASSERT_EQ(a.size(), b.size());
    // A packed triangle may begin at another of its corners: both lists as sets of middles.
    const auto middles = [](const std::vector<glm::dvec3>& corners) {
      std::vector<std::pair<double, double>> all;
      for (std::size_t i = 0; i < corners.size(); i += 3) {
        const glm::dvec3 middle = (corners[i] + corners[i + 1] + corners[i + 2]) / 3.0;
        all.emplace_back(std::round(middle.x * 1e3), std::round(middle.z * 1e3));
      }
      std::ranges::sort(all);
      return all;
    };
    EXPECT_EQ(middles(a), middles(b));  // 15 bits of 1 m: 0.03 mm, rounded here to mm
    for (const SceneVertex& vertex : packed.vertices)  // 16 bits of an octahedron: 2^-15 each way
      EXPECT_LT(glm::distance(vertex.normal, glm::vec3(0.6f, -0.8f, 0.0f)), 1e-4f);
  }
}

TEST(ForeignScene, WhatIsWrongWithAPackedViewIsSaid) {
  const auto wrong = [](const char* key, const Json& value) {
    PackedFan fan = packed_fan(false);
    Json& view = fan.packed.root["bufferViews"][static_cast<std::size_t>(fan.positions)];
    view["extensions"]["EXT_meshopt_compression"][key] = value;
    const std::string reason = reason_of(fan.packed);
    EXPECT_NE(reason.find("bufferView 0: EXT_meshopt_compression: "), std::string::npos) << reason;
    return reason;
  };
  EXPECT_NE(wrong("buffer", 7).find("buffer 7"), std::string::npos);
  EXPECT_NE(wrong("byteLength", 100000).find("reaches beyond"), std::string::npos);
  EXPECT_NE(wrong("byteLength", 9).find("not what meshoptimizer packs"), std::string::npos);
  EXPECT_NE(wrong("mode", "SHAPES").find("SHAPES"), std::string::npos);
  EXPECT_NE(wrong("filter", "MAGIC").find("MAGIC"), std::string::npos);
  EXPECT_NE(wrong("count", 3000000000u).find("GiB"), std::string::npos);
  EXPECT_NE(wrong("count", 0).find("no elements"), std::string::npos);
  EXPECT_NE(wrong("byteStride", 6).find("as long as the view"), std::string::npos);
}

TEST(ForeignScene, RequiredExtensionsAreRefusedByNameOthersNamedOnce) {
  GltfBuilder file;
  file.square();
  file.root["extensionsUsed"] = Json::array({"XYZ_curves", "KHR_draco_mesh_compression"});
  const Scene scene = scene_of(file);
  EXPECT_TRUE(noted(scene, "XYZ_curves"));
  const auto names_it = [](const auto& line) { return line.find("XYZ") != std::string::npos; };
  EXPECT_EQ(std::ranges::count_if(scene.notes, names_it), 1);
  file.root["extensionsRequired"] = Json::array({"KHR_draco_mesh_compression"});
  EXPECT_NE(reason_of(file).find("KHR_draco_mesh_compression"), std::string::npos);
}

TEST(ForeignScene, WhatIsWideIsReadInSmallTriangles) {
  GltfBuilder file;
  file.square();
  const double side = 1024.0;
  file.root["nodes"][0]["scale"] = {side, side, side};
  const std::vector<glm::dvec3> corners = corners_of(scene_of(file));
  ASSERT_GT(corners.size(), 6u);
  for (std::size_t i = 0; i < corners.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_LE(glm::distance(corners[i + k], corners[i + (k + 1) % 3]), kLongestEdge_m);
}

TEST(ForeignScene, OfAnotherVersionIsRefused) {
  for (const auto& [key, version] : {std::pair{"version", "3.0"}, {"minVersion", "2.9"}, {"version", "1.0"}}) {
    GltfBuilder file;
    file.square();
    file.root["asset"][key] = version;
    EXPECT_NE(reason_of(file).find(std::string("asset: ") + key + " is \"" + version), std::string::npos) << version;
  }
}

TEST(ForeignScene, WhatShinesHasItsLuminance) {
  GltfBuilder file;
  file.square();
  file.material({{"name", "lit"},
                 {"emissiveFactor", {0.5, 0.25, 0.0}},
                 {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 400}}}}}});
  Scene scene = scene_of(file);
  EXPECT_EQ(scene.materials.at(0).look.emitted_cdm2, glm::vec3(200.0f, 100.0f, 0.0f));  // cd/m², its own unit
  ASSERT_TRUE(scene.chunks.at(0).first_look);

  Json& material = file.root["materials"][0];
  material["extras"]["phare"]["luminance_cdm2"] = 50;  // of Rec. 709 luminance, colour kept
  scene = scene_of(file);
  const glm::vec3 told = scene.materials.at(0).look.emitted_cdm2;
  EXPECT_NEAR(glm::dot(told, glm::vec3(0.2126f, 0.7152f, 0.0722f)), 50.0f, 1e-3f);
  EXPECT_NEAR(told.x / told.y, 2.0f, 1e-5f);
  material["extras"]["phare"]["luminance_cdm2"] = -1;
  EXPECT_NE(reason_of(file).find("luminance_cdm2"), std::string::npos);

  material.erase("extras");
  material["emissiveTexture"] = {{"index", file.texture(png_of(2, 1, {255, 255, 255, 255, 0, 0, 0, 255}))}};
  scene = scene_of(file);
  EXPECT_EQ(mean_emitted_cdm2(scene, scene.materials.at(0)), glm::vec3(100.0f, 50.0f, 0.0f));

  material = {{"name", "flat"},
              {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1.0, 1.0}}}},
              {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
  scene = scene_of(file);
  EXPECT_EQ(scene.materials.at(0).look.emitted_cdm2, glm::vec3(0.5f, 0.25f, 1.0f));
  EXPECT_EQ(scene.materials.at(0).reflectance, glm::vec3(0.0f));
  EXPECT_TRUE(noted(scene, "unlit"));
}

TEST(ForeignScene, ColoursAtCornersAreReflectance) {
  GltfBuilder file;
  file.square();
  file.material({{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1.0}}}}});
  const std::vector<std::uint8_t> white(16, 255);
  file.attribute("COLOR_0", file.accessor(file.view(white), 5121, 4, "VEC4", true));
  EXPECT_TRUE(scene_of(file).looks.empty());  // all white: nothing to draw at every pixel

  std::vector<std::uint16_t> half(12, 65535);
  for (std::size_t i = 0; i < 12; i += 3) half[i] = 32768;
  file.attribute("COLOR_0", file.accessor(file.view(half), 5123, 4, "VEC3", true));
  const Scene scene = scene_of(file);
  ASSERT_EQ(scene.looks.size(), 6u);  // without normals each triangle has corners of its own
  EXPECT_TRUE(scene.materials.at(0).look.corner_colours);
  for (const CornerLook& look : scene.looks) EXPECT_EQ(look.colour, glm::u16vec4(32768, 65535, 65535, 65535));
  EXPECT_NEAR(scene.materials.at(0).reflectance.x, 0.25f, 1e-5f);
  EXPECT_NEAR(scene.materials.at(0).reflectance.y, 0.5f, 1e-5f);
}

TEST(ForeignScene, ATextureIsDecodedAndItsMeanIsTheReflectance) {
  GltfBuilder file;
  file.square();
  // Two texels: sRGB 188 is linear 0.5029, 0 is 0.
  const int texture = file.texture(png_of(2, 1, {188, 188, 188, 255, 0, 0, 0, 255}));
  file.root["samplers"] = Json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}});
  file.root["textures"][0]["sampler"] = 0;
  file.material({{"name", "tile"},
                 {"pbrMetallicRoughness",
                  {{"baseColorFactor", {0.5, 1.0, 1.0, 1.0}},
                   {"baseColorTexture",
                    {{"index", texture},
                     {"extensions", {{"KHR_texture_transform", {{"scale", {4.0, 2.0}}, {"offset", {0.5, 0.0}}}}}}}}}}});
  const Scene scene = scene_of(file);
  const PixelLook& look = scene.materials.at(0).look;
  ASSERT_TRUE(look.base_texture);
  EXPECT_EQ(look.sampler, (TextureSampler{TextureWrap::kClamp, TextureWrap::kMirror, true}));
  const float linear = linear_of_srgb_byte(188);
  EXPECT_NEAR(linear, std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4), 1e-6);
  EXPECT_NEAR(scene.materials[0].reflectance.x, 0.25f * linear, 1e-6f);
  EXPECT_NEAR(scene.materials[0].reflectance.y, 0.5f * linear, 1e-6f);
  ASSERT_EQ(scene.looks.size(), 6u);
  EXPECT_EQ(scene.looks[0].uv, glm::vec2(0.5f, 2.0f));  // (0, 1), scaled and moved
  EXPECT_EQ(scene.looks[1].uv, glm::vec2(4.5f, 2.0f));
}

TEST(ForeignScene, HolesAreThereWhereOpacityChanges) {
  const auto cut = [](const Json& material, std::uint8_t opacity) {
    GltfBuilder file;
    file.square();
    Json own = material;
    own["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", file.texture(png_of(1, 1, {255, 255, 255, opacity}))}};
    file.material(own);
    return scene_of(file);
  };
  EXPECT_EQ(cut({{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}}, 100).materials.at(0).look.cut_below, 0.25f);
  EXPECT_EQ(cut({{"alphaMode", "MASK"}}, 255).materials.at(0).look.cut_below, std::nullopt);  // opaque all over
  EXPECT_EQ(cut(Json::object(), 100).materials.at(0).look.cut_below, std::nullopt);           // opacity does not count
  const Scene blended = cut({{"alphaMode", "BLEND"}}, 100);
  EXPECT_EQ(blended.materials.at(0).look.cut_below, 0.5f);
  EXPECT_TRUE(noted(blended, "BLEND"));
}

TEST(ForeignScene, TexturesThatCannotBeHadAreNamed) {
  GltfBuilder file;
  file.square();
  file.root["images"] = Json::array({{{"uri", "no%20such.png"}}, {{"uri", "data:image/png;base64,AAAA"}}});
  file.root["textures"] =
      Json::array({{{"source", 0}}, {{"source", 1}}, {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}});
  for (std::size_t i = 0; i < 4; ++i)
    file.material({{"name", "m" + std::to_string(i)},
                   {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}},
                   {"normalTexture", {{"index", 0}}}});
  const Scene scene = scene_of(file);
  EXPECT_TRUE(noted(scene, "no such.png: no such file"));
  EXPECT_TRUE(noted(scene, "image 1: is no PNG or JPEG"));
  EXPECT_TRUE(noted(scene, "KHR_texture_basisu"));
  EXPECT_TRUE(noted(scene, "texture 3 of 'm3' does not exist"));
  for (const SceneMaterial& material : scene.materials) EXPECT_TRUE(material.look.none());
}

// ---- the library

TEST(ForeignScene, NamesAndExtrasFindTheLibrary) {
  GltfBuilder file;
  file.square();
  file.material({{"name", "Road_01"}});
  Scene scene = scene_of(file);
  EXPECT_EQ(scene.materials.at(0).surface, Surface::kAsphalt);
  EXPECT_EQ(scene.materials.at(0).retro.kind, RetroKind::kFacets);
  EXPECT_LT(scene.materials.at(0).reflectance.x, 0.1f);  // the file said no colour
  EXPECT_TRUE(noted(scene, "'Road_01' as asphalt"));

  Json& material = file.root["materials"][0];
  material["pbrMetallicRoughness"]["baseColorFactor"] = {0.2, 0.2, 0.2, 1.0};
  EXPECT_EQ(scene_of(file).materials.at(0).reflectance, glm::vec3(0.2f));  // its own colour stays

  material["extras"]["phare"]["material"] = "road marking";
  scene = scene_of(file);
  EXPECT_EQ(scene.materials.at(0).retro.class_name, "EN 1436 R4");
  EXPECT_EQ(scene.materials.at(0).reflectance, glm::vec3(0.50f, 0.50f, 0.48f));
  EXPECT_FALSE(noted(scene, "Road_01"));
  material["extras"]["phare"]["retro"] = "EN 1436 R2";  // what else is said counts before it
  EXPECT_EQ(scene_of(file).materials.at(0).retro.class_name, "EN 1436 R2");
  material["extras"]["phare"]["material"] = "asfalt";
  EXPECT_NE(reason_of(file).find("did you mean \"asphalt\"?"), std::string::npos) << reason_of(file);
  material["extras"]["phare"]["material"] = 7;
  EXPECT_NE(reason_of(file).find("material is not a text"), std::string::npos);

  // Rough in place of flat, or of the library's facets; 0: flat.
  material["extras"]["phare"] = {{"material", "asphalt"}, {"roughness_deg", 25}};
  EXPECT_EQ(scene_of(file).materials.at(0).retro.kind, RetroKind::kGrooves);
  EXPECT_NEAR(scene_of(file).materials.at(0).retro.roughness_rad, 0.43633, 1e-5);
  material["extras"]["phare"] = {{"material", "plaster rough"}};
  EXPECT_NEAR(scene_of(file).materials.at(0).retro.roughness_rad, 0.52360, 1e-5);
  material["extras"]["phare"]["roughness_deg"] = 0;
  EXPECT_EQ(scene_of(file).materials.at(0).retro.kind, RetroKind::kNone);
  for (const Json& wrong : {Json(-1), Json(61), Json("25")}) {
    material["extras"]["phare"]["roughness_deg"] = wrong;
    EXPECT_NE(reason_of(file).find("'Road_01': roughness_deg is not a number from 0 to 60"), std::string::npos)
        << reason_of(file);
  }
  material["extras"]["phare"] = {{"roughness_deg", 25}, {"retro", "EN 1436 R4"}};
  EXPECT_NE(reason_of(file).find("not both"), std::string::npos) << reason_of(file);

  // With a picture: its differences, the library's darkness.
  material["extras"]["phare"] = {{"material", "asphalt"}};
  material["pbrMetallicRoughness"] = {
      {"baseColorTexture", {{"index", file.texture(png_of(2, 1, {255, 255, 255, 255, 188, 188, 188, 255}))}}}};
  scene = scene_of(file);
  EXPECT_NEAR(glm::dot(scene.materials.at(0).reflectance, glm::vec3(0.2126f, 0.7152f, 0.0722f)),
              glm::dot(glm::vec3(0.085f, 0.083f, 0.080f), glm::vec3(0.2126f, 0.7152f, 0.0722f)), 1e-6f);
  ASSERT_TRUE(scene.materials.at(0).look.base_texture);
}

TEST(ForeignScene, ReadingSaysHowFarItIs) {
  GltfBuilder file;
  file.square();
  std::vector<double> done;
  const auto scene = read_scene(file.write("phare_foreign.gltf"), [&](double done_01, std::string_view what) {
    EXPECT_EQ(what, "reading phare_foreign.gltf");
    done.push_back(done_01);
  });
  ASSERT_TRUE(scene);
  EXPECT_TRUE(std::ranges::is_sorted(done));
  ASSERT_GE(done.size(), 3u);
  EXPECT_EQ(done.front(), 0.0);
  EXPECT_EQ(done.back(), 1.0);
}

TEST(ForeignScene, SharedSamplesHaveTheirTextures) {
  const std::filesystem::path folder = std::filesystem::path(shared_data_dir()) / "gltf";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no " << folder.string() << ", the shared glTF samples";
  const Result<Scene> truck = read_scene(folder / "trimesh/CesiumMilkTruck.glb");
  ASSERT_TRUE(truck) << truck.error().text();
  EXPECT_FALSE(truck->textures.empty());
  EXPECT_FALSE(truck->looks.empty());
  const Result<Scene> cube = read_scene(folder / "tinygltf/Cube/Cube.gltf");
  ASSERT_TRUE(cube) << cube.error().text();
  ASSERT_EQ(cube->textures.size(), 2u);  // the second of roughness and metal
  EXPECT_EQ(cube->textures[0].width, 512u);
  const Result<Scene> spaces = read_scene(folder / "tinygltf/CubeImageUriSpaces/CubeImageUriSpaces.gltf");
  ASSERT_TRUE(spaces) << spaces.error().text();
  EXPECT_FALSE(noted(*spaces, "no such file"));
}

}  // namespace
}  // namespace phare
