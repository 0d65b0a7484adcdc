// process: what is picked for a budget and a tolerance is what is drawn, told and kept; and the governor steps down
// while the budget is missed. The table of the machine is measured once, for all tests; what they hang on is written
// into it.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <thread>

#include "tests/paths.h"
#include "tests/process/drive_run.h"

namespace phare::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json json_of(const fs::path& file) {
  std::ifstream stream(file);
  return json::parse(stream, nullptr, false);
}

/// A cache folder of its own, with the table of the picture that DriveRun draws.
class Budget : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    setenv("XDG_CACHE_HOME", (*folder_ / "cache").c_str(), 1);
    // Half of the light is a tolerance that any machine holds.
    first_exit_ = drive(*folder_ / "first", folder_->path(), {"--frames", "2", "--tolerance", "50%"});
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(*folder_ / "cache" / "phare", none)) table_ = entry.path();
  }
  static void TearDownTestSuite() {
    unsetenv("XDG_CACHE_HOME");
    folder_.reset();
  }
  void SetUp() override {
    ASSERT_EQ(first_exit_, 0);
    ASSERT_FALSE(table_.empty()) << "nothing was kept";
  }

  /// Times and errors of a machine that is faster than any: levels fall in time as they rise in error.
  static void write_table() {
    json table = json_of(table_);
    const auto set = [](json& row, double ms, double misplaced) {
      row["median_ms"] = row["p95_ms"] = ms;
      row["misplaced"] = misplaced;
      if (row.contains("p99")) row["p99"] = misplaced;
    };
    for (json& row : table["light"])
      set(row, 0.01, row["method"] == "fragment" && row["beam_image"] == "float32-native-nodes" ? 1e-6 : 0.9);
    const double ms[] = {0.0, 0.01, 0.02, 0.03}, misplaced[] = {0.1, 0.03, 0.02, 0.01};
    for (std::size_t level = 0; level < 4; ++level) set(table["shadows"][level], ms[level], misplaced[level]);
    std::ofstream(table_) << table.dump(2);
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static fs::path table_;
  static int first_exit_;
};
std::unique_ptr<TemporaryFolder> Budget::folder_;
fs::path Budget::table_;
int Budget::first_exit_ = -1;

TEST_F(Budget, WhatIsPickedIsDrawnAndTold) {
  write_table();
  ASSERT_EQ(drive(*folder_ / "tolerance", folder_->path(), {"--frames", "2", "--tolerance", "2.5%"}), 0);
  const json tolerance = report_of(*folder_ / "tolerance");
  EXPECT_EQ(tolerance["summary"]["picked"]["level"], "fragment, shadows soft");
  EXPECT_FALSE(tolerance["summary"]["picked"].contains("governor"));
  EXPECT_EQ(tolerance["processes"]["visual-0"]["beams"]["image"], "float32-native-nodes");
  for (const json& effect : tolerance["processes"]["visual-0"]["effects"])
    if (effect["name"] == "shadows" && effect["level"] != "off") {
      EXPECT_EQ(effect["level"], "soft");
    }
  // Lockstep: what is picked for a budget stays.
  ASSERT_EQ(drive(*folder_ / "lockstep", folder_->path(), {"--frames", "2", "--budget-ms", "9000"}), 0);
  const json lockstep = report_of(*folder_ / "lockstep");
  EXPECT_EQ(lockstep["summary"]["picked"]["level"], "fragment, shadows fine");
  EXPECT_FALSE(lockstep["summary"]["picked"].contains("governor"));
  // No setting of this table holds half a per cent: it does not begin, and nothing is written.
  EXPECT_EQ(drive(*folder_ / "none", folder_->path(), {"--frames", "2", "--tolerance", "0.5%"}), 2);
  EXPECT_FALSE(fs::exists(*folder_ / "none"));
}

// No machine draws a frame in a tenth of a millisecond, whatever the table says: step by step down to the cheapest.
TEST_F(Budget, TheGovernorStepsDownWhileTheBudgetIsMissed) {
  write_table();
  const fs::path out = *folder_ / "governed";
  DriveRun run(out, folder_->path(), {"--budget-ms", "0.1"}, false);
  const auto until = std::chrono::steady_clock::now() + kPatience;
  const auto steps = [&] {
    const json report = json_of(out / "visual-0.json");
    return report.is_object() && report.contains("picked") ? report["picked"]["governor"]["steps"].size() : 0u;
  };
  while (run.running() && steps() < 3 && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  run.end(SIGINT);
  const json governor = report_of(out)["summary"]["picked"]["governor"];
  ASSERT_EQ(governor["steps"].size(), 3u) << governor.dump();
  const char* const levels[] = {"fragment, shadows fine", "fragment, shadows soft", "fragment, shadows hard",
                                "fragment, shadows off"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(governor["steps"][i]["from"], levels[i]);
    EXPECT_EQ(governor["steps"][i]["to"], levels[i + 1]);
    EXPECT_GT(governor["steps"][i]["p95_ms"].get<double>(), 0.1);
  }
  EXPECT_EQ(governor["now"], levels[3]);
}

// A frame whose picture is kept counts as any other: it takes its time too.
TEST_F(Budget, FramesWhosePictureIsKeptCount) {
  write_table();
  const fs::path out = *folder_ / "kept";
  DriveRun run(out, folder_->path(), {"--budget-ms", "0.1", "--frames", "120"}, false);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_GE(report_of(out)["summary"]["picked"]["governor"]["steps"].size(), 1u) << "80 frames miss it";
}

}  // namespace
}  // namespace phare::test
