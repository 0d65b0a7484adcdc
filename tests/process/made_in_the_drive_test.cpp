// process: what a drive in real time takes to draw what comes up in it is made before it or beside its frames: no frame
// is late for a pipeline.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "tests/paths.h"
#include "tests/process/drive_run.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class MadeInTheDrive : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "home"); }
  TemporaryFolder folder_;
};

/// `phare control` for the drive of a test: its exit code.
int control(const std::vector<std::string>& words) {
  std::vector<std::string> arguments{"control", "--port-base", std::to_string(port_base())};
  arguments.insert(arguments.end(), words.begin(), words.end());
  auto child = ChildProcess::start(program_beside_us("phare"), arguments);
  if (!child.ok()) return -1;
  while (!child->ended()) std::this_thread::sleep_for(std::chrono::milliseconds(5));  // it gives up by itself
  return child->ended()->exit_code;
}

std::int64_t newest_picture(const fs::path& out) {
  std::int64_t newest = 0;
  for (const fs::directory_entry& picture : fs::directory_iterator(out / "frames"))
    newest = std::max<std::int64_t>(newest, std::atoll(picture.path().stem().c_str()));
  return newest;
}

/// Once so many kinds of picture are complete, as the report says that a running drive writes. The car is taken back
/// to where it is at `at_s` again and again, so that its light stays and the drive does not end, be the machine slow.
bool wait_for_kinds(const fs::path& out, std::uint64_t kinds, const char* at_s) {
  for (int tenths = 0; tenths < 10 * kPatience.count(); ++tenths) {
    if (tenths % 30 == 29 && control({"seek", at_s}) != 0) return false;
    std::ifstream stats(out / "visual-0.json");
    const json now = json::parse(stats, nullptr, false);
    if (now.is_object() && now["made_in_the_drive"]["kinds_complete"] >= kinds) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

// Whatever the picture begins with, what it takes to draw it is made before the drive, and no frame of it is late for
// that.
TEST_F(MadeInTheDrive, IsNoPipelineWhateverThePictureBeginsWith) {
  for (const std::vector<std::string>& set :
       {std::vector<std::string>{"--set", "view=false-colour", "--set", "depth_first=on"},
        {"--set", "mirrors=on", "--set", "visibility_m=100", "--set", "shadows=fine"}}) {
    std::vector<std::string> arguments{"--frames", "20", "--rig", source_dir() + "/config/rigs/matrix.toml"};
    arguments.insert(arguments.end(), set.begin(), set.end());
    DriveRun run(folder_ / "ahead", folder_ / "home", arguments, /*lockstep=*/false);
    ASSERT_EQ(run.wait(), 0);
    const json made = report_of(folder_ / "ahead")["processes"]["visual-0"]["made_in_the_drive"];
    EXPECT_EQ(made["pipelines"], 0) << set[1] << ": " << made;
    fs::remove_all(folder_ / "ahead");
  }
}

// Two headlamps that are aimed alike have shaders of their own: one of them turned takes others.
TEST_F(MadeInTheDrive, IsNoPipelineWhenALampIsTurned) {
  const fs::path out = folder_ / "turned";
  DriveRun run(out, folder_ / "home", {"--frames", "100000"}, /*lockstep=*/false);
  ASSERT_TRUE(run.wait_for_frame(2));
  for (const char* yaw_deg : {"1", "0"}) {
    ASSERT_EQ(control({"move", "headlamp right", "yaw", yaw_deg}), 0);
    ASSERT_TRUE(run.wait_for_frame(newest_picture(out) + 60));
  }
  ASSERT_EQ(control({"quit"}), 0);
  ASSERT_EQ(run.wait(), 0);
  const json made = report_of(out)["processes"]["visual-0"]["made_in_the_drive"];
  EXPECT_EQ(made["pipelines"], 0) << made;
  EXPECT_GT(made["beside_the_frames"], 0) << made;
}

// A picture of a kind that nobody has thought of before the drive is made beside its frames: none is late for it, nor
// for the lights that are switched in it later, the front fog lamps from 51 to 57 s, high beam from 57 s on.
TEST_F(MadeInTheDrive, IsAnotherKindOfPictureBesideTheFrames) {
  const fs::path out = folder_ / "kinds";
  DriveRun run(out, folder_ / "home", {"--frames", "100000", "--validation", "--set", "weather_ahead=off"},
               /*lockstep=*/false);
  ASSERT_TRUE(run.wait_for_frame(2));
  const auto see = [&](const char* at_s) {
    ASSERT_EQ(control({"seek", at_s}), 0);
    ASSERT_TRUE(run.wait_for_frame(newest_picture(out) + 10)) << at_s;
  };
  ASSERT_EQ(control({"set", "method", "vertex"}), 0);
  ASSERT_TRUE(wait_for_kinds(out, 1, "1"));
  see("52"), see("58"), see("1");
  ASSERT_EQ(control({"set", "snow_cover", "0.5"}), 0);
  see("52");  // another light while the picture has not followed yet
  ASSERT_TRUE(wait_for_kinds(out, 2, "52"));
  see("52"), see("58");
  ASSERT_EQ(control({"quit"}), 0);
  ASSERT_EQ(run.wait(), 0);
  std::ifstream rows(out / "drive.csv");
  const std::string lit{std::istreambuf_iterator<char>(rows), {}};
  EXPECT_NE(lit.find("\"low fog\""), std::string::npos);
  EXPECT_NE(lit.find("\"low high\""), std::string::npos);
  const json report = report_of(out), made = report["processes"]["visual-0"]["made_in_the_drive"];
  EXPECT_EQ(made["pipelines"], 0) << made;
  EXPECT_EQ(made["kinds_followed"], 2) << made;
  EXPECT_GT(made["beside_the_frames"], 2) << made;
  EXPECT_EQ(report["summary"]["validation_messages"], 0);
}

// Vehicles that come toward us light the road with one lamp or two, and what stands in the beams of some of the lamps
// does not stand in those of the others; then the front fog lamps shine among theirs, of which nothing was made ready,
// and then the other design.
TEST_F(MadeInTheDrive, IsNoPipelineWhereOthersAreMet) {
  const fs::path out = folder_ / "others", script = folder_ / "fog.toml";
  std::ifstream without(source_dir() + "/config/drives/motorway_script.toml");
  std::ofstream(script) << without.rdbuf() << "\n[[event]]\nat_s_m = 50\nfog = true\n";
  DriveRun run(
      out, folder_ / "home",
      {"--frames", "100000", "--rig", source_dir() + "/config/rigs/motorway.toml", "--script", script.string()},
      /*lockstep=*/false);
  ASSERT_TRUE(run.wait_for_frame(2));
  std::this_thread::sleep_for(std::chrono::seconds(13));  // others go by before the fog lamps and after
  ASSERT_EQ(control({"set", "design", "1"}), 0);
  std::this_thread::sleep_for(std::chrono::seconds(5));
  ASSERT_EQ(control({"quit"}), 0);
  ASSERT_EQ(run.wait(), 0);
  std::ifstream rows(out / "drive.csv");
  const std::string lit{std::istreambuf_iterator<char>(rows), {}};
  EXPECT_NE(lit.find("\"low\""), std::string::npos);
  EXPECT_NE(lit.find("\"low fog\""), std::string::npos);
  const json visual = report_of(out)["processes"]["visual-0"];
  EXPECT_EQ(visual["made_in_the_drive"]["pipelines"], 0) << visual["made_in_the_drive"];
  EXPECT_GT(visual["made_in_the_drive"]["longest_between_frames_ms"], 0.0) << "nothing was rehearsed";
}

// Weather that begins in a drive switches within one frame, for which nothing is left to make.
TEST_F(MadeInTheDrive, IsNoPipelineForWeatherThatBegins) {
  const fs::path out = folder_ / "weather";
  DriveRun run(out, folder_ / "home", {"--frames", "100000", "--set", "weather_ahead=on"}, /*lockstep=*/false);
  ASSERT_TRUE(run.wait_for_frame(2));
  const auto draws = [&](const char* setting, const char* value) {
    // What has been drawn when the answer came may have been without; the one after has it.
    ASSERT_TRUE(run.wait_for_frame(newest_picture(out) + 3)) << setting << " " << value;
  };
  for (const auto& [setting, value] :
       {std::pair("windscreen", "on"), {"rain_mmph", "0.2"}, {"rain_mmph", "40"}, {"snow_cover", "0.3"},
        {"rain_mmph", "0"}, {"snow_mmph", "1"}, {"snow_cover", "0"}, {"snow_mmph", "0"}, {"ground", "wet"},
        {"ground", "auto"}, {"visibility_m", "80"}, {"visibility_m", "clear"}, {"snow_cover", "0.6"}}) {
    ASSERT_EQ(control({"set", setting, value}), 0) << setting;
    draws(setting, value);
  }
  // With the front fog lamps on, as they are from 51 to 57 s: four lamps in place of two.
  ASSERT_EQ(control({"set", "snow_cover", "0"}), 0);
  for (const auto& [setting, value] :
       {std::pair("rain_mmph", "5"), {"rain_mmph", "0"}, {"visibility_m", "80"}, {"snow_mmph", "1"}}) {
    ASSERT_EQ(control({"seek", "52"}), 0);
    ASSERT_EQ(control({"set", setting, value}), 0) << setting;
    draws(setting, value);
  }
  // The car comes from afar, and the frame that shows it there first may be the one that follows the desk, too.
  ASSERT_EQ(control({"set", "snow_mmph", "0"}), 0);
  for (int tenth = 0; tenth < 10; ++tenth) {
    ASSERT_EQ(control({"seek", "10"}), 0);
    draws("seek", "10");
    ASSERT_EQ(control({"seek", "52"}), 0);
    std::this_thread::sleep_for(tenth * std::chrono::milliseconds(6));  // frames are 16.7 ms apart, poses kept back 50
    ASSERT_EQ(control({"set", "visibility_m", tenth % 2 == 0 ? "clear" : "80"}), 0);
    draws("seek", "52");
  }
  ASSERT_EQ(control({"quit"}), 0);
  ASSERT_EQ(run.wait(), 0);
  const json visual = report_of(out)["processes"]["visual-0"];
  EXPECT_EQ(visual["made_in_the_drive"]["pipelines"], 0) << visual["made_in_the_drive"];
  EXPECT_EQ(visual["made_in_the_drive"]["kinds_followed"], 0) << visual["made_in_the_drive"];
  EXPECT_GT(visual["frames"], 2 + 3 * (13 + 4 + 20));
  std::ifstream rows(out / "drive.csv");
  std::size_t with_fog_lamps = 0;
  for (std::string row; std::getline(rows, row);)
    with_fog_lamps += row.find("\"low fog\"") != std::string::npos ? 1 : 0;
  EXPECT_GT(with_fog_lamps, 3u * 4u) << "they shone";
}

}  // namespace
}  // namespace phare::test
