// phare-dynamics as a process: lockstep twice, killed and started again, real time with silence, ended by signals.
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "net/bus.h"
#include "net/drive_file.h"
#include "net/run_key.h"
#include "tests/paths.h"

extern char** environ;

namespace phare {
namespace {

using namespace std::chrono_literals;
using SteadyClock = std::chrono::steady_clock;

// The process under test, killed at the latest when the test ends.
class Child {
 public:
  explicit Child(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program("phare-dynamics"));
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    if (posix_spawn(&pid_, arguments[0].c_str(), nullptr, nullptr, argv.data(), environ) != 0) pid_ = -1;
  }
  ~Child() {
    if (pid_ > 0) end(SIGKILL);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  // Exit code, or -signal.
  int end(int signal_number) {
    if (signal_number != 0) ::kill(pid_, signal_number);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t pid_ = -1;
};

class DynamicsProcess : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("phare_dynamics_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    // A scene without a road, but with a lane to start on.
    std::ofstream(folder_ / "scene.gltf") << R"({"asset":{"version":"2.0"}})";
    std::ofstream(folder_ / "scene_lane.csv") << "x_m,y_m,z_m,heading_rad\n5,6,7,0.5\n";
    std::ofstream(folder_ / "rig.toml")
        << "name = \"test\"\nscene = \"scene.gltf\"\nvehicle = \"" + vehicles_dir() +
               "/hatchback.toml\"\ncockpit = \"none.toml\"\n"
               "[dynamics]\nlevel = \"kinematic\"\nstep_s = 0.002\n"
               "[[channel]]\nname = \"front\"\n[[design]]\nname = \"a\"\n"
               "[[design.lamp]]\nname = \"l\"\npair = true\nposition_m = [3.4, 0.6, 0.6]\n"
               "[[design.lamp.source]]\nfunction = \"low\"\nfile = \"l.ies\"\n";
    rig_.port_base = static_cast<std::uint16_t>(20000 + (::getpid() % 500) * 20);
    rig_.channels.resize(1);
    setenv("PHARE_RUN_DIR", (folder_ / "run").c_str(), 1);
    ASSERT_TRUE(take_run_key(rig_));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::vector<std::string> arguments(std::initializer_list<std::string> more) const {
    std::vector<std::string> all{
        "--rig", (folder_ / "rig.toml").string(), "--port-base", std::to_string(rig_.port_base), "--log-level", "warn"};
    all.insert(all.end(), more);
    return all;
  }

  void set_step(const char* step_s) const {
    std::stringstream rig;
    rig << std::ifstream(folder_ / "rig.toml").rdbuf();
    std::string text = rig.str();
    text.replace(text.find("step_s = 0.002"), 14, std::string("step_s = ") + step_s);
    std::ofstream(folder_ / "rig.toml") << text;
  }

  std::string drive_file() const {  // 2 s of recorded poses
    const std::string path = (folder_ / "drive.pcap").string();
    auto writer = DriveWriter::create(path, rig_.port_base);
    for (std::int64_t k = 0; k <= 120; ++k) {
      VehicleState state;
      state.frame_index = k;
      state.x_m = 20.0 * frame_time(k, 60).seconds();
      state.level = "pose";
      const Datagram datagram{Sender::kDynamics, 0,  77,   static_cast<std::uint64_t>(k + 1),
                              frame_time(k, 60), {}, state};
      const std::string bytes = encode(datagram);
      EXPECT_TRUE(writer->write(datagram, std::as_bytes(std::span(bytes))).ok());
    }
    return path;
  }

  // Plays cockpit and visual for frames first..last; every pose as received. Repeats its report as a visual does.
  std::vector<VehicleState> play(Bus& cockpit, Bus& visual, std::int64_t first, std::int64_t last,
                                 VehicleState drawn = {}) {
    std::vector<VehicleState> poses;
    for (std::int64_t k = first; k <= last; ++k) {
      const SimTime time = frame_time(k, rig_.frame_rate_hz);
      FrameReport report;
      report.frame_index = k - 1;
      report.drawn = drawn;
      visual.send(time, report);
      CockpitState controls;
      controls.frame_index = k;
      controls.accelerator_01 = 0.8;
      controls.steering_wheel_rad = 0.2 * std::sin(time.seconds());
      controls.drive_ended = k == 1000;
      cockpit.send(time, controls);
      const auto give_up = SteadyClock::now() + 10s;
      for (auto repeat = SteadyClock::now() + 100ms;;) {
        visual.wait(5ms);
        visual.poll();
        cockpit.poll();
        const auto* pose = visual.newest<VehicleState>();
        if (pose && pose->value.frame_index == k) {
          poses.push_back(drawn = pose->value);
          break;
        }
        if (SteadyClock::now() > give_up) return poses;
        if (SteadyClock::now() > repeat) {
          visual.send_again(kPayloadIndex<FrameReport>);
          cockpit.send_again(kPayloadIndex<CockpitState>);
          repeat += 100ms;
        }
      }
    }
    return poses;
  }

  Rig rig_;
  std::filesystem::path folder_;
};

TEST_F(DynamicsProcess, LockstepRepeatsAndSurvivesAKill) {
  std::vector<VehicleState> run[2];
  for (auto& poses : run) {
    auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
    ASSERT_TRUE(cockpit.ok() && visual.ok());
    Child child(arguments({"--lockstep", "--level", "kinematic"}));
    poses = play(*cockpit, *visual, 0, 120);
    ASSERT_EQ(poses.size(), 121u);
    EXPECT_EQ(poses.front().x_m, 5.0);
    EXPECT_EQ(poses.front().z_m, 7.0);
    EXPECT_EQ(poses.back().step, 1000u);
    EXPECT_GT(poses.back().speed_mps, 3.0);
    if (&poses == &run[1]) {
      EXPECT_EQ(child.end(SIGKILL), -SIGKILL);
      Child successor(arguments({"--lockstep", "--level", "kinematic", "--stats", (folder_ / "s.json").string()}));
      const auto more = play(*cockpit, *visual, 121, 180, poses.back());
      ASSERT_EQ(more.size(), 60u);
      EXPECT_NEAR(more.front().x_m - poses.back().x_m, poses.back().vx_mps / 60.0, 0.01);
      EXPECT_NEAR(more.front().pitch_rad, poses.back().pitch_rad, 1e-3);
      EXPECT_EQ(successor.end(SIGTERM), 0);
      const auto stats = nlohmann::json::parse(std::ifstream(folder_ / "s.json"));
      EXPECT_EQ(stats["process"], "dynamics");
      EXPECT_GT(stats["step_ns"]["p50"].get<double>(), 0.0);
    } else {
      EXPECT_EQ(child.end(SIGTERM), 0);
    }
  }
  for (std::size_t k = 0; k < run[0].size(); ++k) EXPECT_EQ(run[0][k], run[1][k]) << "frame " << k;
}

// With the state file of the run every kill, wherever it falls, leaves the drive as it would have been, bit for bit.
TEST_F(DynamicsProcess, LockstepIsTheSameToTheBitWithKillsAtEveryLevel) {
  for (const char* level : {"kinematic", "single-track", "full", "auto"}) {
    std::vector<VehicleState> run[2];
    for (const bool kills : {false, true}) {
      auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
      ASSERT_TRUE(cockpit.ok() && visual.ok());
      const std::string state = (folder_ / (std::string("car.state") + level)).string();
      const auto start = [&] {
        return std::make_unique<Child>(arguments({"--lockstep", "--level", level, "--state", state}));
      };
      auto child = start();
      for (std::int64_t first = 0; first < 120; first += 40) {
        const auto poses = play(*cockpit, *visual, first, first + 39, first == 0 ? VehicleState{} : run[kills].back());
        ASSERT_EQ(poses.size(), 40u) << level << " from " << first;
        run[kills].insert(run[kills].end(), poses.begin(), poses.end());
        if (!kills || first == 80) continue;
        EXPECT_EQ(child->end(SIGKILL), -SIGKILL);
        child = start();
      }
      EXPECT_EQ(child->end(SIGTERM), 0);
      std::filesystem::remove(state);
    }
    for (std::size_t k = 0; k < run[0].size(); ++k) ASSERT_EQ(run[0][k], run[1][k]) << level << ", frame " << k;
  }
}

// Of a process that took over from a picture, and of the one that took over from it: times are those of the drive.
TEST_F(DynamicsProcess, SwitchesKeepTheirTimesThroughKills) {
  auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
  ASSERT_TRUE(cockpit.ok() && visual.ok());
  const std::string state = (folder_ / "car.state").string(), stats = (folder_ / "s.json").string();
  std::vector<VehicleState> poses{VehicleState{}};
  std::int64_t next = 0;
  for (const auto& more :
       {arguments({"--lockstep", "--level", "auto"}), arguments({"--lockstep", "--level", "auto", "--state", state}),
        arguments({"--lockstep", "--level", "auto", "--state", state, "--stats", stats})}) {
    Child child(more);
    poses = play(*cockpit, *visual, next, next + 39, poses.back());
    ASSERT_EQ(poses.size(), 40u);
    next += 40;
    child.end(next == 120 ? SIGTERM : SIGKILL);
  }
  const auto told = nlohmann::json::parse(std::ifstream(stats))["auto"];
  ASSERT_FALSE(told["history"].empty());
  for (const auto& change : told["history"]) {
    EXPECT_GE(change["time_s"].get<double>(), 39.0 / 60.0);  // where the second began
    EXPECT_LE(change["time_s"].get<double>(), 2.0);
    EXPECT_NE(change["from"], change["to"]);
    EXPECT_FALSE(change["because"].get<std::string>().empty());
  }
}

// In real time, and with no picture that could tell where the car was: it goes on from where it was, and time does not
// go back.
TEST_F(DynamicsProcess, RealTimeGoesOnAfterAKillThoughNoPictureTellsOfTheCar) {
  auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
  ASSERT_TRUE(cockpit.ok() && visual.ok());
  const auto all = arguments({"--level", "full", "--state", (folder_ / "car.state").string()});
  auto child = std::make_unique<Child>(all);
  SimTime newest{-1};
  VehicleState before;
  const auto drive_on = [&](std::chrono::milliseconds for_long) {
    for (const auto until = SteadyClock::now() + for_long; SteadyClock::now() < until;) {
      CockpitState controls;
      controls.accelerator_01 = 0.8;
      cockpit->send(SimTime{std::max<std::int64_t>(newest.ns, 0)}, controls);
      visual->wait(10ms);
      visual->poll();
    }
  };
  visual->on_datagram = [&](const Datagram& datagram, std::span<const std::byte>) {
    if (const auto* state = std::get_if<VehicleState>(&datagram.payload)) {
      EXPECT_GE(datagram.sim_time, newest);
      EXPECT_GE(state->x_m * std::cos(0.5) + state->y_m * std::sin(0.5),
                before.x_m * std::cos(0.5) + before.y_m * std::sin(0.5) - 1e-3);
      EXPECT_GE(state->step, before.step);
      newest = datagram.sim_time;
      before = *state;
    }
  };
  drive_on(1500ms);
  ASSERT_GT(before.speed_mps, 1.0);
  for (int kill_count = 0; kill_count < 3; ++kill_count) {
    const double speed_mps = before.speed_mps;
    const SimTime time = newest;
    EXPECT_EQ(child->end(SIGKILL), -SIGKILL);
    child = std::make_unique<Child>(all);
    drive_on(700ms);
    EXPECT_GT(before.speed_mps, speed_mps);
    EXPECT_GT(newest, time);
  }
  EXPECT_EQ(child->end(SIGTERM), 0);
}

// The picture gets what levelling does: the nose rises under power, the sensors see it, the lamps are turned down.
TEST_F(DynamicsProcess, LevellingReachesTheBus) {
  for (const bool dynamic : {false, true}) {
    auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
    ASSERT_TRUE(cockpit.ok() && visual.ok());
    std::vector<std::string> all = arguments({"--lockstep", "--level", "single-track"});
    if (dynamic) all.insert(all.end(), {"--levelling", "dynamic"});
    Child child(all);
    const auto poses = play(*cockpit, *visual, 0, 120);
    ASSERT_EQ(poses.size(), 121u);
    EXPECT_LT(poses.back().suspension_pitch_rad, -5e-3);
    if (!dynamic) {
      EXPECT_EQ(poses.back().lamp_tilt_rad, 0.0);  // the hatchback has the driver's wheel only
      continue;
    }
    EXPECT_EQ(poses.front().lamp_tilt_rad, 0.0);
    // After two seconds, of which the filter forgets all but 0.3 s, the lamps follow within a quarter of the pitch.
    EXPECT_NEAR(poses.back().lamp_tilt_rad, poses.back().suspension_pitch_rad,
                0.25 * std::abs(poses.back().suspension_pitch_rad));
    // No faster than the actuator.
    for (std::size_t k = 1; k < poses.size(); ++k)
      EXPECT_LE(std::abs(poses[k].lamp_tilt_rad - poses[k - 1].lamp_tilt_rad), 5.0 * M_PI / 180.0 / 60.0 + 1e-4);
    EXPECT_EQ(child.end(SIGTERM), 0);
  }
}

TEST_F(DynamicsProcess, EveryStepOfADriveHasItsHash) {
  auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
  ASSERT_TRUE(cockpit.ok() && visual.ok());
  Child child(arguments({"--lockstep", "--level", "full"}));
  const auto poses = play(*cockpit, *visual, 0, 60);
  ASSERT_EQ(poses.size(), 61u);
  std::uint64_t step = 0;
  std::set<std::uint64_t> different;
  for (const VehicleState& pose : poses) {
    ASSERT_EQ(pose.step_hash.size(), pose.step - step);
    if (!pose.step_hash.empty()) {
      EXPECT_EQ(pose.step_hash.back(), pose.state_hash);
    }
    different.insert(pose.step_hash.begin(), pose.step_hash.end());
    step = pose.step;
  }
  EXPECT_EQ(step, 500u);
  EXPECT_EQ(different.size(), 500u);
  EXPECT_EQ(child.end(SIGTERM), 0);
}

// 1 kHz in lockstep: ten minutes with PHARE_LONG_TESTS=1, ten seconds without. Every step of the time is done, in
// order, and has its hash.
TEST_F(DynamicsProcess, LockstepMissesNoStep) {
  const std::int64_t seconds = std::getenv("PHARE_LONG_TESTS") ? 600 : 10;
  set_step("0.001");
  auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
  ASSERT_TRUE(cockpit.ok() && visual.ok());
  Child child(arguments({"--lockstep", "--level", "full", "--stats", (folder_ / "s.json").string()}));
  std::uint64_t step = 0;
  const auto poses = play(*cockpit, *visual, 0, 60 * seconds);
  ASSERT_EQ(poses.size(), static_cast<std::size_t>(60 * seconds + 1));
  for (const VehicleState& pose : poses) {
    // The step that reaches the frame's time, floor(k / 60 s) in ns, counted up.
    ASSERT_EQ(pose.step, static_cast<std::uint64_t>((frame_time(pose.frame_index, 60).ns + 999'999) / 1'000'000));
    ASSERT_EQ(pose.step_hash.size(), pose.step - step) << pose.frame_index;
    step = pose.step;
  }
  EXPECT_EQ(step, static_cast<std::uint64_t>(1000 * seconds));
  EXPECT_EQ(child.end(SIGTERM), 0);
  const auto stats = nlohmann::json::parse(std::ifstream(folder_ / "s.json"));
  EXPECT_EQ(stats["steps"].get<std::uint64_t>(), step);
  EXPECT_EQ(stats["lag_s"].get<double>(), 0.0);
  std::printf("%lld steps in lockstep, p50 %.0f ns, p99.9 %.0f ns, longest %lld ns\n", static_cast<long long>(step),
              stats["step_ns"]["p50"].get<double>(), stats["step_ns"]["p99_9"].get<double>(),
              static_cast<long long>(stats["step_ns"]["max"].get<std::int64_t>()));
}

TEST_F(DynamicsProcess, ReplaysADriveToItsEnd) {
  auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
  ASSERT_TRUE(cockpit.ok() && visual.ok());
  Child child(arguments({"--lockstep", "--level", "pose", "--drive", drive_file()}));
  const auto poses = play(*cockpit, *visual, 0, 120);
  ASSERT_EQ(poses.size(), 121u);
  for (std::size_t k = 0; k <= 120; ++k) {
    EXPECT_NEAR(poses[k].x_m, 20.0 * frame_time(static_cast<std::int64_t>(k), 60).seconds(), 1e-9);
    EXPECT_EQ(poses[k].drive_ended, k == 120);
  }
  EXPECT_EQ(child.end(SIGINT), 0);
}

// Simulated time begins with the picture; one that never becomes ready is not waited for without end.
// With a level of its own a drive gives the first pose, and another vehicle may drive it.
TEST_F(DynamicsProcess, ADriveAndALevelBeginWhereTheDriveBegins) {
  const std::string drive = drive_file();
  for (const char* level : {"kinematic", "full"}) {
    auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
    ASSERT_TRUE(cockpit.ok() && visual.ok());
    Child child(
        arguments({"--lockstep", "--drive", drive, "--level", level, "--vehicle", vehicles_dir() + "/bmw_320i.toml"}));
    const auto poses = play(*cockpit, *visual, 0, 20);
    ASSERT_EQ(poses.size(), 21u) << level;
    EXPECT_NEAR(poses.front().x_m, 0.0, 1e-9) << level;  // the lane would begin at 5
    EXPECT_EQ(poses.back().level, level);
    EXPECT_GT(poses.back().speed_mps, 0.1) << level;  // and not the record's 20 m/s times time
    EXPECT_EQ(child.end(SIGTERM), 0);
  }
}

TEST_F(DynamicsProcess, RealTimeBeginsWithThePicture) {
  for (const bool comes : {true, false}) {
    auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
    ASSERT_TRUE(cockpit.ok() && visual.ok());
    const auto begin = SteadyClock::now();
    Child child(arguments({"--level", "kinematic", "--wait-for-picture", comes ? "60" : "1.5"}));
    std::optional<SteadyClock::time_point> ready, first;
    SimTime first_time{-1};
    while (SteadyClock::now() < begin + 20s && !first) {
      if (comes && !ready && SteadyClock::now() > begin + 1s) {
        FrameReport up;
        up.channels = 1;
        visual->send({}, up);
        ready = SteadyClock::now();
      }
      visual->wait(10ms);
      visual->poll();
      const auto* car = visual->newest<VehicleState>();
      if (car == nullptr) continue;
      first = SteadyClock::now();
      first_time = car->sim_time;
    }
    ASSERT_TRUE(first);
    ASSERT_TRUE(ready || !comes) << "it began before the picture was ready";
    EXPECT_GE(*first - begin, comes ? 1000ms : 1500ms);
    EXPECT_LT(first_time.ns, (*first - begin - (comes ? 1000ms : 1500ms) + 1ms) / 1ns) << "time began when it did";
    EXPECT_EQ(child.end(SIGTERM), 0);
  }
}

TEST_F(DynamicsProcess, RealTimeSendsAndFadesInSilence) {
  auto cockpit = Bus::open(rig_, Role::kCockpit), visual = Bus::open(rig_, Role::kVisual);
  ASSERT_TRUE(cockpit.ok() && visual.ok());
  Child child(arguments({"--level", "kinematic"}));
  int received = 0;
  SimTime first{-1}, last{};
  double fastest = 0.0, end_ax = 1.0;
  const auto begin = SteadyClock::now();
  while (SteadyClock::now() < begin + 4s) {
    if (SteadyClock::now() < begin + 1500ms) {  // then the driver is gone, foot on the accelerator
      CockpitState controls;
      controls.accelerator_01 = 0.5;
      cockpit->send({}, controls);
    }
    visual->wait(2ms);
    visual->poll();
    if (const auto pose = visual->take<VehicleState>()) {
      if (first.ns < 0) first = pose->sim_time;
      last = pose->sim_time;
      ++received;
      fastest = std::max(fastest, pose->value.speed_mps);
      end_ax = pose->value.ax_mps2;
    }
  }
  EXPECT_GT(received, 100);  // 250 a second on a machine that is not loaded
  EXPECT_GT(last.seconds() - first.seconds(), 1.0);
  EXPECT_GT(fastest, 0.5);
  EXPECT_LT(end_ax, 0.0);  // coasting
  RigControl quit;
  quit.command = RigControl::Quit{};
  auto control = Bus::open(rig_, Role::kControl);
  ASSERT_TRUE(control.ok());
  control->send({}, quit);
  EXPECT_EQ(child.end(0), 0);
}

// At 1 kHz beside whatever else runs: every millisecond of wall time is a step done, a step dropped and told, or not
// yet due; every wake-up is in the histogram of lateness. Counts only: how late they come is the machine's affair.
TEST_F(DynamicsProcess, RealTimeAccountsForEveryMillisecond) {
  set_step("0.001");
  const auto begin = SteadyClock::now();
  Child child(arguments({"--level", "full", "--stats", (folder_ / "s.json").string()}));
  std::this_thread::sleep_for(1500ms);
  EXPECT_EQ(child.end(SIGTERM), 0);
  const double ran_s = std::chrono::duration<double>(SteadyClock::now() - begin).count();
  const auto stats = nlohmann::json::parse(std::ifstream(folder_ / "s.json"));
  const nlohmann::json& wakes = stats["wake_late_ns"];
  const auto count = wakes["count"].get<std::int64_t>(), missed = wakes["missed"].get<std::int64_t>(),
             steps = stats["steps"].get<std::int64_t>(),
             dropped = static_cast<std::int64_t>(std::llround(stats["lag_s"].get<double>() * 1e3));
  std::int64_t in_histogram = 0;
  for (const auto& octave : wakes["octaves"]) in_histogram += octave.get<std::int64_t>();
  EXPECT_EQ(in_histogram, count);
  // A wake-up may find its step not quite due, and the signal that ends the run wakes once more.
  EXPECT_NEAR(static_cast<double>(steps + dropped), static_cast<double>(count + missed), 2.0);
  EXPECT_GT(steps, 100);
  EXPECT_LE(static_cast<double>(steps + dropped), ran_s * 1e3 + 1.0);
  EXPECT_EQ(stats["drops"].get<int>() == 0, dropped == 0);
}

TEST_F(DynamicsProcess, BadUseExitsWithTwo) {
  EXPECT_EQ(Child({"--nonsense"}).end(0), 2);
  EXPECT_EQ(Child({"--rig", "/nonexistent.toml"}).end(0), 2);
  EXPECT_EQ(Child(arguments({"--level", "best"})).end(0), 2);
  EXPECT_EQ(Child(arguments({"--level", "pose"})).end(0), 2);
  EXPECT_EQ(Child(arguments({"--level", "pose", "--drive", "/nonexistent.pcap"})).end(0), 2);
  EXPECT_EQ(Child({"--help"}).end(0), 0);
}

}  // namespace
}  // namespace phare
