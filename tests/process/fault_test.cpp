// process: a rig that is killed, stopped and both: no picture shows a beam that neither the stalk nor the fail-safe
// asked for, and no drive is lost. A slice of phare-fault-sweep, with its seed.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/process/drive_run.h"
#include "tests/process/faults.h"

namespace phare::test {
namespace {

class Faults : public testing::TestWithParam<FaultSetup> {};

TEST_P(Faults, NoPictureShowsAWrongBeamAndNoDriveIsLost) {
  const TemporaryFolder folder;
  const FaultResult result = drive_with_faults(GetParam(), folder.path());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_GT(result.pictures, 50u);
  EXPECT_GT(result.kills + result.stops, 0);
  EXPECT_EQ(result.wrong, 0u) << (result.wrong_ones.empty() ? "" : result.wrong_ones.front());
  EXPECT_EQ(result.time_back, 0u);
  EXPECT_GE(result.restarts_reported, result.kills);
  EXPECT_GT(result.driven_s, result.log_s - 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    Slice, Faults,
    testing::Values(
        FaultSetup{.kind = FaultSetup::Kind::kKill, .faults = 3, .seed = 11},
        FaultSetup{
            .kind = FaultSetup::Kind::kStop, .faults = 3, .seed = 12, .longest_stop = std::chrono::milliseconds(1500)},
        FaultSetup{
            .kind = FaultSetup::Kind::kBoth, .faults = 2, .seed = 13, .longest_stop = std::chrono::milliseconds(1500)},
        FaultSetup{.kind = FaultSetup::Kind::kKill, .lockstep = true, .faults = 3, .seed = 14}));

// Best practices are warned of in any drive: one that draws on is told of once, and not started again.
TEST(Validation, FailsTheDriveOnce) {
  const TemporaryFolder folder;
  setenv("VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT", 1);
  const int exit_code = drive(folder / "out", folder.path(), {"--frames", "2", "--validation"});
  unsetenv("VK_LAYER_ENABLES");
  EXPECT_EQ(exit_code, kExitCheckFailed);
  const nlohmann::json report = report_of(folder / "out");
  EXPECT_TRUE(report["restarts"].empty());
  EXPECT_NE(report["why"].get<std::string>().find("Vulkan validation messages in visual-0"), std::string::npos);
}

}  // namespace
}  // namespace phare::test
