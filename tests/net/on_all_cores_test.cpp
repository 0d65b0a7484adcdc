// A loop on all processors: each turn once, whoever does it, and no turn lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "config/base/on_all_cores.h"

namespace phare {
namespace {

TEST(OnAllCores, EachTurnOnceHoweverManyThereAre) {
  for (const std::size_t count : {0u, 1u, 2u, 3u, 7u, 1000u}) {
    for (int again = 0; again < 200; ++again) {
      std::vector<int> done(count);
      on_all_cores(count, [&](std::size_t i) { ++done[i]; });
      ASSERT_EQ(std::ranges::count(done, 1), static_cast<std::ptrdiff_t>(count));
    }
  }
}

TEST(OnAllCores, LoopsWithinLoopsAndBesideOthersEnd) {
  std::atomic<int> turns = 0;
  const auto nest = [&] {
    for (int again = 0; again < 50; ++again)
      on_all_cores(5, [&](std::size_t) { on_all_cores(4, [&](std::size_t) { ++turns; }); });
  };
  std::vector<std::thread> beside;
  for (int i = 0; i < 3; ++i) beside.emplace_back(nest);
  nest();
  for (std::thread& thread : beside) thread.join();
  EXPECT_EQ(turns, 4 * 50 * 5 * 4);
}

TEST(OnAllCores, WhatATurnThrowsArrives) {
  for (std::size_t thrower = 0; thrower < 6; ++thrower) {
    for (int again = 0; again < 50; ++again) {
      try {
        on_all_cores(6, [&](std::size_t i) {
          if (i == thrower) throw std::runtime_error(std::to_string(i));
        });
        ADD_FAILURE() << thrower;
      } catch (const std::runtime_error& thrown) {
        EXPECT_EQ(thrown.what(), std::to_string(thrower));
      }
    }
  }
  std::atomic<int> turns = 0;
  on_all_cores(6, [&](std::size_t) { ++turns; });
  EXPECT_EQ(turns, 6) << "they go on after that";
}

// Two turns that wait for each other end only if two threads do them.
TEST(OnAllCores, TurnsAreDoneAtOnceWhereThereAreProcessors) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  std::atomic<int> there = 0;
  on_all_cores(2, [&](std::size_t) {
    ++there;
    while (there < 2) std::this_thread::yield();
  });
  EXPECT_EQ(there, 2);
}

}  // namespace
}  // namespace phare
