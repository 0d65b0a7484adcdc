// unit: what is picked for a budget and for a tolerance, from a table of known figures; when a table counts; that one
// from a file is whole or refused.
#include "tools/cost/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tools/cost/measure_settings.h"

namespace phare::cost {
namespace {

/// Exact light in 20 ms, by vertex in 10; shadows add 0, 4, 6, 20 ms.
SettingsTable a_table() {
  SettingsTable table{.validity = {"a device, driver 1", "1.0, commit abc", "sha256:12", "1280x720"},
                      .measured_at = "2026-01-01T00:00:00Z",
                      .rounds = 12};
  table.light = {{Method::kFragment, ImageLevel::kFloatNodes, {1e-6, 2e-6, 19.0, 20.0}},
                 {Method::kFragment, ImageLevel::kNormalised8, {0.03, 0.3, 18.0, 21.0}},
                 {Method::kFragment, ImageLevel::kHalfNodes, {1e-4, 4e-4, 19.5, 20.5}},
                 {Method::kVertex, ImageLevel::kFloatNodes, {0.2, 0.9, 9.0, 10.0}}};
  table.shadows = {{0.05, {}, 19.0, 20.0}, {0.008, {}, 22.5, 24.0}, {0.006, {}, 24.0, 26.0}, {0.004, {}, 38.0, 40.0}};
  return table;
}

Setting picked(const Pick& pick) {
  EXPECT_TRUE(pick.holds) << pick.why;
  return pick.setting;
}

TEST(Settings, OfABudgetTheMostAccurateThatFits) {
  const std::vector<Setting> all = all_settings(a_table());
  EXPECT_EQ(all.size(), 16u);
  EXPECT_EQ(picked(pick_for_budget(all, 100.0)).text(), "fragment, float32-native-nodes, shadows fine");
  EXPECT_EQ(picked(pick_for_budget(all, 39.9)).text(), "fragment, float32-native-nodes, shadows soft");
  EXPECT_EQ(picked(pick_for_budget(all, 24.0)).text(), "fragment, float32-native-nodes, shadows hard");
  EXPECT_EQ(picked(pick_for_budget(all, 23.9)).text(), "fragment, float32-native-nodes, shadows off");
  const Setting vertex = picked(pick_for_budget(all, 16.6));
  EXPECT_EQ(vertex.method, Method::kVertex);
  EXPECT_EQ(vertex.shadows, 2u) << "10 + 6 ms";
  // Every pick fits, and nothing that fits is more accurate.
  for (double budget_ms = 10.0; budget_ms < 60.0; budget_ms += 0.7) {
    const Pick pick = pick_for_budget(all, budget_ms);
    EXPECT_LE(pick.setting.p95_ms, budget_ms);
    for (const Setting& other : all)
      EXPECT_TRUE(other.p95_ms > budget_ms || other.misplaced >= pick.setting.misplaced) << budget_ms;
  }
}

TEST(Settings, OfABudgetThatNoneFitsTheCheapest) {
  const Pick none = pick_for_budget(all_settings(a_table()), 5.0);
  EXPECT_FALSE(none.holds);
  EXPECT_EQ(none.setting.p95_ms, 10.0);
  EXPECT_NE(none.why.find("none fits 5 ms"), std::string::npos) << none.why;
}

TEST(Settings, OfAToleranceTheCheapestThatHolds) {
  const std::vector<Setting> all = all_settings(a_table());
  EXPECT_EQ(picked(pick_for_tolerance(all, 0.01)).text(), "fragment, float32-native-nodes, shadows hard");
  EXPECT_EQ(picked(pick_for_tolerance(all, 0.006)).text(), "fragment, float32-native-nodes, shadows soft");
  // None is no approximation of shadows, unless the user wants none.
  EXPECT_EQ(picked(pick_for_tolerance(all, 0.05)).text(), "fragment, float32-native-nodes, shadows hard");
  EXPECT_EQ(picked(pick_for_tolerance(all_settings(a_table(), {.shadows = 0}), 0.05)).text(),
            "fragment, float32-native-nodes, shadows off");
  EXPECT_EQ(picked(pick_for_tolerance(all, 1.0)).text(), "vertex, float32-native-nodes, shadows hard");
  // What is off by hand is no approximation either: it takes nothing of the tolerance.
  EXPECT_EQ(picked(pick_for_tolerance(all_settings(a_table(), {.shadows = 0}), 1e-5)).text(),
            "fragment, float32-native-nodes, shadows off");
  const Pick none = pick_for_tolerance(all, 0.001);
  EXPECT_FALSE(none.holds);
  EXPECT_NE(none.why.find("the best is fragment, float32-native-nodes, shadows fine: 0.4 %"), std::string::npos)
      << none.why;
}

TEST(Settings, WhatTheUserHasSetIsNotPicked) {
  const std::vector<Setting> all = all_settings(a_table(), {.image = ImageLevel::kHalfNodes, .shadows = 3});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all.front().text(), "fragment, half-float-native-nodes, shadows fine");
  EXPECT_TRUE(all_settings(a_table(), {.method = Method::kVertex, .image = ImageLevel::kHalfNodes}).empty());
}

TEST(Settings, FogCountsWhereThereIsSome) {
  SettingsTable table = a_table();
  table.fog = {{0.5, {}, 20.0, 21.0}, {0.1, {}, 22.0, 23.0}, {0.02, {}, 25.0, 27.0}, {0.001, {}, 90.0, 95.0}};
  const std::vector<Setting> all = all_settings(table);
  EXPECT_EQ(all.size(), 64u);
  EXPECT_EQ(picked(pick_for_tolerance(all, 0.03)).text(), "fragment, float32-native-nodes, shadows hard, fog medium");
  EXPECT_EQ(picked(pick_for_tolerance(all_settings(table, {.fog = 0}), 0.01)).text(),
            "fragment, float32-native-nodes, shadows hard, fog off");
  EXPECT_NEAR(pick_for_tolerance(all, 0.03).setting.p95_ms, 20.0 + 4.0 + 6.0, 1e-12);
}

// What a running picture steps along: accuracy and time both fall, and the picked one is among them.
TEST(Settings, StepsFallInAccuracyAndTime) {
  const std::vector<Setting> all = all_settings(a_table());
  for (const Setting& begin : all) {
    const std::vector<Setting> steps = steps_about(all, begin);
    bool there = false;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(steps[i].image, begin.image);
      there = there || steps[i].text() == begin.text();
      if (i == 0) continue;
      EXPECT_GE(steps[i].misplaced, steps[i - 1].misplaced) << begin.text();
      EXPECT_LT(steps[i].p95_ms, steps[i - 1].p95_ms) << begin.text();
    }
    EXPECT_TRUE(there) << begin.text();
  }
}

TEST(Settings, ATableCountsForTheVerySameOnly) {
  const Validity valid = a_table().validity;
  EXPECT_EQ(why_not_valid(valid, valid), "");
  Validity other = valid;
  other.device = "a device, driver 2";
  EXPECT_NE(why_not_valid(valid, other).find("driver 2"), std::string::npos);
  other = valid;
  other.version = "1.0, commit abd";
  EXPECT_NE(why_not_valid(valid, other).find("abd"), std::string::npos);
  other = valid;
  other.rig = "sha256:13";
  EXPECT_NE(why_not_valid(valid, other), "");
  other = valid;
  other.picture = "640x360";
  EXPECT_NE(why_not_valid(valid, other), "");
}

TEST(Settings, ATableComesBackAsWrittenOrIsRefused) {
  const nlohmann::json good = json_of(a_table());
  const auto back = table_of_json(good);
  ASSERT_TRUE(back.ok()) << (back.ok() ? "" : back.error().text());
  EXPECT_EQ(*back, a_table());
  const auto refused = [&](auto&& spoil) {
    nlohmann::json bad = good;
    spoil(bad);
    return !table_of_json(bad).ok();
  };
  EXPECT_TRUE(refused([](nlohmann::json& j) { j = nlohmann::json::array(); }));
  EXPECT_TRUE(refused([](nlohmann::json& j) { j.erase("light"); }));
  EXPECT_TRUE(refused([](nlohmann::json& j) { j["light"].clear(); }));
  EXPECT_TRUE(refused([](nlohmann::json& j) { j["shadows"].erase(0); }));
  EXPECT_TRUE(refused([](nlohmann::json& j) { j["light"][0]["method"] = "by hand"; }));
  EXPECT_TRUE(refused([](nlohmann::json& j) { j["light"][0]["p95_ms"] = "fast"; }));
  EXPECT_TRUE(refused([](nlohmann::json& j) { j["light"][0]["p95_ms"] = -1.0; }));
  EXPECT_TRUE(refused([](nlohmann::json& j) { j["shadows"][1]["misplaced"] = nullptr; }));
}

// A quick table does not take the place of a longer one that counts; a longer one, or one of another device, does.
TEST(Settings, ALongerTableThatCountsStays) {
  const auto cache = std::filesystem::path(testing::TempDir()) / "settings_test_cache";
  std::filesystem::remove_all(cache);
  setenv("XDG_CACHE_HOME", cache.c_str(), 1);
  SettingsTable quick = a_table(), longer = a_table();
  longer.rounds = 60, longer.measured_at = "2026-01-02T00:00:00Z";
  EXPECT_FALSE(keep_settings(quick)->stays);
  EXPECT_FALSE(keep_settings(longer)->stays);
  EXPECT_TRUE(keep_settings(quick)->stays);
  EXPECT_EQ(kept_settings(quick.validity).table, longer);
  quick.validity.device = "a device, driver 2";
  EXPECT_FALSE(keep_settings(quick)->stays);
  EXPECT_EQ(kept_settings(quick.validity).table, quick);
  unsetenv("XDG_CACHE_HOME");
}

// All files of a scene count: the buffers that a .gltf names, and the lane beside it.
TEST(Settings, ASceneIsAllItsFiles) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "settings_test_scene";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const char* text) { std::ofstream(folder / name) << text; };
  write("road.gltf", R"({"buffers": [{"uri": "road.bin"}, {"uri": "data:,x"}], "images": [{"bufferView": 0}]})");
  write("road.bin", "one");
  write("road_lane.csv", "a lane");
  const auto hash = [&] { return scene_hash(folder / "road.gltf"); };
  const auto first = hash();
  ASSERT_TRUE(first) << first.error().text();
  EXPECT_EQ(*hash(), *first);
  write("road.bin", "two");
  const auto second = hash();
  EXPECT_NE(*second, *first);
  write("road_lane.csv", "another lane");
  EXPECT_NE(*hash(), *second);
  std::filesystem::remove(folder / "road.bin");
  EXPECT_FALSE(hash()) << "a buffer that is not there";
}

}  // namespace
}  // namespace phare::cost
