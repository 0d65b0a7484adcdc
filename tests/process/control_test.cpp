// process: `phare control` and a rig that runs: answers, refusals, streams, several senders, no rig.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <thread>

#include "tests/paths.h"
#include "tests/process/drive_run.h"

namespace phare::test {
namespace {

struct Heard {
  int code = -1;
  std::string out, err;
};

class Control : public testing::Test {
 protected:
  /// `shell` stands before the command: "printf … |".
  Heard control(const std::string& arguments, const std::string& shell = "") const {
    const std::string err = (folder_ / "err.txt").string();
    const std::string command = shell + "timeout 100 '" + program("phare") + "' control --port-base " +
                                std::to_string(port_base()) + " " + arguments + " 2>'" + err + "'";
    Heard heard;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return heard;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) heard.out.push_back(static_cast<char>(c));
    const int status = pclose(pipe);
    heard.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    std::stringstream text;
    text << std::ifstream(err).rdbuf();
    heard.err = text.str();
    return heard;
  }
  void expect_refused(const std::string& arguments, const std::string& why) const {
    const Heard heard = control(arguments);
    EXPECT_EQ(heard.code, 2) << arguments << heard.out << heard.err;
    EXPECT_EQ(heard.out, "") << arguments;
    EXPECT_NE(heard.err.find(why), std::string::npos) << arguments << ": " << heard.err;
    EXPECT_EQ(std::count(heard.err.begin(), heard.err.end(), '\n'), 1) << heard.err;
  }
  TemporaryFolder folder_;
};

TEST_F(Control, WithoutARigSaysSoAndEndsWithOne) {
  const Heard heard = control("--wait 0.3 aim -0.5");
  EXPECT_EQ(heard.code, 1);
  EXPECT_EQ(heard.err, "phare: no rig answers on 127.0.0.1:" + std::to_string(port_base()) + "; is one running?\n");
}

TEST_F(Control, ARunningRigAnswers) {
  DriveRun run(folder_ / "out", folder_.path(), {});
  while (run.running() && control("--wait 2 status").code != 0) {
  }
  ASSERT_TRUE(run.running());

  Heard heard = control("dim 'headlamp left' 1 0.25");
  EXPECT_EQ(heard.code, 0) << heard.err;
  EXPECT_EQ(heard.out, "headlamp left: source 1 at 25 %\n");
  heard = control("status");
  EXPECT_NE(heard.out.find("cockpit: "), std::string::npos) << heard.out;
  EXPECT_NE(heard.out.find("dynamics: "), std::string::npos) << heard.out;
  EXPECT_NE(heard.out.find("visual-0: design "), std::string::npos) << heard.out;
  EXPECT_NE(heard.out.find("full light but source 1 at 25 %"), std::string::npos) << heard.out;

  expect_refused("dim 'fog lamp of another car' 1 0", "lamp \"fog lamp of another car\": design ");
  expect_refused("dim 'headlamp left' 99 0", "no number 99");
  expect_refused("design 7", "design 7: the rig has 2, counted from 0: 0 \"");
  expect_refused("seek 10", "seek: not in lockstep");
  expect_refused("aim 91", "aim: an angle beyond 90 degrees");
  EXPECT_NE(control("status").out.find("visual-0: design "), std::string::npos);

  // A design that is chosen stays, though the replayed drive is recorded frame by frame with another.
  EXPECT_TRUE(control("design 1").out.starts_with("design 1 of 2, "));
  EXPECT_NE(control("status").out.find("visual-0: design 1 of 2, "), std::string::npos);
  EXPECT_NE(control("status").out.find("visual-0: design 1 of 2, "), std::string::npos);
  EXPECT_TRUE(control("design 0").out.starts_with("design 0 of 2, "));

  // A design that is chosen shines when the answer comes, so a lamp of it can be named at once. In between other
  // senders speak, and the stream goes on.
  const std::string one = "timeout 100 '" + program("phare") + "' control --port-base " + std::to_string(port_base()) +
                          " aim 0.1 >/dev/null; ";
  heard = control("--wait 60 -", "{ echo design 1; echo '# nothing'; echo 'dim \"headlamp left\" 1 0'; " + one +
                                     "echo 'dim \"nobody\" 1 0'; " + one +
                                     "echo design 7; echo aim nan; echo 'dim \"headlamp left\" 1 1'; echo design 0; "
                                     "echo 'reset \"headlamp left'; } | ");
  EXPECT_EQ(heard.code, 2);
  std::vector<std::string> lines;
  std::istringstream in(heard.out);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 8u) << heard.out << heard.err;
  EXPECT_TRUE(lines[0].starts_with("ok: design 1 of 2, ")) << lines[0];
  EXPECT_EQ(lines[1], "ok: headlamp left: source 1 at 0 %");
  EXPECT_TRUE(lines[2].starts_with("refused: lamp \"nobody\": ")) << lines[2];
  EXPECT_TRUE(lines[3].starts_with("refused: design 7: ")) << lines[3];
  EXPECT_TRUE(lines[4].starts_with("refused: line 6: aim: ")) << lines[4];
  EXPECT_EQ(lines[5], "ok: headlamp left: source 1 at 100 %");
  EXPECT_TRUE(lines[6].starts_with("ok: design 0 of 2, ")) << lines[6];
  EXPECT_TRUE(lines[7].starts_with("refused: line 9: ")) << lines[7];
  EXPECT_NE(lines[7].find("a double quote does not end"), std::string::npos) << lines[7];
  EXPECT_EQ(heard.err, "phare: standard input: 4 of 8 commands refused\n");

  EXPECT_EQ(control("quit").out, "leaves\n");
  EXPECT_EQ(run.wait(), 0);
}

std::string whole(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// Lamps are moved in the midst of a drive, saved, and the recording of it shows the same pictures again.
TEST_F(Control, LampsAreMovedSavedAndReplayedBitForBit) {
  // A rig of its own, to be saved.
  std::string text = whole(source_dir() + "/config/rigs/country_road.toml");
  for (const char* folder : {"\"../vehicles/", "\"../cockpits/"})
    text.replace(text.find(folder), 3, "\"" + source_dir() + "/config");
  const std::filesystem::path rig = folder_ / "my.toml";
  std::ofstream(rig) << text;
  const std::string with = "--rig '" + rig.string() + "' ";
  {
    DriveRun run(folder_ / "out", folder_.path(),
                 {"--rig", rig.string(), "--frames", "60", "--record", (folder_ / "d.pcap").string()});
    ASSERT_TRUE(run.wait_for_frame(10));
    ASSERT_EQ(control(with + "pause").code, 0);  // a fast machine would be through before the last command
    Heard heard = control(with + "move headlamp up by 0.3");
    EXPECT_EQ(heard.out,
              "headlamp left: at x 3.450, y 0.620, z 0.960 m\nheadlamp right: at x 3.450, y -0.620, z 0.960 m\n"
              "1.240 m apart\n")
        << heard.err;
    EXPECT_EQ(control(with + "move 'headlamp left' yaw 4").code, 0);
    EXPECT_EQ(control(with + "move 'fog left' roll by 1").code, 0);
    EXPECT_TRUE(control(with + "undo").out.starts_with("1 taken back\n"));
    EXPECT_EQ(control(with + "aim by -0.5").out, "all lamps turned -0.500 deg up\n");
    EXPECT_EQ(control(with + "move roof up 1").code, 2);
    EXPECT_EQ(control(with + "undo 0").code, 2);
    EXPECT_EQ(control(with + "save /nowhere/rig.toml").code, 2);
    EXPECT_EQ(whole(rig), text) << "refused, and nothing is written";
    EXPECT_EQ(control(with + "save").out, rig.string() + ": 8 lamps\n");
    EXPECT_EQ(control(with + "resume").code, 0);
    EXPECT_EQ(run.wait(), 0);
  }
  EXPECT_NE(whole(rig).find("position_m = [3.45, 0.62, 0.96]"), std::string::npos);
  EXPECT_NE(whole(rig).find("# halogen filament"), std::string::npos) << "comments stay";
  EXPECT_EQ(whole(rig).find("its twin sits at -y"), std::string::npos) << "the left one was turned alone";

  // As it was recorded: the rig as it was then, and nobody commands.
  std::ofstream(rig) << text;
  ASSERT_EQ(drive(folder_ / "again", folder_.path(),
                  {"--rig", rig.string(), "--frames", "60", "--drive", (folder_ / "d.pcap").string()}),
            0);
  EXPECT_EQ(differences(pictures_of(folder_ / "out"), pictures_of(folder_ / "again")), std::vector<std::string>{});
  // And the lamps did move in it.
  ASSERT_EQ(drive(folder_ / "still", folder_.path(), {"--rig", rig.string(), "--frames", "60"}), 0);
  const auto still = differences(pictures_of(folder_ / "out"), pictures_of(folder_ / "still"));
  EXPECT_NE(std::ranges::find(still, "frames/000059.png"), still.end());
  EXPECT_EQ(std::ranges::find(still, "frames/000005.png"), still.end());
}

// What a click reads is what `phare measure` says there, to 1e-4; six digits are written.
TEST_F(Control, APointIsReadAsMeasureHasIt) {
  std::ofstream(folder_ / "p.csv") << "x_m,y_m,z_m,nx,ny,nz\n30,-1.5,0.3,0,0,1\n20,2,0.3,-1,0,0\n";
  const std::string measure = "'" + program("phare") + "' measure --rig '" + source_dir() +
                              "/config/rigs/country_road.toml' --method reference --points '" +
                              (folder_ / "p.csv").string() + "' --out '" + (folder_ / "lx.csv").string() +
                              "' >/dev/null";
  ASSERT_EQ(std::system(measure.c_str()), 0);
  std::vector<double> measured_lx;
  std::ifstream table(folder_ / "lx.csv");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream cells(line);
    for (int i = 0; i < 7; ++i) std::getline(cells, line, ',');
    measured_lx.push_back(std::stod(line));
  }
  ASSERT_EQ(measured_lx.size(), 2u);

  DriveRun run(folder_ / "out", folder_.path(), {"--rig", source_dir() + "/config/rigs/country_road.toml"});
  ASSERT_TRUE(run.wait_for_frame(0));
  ASSERT_EQ(control("pause").code, 0);
  const char* points[] = {"car 30 -1.5 0.3", "car 20 2 0.3 -1 0 0"};
  for (std::size_t i = 0; i < 2; ++i) {
    const Heard heard = control(std::string("set point ") + points[i]);
    ASSERT_EQ(heard.code, 0) << heard.err;
    EXPECT_TRUE(heard.out.starts_with(std::string("point ") + points[i] + "\n")) << heard.out;
    const std::string reading = heard.out.substr(heard.out.find('\n') + 1);
    EXPECT_NEAR(std::stod(reading.substr(reading.find(": ") + 2)), measured_lx[i], 1e-4 * measured_lx[i]) << reading;
    EXPECT_NE(reading.find("fog left: dark, off"), std::string::npos) << reading;
  }
  expect_refused("set point car 1 2", "point: a probe is car or world");
  EXPECT_EQ(control("quit").code, 0);
  EXPECT_EQ(run.wait(), 0);
}

// Under a tunnel's roof nothing but what road and walls send on: the column of the strongest lamp is 0, the sum is not.
TEST_F(Control, ReflectedLightIsInNoLampsColumn) {
  std::ofstream(folder_ / "p.csv") << "x_m,y_m,z_m,nx,ny,nz\n100,0,5,0,0,-1\n";
  const std::string scenes = scene_dir();
  const std::string measure = "'" + program("phare") + "' measure --street-lamps '" + scenes +
                              "/tunnel_lamps.toml' --scene '" + scenes + "/tunnel.glb' --points '" +
                              (folder_ / "p.csv").string() + "' --out '" + (folder_ / "lx.csv").string() +
                              "' >/dev/null";
  ASSERT_EQ(std::system(measure.c_str()), 0);
  std::ifstream table(folder_ / "lx.csv");
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "x_m,y_m,z_m,nx,ny,nz,illuminance_lx,illuminance_lx_1,hidden_by_1");
  std::getline(table, line);
  double sum_lx = 0.0, lamp_lx = -1.0;
  ASSERT_EQ(std::sscanf(line.c_str(), "100,0,5,0,0,-1,%lf,%lf", &sum_lx, &lamp_lx), 2) << line;
  EXPECT_GT(sum_lx, 2.0);
  EXPECT_EQ(lamp_lx, 0.0);
}

// Somebody who seeks back, by much while it drives and by little in a pause, is shown and kept what is there.
TEST_F(Control, ASeekBackIsFollowedAndKept) {
  struct Row {
    double time_s = 0.0, x_m = 0.0;
    bool kept = false;
  };
  const auto rows = [&] {
    std::vector<Row> all;
    std::ifstream file(folder_ / "out" / "drive.csv");
    std::string line;
    for (std::getline(file, line); std::getline(file, line) && !file.eof();) {
      std::vector<std::string> cells;
      std::istringstream words(line);
      for (std::string cell; std::getline(words, cell, ',');) cells.push_back(cell);
      if (cells.size() > 14) all.push_back({std::stod(cells[1]), std::stod(cells[2]), cells[14] == "1"});
    }
    return all;
  };
  DriveRun run(folder_ / "out", folder_.path(), {}, /*lockstep=*/false);
  const auto comes = [&](const std::function<bool(const std::vector<Row>&)>& at_last) {
    for (const auto until = std::chrono::steady_clock::now() + kPatience;
         run.running() && std::chrono::steady_clock::now() < until;
         std::this_thread::sleep_for(std::chrono::milliseconds(50)))
      if (at_last(rows())) return true;
    return false;
  };
  ASSERT_TRUE(comes([](const auto& all) { return !all.empty() && all.back().time_s > 3.0; }));
  ASSERT_EQ(control("seek 1").code, 0);
  std::size_t back = 0;
  ASSERT_TRUE(comes([&](const auto& all) {
    for (std::size_t i = 1; i < all.size(); ++i)
      if (all[i].time_s < all[i - 1].time_s - 1.0) back = i;
    return back > 0 && all.back().time_s > all[back].time_s + 1.0;
  }));
  const std::vector<Row> since = rows();
  EXPECT_GE(std::ranges::count(since.begin() + static_cast<std::ptrdiff_t>(back), since.end(), true, &Row::kept), 3)
      << "of ten a second";
  ASSERT_EQ(control("pause").code, 0);
  ASSERT_EQ(control("seek 4.9").code, 0);
  ASSERT_TRUE(comes([](const auto& all) { return std::abs(all.back().time_s - 4.9) < 0.03; }));
  ASSERT_EQ(control("seek 4.8").code, 0);
  ASSERT_TRUE(comes([](const auto& all) { return std::abs(all.back().time_s - 4.8) < 0.03; }));
  // Lights and design are those of that time too, not those of where one comes from.
  const auto tells = [&](const std::string& words) {
    for (const auto until = std::chrono::steady_clock::now() + kPatience;
         run.running() && std::chrono::steady_clock::now() < until;)
      if (control("status").out.find(words) != std::string::npos) return true;
    return false;
  };
  ASSERT_EQ(control("seek 60").code, 0);
  EXPECT_TRUE(tells("light switch high"));
  EXPECT_TRUE(tells("design 1 of 2, "));
  ASSERT_EQ(control("seek 2.57").code, 0);
  EXPECT_TRUE(tells("light switch low"));
  EXPECT_TRUE(tells("design 0 of 2, "));
  ASSERT_EQ(control("quit").code, 0);
  EXPECT_EQ(run.wait(), 0);
}

// A picture that was killed in its midst: the report knows of the frames before too.
TEST_F(Control, FramesBeforeARestartAreCounted) {
  DriveRun run(folder_ / "out", folder_.path(), {}, /*lockstep=*/false);
  const auto rows = [&] {
    std::ifstream table(folder_ / "out" / "drive.csv");
    return std::count(std::istreambuf_iterator<char>(table), {}, '\n') - 1;
  };
  const auto comes_to = [&](std::ptrdiff_t wanted) {
    for (const auto until = std::chrono::steady_clock::now() + kPatience;
         run.running() && std::chrono::steady_clock::now() < until;
         std::this_thread::sleep_for(std::chrono::milliseconds(20)))
      if (rows() >= wanted) return true;
    return false;
  };
  ASSERT_TRUE(comes_to(20));
  ASSERT_EQ(kill(run.processes().at("phare-visual"), SIGKILL), 0);
  const std::ptrdiff_t before = rows();
  ASSERT_TRUE(comes_to(before + 10));
  ASSERT_EQ(control("quit").code, 0);
  EXPECT_EQ(run.wait(), 0);
  const nlohmann::json summary = report_of(folder_ / "out")["summary"];
  EXPECT_GE(summary["frames_before"].get<std::ptrdiff_t>(), before - 1) << "the last row may be cut off";
  EXPECT_EQ(summary["frames_before"].get<std::ptrdiff_t>() + summary["frames"].get<std::ptrdiff_t>(), rows());
}

// A simulated car has no past: what was set stays, though the seek names a time that has been.
TEST_F(Control, ASeekThatIsRefusedChangesNothing) {
  DriveRun run(folder_ / "out", folder_.path(), {"--closed-loop"}, /*lockstep=*/false);
  while (run.running() && control("--wait 2 status").out.find(" at 3.") == std::string::npos) {
  }
  ASSERT_TRUE(run.running());
  ASSERT_EQ(control("design 1").code, 0);
  expect_refused("seek 1", "seek: only in a replayed drive");
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_NE(control("status").out.find("visual-0: design 1 of 2, "), std::string::npos);
  ASSERT_EQ(control("quit").code, 0);
  EXPECT_EQ(run.wait(), 0);
}

// Each instrument that is off is no pass and no view; those that draw over the picture share the overlay's pass.
TEST_F(Control, InstrumentsThatAreOffCostNoPass) {
  const auto visual = [&](const char* out, const std::vector<std::string>& settings) {
    std::vector<std::string> arguments{"--frames", "4"};
    for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
    EXPECT_EQ(drive(folder_ / out, folder_.path(), arguments), 0);
    return report_of(folder_ / out)["processes"]["visual-0"];
  };
  const nlohmann::json off = visual("off", {});
  EXPECT_EQ(off["views"].size(), 1u);
  const nlohmann::json on = visual("on", {"grid_m=10", "road_isolux=on", "reach=on", "probes=road 40 -1.75"});
  EXPECT_EQ(on["passes"].get<int>(), off["passes"].get<int>() + 1) << "all of them in the overlay's";
  EXPECT_EQ(on["views"].size(), 1u);
  const nlohmann::json mirrors = visual("mirrors", {"mirrors=on"});
  EXPECT_EQ(mirrors["views"].size(), 4u);
  EXPECT_GE(mirrors["passes"].get<int>(), on["passes"].get<int>() + 3) << "one a mirror at least";
  // Each effect says what it takes, in a drive that keeps all its frames too.
  const auto row = [](const nlohmann::json& report, const char* name) {
    return *std::ranges::find(report["effects"], name, [](const nlohmann::json& each) { return each["name"]; });
  };
  EXPECT_EQ(row(off, "overlay")["passes"], 0);
  EXPECT_FALSE(row(off, "overlay").contains("ms"));
  EXPECT_EQ(row(on, "overlay")["passes"], 1);
  EXPECT_GT(row(on, "overlay")["ms"].get<double>(), 0.0);
  EXPECT_EQ(row(on, "eyeshine")["bytes"], 0);
  EXPECT_EQ(on["pass_ms"]["lamps"]["count"], on["frames"]);
  EXPECT_TRUE(on["views"][0]["effects"].empty());
  for (const nlohmann::json& view : mirrors["views"]) EXPECT_TRUE(view["effects"].is_array());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "on" / "probes.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "off" / "probes.csv"));
}

}  // namespace
}  // namespace phare::test
