// unit: which drive a rig takes when nobody names one.
#include "tools/demo_drive.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/paths.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

const fs::path kConfig = fs::path(source_dir()) / "config";

Rig rig_named(const std::string& name) {
  const auto rig = read_rig((kConfig / "rigs" / (name + ".toml")).string());
  EXPECT_TRUE(rig) << (rig ? "" : rig.error().text());
  return rig ? *rig : Rig{};
}

TEST(DemoDrive, EachOfOurScenesHasItsOwn) {
  for (const std::string scene : {"country_road", "town", "motorway", "tunnel"})
    EXPECT_EQ(demo_script(rig_named(scene), kConfig), (kConfig / "drives" / (scene + "_script.toml")).string());
  for (const std::string rig : {"country_road", "matrix", "three_channels"})
    EXPECT_EQ(demo_recording(rig_named(rig), kConfig), (kConfig / "drives/country_road.pcap").string()) << rig;
  for (const std::string rig : {"town", "motorway", "tunnel"}) EXPECT_FALSE(demo_recording(rig_named(rig), kConfig));
}

// A scene of somebody else that happens to be called as one of ours is another road.
TEST(DemoDrive, AnotherSceneHasNone) {
  Rig rig = rig_named("town");
  rig.scene_file = "/elsewhere/town.glb";
  EXPECT_FALSE(demo_script(rig, kConfig));
  rig.scene_file = "/elsewhere/country_road.glb";
  EXPECT_FALSE(demo_recording(rig, kConfig));
}

}  // namespace
}  // namespace phare
