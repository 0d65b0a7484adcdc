#include "visual/process/stall.h"

#include <gtest/gtest.h>

namespace phare {
namespace {

using namespace std::chrono_literals;

TEST(Stall, IsSaidAfterTenSecondsAndThenAsItDoubles) {
  const Stall::Clock::time_point begin{};
  Stall stall(begin);
  EXPECT_FALSE(stall.told_at(begin + 9s));
  EXPECT_EQ(stall.told_at(begin + 10s), 10s);
  EXPECT_FALSE(stall.told_at(begin + 11s)) << "once";
  EXPECT_EQ(stall.told_at(begin + 21s), 20s);
  EXPECT_EQ(stall.told_at(begin + 45s), 40s);
}

TEST(Stall, NamesWhoseNextFrameIsMissing) {
  CockpitState controls;
  VehicleState car;
  EXPECT_EQ(silent_ones(nullptr, nullptr, -1, true), "cockpit and dynamics");
  EXPECT_EQ(silent_ones(&controls, nullptr, -1, false), "dynamics");
  controls.frame_index = 0;
  EXPECT_EQ(silent_ones(&controls, &car, -1, true), "dynamics") << "it has spoken, and waits for the controls";
  EXPECT_EQ(silent_ones(&controls, &car, -1, false), "") << "in real time nothing is counted";
  car.frame_index = 0;
  EXPECT_EQ(silent_ones(&controls, &car, -1, true), "");
}

}  // namespace
}  // namespace phare
