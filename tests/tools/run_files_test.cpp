// process: folders of drives, of which the last launcher was killed.
#include "tools/run_files.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tools/temporary_folder.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

TEST(RunFiles, OfAKilledLauncherGoOthersStay) {
  const TemporaryFolder place;
  ASSERT_EQ(setenv("PHARE_RUN_DIR", place.path().c_str(), 1), 0);
  auto runs = RunFiles::make(Rig{});
  unsetenv("PHARE_RUN_DIR");
  ASSERT_TRUE(runs) << runs.error().text();
  const fs::path killed = place.path() / "drive-47000-aaaaaa", key = place.path() / "127.0.0.1-47000.key",
                 other = place.path() / "other";
  fs::create_directory(killed);
  fs::create_directory(other);
  std::ofstream(killed / "cockpit.state") << "1";
  std::ofstream(key) << "1";
  const auto all_there = [&] { return fs::exists(runs->folder()) && fs::exists(key) && fs::exists(other); };

  RunFiles::remove_left_behind(place.path(), std::chrono::minutes(1));
  EXPECT_TRUE(fs::exists(killed)) << "new: its launcher may be about to hold it";
  RunFiles::remove_left_behind(place.path(), std::chrono::seconds(0));
  EXPECT_FALSE(fs::exists(killed));
  EXPECT_TRUE(all_there());
  const RunFiles moved(std::move(*runs));
  RunFiles::remove_left_behind(place.path(), std::chrono::seconds(0));
  EXPECT_TRUE(fs::exists(moved.folder()));
}

}  // namespace
}  // namespace phare
