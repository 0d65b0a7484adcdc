// The larger levels in the loop: no allocation, no system call, the same bits again, levels by scene, lamps.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <malloc.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <random>

#include "full_car.h"
#include "vehicle_dynamics/levelling.h"

namespace {
std::atomic<long> g_allocations{0};
}  // namespace

// Both halves are replaced, but with sanitizers GCC sees only one of them inlined.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
void* operator new(std::size_t size) {
  ++g_allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {  // of std::stable_sort
  ++g_allocations;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace phare {
namespace {

RunSetup setup_of(Level level, const char* file = "hatchback.toml") {
  RunSetup setup = test::kinematic_setup(file);
  setup.level = level;
  setup.sprung = *SprungParams::of(setup.vehicle, file);
  setup.on_top.profiles.push_back(HeightProfile::iso8608(RoughnessClass::kB, 3, 200.0));
  return setup;
}

Controls controls_at(double t) {
  return {.steering_wheel_rad = 0.5 * std::sin(0.7 * t),
          .accelerator_01 = std::max(0.0, std::sin(0.31 * t)),
          .brake_01 = std::max(0.0, -std::sin(0.31 * t))};
}

constexpr std::array<Level, 4> kLevels{Level::kKinematic, Level::kSingleTrack, Level::kFull, Level::kAuto};
constexpr std::array<Integrator, 3> kIntegrators{Integrator::kSemiImplicitEuler, Integrator::kEtd2, Integrator::kRk4};

StepLoop loop_of(Level level, Integrator integrator) {
  RunSetup setup = setup_of(level);
  setup.sprung->set_integrator(integrator);
  CarState start;
  start.speed_mps = 10.0;
  return StepLoop(setup, start);
}

TEST(Running, NoAllocationInTheStep) {
  for (const Level level : kLevels)
    for (const Integrator integrator : kIntegrators) {
      StepLoop loop = loop_of(level, integrator);
      const long before = g_allocations;
      for (int i = 1; i <= 300; ++i) {
        loop.set_controls(controls_at(0.1 * i));
        loop.run_to(test::seconds(0.02 * i));
      }
      EXPECT_EQ(g_allocations - before, 0) << name(level);
    }
}

// Hard case 9's other half: driving on takes no memory, neither from operator new nor from malloc. (Sanitizers answer
// mallinfo2 with zeros.)
TEST(Running, C09MemoryStaysTheSame) {
  for (const Level level : kLevels) {
    StepLoop loop = loop_of(level, Integrator::kRk4);
    const long before = g_allocations;
    const std::size_t used = mallinfo2().uordblks;
    loop.set_controls({.accelerator_01 = 0.2});
    loop.run_to(test::seconds(test::long_run() ? 3600.0 : 60.0));
    const std::size_t now = mallinfo2().uordblks;
    EXPECT_EQ(now, used) << name(level);
    EXPECT_EQ(g_allocations - before, 0) << name(level);
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// From here on any system call but leaving kills the process. Reading the clock is none where the kernel maps its page
// (vdso), and one in some virtual machines: the loop times its steps, so that is let through.
bool forbid_system_calls() {
  std::array<sock_filter, 5> rule{sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                                  sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clock_gettime, 2, 0),
                                  sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit, 1, 0),
                                  sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
                                  sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program{static_cast<unsigned short>(rule.size()), rule.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

// How a child ended that ran `work` after that: true for a normal end.
template <class Work>
bool ends_without_system_call(const Work& work, bool* can_forbid) {
  const pid_t child = fork();
  if (child == 0) {
    work([] {
      if (!forbid_system_calls()) syscall(SYS_exit, 77);
    });
    syscall(SYS_exit, 0);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  *can_forbid = !(WIFEXITED(status) && WEXITSTATUS(status) == 77);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Running, NoSystemCallInTheStep) {
  bool can_forbid = false;
  const bool forbids = !ends_without_system_call(
      [](const auto& forbid) {
        forbid();
        syscall(SYS_getppid);
      },
      &can_forbid);
  if (!can_forbid) GTEST_SKIP() << "no seccomp here";
  ASSERT_TRUE(forbids) << "a system call does end the child";
  for (const Level level : kLevels)
    for (const Integrator integrator : kIntegrators)
      EXPECT_TRUE(ends_without_system_call(
          [&](const auto& forbid) {
            StepLoop loop = loop_of(level, integrator);
            loop.set_controls(controls_at(0.0));
            loop.run_to(test::seconds(0.1));  // symbols bound
            forbid();
            for (int i = 1; i <= 400; ++i) {
              loop.set_controls(i < 300 ? controls_at(0.05 * i) : Controls{.steering_wheel_rad = 1.0, .brake_01 = 1.0});
              loop.run_to(test::seconds(0.1 + 0.02 * i));
            }
            syscall(SYS_exit, 0);  // before the loop's memory goes back, which may be a call
          },
          &can_forbid))
          << name(level) << ", " << static_cast<int>(integrator);
}
#endif

TEST(Running, TheSameBitsAgain) {
  for (const Level level : {Level::kSingleTrack, Level::kFull, Level::kAuto}) {
    std::uint64_t hash[2]{};
    for (std::uint64_t& run : hash) {
      StepLoop loop(setup_of(level), CarState{});
      for (std::int64_t frame = 0; frame <= 900; ++frame) {
        const SimTime time = frame_time(frame, 60);
        loop.set_controls(controls_at(time.seconds()));
        loop.run_to(time);
        run = run * 31 + loop.at(time).state_hash;
      }
      EXPECT_GT(std::hypot(loop.state().x_m, loop.state().y_m), 5.0);
    }
    EXPECT_EQ(hash[0], hash[1]) << name(level);
  }
}

// Parked and settled the car sleeps: it is where it would be awake, wakes by any control, and drives off alike.
TEST(Running, AParkedCarSleeps) {
  for (const Level level : {Level::kSingleTrack, Level::kFull}) {
    RunSetup setup = setup_of(level);
    StepLoop loop(setup, CarState{}), awake(setup, CarState{});
    for (int i = 1; i <= 600; ++i) {
      const double t = 0.05 * i;
      const Controls held{.accelerator_01 = t < 2.0 ? 0.5 : 0.0, .brake_01 = t < 2.0 ? 0.0 : 0.7};
      loop.set_controls(held);
      // The same brake for the car; never the same twice for the loop, so it does not sleep.
      Controls never = held;
      if (t >= 2.0) never.brake_01 += 1e-9 * (i % 2);
      awake.set_controls(never);
      for (StepLoop* l : {&loop, &awake}) l->run_to(test::seconds(t));
    }
    EXPECT_GT(loop.slept_s(), 10.0) << name(level);
    EXPECT_EQ(awake.slept_s(), 0.0);
    const VehicleState a = loop.at(loop.time()), b = awake.at(awake.time());
    EXPECT_GT(a.x_m, 1.0);
    EXPECT_NEAR(a.x_m, b.x_m, 1e-6);
    EXPECT_NEAR(a.z_m, b.z_m, 1e-6);
    EXPECT_NEAR(a.pitch_rad, b.pitch_rad, 1e-6);
    EXPECT_NEAR(a.roll_rad, b.roll_rad, 1e-6);
    for (StepLoop* l : {&loop, &awake}) l->set_controls({.accelerator_01 = 0.5}), l->run_to(test::seconds(33.0));
    EXPECT_GT(loop.state().speed_mps, 1.0);
    EXPECT_NEAR(loop.state().x_m, awake.state().x_m, 1e-5);
  }
}

// Hard case 11 at level full: when the clock wakes us does not matter.
TEST(Running, C11JitterOfTheClock) {
  StepLoop even(setup_of(Level::kFull), CarState{}), jittery(setup_of(Level::kFull), CarState{});
  std::mt19937 random(7);
  std::int64_t elapsed_ns = 0;
  for (StepLoop* loop : {&even, &jittery}) loop->set_controls({.steering_wheel_rad = 0.4, .accelerator_01 = 0.6});
  for (int i = 0; i < 300; ++i) {
    elapsed_ns += i % 30 == 29 ? 500'000'000 : 1'000'000 + static_cast<std::int64_t>(random() % 32'000'000);
    jittery.catch_up(SimTime{elapsed_ns});
  }
  even.run_to(jittery.time());
  EXPECT_EQ(even.steps(), jittery.steps());
  EXPECT_EQ(even.state(), jittery.state());
  EXPECT_EQ(even.at(even.time()).state_hash, jittery.at(jittery.time()).state_hash);
  EXPECT_EQ(jittery.drops(), 10u);  // ten stalls, each capped and counted
}

// Hard case 12: nonsense is refused, the last good controls stay.
TEST(Running, C12NonsenseIsRefused) {
  StepLoop loop(setup_of(Level::kFull), CarState{}), same(setup_of(Level::kFull), CarState{});
  for (StepLoop* l : {&loop, &same})
    l->set_controls({.steering_wheel_rad = 0.2, .accelerator_01 = 0.5}), l->run_to(test::seconds(1.0));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  loop.set_controls({.steering_wheel_rad = kNan});
  loop.set_controls({.brake_01 = std::numeric_limits<double>::infinity()});
  for (StepLoop* l : {&loop, &same}) l->run_to(test::seconds(2.0));
  EXPECT_EQ(loop.state(), same.state());
  EXPECT_EQ(loop.controls_refused(), 2u);
  loop.set_controls({.steering_wheel_rad = 1e308, .accelerator_01 = 1e308, .brake_01 = -1e308});
  loop.run_to(test::seconds(4.0));
  EXPECT_TRUE(std::isfinite(loop.state().x_m) && std::isfinite(loop.state().roll_rad));
}

TEST(AutoLevel, TheTable) {
  Situation calm{.speed_mps = 20.0};
  EXPECT_EQ(choose(calm).rung, 0);
  Situation s = calm;
  s.ax_mps2 = -0.8;
  EXPECT_EQ(choose(s).rung, 1);
  s = calm, s.unevenness_m = 0.004;
  EXPECT_EQ(choose(s).reason, Reason::kRoughness);
  s = calm, s.unevenness_m = 0.05;
  EXPECT_EQ(choose(s).rung, 2);
  s = calm, s.friction = 0.3;
  EXPECT_EQ(choose(s).reason, Reason::kFriction);
  s = calm, s.utilisation_01 = 0.6;
  EXPECT_EQ(choose(s).reason, Reason::kUtilisation);
  s = calm, s.least_load_share = 0.1;
  EXPECT_EQ(choose(s).reason, Reason::kLoad);
  s = calm, s.speed_mps = 0.5, s.brake_or_grade = true;
  EXPECT_EQ(choose(s).reason, Reason::kStandstill);
}

TEST(AutoLevel, UpAtOnceDownAfterTwoSeconds) {
  AutoLevel level;
  Situation hard{.utilisation_01 = 0.6, .speed_mps = 20.0}, calm{.speed_mps = 20.0};
  EXPECT_EQ(level.next(calm, 0.01).rung, 0);
  EXPECT_EQ(level.next(hard, 0.01).rung, 2);
  for (int i = 0; i < 198; ++i) EXPECT_EQ(level.next(calm, 0.01).rung, 2);
  for (int i = 0; i < 4; ++i) level.next(calm, 0.01);
  EXPECT_EQ(level.now().rung, 0);
  EXPECT_EQ(level.switches(), 2u);
}

// Every switch tells when, from where to where, and the number that decided.
TEST(AutoLevel, SaysWhy) {
  AutoLevel level;
  Situation calm{.speed_mps = 20.0}, hard = calm;
  hard.utilisation_01 = 0.62;
  for (int i = 0; i < 100; ++i) level.next(calm, 0.01);
  level.next(hard, 0.01);
  ASSERT_EQ(level.switches(), 1u);
  EXPECT_NEAR(level.change(0).time_s, 1.0, 1e-9);
  EXPECT_EQ(text(level.change(0)), "kinematic to full: tyres used by more than half (0.62)");
  for (int i = 0; i < 300; ++i) level.next(calm, 0.01);
  ASSERT_EQ(level.switches(), 2u);
  EXPECT_EQ(text(level.change(1)), "full to kinematic: smooth road, gentle driving (0)");
}

// A scene on the edge: every two seconds calm, then not. It comes down ever more rarely.
TEST(AutoLevel, DoesNotHuntOnTheEdge) {
  AutoLevel level;
  Situation calm{.speed_mps = 20.0}, hard = calm;
  hard.utilisation_01 = 0.6;
  for (int i = 0; i < 60'000; ++i) level.next(i % 250 < 230 ? calm : hard, 0.01);  // ten minutes
  EXPECT_LE(level.switches(), 6u);                                                 // 480 with the same wait each time
}

// On a smooth road it goes through all three levels, on a rough one between the two with springs; beside what the pitch
// did in the step before, a switch adds next to nothing.
TEST(AutoLevel, SwitchesWithoutABump) {
  for (const bool rough : {false, true}) {
    RunSetup setup = setup_of(Level::kAuto);
    if (!rough) setup.on_top.profiles.clear();
    CarState start;
    start.speed_mps = 20.0;
    StepLoop loop(setup, start);
    const auto pitch_now = [&] { return loop.state().pitch_rad + loop.state().road_pitch_rad; };
    Level before = loop.level_now();
    double pitch = pitch_now(), rate = 0.0, worst = 0.0;
    std::uint64_t seen = 0;
    for (int i = 1; i <= 10'000; ++i) {
      const double t = 0.002 * i;
      loop.set_controls({.steering_wheel_rad = t > 6.0 && t < 8.0 ? 1.0 : 0.0,
                         .accelerator_01 = 0.1,
                         .brake_01 = t > 3.0 && t < 4.0 ? 0.6 : 0.0});
      loop.run_to(SimTime{static_cast<std::int64_t>(i) * 2'000'000});
      if (loop.level_now() != before) {
        worst = std::max(worst, std::abs(pitch_now() - pitch - 0.002 * rate));
        before = loop.level_now();
        ++seen;
      }
      rate = loop.state().pitch_rate_radps, pitch = pitch_now();
    }
    EXPECT_GE(seen, 2u);
    EXPECT_EQ(seen, loop.choice().switches());
    EXPECT_LT(worst, 0.05e-3) << rough;
  }
}

TEST(Levelling, KeepsTheCutOff) {
  const LevellingParams p = test::car("hatchback.toml").levelling;
  EXPECT_NEAR(levelling::cutoff_on_wall_m(p, 0.0, 0.0, 0.0), p.lamp_height_m - 0.01 * 25.0, 1e-4);
  // Ten mrad nose down lower it by a quarter of a metre and the lamp's own fall.
  EXPECT_NEAR(levelling::cutoff_on_wall_m(p, 0.01, 0.0, 0.0) - levelling::cutoff_on_wall_m(p, 0.0, 0.0, 0.0),
              -0.25 - 0.01 * p.lamp_x_m, 2e-3);
  levelling::State s;
  for (int i = 0; i < 4000; ++i) levelling::advance(p, levelling::Kind::kDynamic, 0.0, 0.01, 20.0, s, 0.002);
  EXPECT_NEAR(s.tilt_rad, 0.01, 1e-6);
  // Half of a step is followed after filter and actuator: ln 2 of the filter's time at least.
  levelling::State quick;
  double half_at = 0.0;
  for (int i = 1; half_at == 0.0; ++i) {
    levelling::advance(p, levelling::Kind::kDynamic, 0.0, 0.01, 20.0, quick, 0.001);
    if (quick.tilt_rad >= 0.005) half_at = 0.001 * i;
  }
  EXPECT_NEAR(half_at, 0.3 * std::log(2.0), 0.01);
  // A load in the boot lifts the nose; the static system follows while the car stands, not while it brakes.
  levelling::State load;
  for (int i = 0; i < 60'000; ++i) levelling::advance(p, levelling::Kind::kStatic, 0.0, -0.008, 0.0, load, 0.002);
  EXPECT_NEAR(load.tilt_rad, -0.008, 1e-4);
  for (int i = 0; i < 1000; ++i) levelling::advance(p, levelling::Kind::kStatic, 0.0, 0.02, 15.0, load, 0.002);
  EXPECT_NEAR(load.tilt_rad, -0.008, 1e-4);
  levelling::State wheel;
  for (int i = 0; i < 1000; ++i) levelling::advance(p, levelling::Kind::kManual, 2.0, 0.0, 15.0, wheel, 0.002);
  EXPECT_NEAR(wheel.tilt_rad, -2.0 * p.manual_step_rad, 1e-9);
}

TEST(Powertrain, GearboxAndAbs) {
  RunSetup setup = setup_of(Level::kFull);
  setup.on_top.profiles.clear();
  StepLoop loop(setup, CarState{});
  loop.set_controls({.accelerator_01 = 1.0});
  loop.run_to(test::seconds(12.0));
  EXPECT_GT(loop.state().speed_mps, 100.0 / 3.6);  // 0 to 100 km/h in 10 s or so: the class
  EXPECT_LT(loop.state().speed_mps, 45.0);
  const double speed = loop.state().speed_mps, x = loop.state().x_m;
  loop.set_controls({.brake_01 = 1.0});
  loop.run_to(test::seconds(12.5));
  double least = 1e9;
  for (int i = 0; i < 100; ++i) {
    loop.run_to(test::seconds(12.5 + 0.01 * i));
    if (loop.state().speed_mps > 5.0) least = std::min(least, -loop.state().ax_mps2);
  }
  EXPECT_GT(least, 6.0);
  loop.run_to(test::seconds(20.0));
  EXPECT_LT(std::abs(loop.state().speed_mps), 1e-3);
  const double mean = speed * speed / 2.0 / (loop.state().x_m - x);
  EXPECT_GT(mean, 8.0);
  EXPECT_LT(mean, 11.6);
}

}  // namespace
}  // namespace phare
