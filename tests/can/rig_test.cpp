// The whole rig with a stalk on real CAN: phare-cockpit in the emulated machine, dynamics and picture on the host, the
// bus between them by UDP. The stalk is moved by cansend; the rendered frames get brighter.
#include "config/rig.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "config/rig_writer.h"
#include "net/bus.h"
#include "tests/paths.h"
#include "visual/image/image.h"

namespace phare {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPatience = 90s;  // the machine boots, the picture's shaders are compiled in software

/// A program until the test ends, what it says in a file.
class Child {
 public:
  Child(std::vector<std::string> words, const std::filesystem::path& log, int niceness = 0) {
    pid_ = fork();
    if (pid_ != 0) return;
    setpriority(PRIO_PROCESS, 0, niceness);
    setpgid(0, 0);  // with all that it starts: the machine is a script's child
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    dup2(nothing, STDIN_FILENO);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execv(pointers[0], pointers.data());
    _exit(127);
  }
  ~Child() {
    if (pid_ > 0) end(SIGTERM);
  }
  /// Exit code, or 1000 + signal.
  int end(int signal) {
    if (signal != 0) kill(-pid_, signal);
    int status = 0;
    const auto limit = Clock::now() + 20s;
    while (waitpid(pid_, &status, WNOHANG) == 0) {
      if (Clock::now() > limit) kill(-pid_, SIGKILL);
      std::this_thread::sleep_for(10ms);
    }
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  }

 private:
  pid_t pid_ = -1;
};

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Mean of all three colours.
double brightness(const Image8& image) {
  double sum = 0.0;
  for (const std::uint8_t value : image.rgba) sum += value;
  return image.rgba.empty() ? 0.0 : sum / static_cast<double>(image.rgba.size());
}

/// The newest whole frame on disk with its number.
std::optional<std::pair<std::filesystem::path, Image8>> newest_frame(const std::filesystem::path& folder) {
  std::filesystem::path newest;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".png" && entry.path().filename() > newest.filename()) newest = entry.path();
  }
  if (newest.empty()) return std::nullopt;
  auto image = read_png(newest);
  if (!image) return std::nullopt;
  return std::pair(newest, std::move(*image));
}

TEST(WholeRig, TheStalkOnCanMovesTheBeamInThePicture) {
  const char* cache = std::getenv("PHARE_CANVM");
  if (cache == nullptr) GTEST_SKIP() << "no emulated machine: start this by tests/can/run_rig.sh";
  const std::filesystem::path folder = build_dir() + "/can_rig";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  Rig rig = *read_rig(cockpits_dir() + "/../rigs/country_road.toml");
  rig.port_base = static_cast<std::uint16_t>(20000 + getpid() % 500 * 20);
  // Two machines: the emulated one reaches the host at 10.0.2.2, the host reaches it at a port of its own loopback.
  rig.key_file = folder / "bus.key";
  std::ofstream(rig.key_file) << std::string(64, '5') << '\n';
  std::filesystem::permissions(rig.key_file, std::filesystem::perms::owner_read);
  rig.bus_key = *read_bus_key(rig.key_file);
  RigWords words;
  words.path = [](const std::filesystem::path& file) { return std::filesystem::absolute(file).string(); };
  Rig guest = rig;
  guest.places = {{"", "10.0.2.15"}, {"", "10.0.2.2"}, {"", "10.0.2.2"}, {}};
  guest.channels.front().place.send_to = "10.0.2.2";
  std::ofstream(folder / "guest.toml") << rig_text(guest, words);
  rig.places.cockpit.send_to = "127.0.0.1";
  rig.places.recorder = {"0.0.0.0", "127.0.0.1"};
  const std::string rig_file = folder / "host.toml";
  std::ofstream(rig_file) << rig_text(rig, words);
  const std::string base = std::to_string(rig.port_base);
  // The stalk of phare_stalk.toml, on the machine's interface, patient with a slow one.
  std::string stalk = contents(cockpits_dir() + "/phare_stalk.toml");
  const auto put = [&](const std::string& from, const std::string& to) {
    const std::size_t at = stalk.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    stalk.replace(at, from.size(), to);
  };
  put("\"can0\"", "\"phc0\"");
  put("\"phare_stalk.dbc\"", "\"" + cockpits_dir() + "/phare_stalk.dbc\"");
  put("timeout_s = 0.2", "timeout_s = 15.0");
  std::ofstream(folder / "stalk.toml") << stalk;

  Result<Bus> opened = Bus::open(rig, Role::kRecorder);
  ASSERT_TRUE(opened.ok()) << opened.error().text();
  Bus& bus = *opened;
  const std::string can = tests_dir("can");
  Child machine({can + "/canvm", "run", "--rw", folder, "--udp", base + ":" + base, "--timeout", "280", cache, "--",
                 can + "/rig_guest.sh", folder, program("phare-cockpit"), folder / "guest.toml", folder / "stalk.toml"},
                folder / "machine.log");
  const auto until = [&](const std::function<bool()>& done) {
    const auto limit = Clock::now() + kPatience;
    while (Clock::now() < limit) {
      bus.wait(20ms);
      bus.poll();
      if (done()) return true;
    }
    return false;
  };
  const auto logs = [&] {
    return contents(folder / "machine.log") + contents(folder / "cockpit.log") + contents(folder / "dynamics.log") +
           contents(folder / "visual.log");
  };
  const auto light_is = [&](LightSwitch light) {
    const auto* state = bus.newest<CockpitState>();
    return state != nullptr && state->value.light_switch == light && !state->value.fail_safe;
  };
  const auto drawn = [&] {
    const auto* state = bus.newest<CockpitState>();
    const auto* report = bus.newest<FrameReport>(0);
    return report != nullptr && !report->value.drawn.level.empty() && state != nullptr &&
           report->value.light_changes_drawn == state->value.light_changes;
  };
  const auto more_frames = [&](int count) {
    const auto first = bus.counters().received[kPayloadIndex<FrameReport>].received;
    return until([&] {
      return bus.counters().received[kPayloadIndex<FrameReport>].received >= first + static_cast<std::uint64_t>(count);
    });
  };

  ASSERT_TRUE(until([&] { return light_is(LightSwitch::kLow); })) << logs();
  // Only now, because a picture drawn in software leaves no time to boot a machine in.
  Child car({program("phare-dynamics"), "--rig", rig_file}, folder / "dynamics.log");
  Child picture({program("phare-visual"), "--rig", rig_file, "--headless", "--size", "160x90", "--audit-every", "0",
                 "--frames", "100000", "--out", folder / "out"},
                folder / "visual.log", 10);

  ASSERT_TRUE(until(drawn) && more_frames(5)) << logs();
  const auto before = newest_frame(folder / "out/frames");
  ASSERT_TRUE(before);

  std::ofstream(folder / "high") << "now";
  ASSERT_TRUE(until([&] { return light_is(LightSwitch::kHigh); })) << logs();
  ASSERT_TRUE(until(drawn) && more_frames(5)) << logs();
  const auto after = newest_frame(folder / "out/frames");
  ASSERT_TRUE(after);

  std::ofstream(folder / "stop") << "now";
  EXPECT_EQ(machine.end(0), 0) << logs();
  // The beam lit more of the picture, and the instrument panel on the bus in the machine was told.
  const double low = brightness(before->second), high = brightness(after->second);
  EXPECT_GT(high, low + 1.0) << before->first << " " << after->first;
  EXPECT_NE(contents(folder / "telltales").find("503"), std::string::npos) << logs();
  std::printf("mean of the picture %.2f with low beam (%s), %.2f with high (%s)\n", low,
              before->first.filename().c_str(), high, after->first.filename().c_str());
}

}  // namespace
}  // namespace phare
