// process: starting, restarting, giving up and ending, on small programs every Debian has (coreutils).
#include "tools/supervisor.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

namespace phare {
namespace {

using namespace std::chrono_literals;

/// Runs until the supervisor says it is over, or the time is up (false).
bool over_within(Supervisor& supervisor, std::chrono::milliseconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  while (std::chrono::steady_clock::now() < deadline) {
    if (!supervisor.step()) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

TEST(Supervisor, EndsWhenThePicturesEnd) {
  Supervisor supervisor({{"cockpit", "/bin/sleep", {"60"}}, {"visual-0", "/bin/true", {}, true}});
  ASSERT_TRUE(supervisor.start());
  EXPECT_TRUE(over_within(supervisor, 5s));
  EXPECT_EQ(supervisor.exit_code(), kExitDone);
  supervisor.end_all(5s);
  ASSERT_EQ(supervisor.ends().size(), 2u);
  EXPECT_EQ(supervisor.ends()[0].how, "SIGTERM");
  EXPECT_EQ(supervisor.ends()[1].how, "exit 0");
  EXPECT_EQ(supervisor.ended_badly(), "");
}

TEST(Supervisor, KnowsThatOneOfSeveralWindowsWasClosed) {
  Supervisor supervisor({{"visual-0", "/bin/true", {}, true}, {"visual-1", "/bin/sleep", {"60"}, true}});
  ASSERT_TRUE(supervisor.start());
  EXPECT_FALSE(supervisor.one_has_left());
  for (int i = 0; i < 5000 && !supervisor.one_has_left(); ++i) {
    ASSERT_TRUE(supervisor.step()) << "the other is there";
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_TRUE(supervisor.one_has_left());
  supervisor.end_all(5s);
}

TEST(Supervisor, TellsWhoEndsBadlyWhenTheDriveIsOver) {
  const auto dies = [](const std::string& how) {
    return std::vector<std::string>{"-c", "trap '" + how + "' TERM; while :; do sleep 0.05; done"};
  };
  Supervisor supervisor({{"dynamics", "/bin/sh", dies("kill -SEGV $$")},
                         {"cockpit", "/bin/sh", dies("exit 3")},
                         {"visual-0", "/bin/sleep", {"0.3"}, true}});
  ASSERT_TRUE(supervisor.start());
  EXPECT_TRUE(over_within(supervisor, 5s));
  supervisor.end_all(5s);
  const std::string told = supervisor.ended_badly();
  EXPECT_NE(told.find("dynamics ended with SIGSEGV"), std::string::npos) << told;
  EXPECT_NE(told.find("cockpit ended with exit 3"), std::string::npos) << told;
}

TEST(Supervisor, GivesUpAfterFiveRestarts) {
  Supervisor supervisor({{"dynamics", "/bin/false", {}}, {"visual-0", "/bin/sleep", {"60"}, true}});
  ASSERT_TRUE(supervisor.start());
  EXPECT_TRUE(over_within(supervisor, 8s));
  EXPECT_EQ(supervisor.exit_code(), kExitCheckFailed);
  EXPECT_EQ(supervisor.restarts().size(), Supervisor::kMaxRestarts);
  EXPECT_EQ(supervisor.restarts()[0].because, "exit 1");
  EXPECT_NE(supervisor.why().find("dynamics ended with exit 1 after 5 restarts"), std::string::npos)
      << supervisor.why();
}

// However long each takes to die, but for one that has lived well in between.
TEST(Supervisor, GivesUpOnWhatDiesSlowlyToo) {
  // Six lives and the waits between take 13 s: longer than one of them may.
  Supervisor slow({{"dynamics", "/bin/sh", {"-c", "sleep 1.6; exit 1"}}, {"visual-0", "/bin/sleep", {"60"}, true}});
  ASSERT_TRUE(slow.start());
  EXPECT_TRUE(over_within(slow, 40s));
  EXPECT_EQ(slow.restarts().size(), Supervisor::kMaxRestarts);
  Supervisor well({{"dynamics", "/bin/sh", {"-c", "sleep 0.3; exit 1"}}, {"visual-0", "/bin/sleep", {"60"}, true}},
                  200ms);
  ASSERT_TRUE(well.start());
  EXPECT_FALSE(over_within(well, 4s));
  EXPECT_GT(well.restarts().size(), Supervisor::kMaxRestarts);
}

// Long to begin and soon at its end: no life is long enough to be tried for ever.
TEST(Supervisor, GivesUpOnWhatEndsAtItsFirstSignOfLife) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("phare_first_sign" + std::to_string(getpid()));
  Supervisor supervisor({{"visual-0", "/bin/sh", {"-c", "sleep 0.4; exit 1"}, true, {}, file, HungAfter{}}}, 200ms);
  ASSERT_TRUE(supervisor.start());
  EXPECT_TRUE(over_within(supervisor, 20s)) << "without a sign";
  EXPECT_EQ(supervisor.restarts().size(), Supervisor::kMaxRestarts);
  std::filesystem::remove(file);
}

// The pictures would wait for it for ever. Where they end as well, as all do that are told to, it stays away.
TEST(Supervisor, RestartsOneThatLeavesWhileThePicturesGoOn) {
  const auto file = [](const char* name) {
    return std::filesystem::path(testing::TempDir()) / (std::string("phare_") + name + std::to_string(getpid()));
  };
  for (const bool goes_on : {true, false}) {
    auto alive = AliveFile::open(file("drawing"));
    ASSERT_TRUE(alive);
    Supervisor supervisor(
        {{"dynamics", "/bin/true", {}}, {"visual-0", "/bin/sleep", {"60"}, true, {}, file("drawing"), HungAfter{}}});
    ASSERT_TRUE(supervisor.start());
    const auto until = std::chrono::steady_clock::now() + 2500ms;
    while (std::chrono::steady_clock::now() < until) {
      if (goes_on) alive->beat();
      ASSERT_TRUE(supervisor.step());
      std::this_thread::sleep_for(5ms);
    }
    ASSERT_EQ(supervisor.restarts().empty(), !goes_on);
    if (goes_on) {
      EXPECT_EQ(supervisor.restarts()[0].process, "dynamics");
      EXPECT_EQ(supervisor.restarts()[0].because, "exit 0, while the pictures go on");
    }
    supervisor.end_all(2s);
    EXPECT_EQ(supervisor.ended_badly(), "");
  }
  std::filesystem::remove(file("drawing"));
}

// Of a quit that the pictures have not heard, for they were busy, or died before they did.
TEST(Supervisor, NobodyComesBackAfterAQuit) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("phare_quit" + std::to_string(getpid()));
  auto alive = AliveFile::open(file);
  ASSERT_TRUE(alive);
  Supervisor supervisor({{"dynamics", "/bin/sh", {"-c", "sleep 0.2"}, false, {}, file, HungAfter{}},
                         {"visual-0", "/bin/sh", {"-c", "sleep 2; exit 1"}, true, {}, file, HungAfter{}}});
  ASSERT_TRUE(supervisor.start());
  alive->leaves_as_told();
  const auto until = std::chrono::steady_clock::now() + 1500ms;
  while (std::chrono::steady_clock::now() < until) {
    alive->beat();  // as the pictures do
    ASSERT_TRUE(supervisor.step());
    std::this_thread::sleep_for(5ms);
  }
  EXPECT_TRUE(over_within(supervisor, 10s));
  EXPECT_TRUE(supervisor.restarts().empty());
  EXPECT_EQ(supervisor.ended_badly(), "visual-0 ended with exit 1");
  std::filesystem::remove(file);
}

TEST(Supervisor, BadInputIsNotTriedAgain) {
  Supervisor supervisor(
      {{"cockpit", "/bin/ls", {"/no/such/file"}}, {"visual-0", "/bin/sleep", {"60"}, true}});  // ls: exit 2
  ASSERT_TRUE(supervisor.start());
  EXPECT_TRUE(over_within(supervisor, 5s));
  EXPECT_EQ(supervisor.exit_code(), kExitBadInput);
  EXPECT_TRUE(supervisor.restarts().empty());
}

TEST(Supervisor, MissingProgramIsAnError) {
  Supervisor supervisor({{"cockpit", "/bin/sleep", {"60"}}, {"visual-0", "/no/such/program", {}, true}});
  const Status status = supervisor.start();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().text(), "/no/such/program: No such file or directory");
}

TEST(ChildProcess, SaysHowItEnded) {
  auto child = ChildProcess::start("/bin/sleep", {"60"});
  ASSERT_TRUE(child);
  EXPECT_FALSE(child->ended().has_value());
  child->send_signal(SIGKILL);
  std::optional<ProcessEnd> end;
  for (int i = 0; i < 5000 && !end; ++i, std::this_thread::sleep_for(1ms)) end = child->ended();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->text(), "SIGKILL");
}

TEST(ChildProcess, EndsWhereNobodyWasToHearOfIt) {
  std::signal(SIGCHLD, SIG_IGN);
  auto child = ChildProcess::start("/bin/true", {});
  std::optional<ProcessEnd> end;
  for (int i = 0; i < 5000 && child && !end; ++i, std::this_thread::sleep_for(1ms)) end = child->ended();
  std::signal(SIGCHLD, SIG_DFL);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->exit_code, kExitCheckFailed);  // how is not known
}

TEST(Watchdog, TellsAHungProcessFromASlowOneAndFromOneThatHasJustBegun) {
  using Time = Watchdog::Clock::time_point;
  const Time begin = Watchdog::Clock::now();
  // In steps of 10 ms: when it counts as hung, s; negative: not within 100 s.
  struct Case {
    const char* what;
    double beats_until_s, computes_until_s;
    bool stopped, window;
    double hung_s;
    const char* text;
  };
  for (const Case& c :
       {Case{"all well", 1e9, 1e9, false, false, -1.0, ""}, Case{"a loop that waits", 1e9, 0.0, false, false, -1.0, ""},
        Case{"stands still", 5.0, 5.0, false, false, 8.0, "hung: no sign of life for 3.0 s"},
        Case{"stopped", 5.0, 5.0, true, false, 8.0, "stopped: no sign of life for 3.0 s"},
        Case{"a picture of 20 s", 5.0, 25.0, false, false, 28.0, "hung: no sign of life for 23.0 s"},
        Case{"an endless loop", 5.0, 1e9, false, false, 65.0, "hung, computing: no sign of life for 60.0 s"},
        Case{"never begins", -1.0, 0.0, false, false, 30.0, "hung: no sign of life for 30.0 s"},
        Case{"a covered window", 5.0, 5.0, false, true, -1.0, ""},
        Case{"a window, stopped", 5.0, 5.0, true, true, 8.0, "stopped: no sign of life for 3.0 s"}}) {
    Watchdog watchdog{HungAfter{.may_be_covered = c.window}};
    double hung_s = -1.0, computed_s = 0.0;
    std::string text;
    for (int step = 0; step < 10'000 && hung_s < 0.0; ++step) {
      const double t = step * 0.01;
      const std::optional<Time> beat =
          c.beats_until_s < 0.0
              ? std::nullopt
              : std::optional(begin +
                              std::chrono::nanoseconds(static_cast<std::int64_t>(std::min(t, c.beats_until_s) * 1e9)));
      if (t < c.computes_until_s) computed_s += 0.01;
      const auto why = watchdog.hung(begin + std::chrono::milliseconds(10 * step), beat,
                                     ProcessUse{computed_s, c.stopped && t > c.beats_until_s});
      if (why) hung_s = t, text = *why;
    }
    EXPECT_NEAR(hung_s, c.hung_s, 0.03) << c.what;
    EXPECT_EQ(text, c.text) << c.what;
  }
}

// Ctrl-Z of the whole rig and fg an hour later: nobody hung, we all slept.
TEST(Watchdog, DoesNotCountTimeInWhichItSleptItself) {
  Watchdog watchdog{HungAfter{}};
  const auto begin = Watchdog::Clock::now();
  const ProcessUse use{1.0, false};
  EXPECT_FALSE(watchdog.hung(begin, begin, use));
  EXPECT_FALSE(watchdog.hung(begin + 10ms, begin, use));
  EXPECT_FALSE(watchdog.hung(begin + 1h, begin, use));
  EXPECT_FALSE(watchdog.hung(begin + 1h + 100ms, begin, use));
}

TEST(Watchdog, ReadsWhatTheSystemSaysOfAProcess) {
  auto child = ChildProcess::start("/bin/sleep", {"60"});
  ASSERT_TRUE(child);
  ASSERT_TRUE(use_of(child->pid()));
  EXPECT_FALSE(use_of(child->pid())->stopped);
  child->send_signal(SIGSTOP);
  for (int i = 0; i < 1000 && !use_of(child->pid())->stopped; ++i) std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(use_of(child->pid())->stopped);
  child->send_signal(SIGKILL);
  while (!child->ended()) std::this_thread::sleep_for(1ms);
  EXPECT_FALSE(use_of(child->pid()));
}

TEST(Supervisor, EndsAndRestartsOneThatHangs) {
  const auto alive = std::filesystem::path(testing::TempDir()) / ("phare_alive_" + std::to_string(getpid()));
  HungAfter soon;
  soon.beginning = soon.idle = 200ms;
  Supervisor supervisor(
      {{"dynamics", "/bin/sleep", {"60"}, false, {}, alive, soon}, {"visual-0", "/bin/sleep", {"60"}, true}});
  ASSERT_TRUE(supervisor.start());
  const auto until = std::chrono::steady_clock::now() + 10s;
  while (supervisor.restarts().empty() && std::chrono::steady_clock::now() < until) {
    ASSERT_TRUE(supervisor.step());
    std::this_thread::sleep_for(5ms);
  }
  ASSERT_FALSE(supervisor.restarts().empty());
  EXPECT_EQ(supervisor.restarts()[0].process, "dynamics");
  EXPECT_TRUE(supervisor.restarts()[0].because.starts_with("hung: no sign of life for 0.2"))
      << supervisor.restarts()[0].because;
  supervisor.end_all(2s);
  std::filesystem::remove(alive);
}

// Whatever they do: stopped, deaf to SIGTERM, or both.
TEST(Supervisor, EndsAllInTheTimeOfAHurry) {
  Supervisor supervisor(
      {{"cockpit", "/bin/sleep", {"60"}},
       {"dynamics", "/bin/sh", {"-c", "trap '' TERM; while :; do sleep 1; done"}},
       {"visual-0", "/bin/sh", {"-c", "trap '' TERM; kill -STOP $$; while :; do sleep 1; done"}, true}});
  ASSERT_TRUE(supervisor.start());
  for (int i = 0; i < 20; ++i) {
    supervisor.step();
    std::this_thread::sleep_for(10ms);
  }
  const auto begin = std::chrono::steady_clock::now();
  supervisor.end_all(60s, [] { return true; });
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);  // the machine may be busy: not the 60 s of the grace
  EXPECT_EQ(supervisor.ends()[1].how, "SIGKILL");
  EXPECT_EQ(supervisor.ends()[2].how, "SIGKILL");
}

}  // namespace
}  // namespace phare
