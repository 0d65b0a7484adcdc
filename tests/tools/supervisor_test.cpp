// process: starting, restarting, giving up and ending, on small programs every Debian has (coreutils).
#include "tools/supervisor.h"

#include <gtest/gtest.h>
#include <signal.h>

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

}  // namespace
}  // namespace phare
