// process: a lamp of one's own through the whole launcher: in its report, aimed, kept against a recorded change of
// design, driven again from the rig that was left behind, and from a folder that was moved.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "config/base/content_hash.h"
#include "config/base/result.h"
#include "tests/paths.h"
#include "tests/process/drive_run.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string whole_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class LampDrive : public testing::Test {
 protected:
  LampDrive() : my_(folder_ / "my lamp.ies") {
    fs::copy_file(lamps_dir() + "/led_low_rht.ies", my_);
    fs::create_directories(folder_ / "home");
  }
  int drive_with(const std::string& out, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--frames", "3"});
    return drive(folder_ / out, folder_ / "home", arguments);
  }

  TemporaryFolder folder_;
  fs::path my_;
};

TEST_F(LampDrive, TheReportHasItsFileFluxAndAim) {
  ASSERT_EQ(drive_with("out", {"--lamp", my_.string()}), 0);
  const json report = report_of(folder_ / "out");
  const auto table = read_lamp(my_);
  ASSERT_TRUE(table);
  int rows = 0;
  for (const json& lamp : report["lamps"]) {
    if (lamp["file"] != "my lamp.ies") continue;
    ++rows;
    EXPECT_EQ(lamp["design"], "my lamp");
    EXPECT_EQ(lamp["function"], "low");
    EXPECT_EQ(lamp["content_hash"], table->content_hash);
    EXPECT_NEAR(lamp["flux_lm"].get<double>(), table->flux_lm(), 1e-9 * table->flux_lm());
  }
  EXPECT_EQ(rows, 2);
  EXPECT_EQ(report["lamps"][0]["design"], "my lamp") << "it stands first";
  const json& visual = report["processes"]["visual-0"];
  ASSERT_EQ(visual["aims"].size(), 2u);
  // -1 % = -0.573°, found to 0.01° and put there to 0.003°
  EXPECT_NEAR(visual["aims"][0]["cutoff_v_deg"].get<double>(), -0.573, 0.013);
  const std::string page = whole_text(folder_ / "out" / "index.html");
  EXPECT_NE(page.find("my lamp, headlamp left: cut-off found"), std::string::npos);

  // The rig that was kept drives the same again.
  ASSERT_EQ(drive_with("again", {"--rig", (folder_ / "out" / "rig.toml").string()}), 0);
  EXPECT_EQ(differences(pictures_of(folder_ / "out"), pictures_of(folder_ / "again")), std::vector<std::string>{});
  EXPECT_FALSE(fs::exists(folder_ / "again" / "rig.toml"));
  // And it is another lamp than the rig's.
  ASSERT_EQ(drive_with("out", {}), 0);
  EXPECT_FALSE(fs::exists(folder_ / "out" / "rig.toml")) << "not of this drive";
  EXPECT_NE(differences(pictures_of(folder_ / "out"), pictures_of(folder_ / "again")), std::vector<std::string>{});
}

TEST_F(LampDrive, ARecordedChangeOfDesignIsLeftOut) {
  std::string script = whole_text(source_dir() + "/config/drives/country_road_script.toml");
  const fs::path quiet = folder_ / "quiet.toml", changes = folder_ / "changes.toml";
  script = script.substr(0, script.find("[[event]]"));
  for (std::size_t at; (at = script.find("\"../")) != std::string::npos;)
    script.replace(at, 4, "\"" + source_dir() + "/config/");
  std::ofstream(quiet) << script;
  std::ofstream(changes) << script << "[[event]]\nat_t_s = 0.02\ndesign_steps = 1\n";
  ASSERT_EQ(drive_with("quiet", {"--lamp", my_.string(), "--script", quiet.string()}), 0);
  ASSERT_EQ(drive_with("kept", {"--lamp", my_.string(), "--script", changes.string()}), 0);
  EXPECT_EQ(differences(pictures_of(folder_ / "quiet"), pictures_of(folder_ / "kept")), std::vector<std::string>{});
  EXPECT_EQ(report_of(folder_ / "kept")["processes"]["cockpit"]["design_changes_left_out"], 1);
  // The rig's own designs still change.
  ASSERT_EQ(drive_with("quiet", {"--script", quiet.string()}), 0);
  ASSERT_EQ(drive_with("kept", {"--script", changes.string()}), 0);
  EXPECT_NE(differences(pictures_of(folder_ / "quiet"), pictures_of(folder_ / "kept")), std::vector<std::string>{});
}

TEST_F(LampDrive, APortableRigDrivesFromWhereItWasMoved) {
  const std::string command = "cd '" + (folder_ / "home").string() + "' && '" + program("phare") +
                              "' rig new --lamp '" + my_.string() + "' --out night.toml --portable >/dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  fs::rename(folder_ / "home", folder_ / "elsewhere");
  fs::create_directories(folder_ / "home");
  ASSERT_EQ(drive_with("straight", {"--lamp", my_.string()}), 0);
  fs::remove(my_);
  ASSERT_EQ(drive_with("moved", {"--rig", (folder_ / "elsewhere" / "night.toml").string()}), 0);
  auto straight = pictures_of(folder_ / "straight");
  EXPECT_EQ(differences(straight, pictures_of(folder_ / "moved")), std::vector<std::string>{});
}

}  // namespace
}  // namespace phare::test
