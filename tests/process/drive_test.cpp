// process: whole drives, three processes and the launcher on loopback, lockstep and validation on. The same drive
// twice, each process killed in its midst, every socket under a flood: the pictures and the lux are the same, bit for
// bit.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

#include "net/drive_file.h"
#include "tests/paths.h"
#include "tests/process/drive_run.h"
#include "tests/process/gpu_fault.h"
#include "visual/image/image.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kFrames = 75;
constexpr int kStills = 4;  // driver's view, bird's eye, wall, EXR

/// What a report says that does not depend on the time it took, nor on who was restarted: lux (float64 residual of the
/// audited pixels), frames, draws, the drive's length, the hash over all frames.
json facts_of(const json& report) {
  const json& visual = report["processes"]["visual-0"];
  json facts;
  for (const char* key : {"self_audit", "draws", "passes", "triangles", "sim_time_s", "kept_frames", "scene", "lamps",
                          "validation", "validation_messages", "frames", "frames_captured", "frames_stale_pose"})
    facts[key] = visual[key];
  facts["light_changes"] = visual["switch_to_photon"]["changes"];
  facts["light_frames"] = visual["switch_to_photon"]["frames"];
  for (const char* key : {"scene", "vehicle", "lamps", "drive", "rig", "ends"}) facts["report"][key] = report[key];
  return facts;
}

/// How two pictures differ, in words: in their pixels, or only in how these were deflated.
std::string pixels_that_differ(const fs::path& a, const fs::path& b) {
  const Result<Image8> one = read_png(a), other = read_png(b);
  if (!one.ok() || !other.ok()) return ", no pictures that can be read";
  if (one->rgba.size() != other->rgba.size()) return ", of another size";
  std::size_t count = 0, first = 0;
  for (std::size_t i = one->rgba.size(); i-- > 0;)
    if (one->rgba[i] != other->rgba[i]) ++count, first = i / 4;
  if (count == 0) return ", pixels as in the other";
  const auto width = static_cast<std::size_t>(one->width_px);
  return ", " + std::to_string(count) + " channels of its pixels, the first at " + std::to_string(first % width) +
         ", " + std::to_string(first / width);
}

/// The undisturbed drive, driven once for all tests of this program.
struct QuietDrive {
  TemporaryFolder folder;
  int exit_code = -1;
  std::map<std::string, std::string> pictures;
  json report;
};

class DriveTest : public testing::Test {
 protected:
  DriveTest() : quiet_(quiet()), folder_(quiet_.folder) {}
  void SetUp() override {
    ASSERT_EQ(quiet_.exit_code, 0);
    ASSERT_EQ(quiet_.pictures.size(), static_cast<std::size_t>(kFrames + kStills));
    for (const auto& [name, bytes] : quiet_.pictures) ASSERT_FALSE(bytes.empty()) << name;
  }

  static const QuietDrive& quiet() {
    static const auto the_only = [] {
      auto driven = std::make_unique<QuietDrive>();
      fs::create_directories(driven->folder / "home");
      const fs::path out = driven->folder / "quiet";
      driven->exit_code = drive(out, driven->folder / "home", arguments());
      driven->pictures = pictures_of(out);
      driven->report = report_of(out);
      return driven;
    }();
    return *the_only;
  }

  static std::vector<std::string> arguments() { return {"--frames", std::to_string(kFrames), "--validation"}; }

  void expect_the_same_pictures(const fs::path& out) {
    const auto different = differences(quiet_.pictures, pictures_of(out));
    if (different.empty()) return;
    const std::string& first = different.front();
    ADD_FAILURE() << different.size() << " pictures differ, first " << first
                  << pixels_that_differ(quiet_.folder / "quiet" / first, out / first);
  }

  const QuietDrive& quiet_;
  const TemporaryFolder& folder_;
};

TEST_F(DriveTest, FramesAreOfADriveAndNotAllTheSame) {
  EXPECT_NE(quiet_.pictures.at("frames/000000.png"), quiet_.pictures.at("frames/000074.png"));
  EXPECT_EQ(quiet_.report["summary"]["validation_messages"], 0);
  EXPECT_EQ(quiet_.report["summary"]["restarts"], 0);
  EXPECT_GT(quiet_.report["summary"]["self_audit"]["residual_percent"]["pixels"], 0);
  for (const char* process : {"cockpit", "dynamics", "visual-0", "phare"}) {
    const json& counts = quiet_.report["summary"]["messages"][process];
    EXPECT_GT(counts["received"], 0) << process;
    for (const char* bad : {"lost", "late", "refused", "restarted"}) EXPECT_EQ(counts[bad], 0) << process << " " << bad;
  }
}

// Nobody named a drive: on another of our roads the car begins on the lane of that one.
TEST_F(DriveTest, AnotherOfOurRoadsIsDrivenAlongItsOwnLane) {
  const fs::path out = folder_ / "motorway";
  ASSERT_EQ(drive(out, folder_ / "home",
                  {"--frames", "2", "--validation", "--rig", source_dir() + "/config/rigs/motorway.toml"}),
            0);
  std::ifstream rows(out / "drive.csv");
  std::string names, first;
  ASSERT_TRUE(std::getline(rows, names) && std::getline(rows, first));
  ASSERT_EQ(names.rfind("frame,time_s,x_m,y_m,", 0), 0u) << names;
  double x_m = NAN, y_m = NAN;
  ASSERT_EQ(std::sscanf(first.c_str(), "%*d,%*f,%lf,%lf,", &x_m, &y_m), 2) << first;
  EXPECT_NEAR(x_m, 0.0, 1e-6);
  EXPECT_NEAR(y_m, -8.375, 1e-6);  // the motorway's right lane; the country road's lies at -1.625
}

// A rig whose cockpit names a script is driven by it, and by no demo.
TEST_F(DriveTest, ARigsOwnSourceDrivesIt) {
  const std::string config = source_dir() + "/config/";
  const auto text_of = [](const std::string& file) {
    std::ifstream in(file);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
    return text;
  };
  const fs::path own = folder_ / "own";
  fs::create_directories(own);
  std::ofstream(own / "cockpit.toml") << "[source]\nkind = \"driver\"\nfile = \"script.toml\"\n";
  std::ofstream(own / "script.toml") << replaced(text_of(config + "drives/country_road_script.toml"), "light = \"low\"",
                                                 "light = \"position\"");
  std::ofstream(own / "rig.toml") << replaced(
      replaced(text_of(config + "rigs/country_road.toml"), "\"../cockpits/keyboard.toml\"", "\"cockpit.toml\""),
      "\"../", "\"" + config);
  ASSERT_EQ(drive(own / "out", folder_ / "home", {"--frames", "3", "--rig", (own / "rig.toml").string()}), 0);
  const json report = report_of(own / "out");
  EXPECT_FALSE(report.contains("drive") && !report["drive"].is_null()) << report["drive"];
  std::ifstream rows(own / "out/drive.csv");
  const std::string csv{std::istreambuf_iterator<char>(rows), {}};
  EXPECT_EQ(csv.find("low"), std::string::npos) << csv;
  fs::remove(own / "script.toml");
  EXPECT_EQ(drive(own / "none", folder_ / "home", {"--frames", "3", "--rig", (own / "rig.toml").string()}), 2);
}

// Beam images are summed when a light changes, at most one for each of two headlamps and two fog lamps, and in no other
// frame.
// What dazzles from behind the wall is hidden by it, while the driver is dazzled.
TEST_F(DriveTest, TheWallIsShownWhileOthersComeToward) {
  DriveRun run(folder_ / "wall", folder_.path(),
               {"--frames", "2", "--camera", "wall", "--traffic", source_dir() + "/config/examples/column.toml"});
  EXPECT_EQ(run.wait(), 0);
  EXPECT_TRUE(report_of(folder_ / "wall")["restarts"].empty());
}

TEST_F(DriveTest, BeamsAreSummedOnlyWhenALightChanges) {
  const json& visual = quiet_.report["processes"]["visual-0"];
  const int changes = visual["switch_to_photon"]["changes"];
  EXPECT_LE(visual["beams"]["compositions"], 4 * changes);
  EXPECT_EQ(visual["beams"]["image"], "float32-native-nodes");
}

// A control unit beside the rig dims the segments of one matrix lamp: the picture follows, the other processes do not
// care.
TEST_F(DriveTest, ALampIsDimmedWhileDriving) {
  const std::vector<std::string> arguments{"--frames", "40", "--validation", "--rig",
                                           source_dir() + "/config/rigs/matrix.toml"};
  const fs::path lit = folder_ / "matrix lit", dimmed = folder_ / "matrix dimmed";
  ASSERT_EQ(drive(lit, folder_ / "home", arguments), 0);
  {
    DriveRun run(dimmed, folder_ / "home", arguments);
    ASSERT_TRUE(run.wait_for_frame(5));
    auto child =
        ChildProcess::start(program_beside_us("phare"), {"control", "--port-base", std::to_string(port_base()), "--rig",
                                                         arguments.back(), "dim", "headlamp left", "0", "0.5"});
    ASSERT_TRUE(child.ok());
    EXPECT_EQ(run.wait(), 0);
  }
  const auto with = pictures_of(lit), without = pictures_of(dimmed);
  EXPECT_EQ(with.at("frames/000004.png"), without.at("frames/000004.png"));
  EXPECT_NE(with.at("frames/000039.png"), without.at("frames/000039.png"));
  const json before = report_of(lit)["processes"]["visual-0"]["beams"],
             after = report_of(dimmed)["processes"]["visual-0"]["beams"];
  EXPECT_EQ(after["compositions"], before["compositions"].get<int>() + 1);  // one lamp, in one frame
}

TEST_F(DriveTest, TheSameBitForBitFromAnotherWorkingDirectory) {
  const fs::path elsewhere = folder_ / "a folder elsewhere";
  fs::create_directories(elsewhere);
  ASSERT_EQ(drive("again", elsewhere, arguments()), 0);  // relative to the working directory
  expect_the_same_pictures(elsewhere / "again");
  EXPECT_EQ(facts_of(quiet_.report), facts_of(report_of(elsewhere / "again")));
}

// The stills take a second to make, in which nobody could drive.
TEST_F(DriveTest, StillsOfADriveInRealTimeAreMadeWhenItIsOver) {
  const fs::path out = folder_ / "real time";
  DriveRun run(out, folder_ / "home", {"--frames", "330", "--still-at", "1"}, false);
  ASSERT_TRUE(run.wait_for_frame(250));  // 4.2 s at least; the car is fast enough for stills from 3.6 s on
  EXPECT_FALSE(fs::exists(out / "drivers_view.png"));
  EXPECT_FALSE(fs::exists(out / "wall_25m.png"));
  ASSERT_EQ(run.wait(), 0);
  for (const char* still : {"drivers_view.png", "birds_eye.png", "wall_25m.png", "hdr.exr"})
    EXPECT_TRUE(fs::exists(out / still)) << still;
  EXPECT_EQ(report_of(out)["processes"]["visual-0"]["self_audit"]["audits"], 2);
}

TEST_F(DriveTest, TheSameOffLoopbackWithAKey) {
  std::ifstream rig(source_dir() + "/config/rigs/country_road.toml");
  std::string text{std::istreambuf_iterator<char>(rig), {}};
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  };
  replace("\"../", "\"" + source_dir() + "/config/");
  replace("\"127.0.0.1\"", "\"0.0.0.0\"\nkey_file = \"bus.key\"");
  std::ofstream(folder_ / "sealed.toml") << text;
  std::ofstream(folder_ / "bus.key") << std::string(64, 'a') << '\n';
  fs::permissions(folder_ / "bus.key", fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_EQ(
      drive(folder_ / "sealed", folder_ / "home", {"--frames", "12", "--rig", (folder_ / "sealed.toml").string()}), 0);
  const auto pictures = pictures_of(folder_ / "sealed");
  for (int frame = 0; frame < 12; ++frame) {
    char name[40];
    std::snprintf(name, sizeof name, "frames/%06d.png", frame);
    ASSERT_TRUE(pictures.contains(name)) << name;
    EXPECT_EQ(pictures.at(name), quiet_.pictures.at(name)) << name;
  }
  const json report = report_of(folder_ / "sealed");
  for (const char* process : {"cockpit", "dynamics", "visual-0", "phare"})
    EXPECT_EQ(report["summary"]["messages"][process]["refused"], 0) << process;
}

class KillTest : public DriveTest, public testing::WithParamInterface<const char*> {};

TEST_P(KillTest, TheDriveGoesOnAsIfNothingHadHappened) {
  const std::string name = GetParam(), program = "phare-" + name.substr(0, name.find('-'));
  const fs::path out = folder_ / ("killed " + name);
  DriveRun run(out, folder_ / "home", arguments());
  ASSERT_TRUE(run.wait_for_frame(15));
  const auto before = run.processes();
  ASSERT_EQ(before.size(), 3u);
  ASSERT_EQ(kill(before.at(program), SIGKILL), 0);
  ASSERT_TRUE(run.wait_for_frame(kFrames - 10));
  const auto after = run.processes();
  EXPECT_EQ(after.size(), 3u);
  for (const auto& [other, process] : before) {
    if (other == program) {
      EXPECT_NE(after.at(other), process);
    } else {
      EXPECT_EQ(after.at(other), process) << other << " was not to leave";
    }
  }
  EXPECT_EQ(run.wait(), 0);
  expect_the_same_pictures(out);

  const json report = report_of(out);
  ASSERT_EQ(report["restarts"].size(), 1u);
  EXPECT_EQ(report["restarts"][0]["process"], name);
  EXPECT_EQ(report["restarts"][0]["because"], "SIGKILL");
  for (const char* process : {"cockpit", "dynamics", "visual-0"}) {
    const json& counts = report["summary"]["messages"][process];
    // Each sender that others hear from is noticed as started again, once per message it sends.
    if (process != name) {
      EXPECT_EQ(counts["restarted"], 1) << process;
    }
    EXPECT_EQ(counts["refused"], 0) << process;
    std::printf("%s killed: %-9s lost %s, late %s, duplicate %s, restarted %s\n", name.c_str(), process,
                counts["lost"].dump().c_str(), counts["late"].dump().c_str(), counts["duplicate"].dump().c_str(),
                counts["restarted"].dump().c_str());
  }
  EXPECT_EQ(report["summary"]["validation_messages"], 0);
}
INSTANTIATE_TEST_SUITE_P(Each, KillTest, testing::Values("cockpit", "dynamics", "visual-0"),
                         [](const auto& info) { return std::string(info.param, std::strcspn(info.param, "-")); });

// A driver that is reset, a card that is taken away: the visual says so and leaves, one begun anew asks for the device
// again, and no picture is missing or another.
TEST_F(DriveTest, ALostDeviceIsAskedForAgain) {
  const fs::path out = folder_ / "device lost";
  const GpuFault fault("lost-device:60", folder_ / "device lost told");
  ASSERT_EQ(drive(out, folder_ / "home", arguments()), 0);
  ASSERT_TRUE(fault.happened());
  expect_the_same_pictures(out);
  const json report = report_of(out);
  ASSERT_EQ(report["restarts"].size(), 1u);
  EXPECT_EQ(report["restarts"][0]["process"], "visual-0");
  EXPECT_EQ(report["restarts"][0]["because"], "exit 1") << "it leaves by itself, and does not crash";
  EXPECT_EQ(report["summary"]["validation_messages"], 0);
}

// A command that draws without a launcher: it says what happened, and ends with 1.
TEST_F(DriveTest, ACommandWhoseDeviceIsLostSaysSo) {
  const GpuFault fault("lost-device:3", folder_ / "command told");
  const std::string said = (folder_ / "command said").string();
  const std::string line = "'" + program("phare") + "' hard-cases depth >'" + said + "' 2>&1";
  const int status = std::system(line.c_str());
  ASSERT_TRUE(fault.happened());
  std::stringstream text;
  text << std::ifstream(said).rdbuf();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << status << ": " << text.str();
  EXPECT_NE(text.str().find("phare: the graphics device was lost ("), std::string::npos) << text.str();
}

// A car that answers the controls goes on from the whole state that the killed one left, bit for bit.
TEST_F(DriveTest, AKilledCarThatAnswersTheControlsGoesOnAsIfNothingHadHappened) {
  Drive drives[2];
  for (const bool killed : {false, true}) {
    const std::string name = killed ? "car killed" : "car";
    const fs::path recorded = folder_ / (name + ".pcap");
    DriveRun run(folder_ / name, folder_ / "home",
                 {"--frames", std::to_string(kFrames), "--closed-loop", "--record", recorded.string()});
    ASSERT_TRUE(run.wait_for_frame(15));
    if (killed) {
      ASSERT_EQ(kill(run.processes().at("phare-dynamics"), SIGKILL), 0);
    }
    EXPECT_EQ(run.wait(), 0);
    auto read = read_drive(recorded);
    ASSERT_TRUE(read.ok()) << read.error().text();
    drives[killed ? 1 : 0] = std::move(*read);
  }
  std::map<std::int64_t, VehicleState> undisturbed;
  for (const Datagram& datagram : drives[0].datagrams) {
    if (const auto* car = std::get_if<VehicleState>(&datagram.payload)) undisturbed[car->frame_index] = *car;
  }
  double most_m = 0.0;
  std::int64_t last = -1;
  for (const Datagram& datagram : drives[1].datagrams) {
    const auto* car = std::get_if<VehicleState>(&datagram.payload);
    if (car == nullptr || !undisturbed.contains(car->frame_index)) continue;
    const VehicleState& other = undisturbed[car->frame_index];
    most_m = std::max(
        {most_m, std::abs(car->x_m - other.x_m), std::abs(car->y_m - other.y_m), std::abs(car->z_m - other.z_m)});
    last = std::max(last, car->frame_index);
  }
  EXPECT_GE(last, kFrames - 1);
  EXPECT_EQ(most_m, 0.0);
}

TEST_F(DriveTest, AKilledLauncherLeavesNoProcessBehind) {
  DriveRun run(folder_ / "orphans", folder_ / "home", arguments());
  ASSERT_TRUE(run.wait_for_frame(5));
  const auto processes = run.processes();
  ASSERT_EQ(processes.size(), 3u);
  run.end(SIGKILL);
  const auto until = std::chrono::steady_clock::now() + kPatience;
  for (const auto& [name, process] : processes) {
    while (fs::exists("/proc/" + std::to_string(process) + "/exe") && std::chrono::steady_clock::now() < until)
      usleep(1000);
    EXPECT_FALSE(fs::exists("/proc/" + std::to_string(process) + "/exe")) << name;  // a zombie has none
  }
}

TEST_F(DriveTest, GarbageIsRefusedCountedAndWithoutEffect) {
  constexpr std::uint64_t kCount =
      20'000;  // a port; the whole measurement of millions is a command: docs/robustness.md
  const fs::path out = folder_ / "garbage";
  auto with_recorder = arguments();
  with_recorder.insert(with_recorder.end(), {"--record", (folder_ / "garbage.pcap").string()});
  DriveRun run(out, folder_ / "home", with_recorder);
  ASSERT_TRUE(run.wait_for_frame(2));
  const std::map<std::string, int> port_of{
      {"cockpit", 0}, {"dynamics", 1}, {"recorder", 2}, {"phare", 3}, {"visual-0", 10}};
  std::vector<ChildProcess> throwers;
  for (const auto& [process, offset] : port_of) {
    auto thrower = ChildProcess::start(program("phare-throw-garbage"),
                                       {"--port", std::to_string(port_base() + offset), "--count",
                                        std::to_string(kCount), "--seed", std::to_string(offset + 1), "--quiet"});
    ASSERT_TRUE(thrower);
    throwers.push_back(*thrower);
  }
  for (ChildProcess& thrower : throwers) {
    while (!thrower.ended()) usleep(1000);
    EXPECT_EQ(thrower.ended()->text(), "exit 0");
  }
  ASSERT_TRUE(run.running()) << "the flood outlived the drive: its end is not in the counts";
  EXPECT_EQ(run.wait(), 0);
  expect_the_same_pictures(out);
  const json report = report_of(out);
  EXPECT_EQ(report["summary"]["restarts"], 0);
  EXPECT_EQ(facts_of(report), facts_of(quiet_.report));
  for (const auto& [process, offset] : port_of) {
    const json& bus = report["processes"][process]["bus"];
    EXPECT_EQ(bus["refused"], kCount) << process;
    EXPECT_GT(bus["refused_in_kernel"], 0) << process;
    const json& counts = report["summary"]["messages"][process];
    EXPECT_EQ(counts["restarted"], 0) << process;
    std::printf("%-9s refused %s of %llu, by the kernel's filter or for want of room %s, lost %s, duplicate %s\n",
                process.c_str(), bus["refused"].dump().c_str(), static_cast<unsigned long long>(kCount),
                bus["refused_in_kernel"].dump().c_str(), counts["lost"].dump().c_str(),
                counts["duplicate"].dump().c_str());
  }
}

}  // namespace
}  // namespace phare::test
