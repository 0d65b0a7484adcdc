// unit: the hard cases hold, by any of a few seeds, and one that is broken is told from one that holds.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "tests/paths.h"
#include "tools/hard_cases/lamps.h"
#ifdef PHARE_WITH_GRAPHICS
#include "visual/renderer.h"
#endif

namespace phare::hard {
namespace {

HardCase with_bounds(std::optional<double> device, std::optional<double> float64) {
  HardCase hard;
  hard.device_bound = device;
  hard.float64_bound = float64;
  return hard;
}

Outcome found(std::vector<Found> device, std::vector<Found> float64) {
  Outcome outcome;
  outcome.device = std::move(device);
  outcome.float64 = std::move(float64);
  return outcome;
}

TEST(HardCases, OneNumberOverTheBoundMisses) {
  EXPECT_EQ(standing(with_bounds(1e-5, 1e-9), found({{0, 9e-6}}, {{0, 1e-10}, {1, 0}})), Standing::kHeld);
  EXPECT_EQ(standing(with_bounds(1e-5, 1e-9), found({{0, 1.1e-5}}, {{0, 1e-10}})), Standing::kMissed);
  EXPECT_EQ(standing(with_bounds(1e-5, 1e-9), found({{0, 0}}, {{0, 1e-10}, {1, 2e-9}})), Standing::kMissed);
}

TEST(HardCases, NaNMisses) {
  EXPECT_EQ(standing(with_bounds({}, 1.0), found({}, {{0, 0.0}, {1, std::nan("")}, {2, 0.0}})), Standing::kMissed);
}

TEST(HardCases, WhatFoundNothingHasNotHeld) {
  EXPECT_EQ(standing(with_bounds(1e-5, 1e-9), found({}, {})), Standing::kNotRun);
  EXPECT_EQ(standing(with_bounds(1e-5, {}), found({}, {{0, 0}})), Standing::kMissed);
  EXPECT_EQ(standing(with_bounds(1e-5, 1e-9), found({}, {{0, 0}})), Standing::kHeld) << "no device: float64 alone";
}

TEST(HardCases, AWrongLawOfDistanceWouldBeSeen) {
  // The light of 1/r instead of 1/r² at the places of a case: what the comparison is for.
  const IntensityTable table = even_lamp(100.0);
  const std::vector<Point> points{{{3.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}}};
  const std::vector<double> wrong{100.0 / 3.0}, along{3.0};
  EXPECT_GT(*worst(against({}, {.table = &table}, points, wrong, along).float64), 0.5);
}

TEST(HardCases, TheDocumentIsTheTable) {
#ifdef PHARE_WITH_GRAPHICS
  std::vector<HardCase> cases = light_cases();
  for (std::vector<HardCase> more :
       {property_cases(), picture_cases(), whole_drive_cases(), vehicle_cases(), vehicle_limit_cases(), bus_cases()})
    cases.insert(cases.end(), more.begin(), more.end());
  std::ifstream file(source_dir() + "/docs/hard-cases.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, markdown(cases)) << "phare hard-cases --markdown > docs/hard-cases.md";
#else
  GTEST_SKIP() << "built without graphics: the list is shorter";
#endif
}

class EveryHardCase : public testing::TestWithParam<std::uint64_t> {};

TEST_P(EveryHardCase, Holds) {
  Bench bench{.renderer = nullptr, .seed = GetParam()};
  std::vector<HardCase> cases = property_cases();
  const auto add = [&](const std::vector<HardCase>& more) { cases.insert(cases.end(), more.begin(), more.end()); };
  add(bus_cases());
  if (GetParam() == 1) add(light_cases()), add(vehicle_cases()), add(vehicle_limit_cases());
#ifdef PHARE_WITH_GRAPHICS
  Result<Renderer> renderer = Renderer::create({.width_px = 64, .height_px = 64, .validation = true});
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  bench.renderer = &*renderer;
  if (GetParam() == 1) add(picture_cases()), add(whole_drive_cases());
#endif
  for (const HardCase& hard : cases) {
    const Outcome outcome = hard.run(bench);
    if (!outcome.not_run.empty()) {
      std::printf("%s not run: %s\n", hard.name.c_str(), outcome.not_run.c_str());
      continue;
    }
    EXPECT_TRUE(standing(hard, outcome) == Standing::kHeld)
        << hard.name << ": device " << worst(outcome.device).value_or(-1.0) << ", float64 "
        << worst(outcome.float64).value_or(-1.0) << " " << outcome.error << "; again: phare hard-cases " << hard.name
        << " --seed " << GetParam();
  }
#ifdef PHARE_WITH_GRAPHICS
  EXPECT_EQ(renderer->validation_messages(), 0u);
#endif
}

INSTANTIATE_TEST_SUITE_P(Seeds, EveryHardCase, testing::Values(1u, 4u, 9u, 20261123u));

}  // namespace
}  // namespace phare::hard
