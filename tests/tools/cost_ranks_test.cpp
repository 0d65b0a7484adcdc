// unit: two runs of phare cost that rank levels alike, and two that do not.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "tools/cost/ladder.h"
#include "tools/cost/ranks.h"

namespace phare::cost {
namespace {

using nlohmann::json;

Level level(const std::string& name, double error, double time, std::optional<double> within = {}) {
  return {.name = name,
          .error = {.rms = error, .max = 2.0 * error},
          .time = {.median = time, .within = within, .samples = 9}};
}
json run_of(std::vector<Level> levels) {
  const Ladder ladder{.name = "fog", .what = "", .reference = "", .error_unit = "%", .time_unit = "ms", .levels = levels};
  return {{"size", "64x36"}, {"ladders", {json_of(ladder)}}};
}

TEST(CostRanks, LevelsThatAreNotToldApartAreNotRanked) {
  const json a = run_of({level("coarse", 3.0, 10.0, 0.3), level("medium", 1.0, 10.2, 0.3), level("fine", 0.2, 14, 0.3)});
  const json b = run_of({level("coarse", 3.0, 10.1, 0.3), level("medium", 1.0, 9.9, 0.3), level("fine", 0.2, 13, 0.3)});
  const auto ranks = compare_ranks(a, b);
  ASSERT_TRUE(ranks.ok());
  ASSERT_EQ(ranks->size(), 1u);
  EXPECT_TRUE(ranks->front().alike());
  EXPECT_EQ(ranks->front().pairs, 3u);
  EXPECT_EQ(ranks->front().told_apart, 2u);
}

TEST(CostRanks, OppositeOnesAreNamed) {
  const json a = run_of({level("coarse", 3.0, 10.0, 0.1), level("medium", 1.0, 10.3, 0.1)});
  const json b = run_of({level("coarse", 0.5, 10.4, 0.1), level("medium", 1.0, 10.0, 0.1)});
  const auto ranks = compare_ranks(a, b);
  ASSERT_TRUE(ranks.ok());
  EXPECT_FALSE(ranks->front().alike());
  EXPECT_EQ(ranks->front().opposites, (std::vector<std::string>{"coarse, medium: error", "coarse, medium: time"}));
}

TEST(CostRanks, AFileOfSomethingElseIsRefusedAndOtherRunsAreTold) {
  EXPECT_FALSE(compare_ranks(run_of({}), json{{"a", 1}}).ok());
  EXPECT_FALSE(compare_ranks(run_of({}), json::array()).ok());
  json other = run_of({});
  other["size"] = "128x72";
  EXPECT_EQ(unlike(run_of({}), other), std::vector<std::string>{"size 64x36, before 128x72"});
  EXPECT_TRUE(unlike(run_of({}), run_of({})).empty());
}

// 95 % of such intervals hold the median they are about: 1,000 samples of a known one, within four standard errors.
TEST(CostRanks, TheIntervalOfAMedianHoldsIt) {
  std::mt19937_64 random(7);
  std::exponential_distribution<double> times(std::log(2.0));  // median 1
  int held = 0;
  constexpr int kRuns = 1000;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<double> taken(25);
    for (double& one : taken) one = times(random);
    const Times found = times_of(taken);
    ASSERT_TRUE(found.within);
    if (std::abs(found.median - 1.0) <= *found.within) ++held;
  }
  EXPECT_GE(held, static_cast<int>(kRuns * 0.95 - 4.0 * std::sqrt(kRuns * 0.95 * 0.05)));
  EXPECT_FALSE(times_of({1.0, 2.0, 3.0}).within) << "of so few none is known";
}

}  // namespace
}  // namespace phare::cost
