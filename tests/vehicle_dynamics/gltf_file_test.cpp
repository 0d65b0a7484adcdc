// glTF files of our own making, those of the shared data, and broken ones.
#include "config/formats/gltf_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>
#include <sstream>

#include "config/road/road_surface.h"
#include "tests/paths.h"

namespace phare {
namespace {

std::filesystem::path written(const std::string& name, const std::string& bytes) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / name;
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// A GLB with one triangle of 10 m, 2 m up, under a node "road_a" that a parent moves by (100, 5, 0) glTF.
std::string one_triangle(const std::string& find = "", const std::string& replace = "") {
  std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"name":"world","translation":[100,5,0],"children":[1]},{"name":"road_a","mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,2,-10],"max":[10,2,0]},
                 {"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
    "buffers":[{"byteLength":42}]})";
  if (!find.empty()) {
    const std::size_t where = json.find(find);
    if (where == std::string::npos) throw std::runtime_error("no " + find);
    json.replace(where, find.size(), replace);
  }
  while (json.size() % 4 != 0) json += ' ';
  const float corners[9] = {0, 2, 0, 10, 2, 0, 0, 2, -10};
  const std::uint16_t indices[3] = {0, 1, 2};
  std::string bin(44, '\0');
  std::memcpy(bin.data(), corners, 36);
  std::memcpy(bin.data() + 36, indices, 6);
  const auto word = [](std::size_t value) {
    const auto v = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&v), 4);
  };
  return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + bin.size()) + word(json.size()) + "JSON" + json +
         word(bin.size()) + std::string("BIN\0", 4) + bin;
}

// Reads everything a reader of ours would; true when all of it was good.
bool read_all(const std::filesystem::path& file) {
  const Result<tinygltf::Model> model = read_gltf(file);
  bool good = model.ok();
  if (good) {
    const Result<std::vector<MeshInstance>> instances = mesh_instances(*model);
    good = instances.ok();
    if (good)
      for (const MeshInstance& instance : *instances)
        for (const tinygltf::Primitive& primitive : model->meshes[static_cast<std::size_t>(instance.mesh)].primitives)
          for (const auto& [name, accessor] : primitive.attributes) {
            if (name != "POSITION") continue;
            const auto positions = read_vec3(*model, accessor);
            good = good && positions.ok() && read_triangles(*model, primitive, positions->size()).ok();
          }
  }
  (void)RoadSurface::read(file).ok();
  return good;
}

// What tinygltf calls an invalid binary, or not found, whatever it is.
TEST(GltfFile, ContainersAndBuffersThatAreWrongSayHow) {
  const auto why = [](const std::string& name, const std::string& bytes) {
    const auto model = read_gltf(written(name, bytes));
    return model ? "" : model.error().text();
  };
  std::string glb = one_triangle();
  glb.replace(16, 4, "BIN ");
  EXPECT_NE(why("chunks.glb", glb).find("its first chunk is not JSON"), std::string::npos) << why("chunks.glb", glb);
  glb = one_triangle();
  glb.replace(8, 4, std::string("\x20\0\0\0", 4));
  EXPECT_NE(why("short.glb", glb).find("says 32 bytes, of which its JSON chunk alone takes "), std::string::npos)
      << why("short.glb", glb);

  std::filesystem::create_directories(std::filesystem::path(testing::TempDir()) / "folder.bin");
  const auto of_buffer = [&](const std::string& uri) {
    return why("b.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":42,"uri":")" + uri + "\"}]}");
  };
  EXPECT_NE(of_buffer("ab%20sent.bin").find("its buffer ab sent.bin: no such file"), std::string::npos)
      << of_buffer("ab%20sent.bin");
  EXPECT_NE(of_buffer("folder.bin").find("its buffer folder.bin: is a folder"), std::string::npos)
      << of_buffer("folder.bin");
}

TEST(GltfFile, NodesMoveTheRoadAndYIsUp) {
  const auto road = RoadSurface::read(written("one.glb", one_triangle()));
  ASSERT_TRUE(road.ok()) << road.error().text();
  EXPECT_EQ(road->triangle_count(), 1u);
  const auto point = road->at(102.0, 3.0);  // glTF z = -3
  ASSERT_TRUE(point);
  EXPECT_DOUBLE_EQ(point->z_m, 7.0);
  EXPECT_DOUBLE_EQ(point->normal.z, 1.0);
  EXPECT_FALSE(road->at(102.0, -3.0));
}

TEST(GltfFile, BrokenOnesGiveAReason) {
  const std::pair<const char*, const char*> cases[] = {
      {"\"count\":3,\"type\":\"VEC3\"", "\"count\":4,\"type\":\"VEC3\""},
      {"\"count\":3,\"type\":\"VEC3\"", "\"count\":4000000000,\"type\":\"VEC3\""},
      {"\"indices\":1", "\"indices\":7"},
      {"\"POSITION\":0", "\"POSITION\":9"},
      {"\"POSITION\":0", "\"POSITION\":1"},
      {"\"byteOffset\":36", "\"byteOffset\":4"},  // indices read from floats: out of range
      {"\"byteOffset\":36", "\"byteOffset\":4000000000"},
      {"\"mesh\":0", "\"mesh\":3"},
      {"\"mesh\":0", "\"mesh\":0,\"rotation\":[0,0,0,0]"},
      {"\"mesh\":0", "\"mesh\":0,\"children\":[0]"},
      {"\"children\":[1]", "\"children\":[0]"},
      {"\"children\":[1]", "\"children\":[77]"},
      {"\"children\":[1]", "\"children\":[1,1]"},
      {"\"scene\":0", "\"scene\":5"},
      {"\"bufferView\":0", "\"bufferView\":-4"},
      {"\"version\":\"2.0\"", "\"version\":\"2.0\",\"extras\":" /* nested below */},
      {"\"scene\":0", "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]"}};
  for (const auto& [find, replace] : cases) {
    std::string with = replace;
    if (with.ends_with("extras\":")) with += std::string(100'000, '[') + std::string(100'000, ']');
    const std::filesystem::path file = written("broken.glb", one_triangle(find, with));
    EXPECT_FALSE(read_all(file)) << find << " -> " << replace;
    const auto road = RoadSurface::read(file);
    ASSERT_FALSE(road.ok()) << find << " -> " << replace;
    EXPECT_NE(road.error().place.find("broken.glb"), std::string::npos);
    EXPECT_FALSE(road.error().reason.empty());
  }
  EXPECT_EQ(read_gltf("/nonexistent.glb").error().text(), "/nonexistent.glb: no such file");
  EXPECT_FALSE(read_gltf(testing::TempDir()).ok());
  EXPECT_FALSE(read_gltf(written("empty.glb", "")).ok());
}

TEST(GltfFile, CutAnywhereItDoesNotCrash) {
  const std::string whole = one_triangle();
  for (std::size_t size = 0; size < whole.size(); size += 3) {
    const std::filesystem::path file = written("cut.glb", whole.substr(0, size));
    EXPECT_FALSE(read_all(file)) << size;
  }
}

TEST(GltfFile, FlippedBytesDoNotCrash) {
  const std::string whole = one_triangle();
  std::mt19937 random(11);
  for (int i = 0; i < 1000; ++i) {
    std::string bytes = whole;
    for (int flips = 0; flips < 3; ++flips) bytes[random() % bytes.size()] = static_cast<char>(random());
    (void)read_all(written("flip.glb", bytes));
  }
}

TEST(GltfFile, SharedFilesAreReadOrRefused) {
  const std::filesystem::path folder = std::filesystem::path(shared_data_dir()) / "gltf";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  int good = 0, refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") continue;
    const bool read = read_all(entry.path());
    (read ? good : refused) += 1;
    const bool meant_broken = entry.path().string().find("/validator/") != std::string::npos;
    EXPECT_TRUE(read || meant_broken) << entry.path();
    // and cut in half, with its neighbours beside it out of reach
    const std::string bytes = bytes_of(entry.path());
    (void)read_all(written("half" + entry.path().extension().string(), bytes.substr(0, bytes.size() / 2)));
  }
  std::printf("shared glTF files: %d read, %d refused\n", good, refused);
  EXPECT_GT(good, 0);
}

}  // namespace
}  // namespace phare
