#include "visual/process/frame_stats.h"

#include <gtest/gtest.h>

#include "visual/process/audit.h"
#include "visual/process/switch_to_photon.h"

namespace phare {
namespace {

TEST(LogHistogram, PercentilesOfKnownValues) {
  LogHistogram histogram;
  for (int i = 1000; i >= 1; --i) histogram.add(i * 0.01);  // 0.01 … 10
  EXPECT_EQ(histogram.count(), 1000u);
  EXPECT_DOUBLE_EQ(histogram.min(), 0.01);
  EXPECT_DOUBLE_EQ(histogram.max(), 10.0);
  EXPECT_NEAR(histogram.mean(), 5.005, 1e-9);
  EXPECT_NEAR(histogram.percentile(0.50), 5.0, 0.05);  // half a bin is 0.5 %
  EXPECT_NEAR(histogram.percentile(0.95), 9.5, 0.095);
  EXPECT_NEAR(histogram.percentile(0.99), 9.9, 0.099);
  EXPECT_DOUBLE_EQ(histogram.percentile(1.0), 10.0);
}

TEST(LogHistogram, EmptyZeroAndExtremes) {
  LogHistogram histogram;
  EXPECT_EQ(histogram.percentile(0.5), 0.0);
  EXPECT_EQ(histogram.max(), 0.0);
  histogram.add(0.0);
  EXPECT_EQ(histogram.percentile(0.5), 0.0);
  histogram.add(1e300);
  EXPECT_EQ(histogram.max(), 1e300);
  EXPECT_LE(histogram.percentile(1.0), 1e300);
}

TEST(FrameStats, CapturedFramesStayOutOfTheOtherFigure) {
  FrameStats stats;
  FrameResult quick, slow;
  quick.wall_ms = 4.0;
  quick.passes = {{"lamps", 3.0}};
  slow.wall_ms = 90.0;
  slow.timed_kept = true;
  for (int i = 0; i < 10; ++i) stats.add(quick, false);
  stats.add(slow, true);
  EXPECT_EQ(stats.frames, 11u);
  EXPECT_EQ(stats.captured_frames, 1u);
  EXPECT_EQ(stats.wall_ms.max(), 90.0);
  EXPECT_EQ(stats.wall_no_capture_ms.max(), 4.0);
  EXPECT_EQ(stats.pass_ms.at("lamps").count(), 10u);
}

// In a drive that keeps every frame passes are timed all the same: reading back is one of its own.
TEST(FrameStats, PassesOfKeptFramesAreTimed) {
  FrameStats stats;
  FrameResult kept;
  kept.timed_kept = true;
  kept.passes = {{.name = "shadows", .ms = 2.0, .effect = Effect::kShadows},
                 {.name = "shadow depths", .ms = 1.0, .effect = Effect::kShadows},
                 {.name = "lamps", .ms = 3.0},
                 {.name = "read back display", .ms = 9.0}};
  for (int i = 0; i < 5; ++i) stats.add(kept, true);
  EXPECT_EQ(stats.pass_ms.at("lamps").count(), 5u);
  EXPECT_EQ(stats.pass_ms.at("lamps").max(), 3.0);
  EXPECT_EQ(to_json(stats.gpu_ms), (nlohmann::json{{"count", 0}})) << "nothing is no 0.000 ms";
  EXPECT_EQ(stats.gpu_ms.count(), 0u) << "from the first stamp to the last, reading back with it";
  EXPECT_EQ(stats.effect_ms.size(), 1u);
  EXPECT_EQ(stats.effect_ms.at(Effect::kShadows).count(), 5u);
  EXPECT_EQ(stats.effect_ms.at(Effect::kShadows).max(), 3.0) << "its copy with its map";
}

TEST(FrameStats, WhatIsToldWithoutTimesKeepsThoseBefore) {
  FrameStats stats;
  FrameResult timed, on_its_way;
  timed.wall_ms = 4.0;
  timed.passes = {{"lamps", 3.0}};
  on_its_way.timed = false;
  on_its_way.draws = 7;
  stats.add(timed, false);
  stats.add(on_its_way, true);
  EXPECT_EQ(stats.frames, 2u);
  EXPECT_EQ(stats.captured_frames, 1u);
  EXPECT_EQ(stats.wall_ms.count(), 1u);
  EXPECT_EQ(stats.newest.wall_ms, 4.0);
  EXPECT_EQ(stats.newest.passes.size(), 1u);
  EXPECT_EQ(stats.newest.draws, 7u);
}

TEST(AuditStats, ShareOnlyWhereThereIsLight) {
  AuditStats audit;
  audit.add(10.01, 10.0);
  audit.add(0.002, 0.001);  // 100 % of next to nothing
  const nlohmann::json json = audit.json();
  EXPECT_EQ(json["pixels"], 2);
  EXPECT_NEAR(json["residual_lx"]["max"].get<double>(), 0.01, 1e-12);
  EXPECT_EQ(json["residual_percent"]["pixels"], 1);
  EXPECT_NEAR(json["residual_percent"]["max"].get<double>(), 0.1, 1e-9);
}

TEST(SwitchToPhoton, LockstepCountsFramesInSimulatedTime) {
  SwitchToPhoton switches;
  CockpitState controls;
  switches.frame_finished(controls, frame_time(0, 60), WallTime{0}, 60);
  controls.light_changes = 1;
  controls.light_change_sim = SimTime{10'000'000};  // between frame 0 and 1
  controls.light_change_wall = WallTime{5'000'000};
  switches.frame_finished(controls, frame_time(1, 60), WallTime{8'000'000}, 60);
  switches.frame_finished(controls, frame_time(2, 60), WallTime{9'000'000}, 60);
  controls.light_changes = 2;
  controls.light_change_sim = SimTime{40'000'000};  // between frame 2 and 3, shown in frame 4: one late
  switches.frame_finished(controls, frame_time(4, 60), WallTime{12'000'000}, 60);
  const nlohmann::json json = switches.json();
  EXPECT_EQ(json["changes"], 2);
  EXPECT_EQ(json["frames"]["1"], 1);
  EXPECT_EQ(json["frames"]["2"], 1);
  EXPECT_NEAR(json["newest"][0]["ms"].get<double>(), 3.0, 1e-9);
}

TEST(SwitchToPhoton, RealTimeCountsFramesByTheWallClock) {
  SwitchToPhoton switches;
  CockpitState controls;
  controls.light_changes = 7;  // what was before the first frame is no change
  switches.frame_finished(controls, SimTime{}, WallTime{10}, 0);
  switches.frame_finished(controls, SimTime{}, WallTime{20}, 0);
  controls.light_changes = 8;
  controls.light_change_wall = WallTime{15};  // while the second frame was drawn
  switches.frame_finished(controls, SimTime{}, WallTime{30}, 0);
  EXPECT_EQ(switches.json()["changes"], 1);
  EXPECT_EQ(switches.json()["frames"]["2"], 1);
}

TEST(FrameStats, FramesASecondAreAllFramesByAllSeconds) {
  FrameStats stats;
  EXPECT_EQ(stats.frames_per_s(), 0.0);
  std::chrono::steady_clock::time_point now{};
  for (const int after_ms : {0, 10, 10, 10, 970}) {  // the median interval alone would say 100
    now += std::chrono::milliseconds(after_ms);
    stats.add(FrameResult{}, false);
    stats.frame_ended(now);
  }
  EXPECT_DOUBLE_EQ(stats.seconds(), 1.0);
  EXPECT_DOUBLE_EQ(stats.frames_per_s(), 4.0);
}

}  // namespace
}  // namespace phare
