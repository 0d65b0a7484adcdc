// unit: what a killed process wrote is there, and half a state is none.
#include "net/state_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>

namespace phare {
namespace {

struct Numbers {
  std::array<std::uint64_t, 200> numbers{};
};

Numbers of(std::int64_t key) {
  Numbers state;
  state.numbers.fill(static_cast<std::uint64_t>(key));
  return state;
}

class StateFileTest : public testing::Test {
 protected:
  ~StateFileTest() override { std::filesystem::remove(file_); }
  StateFile open() const {
    auto opened = StateFile::open(file_, sizeof(Numbers));
    EXPECT_TRUE(opened) << opened.error().text();
    return std::move(*opened);
  }
  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) / ("phare_state_" + std::to_string(::getpid()));
};

TEST_F(StateFileTest, HoldsTheTwoNewestStates) {
  StateFile file = open();
  EXPECT_FALSE(file.newest());
  for (std::int64_t key = 0; key < 7; ++key) file.save(key, of(key));
  StateFile again = open();
  ASSERT_TRUE(again.newest());
  EXPECT_EQ(again.newest()->key, 6);
  EXPECT_EQ(state_of<Numbers>(*again.newest()).numbers, of(6).numbers);
  ASSERT_TRUE(again.at(5));
  EXPECT_EQ(state_of<Numbers>(*again.at(5)).numbers, of(5).numbers);
  EXPECT_FALSE(again.at(4));
  struct stat found {};
  ASSERT_EQ(::stat(file_.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0077u, 0u);
}

TEST_F(StateFileTest, OfAnotherSizeIsNone) {
  std::ofstream(file_) << "another program's";
  EXPECT_FALSE(open().newest());
}

TEST_F(StateFileTest, AByteThatIsNotAsWrittenMakesItNone) {
  open().save(0, of(1));
  {
    std::fstream stream(file_, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(700);
    stream.put('x');
  }
  EXPECT_FALSE(open().newest());
}

// Killed two hundred times while it writes as fast as it can: one of the two slots is always whole, and of one state.
TEST_F(StateFileTest, AKillLeavesAWholeState) {
  {
    StateFile file = open();
    file.save(0, of(0));
  }
  std::int64_t before = 0;
  for (int kill_count = 0; kill_count < 200; ++kill_count) {
    int begun[2];
    ASSERT_EQ(pipe(begun), 0);
    const pid_t child = fork();
    if (child == 0) {
      auto file = StateFile::open(file_, sizeof(Numbers));
      if (!file || !file->newest()) _exit(1);
      for (std::int64_t key = file->newest()->key + 1;; ++key) {
        file->save(key, of(key));
        if (key % 64 == 0) [[maybe_unused]]
          const ssize_t told = write(begun[1], "x", 1);
      }
    }
    char told = 0;
    ASSERT_EQ(read(begun[0], &told, 1), 1);
    usleep(static_cast<useconds_t>(kill_count * 7 % 300));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(begun[0]), close(begun[1]);
    const StateFile file = open();
    const auto newest = file.newest();
    ASSERT_TRUE(newest);
    ASSERT_GT(newest->key, before);
    ASSERT_EQ(state_of<Numbers>(*newest).numbers, of(newest->key).numbers);
    before = newest->key;
  }
}

}  // namespace
}  // namespace phare
