// phare-cockpit as a process: lockstep and its repeats, a kill in mid-drive, real time with its latency, bad input.
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cockpit_io/can_socket.h"
#include "config/rig.h"
#include "net/bus.h"
#include "net/run_key.h"
#include "tests/cockpit_io/program.h"
#include "tests/paths.h"

namespace phare {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

class CockpitProcessTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("phare-cockpit-test-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    // Light on at 0, high at 105 ms, low at 300 ms, the last frame at 500 ms; then nothing mapped until 2 s.
    std::ofstream(folder_ / "stalk.log") << "(9.000) can0 500#0201000000000000\n(9.105) can0 500#0301000000000000\n"
                                            "(9.200) can0 500#0301000000000000\n(9.300) can0 500#0201000000000000\n"
                                            "(9.400) can0 500#0301000000000000\n(9.500) can0 500#0301000000000000\n"
                                            "(11.000) can0 123#00\n";
    std::ofstream(folder_ / "cockpit.toml")
        << "[source]\nkind = \"log\"\ndbc = \"" + cockpits_dir() +
               "/phare_stalk.dbc\"\ntimeout_s = 0.2\n"
               "[control.light_switch]\nmessage = \"BEAM_STALK\"\nsignal = \"BEAM_SWITCH\"\n"
               "levels = { off = 0, position = 1, low = 2, high = 3 }\n";
    rig_file_ = std::string(cockpits_dir()) + "/../rigs/country_road.toml";
    Result<Rig> rig = read_rig(rig_file_);
    ASSERT_TRUE(rig.ok()) << rig.error().text();
    rig_ = *rig;
    rig_.port_base = static_cast<std::uint16_t>(20000 + getpid() % 1500 * 20);
    setenv("PHARE_RUN_DIR", (folder_ / "run").c_str(), 1);
    ASSERT_TRUE(take_run_key(rig_));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::vector<std::string> arguments(std::initializer_list<std::string> more) const {
    std::vector<std::string> all{"--rig", rig_file_, "--port-base", std::to_string(rig_.port_base)};
    all.insert(all.end(), more);
    return all;
  }
  std::vector<std::string> log_arguments() const {
    return arguments(
        {"--cockpit", folder_ / "cockpit.toml", "--log", folder_ / "stalk.log", "--stats", folder_ / "stats.json"});
  }
  std::string errors() const {
    std::ifstream stream(folder_ / "errors");
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  Bus bus(Role role) const {
    Result<Bus> opened = Bus::open(rig_, role);
    EXPECT_TRUE(opened.ok()) << opened.error().text();
    return std::move(*opened);
  }

  /// Plays the picture: reports frame `frame` until the controls of the next one are there.
  std::optional<CockpitState> next_controls(Bus& visual, std::int64_t frame) const {
    FrameReport report;
    report.frame_index = frame;
    report.channels = 1;
    const auto until = Clock::now() + kPatience;
    visual.send(frame_time(std::max<std::int64_t>(frame, 0), rig_.frame_rate_hz), report);
    auto repeat = Clock::now() + 100ms;
    while (Clock::now() < until) {
      visual.wait(20ms);
      visual.poll();
      const auto* state = visual.newest<CockpitState>();
      if (state != nullptr && state->value.frame_index == frame + 1) return state->value;
      if (Clock::now() > repeat) {
        visual.send_again(kPayloadIndex<FrameReport>);
        repeat += 100ms;
      }
    }
    return std::nullopt;
  }

  std::filesystem::path folder_;
  std::string rig_file_;
  Rig rig_;
};

TEST_F(CockpitProcessTest, LockstepIsTheSameWithAndWithoutAKill) {
  std::vector<CockpitState> runs[2];
  for (int run = 0; run < 2; ++run) {
    Bus visual = bus(Role::kVisual);
    auto with_lockstep = log_arguments();
    with_lockstep.push_back("--lockstep");
    std::optional<Program> cockpit;
    cockpit.emplace(with_lockstep, folder_ / "errors");
    for (std::int64_t frame = -1; frame < 130; ++frame) {
      if (run == 1 && frame == 20) {
        cockpit->end(SIGKILL);
        cockpit.emplace(with_lockstep, folder_ / "errors");
      }
      auto state = next_controls(visual, frame);
      ASSERT_TRUE(state) << "frame " << frame << ": " << errors();
      state->light_change_wall = {};
      runs[run].push_back(*state);
    }
    // A report that was answered is answered again with the same bytes.
    const auto before = visual.counters().received[kPayloadIndex<CockpitState>];
    FrameReport old;
    old.frame_index = 100;
    visual.send({}, old);
    const auto until = Clock::now() + kPatience;
    while (visual.counters().received[kPayloadIndex<CockpitState>].duplicate == before.duplicate &&
           Clock::now() < until) {
      visual.wait(20ms);
      visual.poll();
    }
    EXPECT_GT(visual.counters().received[kPayloadIndex<CockpitState>].duplicate, before.duplicate);
    EXPECT_EQ(visual.counters().received[kPayloadIndex<CockpitState>].received, before.received);
    EXPECT_EQ(visual.counters().received[kPayloadIndex<CockpitState>].restarted, run == 1 ? 1u : 0u);
    EXPECT_EQ(cockpit->end(SIGTERM), 0) << errors();
  }
  EXPECT_EQ(runs[0], runs[1]);
  const auto& states = runs[0];
  EXPECT_EQ(states[6].light_switch, LightSwitch::kLow);   // 100 ms
  EXPECT_EQ(states[7].light_switch, LightSwitch::kHigh);  // 116.7 ms, the first frame at or after 105 ms
  EXPECT_EQ(states[7].light_change_sim.ns, 105'000'000);
  EXPECT_EQ(states[41].light_switch, LightSwitch::kHigh);  // 683 ms
  EXPECT_TRUE(states[42].fail_safe);                       // 700 ms: the last frame and the timeout
  EXPECT_EQ(states[42].light_switch, LightSwitch::kLow);
  EXPECT_FALSE(states[119].drive_ended);
  EXPECT_TRUE(states[120].drive_ended);  // 2 s
  EXPECT_EQ(states[130].source, "log");
}

TEST_F(CockpitProcessTest, RealTimeKeepsItsRateAndFallsSafe) {
  Bus car = bus(Role::kDynamics);
  Program cockpit(log_arguments(), folder_ / "errors");
  const auto start = Clock::now();
  std::uint64_t light_changes = 0;
  std::optional<double> safe_s;
  std::optional<Clock::time_point> first;
  while (Clock::now() - start < 4s) {
    if (car.poll() > 0) {
      if (!first) first = Clock::now();
      const auto* state = car.newest<CockpitState>();
      if (state != nullptr) {
        light_changes = state->value.light_changes;
        if (state->value.fail_safe && !safe_s) safe_s = std::chrono::duration<double>(Clock::now() - *first).count();
      }
    }
    VehicleState pose;
    pose.level = "kinematic";
    const auto sim = first ? Clock::now() - *first : Clock::duration{};
    car.send(SimTime{std::chrono::nanoseconds(sim).count()}, pose);
    std::this_thread::sleep_for(4ms);
  }
  ASSERT_TRUE(first) << errors();
  EXPECT_EQ(cockpit.end(SIGTERM), 0) << errors();
  const double seconds = std::chrono::duration<double>(Clock::now() - *first).count();
  const double rate_hz = static_cast<double>(car.counters().received[kPayloadIndex<CockpitState>].received) / seconds;
  EXPECT_GT(rate_hz, 60.0);
  EXPECT_LT(rate_hz, 110.0);
  EXPECT_EQ(light_changes, 5u);  // low, high, low, high, fail-safe low
  ASSERT_TRUE(safe_s);
  EXPECT_GE(*safe_s, 0.69);
  EXPECT_LT(*safe_s, 1.2);  // 0.7 s on a quiet machine

  std::ifstream stream(folder_ / "stats.json");
  const auto stats = nlohmann::json::parse(stream);
  EXPECT_EQ(stats["process"], "cockpit");
  EXPECT_EQ(stats["source"]["frames_read"], 7);
  EXPECT_EQ(stats["source"]["decoded"], 6);
  EXPECT_EQ(stats["source"]["unknown_ids"], 1);
  EXPECT_EQ(stats["source"]["status"], "ended");
  EXPECT_EQ(stats["light_changes"], 5);
  EXPECT_EQ(stats["frame_to_datagram"]["count"], 6);
  std::printf(
      "%.1f datagrams a second, fail-safe %.3f s after the start (0.700 due), frame to datagram median %.0f us, p99 "
      "%.0f "
      "us, light change to datagram median %.0f us, max %.0f us\n",
      rate_hz, *safe_s, stats["frame_to_datagram"]["median_us"].get<double>(),
      stats["frame_to_datagram"]["p99_us"].get<double>(), stats["light_change_to_datagram"]["median_us"].get<double>(),
      stats["light_change_to_datagram"]["max_us"].get<double>());
}

// While the picture is made ready nothing is sent, and the cockpit sleeps: the picture wants the processor.
TEST_F(CockpitProcessTest, SleepsWhileThePictureIsMadeReady) {
  Program cockpit(arguments({"--cockpit", folder_ / "cockpit.toml", "--log", folder_ / "stalk.log", "--stats",
                             folder_ / "stats.json", "--wait-for-picture", "60"}),
                  folder_ / "errors");
  std::this_thread::sleep_for(1500ms);
  EXPECT_EQ(cockpit.end(SIGTERM), 0) << errors();
  std::ifstream stream(folder_ / "stats.json");
  const auto stats = nlohmann::json::parse(stream);
  // It looks every 2 ms at the source and every 10 ms sends: 600 turns a second at most; twice that for the bus.
  EXPECT_GT(stats["turns"].get<double>(), 0.0);
  EXPECT_LT(stats["turns"].get<double>(), 1200.0 * stats["wall_s"].get<double>());
}

TEST_F(CockpitProcessTest, KeysOfATerminalReachTheBus) {
  Bus car = bus(Role::kDynamics);
  const auto words = arguments({"--cockpit", cockpits_dir() + "/keyboard.toml", "--stats", folder_ / "stats.json"});
  std::string cockpit = program("phare-cockpit");
  int terminal = -1;
  const pid_t pid = forkpty(&terminal, nullptr, nullptr, nullptr);
  ASSERT_GE(pid, 0);
  if (pid == 0) {
    std::vector<char*> pointers{cockpit.data()};
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    execv(pointers[0], pointers.data());
    _exit(127);
  }
  const auto begin = Clock::now();
  const auto light = [&]() -> std::optional<LightSwitch> {
    VehicleState pose;  // simulated time goes on with the car's
    pose.level = "kinematic";
    car.send(SimTime{std::chrono::nanoseconds(Clock::now() - begin).count()}, pose);
    car.wait(10ms);
    car.poll();
    const auto* state = car.newest<CockpitState>();
    return state == nullptr ? std::nullopt : std::optional(state->value.light_switch);
  };
  const auto until = [&](LightSwitch wanted) {
    const auto limit = Clock::now() + kPatience;
    while (Clock::now() < limit) {
      if (light() == wanted) return true;
    }
    return false;
  };
  EXPECT_TRUE(until(LightSwitch::kLow));
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(write(terminal, i % 2 == 0 ? "l" : "L", 1), 1);
    ASSERT_TRUE(until(i % 2 == 0 ? LightSwitch::kHigh : LightSwitch::kLow)) << i;
    for (const auto next = Clock::now() + 25ms; Clock::now() < next;) light();  // longer than the debounce
  }
  kill(pid, SIGTERM);
  int status = 0;
  waitpid(pid, &status, 0);
  close(terminal);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  std::ifstream stream(folder_ / "stats.json");
  const auto stats = nlohmann::json::parse(stream);
  EXPECT_EQ(stats["light_change_to_datagram"]["count"], 21);  // low at the start, and twenty keys
  std::printf("key to datagram median %.0f us, p99 %.0f us\n",
              stats["light_change_to_datagram"]["median_us"].get<double>(),
              stats["light_change_to_datagram"]["p99_us"].get<double>());
}

// High beam, fog lamps and hazard by keys that only latch: nobody can ask for them again, and the newest press still
// travels when the new cockpit begins.
TEST_F(CockpitProcessTest, LatchesComeBackAfterAKill) {
  Bus car = bus(Role::kDynamics), window = bus(Role::kVisual);
  const auto words =
      arguments({"--cockpit", cockpits_dir() + "/keyboard.toml", "--state", folder_ / "state", "--log-level", "warn"});
  std::optional<Program> cockpit;
  cockpit.emplace(words, folder_ / "errors");
  const auto begin = Clock::now();
  KeyInput keys;
  std::vector<CockpitState> heard;
  car.on_datagram = [&](const Datagram& datagram, std::span<const std::byte>) {
    if (const auto* state = std::get_if<CockpitState>(&datagram.payload)) heard.push_back(*state);
  };
  const auto go_on = [&](const auto& done) {
    const auto limit = Clock::now() + kPatience;
    while (Clock::now() < limit) {
      VehicleState pose;
      pose.level = "kinematic";
      car.send(SimTime{std::chrono::nanoseconds(Clock::now() - begin).count()}, pose);
      window.send(SimTime{}, keys);
      car.wait(5ms);
      car.poll();
      if (!heard.empty() && done(heard.back())) return true;
    }
    return false;
  };
  const auto lit = [](const CockpitState& state) {
    return state.light_switch == LightSwitch::kHigh && state.fog_front && state.hazard && !state.fail_safe;
  };
  ASSERT_TRUE(go_on([](const CockpitState& state) { return state.light_switch == LightSwitch::kLow; })) << errors();
  for (const char key : {'h', 'g', 'w'}) {
    keys.event.push_back(key);
    keys.event.push_back(-key);
    keys.events += 2;
  }
  ASSERT_TRUE(go_on(lit)) << errors();
  for (int times = 0; times < 3; ++times) {
    // The pressing of the third key may be a datagram later than its lamp: let the state settle.
    heard.clear();
    ASSERT_TRUE(go_on([&](const CockpitState&) { return heard.size() >= 5; }));
    const std::uint64_t changes = heard.back().light_changes;
    EXPECT_EQ(cockpit->end(SIGKILL), 1000 + SIGKILL);
    car.poll();
    heard.clear();
    cockpit.emplace(words, folder_ / "errors");
    ASSERT_TRUE(go_on([&](const CockpitState&) { return heard.size() >= 60; })) << errors();
    for (const CockpitState& state : heard) ASSERT_TRUE(lit(state)) << "kill " << times;
    EXPECT_EQ(heard.back().light_changes, changes);
  }
  EXPECT_EQ(car.counters().received[kPayloadIndex<CockpitState>].restarted, 3u);
  keys.event.push_back('h');
  ++keys.events;
  EXPECT_TRUE(go_on([](const CockpitState& state) { return state.light_switch == LightSwitch::kLow; }));
  EXPECT_EQ(cockpit->end(SIGTERM), 0) << errors();
}

// A design chosen by hand beside a log, which itself is played again up to now.
TEST_F(CockpitProcessTest, AChosenDesignComesBackAfterAKill) {
  auto words = log_arguments();
  words.insert(words.end(), {"--lockstep", "--state", folder_ / "state"});
  Bus visual = bus(Role::kVisual), control = bus(Role::kControl);
  std::optional<Program> cockpit;
  cockpit.emplace(words, folder_ / "errors");
  std::optional<CockpitState> before;
  for (std::int64_t frame = -1; frame < 20; ++frame) {
    if (frame == 12) {
      control.send(SimTime{}, RigControl{RigControl::Design{1}});
      std::this_thread::sleep_for(100ms);
    }
    before = next_controls(visual, frame);
    ASSERT_TRUE(before) << errors();
  }
  ASSERT_EQ(before->design_index, 1u);
  cockpit->end(SIGKILL);
  cockpit.emplace(words, folder_ / "errors");
  for (std::int64_t frame = 20; frame < 23; ++frame) {
    const auto after = next_controls(visual, frame);
    ASSERT_TRUE(after) << errors();
    EXPECT_EQ(after->design_index, 1u) << frame;
    EXPECT_EQ(after->light_switch, before->light_switch);
    EXPECT_EQ(after->light_changes, before->light_changes);
  }
  EXPECT_EQ(cockpit->end(SIGTERM), 0) << errors();
}

TEST_F(CockpitProcessTest, BadInputIsOneLineAndExitTwo) {
  const std::string cockpits = cockpits_dir();
  std::ofstream(folder_ / "empty.log") << "nothing\n";
  std::vector<std::vector<std::string>> all{
      arguments({"--log", "/nonexistent.log", "--cockpit", folder_ / "cockpit.toml"}),
      arguments({"--log", folder_ / "empty.log", "--cockpit", folder_ / "cockpit.toml"}),
      arguments({"--log", folder_ / "stalk.log", "--cockpit", cockpits + "/toyota_rav4.toml"}),  // no DBC
      arguments({"--log", folder_ / "stalk.log", "--cockpit", cockpits + "/keyboard.toml"}),     // no mapping
      arguments({"--cockpit", folder_ / "stalk.log"}),
      arguments({"--cockpit", "/nonexistent.toml"}),
      arguments({"--drive", "/nonexistent.pcap"}),
      arguments({"--drive", folder_ / "stalk.log"}),
      arguments({"--script", folder_ / "cockpit.toml"}),
      arguments({"--source", "can"}),
      {"--nonsense"},
      {"--rig", "/nonexistent.toml"}};
  if (!can_supported().ok()) all.push_back(arguments({"--cockpit", cockpits + "/phare_stalk.toml"}));
  for (const auto& flags : all) {
    EXPECT_EQ(Program(flags, folder_ / "errors").end(0), kExitBadInput) << flags.back();
    const std::string said = errors();
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_NE(said.find("phare-cockpit: "), std::string::npos) << said;
    std::printf("%s", said.c_str());
  }
  EXPECT_EQ(Program({"--help"}, folder_ / "errors").end(0), kExitDone);
}

}  // namespace
}  // namespace phare
