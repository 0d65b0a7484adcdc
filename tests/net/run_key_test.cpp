// unit: the key of a run is its user's alone, the same for all who ask, and new with every launcher.
#include "net/run_key.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "net/bus.h"
#include "net/udp.h"
#include "tests/net/sample.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

class RunKeyTest : public testing::Test {
 protected:
  RunKeyTest() {
    setenv("PHARE_RUN_DIR", folder_.c_str(), 1);
    rig_.file = "test.toml";
    rig_.channels.resize(1);
    rig_.port_base = static_cast<std::uint16_t>(24000 + getpid() % 900 * 30);
  }
  ~RunKeyTest() override {
    unsetenv("PHARE_RUN_DIR");
    fs::remove_all(folder_);
  }
  /// In a process of its own, whose locks end with it; the exit code.
  template <class Act>
  int elsewhere(Act act) {
    const pid_t child = fork();
    if (child == 0) _exit(act());
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// The key that another process gets; nullopt: it got none.
  std::optional<BusKey> key_elsewhere(RunKey how) {
    const int got = elsewhere([&] { return take_run_key(rig_, how) ? 0 : 1; });
    const auto key = read_bus_key(*run_key_file(rig_));
    return got == 0 && key ? std::optional(*key) : std::nullopt;
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("phare_run_" + std::to_string(getpid()));
  Rig rig_;
};

TEST_F(RunKeyTest, IsTheSameForAllAndNewWithEveryLauncher) {
  const auto first = key_elsewhere(RunKey::kUse);
  ASSERT_TRUE(first);
  EXPECT_EQ(key_elsewhere(RunKey::kUse), first);
  const auto second = key_elsewhere(RunKey::kMake);
  ASSERT_TRUE(second);
  EXPECT_NE(second, first);
  EXPECT_EQ(key_elsewhere(RunKey::kUse), second);
  // A recorder that waits for a rig holds the key: the launcher joins it.
  ASSERT_TRUE(take_run_key(rig_));
  EXPECT_EQ(rig_.bus_key, second);
  Rig launched = rig_;
  launched.bus_key.reset();
  EXPECT_EQ(elsewhere([&] { return take_run_key(launched, RunKey::kMake) && launched.bus_key == second ? 0 : 1; }), 0);
}

TEST_F(RunKeyTest, IsTheUsersAlone) {
  ASSERT_TRUE(key_elsewhere(RunKey::kMake));
  const fs::path file = *run_key_file(rig_);
  struct stat found {};
  ASSERT_EQ(::stat(file.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777u, 0600u);
  ASSERT_EQ(::stat(folder_.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777u, 0700u);

  fs::permissions(file, fs::perms::others_read, fs::perm_options::add);
  const Status refused = take_run_key(rig_);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().reason.find("others may read it"), std::string::npos) << refused.error().text();
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  fs::permissions(folder_, fs::perms::others_exec, fs::perm_options::add);
  EXPECT_FALSE(take_run_key(rig_));
  fs::permissions(folder_, fs::perms::owner_all);
  fs::remove(file);
  fs::create_symlink("/dev/null", file);
  EXPECT_FALSE(take_run_key(rig_));
}

TEST_F(RunKeyTest, IsNotTakenWhereTheRigHasAnotherOrGoesWithout) {
  rig_.run_key = false;
  ASSERT_TRUE(take_run_key(rig_));
  EXPECT_FALSE(rig_.bus_key);
  rig_.run_key = true;
  rig_.bus_key.emplace().fill(7);
  const BusKey own = *rig_.bus_key;
  ASSERT_TRUE(take_run_key(rig_));
  EXPECT_EQ(*rig_.bus_key, own);
  EXPECT_FALSE(fs::exists(folder_));
}

// On loopback too: a datagram that is right in all but the key moves nothing, and is counted.
TEST_F(RunKeyTest, KeepsStrangersOffLoopback) {
  ASSERT_TRUE(take_run_key(rig_));
  auto visual = Bus::open(rig_, Role::kVisual), cockpit = Bus::open(rig_, Role::kCockpit);
  Rig without = rig_;
  without.bus_key.reset();
  auto stranger = Bus::open_to_send(without, Role::kCockpit);
  ASSERT_TRUE(visual && cockpit && stranger);
  CockpitState high;
  high.light_switch = LightSwitch::kHigh;
  for (int i = 0; i < 10; ++i) stranger->send({}, high);
  visual->poll();
  EXPECT_EQ(visual->newest<CockpitState>(), nullptr);
  EXPECT_EQ(visual->counters().refused, 10u);
  cockpit->send({}, CockpitState{});
  visual->poll();
  EXPECT_NE(visual->newest<CockpitState>(), nullptr);
}

TEST_F(RunKeyTest, AKeyFileThatIsNoSecretIsRefused) {
  fs::create_directories(folder_);
  const fs::path file = folder_ / "bus.key";
  std::ofstream(file) << std::string(64, 'a') << '\n';
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_TRUE(read_bus_key(file));
  fs::permissions(file, fs::perms::others_read, fs::perm_options::add);
  const auto open = read_bus_key(file);
  ASSERT_FALSE(open);
  EXPECT_NE(open.error().reason.find("chmod 600"), std::string::npos);
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  std::ofstream(file) << std::string(64, '0') << '\n';
  const auto zero = read_bus_key(file);
  ASSERT_FALSE(zero);
  EXPECT_NE(zero.error().reason.find("all zero"), std::string::npos);
}

}  // namespace
}  // namespace phare
