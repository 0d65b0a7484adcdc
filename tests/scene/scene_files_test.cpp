// unit: which files a scene is made of, and the hash that they are known by.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "config/base/content_hash.h"
#include "config/formats/gltf_uri.h"
#include "tests/scene/gltf_builder.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

std::string hash_of(GltfBuilder& file) {
  const Result<Scene> scene = read_scene(file.write("phare_scene_files.gltf"));
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
  return scene ? scene->content_hash : "";
}

TEST(SceneFiles, TheHashCoversWhatLiesBesideTheFile) {
  const std::filesystem::path folder(testing::TempDir());
  const auto put = [&](const char* name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  };
  GltfBuilder alone;
  alone.square();
  const std::filesystem::path file = alone.write("phare_scene_files.gltf");
  EXPECT_EQ(hash_of(alone), *content_hash_of_file(file)) << "as sha256sum says";
  EXPECT_EQ(files_beside(file), std::vector<std::filesystem::path>{});

  GltfBuilder whole;
  whole.square();
  whole.root["images"] = GltfBuilder::Json::array({{{"uri", "my%20bark.png"}}});
  whole.root["buffers"] = GltfBuilder::Json::array({{{"uri", "more.bin"}, {"byteLength", 4}}});
  whole.root["extensions"]["EXT_lights_ies"]["lights"] = GltfBuilder::Json::array({{{"uri", "street.ies"}}});
  const char* names[] = {"my bark.png", "more.bin", "street.ies"};
  for (const char* name : names) put(name, "1234");
  const std::string before = hash_of(whole);
  EXPECT_TRUE(before.starts_with("sha256:"));
  EXPECT_EQ(hash_of(whole), before);
  for (const char* name : names) {
    put(name, "4321");
    EXPECT_NE(hash_of(whole), before) << name;
    put(name, "1234");
    EXPECT_EQ(hash_of(whole), before) << name;
  }
  std::filesystem::remove(folder / names[0]);
  EXPECT_NE(hash_of(whole), before) << "a picture that is gone";
  const std::vector<std::filesystem::path> beside{"more.bin", "my bark.png", "street.ies"};
  EXPECT_EQ(files_beside(whole.write("phare_scene_files.gltf")), beside);
}

}  // namespace
}  // namespace phare
