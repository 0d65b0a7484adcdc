// process: a rig on three machines (network namespaces) with a bad network between them and clocks that differ: in
// lockstep the pictures are those of one machine, in real time the clocks are known and no beam is shown before its
// switch.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "config/rig.h"
#include "config/rig_writer.h"
#include "tests/paths.h"
#include "tests/process/drive_run.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kMachineFrames = 40;
constexpr const char* kBadNetwork = "--loss 1 --delay-ms 1 --jitter-ms 5";

std::string read_all(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Why there can be no machines here; empty: there can.
std::string why_no_machines() {
  if (std::system("command -v unshare ip nsenter >/dev/null 2>&1") != 0) return "unshare, nsenter and ip are needed";
  if (std::system("unshare -Urn sh -c 'ip link set lo up && ip link add one type veth peer name two' >/dev/null 2>&1"))
    return "this machine gives its users no network namespaces";
  return "";
}

/// The demo rig with three channels.
Rig three_channels() {
  Rig rig = *read_rig(source_dir() + "/config/rigs/country_road.toml");
  rig.port_base = port_base();
  rig.channels.resize(3, rig.channels.front());
  rig.designs.resize(1);  // each costs its pictures before the drive
  for (std::size_t i = 0; i < 3; ++i) {
    rig.channels[i].name = "picture " + std::to_string(i);
    rig.channels[i].yaw_rad = 0.5 * (1.0 - static_cast<double>(i));
  }
  return rig;
}

void write_rig(const Rig& rig, const fs::path& file) {
  RigWords words;
  words.path = [](const fs::path& path) { return fs::absolute(path).string(); };
  std::ofstream(file) << rig_text(rig, words);
}

class Machines : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = why_no_machines(); !why.empty()) GTEST_SKIP() << why;
    std::ofstream(folder_ / "bus.key") << std::string(64, '5') << '\n';
    ASSERT_EQ(chmod((folder_ / "bus.key").c_str(), 0600), 0);
    const std::array<int, 5> machine_of{1, 2, 2, 3, 3};  // cockpit, dynamics, pictures
    for (int here = 1; here <= 3; ++here) {
      Rig rig = three_channels();
      rig.key_file = folder_ / "bus.key";
      const auto place = [&](std::size_t who) {
        const int there = machine_of[who];
        return BusPlace{"", "10.77." + std::to_string(here) + (there == here ? ".1" : ".10" + std::to_string(there))};
      };
      rig.places = {place(0), place(1), {"127.0.0.1", "127.0.0.1"}, {"127.0.0.1", "127.0.0.1"}};
      for (std::size_t i = 0; i < 3; ++i) rig.channels[i].place = place(2 + i);
      write_rig(rig, folder_ / (std::string(1, static_cast<char>('a' + here - 1)) + ".toml"));
    }
  }

  /// The exit codes of pictures, cockpit and dynamics: "ends: 0 0 0 0 0\n".
  std::string run(const std::string& all, const std::string& cockpit, const std::string& dynamics,
                  const std::string& pictures, const std::string& clocks) const {
    const auto quoted = [](const std::string& word) { return " '" + word + "'"; };
    const std::string command =
        clocks + " timeout 240 unshare -Urn" + quoted(tests_dir("process") + "/machines.sh") + quoted(folder_.path()) +
        quoted(build_dir() + "/bin") + quoted(std::to_string(port_base())) + quoted(kBadNetwork) + quoted(all) +
        quoted(cockpit) + quoted(dynamics) + quoted(pictures) + " >'" + (folder_ / "machines.txt").string() + "' 2>&1";
    std::system(command.c_str());
    return read_all(folder_ / "machines.txt");
  }
  json stats(const std::string& name) const { return json::parse(read_all(folder_ / name), nullptr, false); }
  std::string logs() const {
    std::string all;
    for (const char* name :
         {"machines.txt", "cockpit.log", "dynamics.log", "visual-0.log", "visual-1.log", "visual-2.log"})
      all += std::string(name) + ":\n" + read_all(folder_ / name);
    return all;
  }
  /// Datagrams that the network between the machines took and lost.
  std::pair<unsigned long long, unsigned long long> passed_and_lost() const {
    unsigned long long passed = 0, lost = 0;
    for (const char* way : {"12", "13", "21", "23", "31", "32"}) {
      const std::string text = read_all(folder_ / ("relay-" + std::string(way) + ".txt"));
      unsigned long long received = 0, on = 0, gone = 0;
      const std::size_t line = text.find('\n');
      if (line == std::string::npos ||
          std::sscanf(text.c_str() + line + 1, "%llu datagrams received, %llu passed on, %llu lost", &received, &on,
                      &gone) != 3)
        ADD_FAILURE() << way << ": " << text;
      passed += on;
      lost += gone;
    }
    return {passed, lost};
  }

  TemporaryFolder folder_;
};

TEST_F(Machines, LockstepDrawsThePicturesOfOneMachine) {
  const std::string frames = std::to_string(kMachineFrames);
  Rig rig = three_channels();
  write_rig(rig, folder_ / "one.toml");
  const std::string pcap = source_dir() + "/config/drives/country_road.pcap";
  ASSERT_EQ(
      drive(folder_ / "one", folder_.path(), {"--rig", folder_ / "one.toml", "--frames", frames, "--drive", pcap}), 0);
  const std::string ends = run("--lockstep --log-level warn", "--drive " + pcap, "--drive " + pcap + " --level pose",
                               "--headless --size 160x90 --frames " + frames, "CLOCK_A=100 CLOCK_B=0 CLOCK_C=-250");
  ASSERT_EQ(ends, "ends: 0 0 0 0 0\n") << logs();
  const json one = report_of(folder_ / "one");
  for (int i = 0; i < 3; ++i) {
    const std::string name = "visual-" + std::to_string(i);
    const json there = stats("out-" + std::to_string(i) + "/" + name + ".json");
    EXPECT_EQ(there["kept_frames"]["count"], kMachineFrames);
    EXPECT_EQ(there["kept_frames"]["hash"], one["processes"][name]["kept_frames"]["hash"]) << name;
  }
  const auto [passed, lost] = passed_and_lost();
  // Five ways a frame at the least go over the network; of so many one in a hundred is lost, and none at all by chance
  // only once in e^(-passed / 100).
  EXPECT_GT(passed, 5u * kMachineFrames);
  std::printf("%llu datagrams passed on, %llu lost\n", passed, lost);
}

TEST_F(Machines, ClocksThatDifferAreKnownAndNoBeamIsOlderThanItsSwitch) {
  const std::string stalk = source_dir() + "/config/cockpits/phare_stalk.toml",
                    log = source_dir() + "/config/examples/stalk.log";
  const std::string ends =
      run("--log-level info", "--cockpit " + stalk + " --log " + log + " --wait-for-picture 60",
          "--wait-for-picture 60", "--headless --size 160x90 --audit-every 0", "CLOCK_A=100 CLOCK_B=0 CLOCK_C=-250");
  ASSERT_EQ(ends, "ends: 0 0 0 0 0\n") << logs();
  const std::array<std::pair<std::string, std::array<double, 2>>, 3> ahead{{{"out-0/visual-0.json", {100.0, 0.0}},
                                                                            {"out-1/visual-1.json", {350.0, 250.0}},
                                                                            {"out-2/visual-2.json", {350.0, 250.0}}}};
  for (const auto& [file, expected_ms] : ahead) {
    const json visual = stats(file), &clocks = visual["bus"]["clocks"];
    ASSERT_TRUE(clocks.is_object()) << file << logs();
    for (std::size_t i = 0; i < 2; ++i) {
      const json& clock = clocks[i == 0 ? "cockpit" : "dynamics"];
      ASSERT_TRUE(clock.contains("ahead_ms")) << file << clock;
      EXPECT_LE(std::abs(clock["ahead_ms"].get<double>() - expected_ms[i]), clock["within_ms"].get<double>()) << clock;
      EXPECT_EQ(clock["set"], 0) << clock;
    }
    EXPECT_EQ(visual["bus"]["refused"], 0) << visual["bus"];
    EXPECT_GT(visual["switch_to_photon"]["changes"], 0) << logs();
    // The cockpit's stamp, in the picture's time, lies before the picture, to what the clocks are known to.
    for (const json& change : visual["switch_to_photon"]["newest"])
      EXPECT_GE(change["ms"].get<double>(), -clocks["cockpit"]["within_ms"].get<double>()) << change;
    std::printf("%s: cockpit ahead %.3f ms to %.3f, light switch to photon %s\n", file.c_str(),
                clocks["cockpit"]["ahead_ms"].get<double>(), clocks["cockpit"]["within_ms"].get<double>(),
                visual["switch_to_photon"]["ms"].dump().c_str());
  }
  const auto [passed, lost] = passed_and_lost();
  EXPECT_GT(lost, 0u) << "of " << passed << ", one in a hundred";
}

}  // namespace
}  // namespace phare::test
