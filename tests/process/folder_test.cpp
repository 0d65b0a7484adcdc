// process: what a drive does to the folders of others, what it says when it could not keep what it was to keep, and how
// it ends when it is cut short.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <thread>

#include "tests/paths.h"
#include "tests/process/drive_run.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

struct Said {
  int code = -1;
  std::string err;
};

std::string contents_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What a page refers to. By hand: a regular expression takes stack by the character, and a video within has millions.
std::vector<std::string> references_of(const std::string& page) {
  std::vector<std::string> all;
  for (const std::string word : {"src=\"", "href=\""})
    for (std::size_t at = page.find(word); at != std::string::npos; at = page.find(word, at + 1))
      all.push_back(page.substr(at + word.size(), page.find('"', at + word.size()) - at - word.size()));
  return all;
}

class Folder : public testing::Test {
 protected:
  /// `phare drive --headless --lockstep --size 96x54 … words` in the folder.
  Said drive_here(const std::string& words) const {
    const std::string command = "cd '" + folder_.path().string() + "' && timeout 110 '" + program("phare") +
                                "' drive --headless --lockstep --size 96x54 --log-level warn --port-base " +
                                std::to_string(port_base()) + " " + words + " 2>err.txt >/dev/null </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents_of(folder_ / "err.txt")};
  }
  std::map<std::string, std::string> everything_in(const std::string& name) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / name))
      if (entry.is_regular_file()) files[entry.path().string()] = contents_of(entry.path());
    return files;
  }
  TemporaryFolder folder_;
};

// A word wrong in a file that only one process reads costs the evening's drive nothing, and the recording neither.
TEST_F(Folder, WhatAnyProcessCannotReadLeavesTheDriveBeforeAsItLay) {
  ASSERT_EQ(drive_here("--frames 3 --out out --record evening.pcap").code, 0);
  const auto before = everything_in("out");
  const std::string recorded = contents_of(folder_ / "evening.pcap");
  ASSERT_GT(before.size(), 8u);
  std::ofstream(folder_ / "typo.toml") << "[source]\nkind = \"keybord\"\n";
  std::ofstream(folder_ / "typo_script.toml") << "lane = 3\n";
  std::ofstream(folder_ / "typo_traffic.toml") << "[[road_user]]\nclass = \"kar\"\n";
  std::ofstream(folder_ / "typo_lamp.toml") << "[[road_user]]\nlow_beam = \"nowhere.ies\"\n";
  std::ofstream(folder_ / "typo_path.toml") << "[[road_user]]\npath = \"typo_path.csv\"\n";
  std::ofstream(folder_ / "typo_path.csv") << "time_s,s_m,offset_m\n0,50,0\n0,60,0\n";
  for (const char* wrong : {"--cockpit typo.toml", "--script typo_script.toml", "--traffic typo_traffic.toml",
                            "--traffic typo_lamp.toml", "--traffic typo_path.toml"}) {
    const Said said = drive_here("--frames 3 --out out --record evening.pcap --overwrite " + std::string(wrong));
    EXPECT_EQ(said.code, 2) << said.err;
    EXPECT_NE(said.err.find("typo"), std::string::npos) << said.err;
    EXPECT_TRUE(everything_in("out") == before) << wrong;
    EXPECT_TRUE(contents_of(folder_ / "evening.pcap") == recorded) << wrong;
  }
}

TEST_F(Folder, WhatAnotherDriveIsFillingIsLeftToIt) {
  fs::create_directory(folder_ / "out");
  const int other = open((folder_ / "out").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(other, LOCK_EX | LOCK_NB), 0);
  std::ofstream(folder_ / "out" / "report.json") << "half wr";
  std::ofstream(folder_ / "evening.pcap") << "recorded";
  const Said said = drive_here("--frames 3 --overwrite --out out --record evening.pcap");
  EXPECT_EQ(said.code, 2);
  EXPECT_NE(said.err.find("out: another drive is filling it"), std::string::npos) << said.err;
  EXPECT_EQ(everything_in("out").size(), 1u);
  EXPECT_EQ(contents_of(folder_ / "evening.pcap"), "recorded");
  close(other);
  EXPECT_EQ(drive_here("--frames 3 --overwrite --out out").code, 0);
  EXPECT_GT(everything_in("out").size(), 8u);
}

TEST_F(Folder, ARecordThatCannotBeMadeLeavesNoFolder) {
  const Said said = drive_here("--frames 3 --out new/out --record nowhere/evening.pcap");
  EXPECT_EQ(said.code, 2);
  EXPECT_NE(said.err.find("nowhere/evening.pcap: "), std::string::npos) << said.err;
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

// The demo that is driven where none is named is a drive like any other: a car that was asked for drives it.
TEST_F(Folder, ALevelOfTheCarCountsForTheDemoToo) {
  const Said said = drive_here("--frames 2 --level kinematic --out out");
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_NE(said.err.find("open loop"), std::string::npos) << said.err;
  EXPECT_NE(contents_of(folder_ / "out" / "dynamics.json").find("\"level\": \"kinematic\""), std::string::npos);
  // On another road than the recorded one the recorded controls would leave it: the demo driver drives.
  const Said ice = drive_here("--frames 2 --level full --friction 0.3 --out ice");
  EXPECT_EQ(ice.code, 0) << ice.err;
  EXPECT_EQ(report_of(folder_ / "ice")["processes"]["cockpit"]["source"]["name"], "driver");
}

// Pixels computed again in float64 fail a drive whose light is not what its level states, and no other.
TEST_F(Folder, TheSelfAuditFailsADriveThatIsOffByMoreThanItsLevelStates) {
  const Said good = drive_here("--frames 4 --audit-every 1 --out good");
  EXPECT_EQ(good.code, 0) << good.err;
  const std::string report = contents_of(folder_ / "good" / "report.json");
  EXPECT_NE(report.find("\"over_bound\": 0"), std::string::npos);
  EXPECT_EQ(report.find("\"judged\": 0"), std::string::npos) << "nothing was held to anything";
  // The texture of 1999 held to what only the default level gives: each pixel near the cut-off is off by more.
  const Said planted =
      drive_here("--frames 4 --audit-every 1 --beam-image normalised-8bit-1999 --audit-bound 0.01% --out bad");
  EXPECT_EQ(planted.code, 1) << planted.err;
  EXPECT_EQ(std::ranges::count(planted.err, '\n'), 1) << planted.err;
  for (const char* word : {"self-audit of visual-0: frame 0", "pixel (", "headlamp", "float64", "allows"})
    EXPECT_NE(planted.err.find(word), std::string::npos) << planted.err;
  EXPECT_NE(contents_of(folder_ / "bad" / "report.json").find("first_over"), std::string::npos);
  // Its own level states what it can: the same texture passes.
  const Said own = drive_here("--frames 4 --audit-every 1 --beam-image normalised-8bit-1999 --out own");
  EXPECT_EQ(own.code, 0) << own.err;
}

TEST_F(Folder, AnotherDriveGoesBesideUnlessItMayOverwrite) {
  ASSERT_EQ(drive_here("--frames 2 --out out").code, 0);
  const auto before = everything_in("out");
  const Said beside = drive_here("--frames 3 --out out");
  EXPECT_EQ(beside.code, 0) << beside.err;
  EXPECT_TRUE(everything_in("out") == before);
  EXPECT_TRUE(fs::exists(folder_ / "out-2" / "frames" / "000002.png"));
  EXPECT_NE(beside.err.find("out-2"), std::string::npos) << beside.err;
  // The same again is no other drive; nor is one that may.
  EXPECT_EQ(drive_here("--frames 2 --out out").code, 0);
  std::ofstream(folder_ / "out" / "probes.csv") << "time_s,probe1_lx\n0,4343\n";  // of the drive before
  // And of its second screen, whose folder its report names; what is not a drive's stays.
  std::ofstream(folder_ / "out" / "report.json") << R"({"processes": {"visual-1": {"channel": "left"}, "visual-2":
      {"channel": "../../etc"}, "visual-3": {"channel": "right"}, "visual-0": {"channel": "frames"}}})";
  for (const char* file : {"out/left/frames/000000.png", "out/left/hdr.exr", "out/right/hdr.exr"}) {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << "x";
  }
  std::ofstream(folder_ / "out" / "right" / "notes.txt") << "mine";
  EXPECT_EQ(drive_here("--frames 4 --out out --overwrite").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "frames" / "000003.png"));
  EXPECT_FALSE(fs::exists(folder_ / "out" / "probes.csv")) << "its page would tell figures of another drive";
  EXPECT_FALSE(fs::exists(folder_ / "out-3"));
  EXPECT_FALSE(fs::exists(folder_ / "out" / "left"));
  EXPECT_FALSE(fs::exists(folder_ / "out" / "right" / "hdr.exr"));
  EXPECT_TRUE(fs::exists(folder_ / "out" / "right" / "notes.txt"));
}

// Stills are the driver's, whole and by the car's own light, whatever the pictures show.
TEST_F(Folder, StillsAreTheDriversWhateverIsShown) {
  const std::string plain = "--frames 3 --still-at 0.03 ";
  const Said said = drive_here(plain + "--out plain");
  ASSERT_EQ(said.code, 0) << said.err;
  ASSERT_EQ(
      drive_here(plain + "--camera wall --set layout=split --set second_camera=chase --set mirrors=on --out other")
          .code,
      0);
  for (const char* still : {"drivers_view.png", "birds_eye.png", "wall_25m.png", "hdr.exr"}) {
    const std::string first = contents_of(folder_ / "plain" / still);
    EXPECT_FALSE(first.empty()) << still;
    EXPECT_TRUE(contents_of(folder_ / "other" / still) == first) << still;
  }
}

// A disk that takes no more, here a folder that is gone: the drive goes on, and says at its end what is missing.
TEST_F(Folder, PicturesThatCouldNotBeKeptAreCountedAndEndWithOne) {
  const fs::path out = folder_ / "out";
  DriveRun run(out, folder_.path(), {"--frames", "40"});
  ASSERT_TRUE(run.wait_for_frame(5));
  fs::rename(out / "frames", out / "gone");
  EXPECT_EQ(run.wait(), 1);
  const auto report = report_of(out);
  ASSERT_TRUE(report.is_object());
  const auto& kept = report["processes"]["visual-0"]["kept_frames"];
  EXPECT_GT(kept["not_kept"].get<int>(), 0);
  EXPECT_EQ(kept["count"].get<int>() + kept["not_kept"].get<int>(), 40);
  EXPECT_NE(report["why"].get<std::string>().find("pictures could not be kept"), std::string::npos) << report["why"];
  EXPECT_EQ(report["exit_code"], 1);
  EXPECT_NE(contents_of(out / "index.html").find("pictures could not be kept"), std::string::npos);
}

// Nor are rows that the disk did not take passed over, here because a folder lies where they belong.
TEST_F(Folder, RowsThatCouldNotBeKeptEndWithOne) {
  fs::create_directories(folder_ / "out" / "drive.csv" / "full");
  EXPECT_EQ(drive_here("--frames 3 --out out --overwrite").code, 1);
  const auto kept = report_of(folder_ / "out")["processes"]["visual-0"]["kept_frames"];
  EXPECT_EQ(kept["not_kept"], 1);
  EXPECT_NE(kept["first_not_kept"].get<std::string>().find("drive.csv"), std::string::npos) << kept;
}

// By a terminal that is closed, before the low beam at speed that stills wait for, and with pictures that went nowhere.
TEST_F(Folder, ADriveThatIsHungUpOnKeepsWhatThereIsAndSaysWhatIsMissing) {
  const fs::path out = folder_ / "out";
  DriveRun run(out, folder_.path(), {"--still-at", "60"});
  ASSERT_TRUE(run.wait_for_frame(0));
  fs::rename(out / "frames", out / "gone");
  const auto not_kept = [&] {
    const auto stats = nlohmann::json::parse(contents_of(out / "visual-0.json"), nullptr, false);
    return stats.is_object() && stats["kept_frames"].value("not_kept", 0) > 0;
  };
  for (int i = 0; i < 1200 && !not_kept(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(run.end(SIGHUP), 130);
  const auto report = report_of(out);
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["cut_short"], true);
  EXPECT_NE(report["why"].get<std::string>().find("pictures could not be kept"), std::string::npos) << report["why"];
  // Ctrl-C and its like have two seconds; on a machine with much to do that is not enough for three pictures.
  const bool told = report["why"].get<std::string>().find("no time was left for visual-0") != std::string::npos;
  EXPECT_EQ(told, report["ends"]["visual-0"] == "SIGKILL") << report["why"];
  for (const char* still : {"drivers_view.png", "wall_25m.png", "birds_eye.png"})
    EXPECT_TRUE(told || fs::exists(out / still)) << still;
}

TEST_F(Folder, ADriveThatIsCutShortSaysSoAndEndsWith130) {
  for (const bool hung : {false, true}) {
    const fs::path out = folder_ / (hung ? "hung" : "cut");
    DriveRun run(out, folder_.path(), {});
    ASSERT_TRUE(run.wait_for_frame(0));
    const auto processes = run.processes();
    ASSERT_EQ(processes.size(), 3u);
    // Processes that cannot answer any more do not hold up the end.
    for (const auto& [name, process] : processes)
      if (hung && name != "phare-dynamics") kill(process, SIGSTOP);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(run.end(SIGINT), 130);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    std::printf("ended %.2f s after Ctrl-C%s\n", took.count(), hung ? ", two of three stopped" : "");
    for (const auto& [name, process] : processes)
      EXPECT_FALSE(fs::exists("/proc/" + std::to_string(process) + "/exe")) << name;
    // One that is left behind gives its memory back first and its port last, which the next drive needs.
    for (const auto& [name, process] : processes) {
      const auto open = [&] {
        std::error_code gone;
        return fs::directory_iterator("/proc/" + std::to_string(process) + "/fd", gone) != fs::directory_iterator();
      };
      for (const auto until = std::chrono::steady_clock::now() + kPatience;
           open() && std::chrono::steady_clock::now() < until;)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const auto report = report_of(out);
    ASSERT_TRUE(report.is_object());
    EXPECT_EQ(report["cut_short"], true);
    EXPECT_EQ(report["exit_code"], 130);
    EXPECT_NE(contents_of(out / "index.html").find("cut short"), std::string::npos);
  }
}

// One whose pictures would take longer than Ctrl-C may is ended, and it is said that they are missing.
TEST_F(Folder, PicturesThatCtrlCLeavesNoTimeForAreToldOf) {
  const fs::path out = folder_ / "out";
  DriveRun run(out, folder_.path(), {"--still-at", "60"});
  ASSERT_TRUE(run.wait_for_frame(0));
  const pid_t visual = run.processes().at("phare-visual");
  const std::jthread held([visual](const std::stop_token& over) {
    for (; !over.stop_requested(); std::this_thread::sleep_for(std::chrono::milliseconds(1))) kill(visual, SIGSTOP);
  });
  EXPECT_EQ(run.end(SIGINT), 130);
  const auto report = report_of(out);
  ASSERT_TRUE(report.is_object());
  EXPECT_NE(report["why"].get<std::string>().find("no time was left for visual-0"), std::string::npos) << report["why"];
}

// One that hangs is told, ended and started again; the picture waits with low beam, not with what was.
TEST_F(Folder, AProcessThatHangsIsEndedAndStartedAgain) {
  const fs::path out = folder_ / "out";
  DriveRun run(out, folder_.path(), {"--frames", "200"});
  ASSERT_TRUE(run.wait_for_frame(20));
  kill(run.processes().at("phare-cockpit"), SIGSTOP);
  EXPECT_EQ(run.wait(), 0);
  const auto report = report_of(out);
  ASSERT_EQ(report["restarts"].size(), 1u);
  EXPECT_EQ(report["restarts"][0]["process"], "cockpit");
  EXPECT_TRUE(report["restarts"][0]["because"].get<std::string>().starts_with("stopped: no sign of life for 3"))
      << report["restarts"][0]["because"];
}

// Two designs on the same drive: one row a frame, both designs on the page, everything it refers to there; and one file
// that refers to nothing.
TEST_F(Folder, ThePageOfTwoDesignsIsWhole) {
  ASSERT_EQ(drive_here("--frames 20 --still-at 0.2 --design halogen --versus led --out ab").code, 0);
  const fs::path out = folder_ / "ab";
  const auto report = report_of(out);
  EXPECT_EQ(report["drove"]["rows"], 20);
  EXPECT_EQ(report["processes"]["visual-0"]["versus"]["b"], "led");
  EXPECT_EQ(report["processes"]["visual-0"]["views"].size(), 2u);
  const auto& reach = report["drove"]["reach_m"];
  EXPECT_NE(reach["reach_3lx_left_m"]["median"], reach["versus_reach_3lx_left_m"]["median"]);
  std::istringstream rows(contents_of(out / "drive.csv"));
  std::int64_t count = -1;  // the header
  for (std::string line; std::getline(rows, line);) ++count;
  EXPECT_EQ(count, 20);
  const std::string page = contents_of(out / "index.html");
  const std::vector<std::string> references = references_of(page);
  EXPECT_GE(references.size(), 12u);
  for (const std::string& file : references) EXPECT_TRUE(fs::exists(out / file)) << file;
  for (const char* file : {"versus.png", "versus_difference.png", "versus_ratio.png", "wall_25m.png", "wall_25m_1.png",
                           "birds_eye.png", "birds_eye_1.png"})
    EXPECT_NE(page.find(file), std::string::npos) << file;

  // Off it costs no view, and no pass more than without the word.
  ASSERT_EQ(drive_here("--frames 3 --out off --set compare=off --single-file").code, 0);
  const auto off = report_of(folder_ / "off");
  EXPECT_EQ(off["processes"]["visual-0"]["views"].size(), 1u);
  ASSERT_EQ(drive_here("--frames 3 --out plain").code, 0);
  EXPECT_EQ(off["summary"]["passes"], report_of(folder_ / "plain")["summary"]["passes"]);
  EXPECT_LT(off["summary"]["passes"], report["summary"]["passes"]);
  for (const std::string& at : references_of(contents_of(folder_ / "off" / "index.html")))
    EXPECT_TRUE(at.starts_with("data:")) << at.substr(0, 60);

  const Said wrong = drive_here("--frames 3 --out bad --design halogen --versus xenon.ies");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("--versus xenon.ies"), std::string::npos) << wrong.err;
  EXPECT_EQ(drive_here("--frames 3 --out bad --design xenon").code, 2);
  EXPECT_EQ(drive_here("--frames 3 --out bad --versus halogen").code, 2) << "it stands first: it is A";
  EXPECT_EQ(drive_here("--frames 3 --out bad --design led --versus led").code, 2);
  EXPECT_EQ(drive_here("--frames 3 --out bad --versus ''").code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "bad"));
}

// Whoever would take the place of a cockpit that speaks is told so at once, and the rig does not care.
TEST_F(Folder, AReplayBesideARigIsToldSo) {
  const fs::path out = folder_ / "out";
  DriveRun run(out, folder_.path(), {"--frames", "60"});
  ASSERT_TRUE(run.wait_for_frame(5));
  const std::string command = "timeout 60 '" + std::string(program("phare")) + "' replay --port-base " +
                              std::to_string(port_base()) + " '" + source_dir() +
                              "/config/drives/country_road.pcap' 2>'" + (folder_ / "said.txt").string() + "'";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 2);
  EXPECT_NE(contents_of(folder_ / "said.txt").find("is another rig running?"), std::string::npos);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_EQ(report_of(out)["summary"]["messages"]["visual-0"]["refused"], 0);
}

// Nobody takes what is replayed: that is no success.
TEST_F(Folder, AReplayThatNobodyHearsSaysSo) {
  const std::string command = "timeout 60 '" + std::string(program("phare")) + "' replay --speed 100 --port-base " +
                              std::to_string(port_base()) + " '" + source_dir() +
                              "/config/drives/country_road.pcap' >'" + (folder_ / "told.txt").string() + "' 2>'" +
                              (folder_ / "said.txt").string() + "'";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 1);
  EXPECT_NE(contents_of(folder_ / "said.txt").find("phare: nobody listens at 127.0.0.1:"), std::string::npos);
  EXPECT_EQ(contents_of(folder_ / "told.txt").find(" by "), std::string::npos);
}

// Ctrl-C and a stop end it early: it says what it has sent, and long before the end that nobody listens.
TEST_F(Folder, AReplayThatIsCutShortSaysSo) {
  const std::string command = "timeout --preserve-status -s TERM 4 '" + std::string(program("phare")) +
                              "' replay --port-base " + std::to_string(port_base()) + " '" + source_dir() +
                              "/config/drives/country_road.pcap' >'" + (folder_ / "told.txt").string() + "' 2>'" +
                              (folder_ / "said.txt").string() + "'";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 130);
  const std::string said = contents_of(folder_ / "said.txt"), told = contents_of(folder_ / "told.txt");
  EXPECT_NE(said.find("nobody listens at 127.0.0.1:"), std::string::npos);
  EXPECT_NE(said.find("; the replay goes on"), std::string::npos) << said;
  const std::size_t at = told.find("; ");
  ASSERT_NE(at, std::string::npos) << told;
  EXPECT_LT(std::stod(told.substr(at + 2)), 5.0) << told;
}

// The command that repeats a drive stands in its report as it was given.
TEST_F(Folder, TheReportHasTheCommandAsGiven) {
  ASSERT_EQ(drive_here("--frames 2 --out out --set lines=off --set 'probes=car 25 0 0'").code, 0);
  const auto command = report_of(folder_ / "out")["command"].get<std::vector<std::string>>();
  const std::vector<std::string> last{"--set", "lines=off", "--set", "probes=car 25 0 0"};
  ASSERT_GT(command.size(), last.size());
  EXPECT_EQ(std::vector<std::string>(command.end() - 4, command.end()), last);
  EXPECT_EQ(std::ranges::count(command, "--set"), 2);
  const std::string page = contents_of(folder_ / "out/index.html");
  EXPECT_NE(page.find("--set lines=off --set 'probes=car 25 0 0' "), std::string::npos);
}

// The page on sending from a program of one's own, as it stands there: it has the key and is answered; without it,
// nobody listens.
TEST_F(Folder, TheProgramOfThePageOnSendingIsAnswered) {
  if (std::system("which python3 protoc > /dev/null 2>&1") != 0) GTEST_SKIP() << "no python3 or no protoc";
  std::ifstream page(source_dir() + "/docs/send.md");
  std::ofstream code(folder_ / "send.py");
  bool inside = false;
  int lines = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) {
      inside = line == "```python";
    } else if (inside) {
      code << line << "\n";
      ++lines;
    }
  }
  code.close();
  ASSERT_GT(lines, 10);
  EXPECT_LE(lines, 22);
  DriveRun run(folder_ / "out", folder_.path(), {});
  ASSERT_TRUE(run.wait_for_frame(0));
  const std::string send = "timeout 60 python3 '" + (folder_ / "send.py").string() + "' " +
                           std::to_string(port_base()) + " '" + source_dir() + "/net/phare.proto'";
  FILE* pipe = popen((send + " 2>&1").c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string said;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) said.push_back(static_cast<char>(c));
  EXPECT_EQ(pclose(pipe), 0) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 3) << said;
  EXPECT_NE(said.find("bytes of answer"), std::string::npos) << said;

  const std::string status =
      "'" + std::string(program("phare")) + "' control --wait 1 --port-base " + std::to_string(port_base()) + " ";
  EXPECT_EQ(std::system((status + "status > /dev/null").c_str()), 0);
  EXPECT_NE(std::system((status + "--open-bus status > /dev/null 2>&1").c_str()), 0) << "without the key";
  EXPECT_EQ(run.end(SIGINT), 130);
}

}  // namespace
}  // namespace phare::test
