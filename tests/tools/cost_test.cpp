// unit: figures of a ladder, which of its levels are worth it, and how they are written.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "config/base/paths.h"
#include "config/desk.h"
#include "tools/cost/ladder.h"
#include "tools/cost/measure_ladders.h"
#include "tools/cost/page.h"
#include "tools/cost/plot.h"

namespace phare::cost {
namespace {

Level level(const std::string& name, double rms, double ms) {
  Level made{.name = name};
  made.error.rms = rms;
  made.time.median = ms;
  return made;
}

TEST(Ladder, ErrorsAreOfAbsoluteDifferences) {
  std::vector<double> differences;
  for (int i = 1; i <= 100; ++i) differences.push_back(i % 2 == 0 ? -i : i);
  const Errors errors = errors_of(differences);
  EXPECT_NEAR(*errors.rms, std::sqrt(338350.0 / 100.0), 1e-12);  // sum of i² to n: n(n+1)(2n+1)/6
  EXPECT_EQ(*errors.p99, 99.0);
  EXPECT_EQ(errors.max, 100.0);
  EXPECT_EQ(errors.samples, 100u);
  EXPECT_FALSE(errors_of({}).rms.has_value()) << "nothing was measured: that is not an error of 0";
}

TEST(Ladder, MedianAndNinetyFifthPercentOfTimes) {
  std::vector<double> times;
  for (int i = 20; i >= 1; --i) times.push_back(i);
  EXPECT_EQ(times_of(times).median, 10.0);
  EXPECT_EQ(*times_of(times).p95, 19.0);
}

TEST(Ladder, ALevelIsWorthItWhenNoneIsAtOnceAsExactAndCheaper) {
  Ladder ladder;
  ladder.levels = {level("rough", 1.0, 1.0), level("dear and rough", 1.0, 2.0), level("fine", 0.1, 3.0),
                   level("dear and fine", 0.1, 4.0), level("between", 0.5, 3.5)};
  mark_efficient(ladder);
  std::vector<std::string> worth;
  for (const Level& one : ladder.levels)
    if (one.efficient) worth.push_back(one.name);
  EXPECT_EQ(worth, (std::vector<std::string>{"rough", "fine"}));
}

TEST(Ladder, TwinsAreBothWorthIt) {
  Ladder ladder;
  ladder.levels = {level("a", 1.0, 1.0), level("b", 1.0, 1.0)};
  mark_efficient(ladder);
  EXPECT_TRUE(ladder.levels[0].efficient && ladder.levels[1].efficient);
}

TEST(Ladder, CsvHasALineForEachLevelAndLeavesWhatWasNotMeasuredEmpty) {
  Ladder ladder;
  ladder.name = "light", ladder.error_unit = "lx", ladder.time_unit = "ms, \"cpu\"";
  ladder.levels = {level("a, b", 0.5, 2.0)};
  ladder.levels[0].error.max = 1.5;
  const std::string csv = csv_of({ladder});
  EXPECT_NE(csv.find("\"light\",\"a, b\",\"lx\",0.5,,1.5,0,\"ms, \"\"cpu\"\"\",2,,0,,0\n"), std::string::npos) << csv;
}

TEST(CostPage, NamesEveryLevelAndNoTextBecomesMarkup) {
  Ladder ladder{.name = "light", .what = "a < b", .reference = "float64", .error_unit = "lx", .time_unit = "ms"};
  ladder.levels = {level("<script>", 1.0, 1.0)};
  const std::string html = page({{"date", "today"}}, {ladder}, {"<?xml?><svg></svg>"});
  EXPECT_NE(html.find("&lt;script&gt;"), std::string::npos);
  EXPECT_EQ(html.find("<script>"), std::string::npos);
  EXPECT_EQ(html.find("<?xml"), std::string::npos);
}

// A name that would run off the page on the right stands to the left of its point.
TEST(CostPlot, EveryLevelThatIsWorthItIsNamedOnThePage) {
  Ladder ladder{.name = "poses", .what = "pitch", .reference = "its own", .error_unit = "deg", .time_unit = "ms"};
  const std::string names[] = {"first", "in between and named", "the dearest, with a long name"};
  ladder.levels = {level(names[0], 1.0, 1.0), level(names[1], 0.1, 3.0), level(names[2], 0.01, 10.0)};
  mark_efficient(ladder);
  const std::string stem =
      (std::filesystem::temp_directory_path() / ("phare_plot_" + std::to_string(::getpid()))).string();
  ASSERT_TRUE(plot(ladder, stem));
  std::ifstream file(stem + ".svg");
  const std::string svg{std::istreambuf_iterator<char>(file), {}};
  for (const std::string& name : names) {
    const std::size_t at = svg.find(">" + name + "<");
    ASSERT_NE(at, std::string::npos) << name;
    const std::string text = svg.substr(svg.rfind("<text", at), at - svg.rfind("<text", at));
    const double x = std::strtod(text.c_str() + text.find("x=\"") + 3, nullptr);
    // Ten points high, a letter is some six wide; the page is 720.
    const double width = 6.0 * static_cast<double>(name.size());
    const bool to_the_left = text.find("text-anchor=\"end\"") != std::string::npos;
    EXPECT_LE(to_the_left ? x : x + width, 720.0) << text;
    EXPECT_EQ(to_the_left, name == names[2]) << text;
  }
  for (const char* ending : {".svg", ".png"}) std::filesystem::remove(stem + ending);
}

TEST(PoseLadder, CarryingAPoseOnIsNearerThanHoldingItAndMoreMessagesAreNearerStill) {
  Plan plan;
  plan.quick = true;
  plan.vehicle_file = (config_dir() / "vehicles/bmw_320i.toml").string();
  plan.progress = [](const std::string&, double) {};
  const Result<Ladder> ladder = pose_ladder(plan);
  ASSERT_TRUE(ladder.ok()) << ladder.error().text();
  ASSERT_EQ(ladder->levels.size(), 12u);
  for (std::size_t i = 0; i < 12; i += 2) {
    EXPECT_LT(*ladder->levels[i + 1].error.rms, *ladder->levels[i].error.rms) << ladder->levels[i].name;
    if (i >= 2) {
      EXPECT_LT(*ladder->levels[i].error.rms, *ladder->levels[i - 2].error.rms) << ladder->levels[i].name;
    }
  }
}

#ifdef PHARE_WITH_GRAPHICS
double rms(const Ladder& ladder, const std::string& name) {
  for (const Level& one : ladder.levels)
    if (one.name == name) return one.error.rms.value_or(-1.0);
  ADD_FAILURE() << "no level " << name;
  return -1.0;
}

TEST(PictureLadders, EachRungIsNearerToTheTruthThanTheOneBelow) {
  Plan plan;
  plan.quick = true;
  plan.width_px = 320, plan.height_px = 180;
  plan.scene_file = (generated_dir() / "scenes/country_road.glb").string();
  plan.lamp_file = (generated_dir() / "lamps/low_rht.ies").string();
  plan.progress = [](const std::string&, double) {};
  plan.wanted = [](const std::string& ladder) { return ladder != "shadows"; };
  const Result<PictureLadders> ladders = picture_ladders(plan);
  ASSERT_TRUE(ladders.ok()) << ladders.error().text();
  // Of 1500 points two are lit or dark wrong, and which is the nearer is chance; of 12,000 some twenty, and each of
  // three seeds ranks hard, soft, fine alike (0.0022 · 0.0016 · 0.0006, 0.0019 · 0.0018 · 0.0014, 0.0025 · 0.0022 ·
  // 0.0010 lx).
  plan.quick = false;
  plan.wanted = [](const std::string& ladder) { return ladder == "shadows"; };
  const Result<PictureLadders> of_shadows = picture_ladders(plan);
  ASSERT_TRUE(of_shadows.ok()) << of_shadows.error().text();
  const Ladder& light = ladders->light;
  EXPECT_GT(rms(light, "fragment, normalised-8bit-1999"), 10.0 * rms(light, "fragment, half-float-texture-filter"));
  EXPECT_GT(rms(light, "fragment, half-float-texture-filter"), rms(light, "fragment, half-float-native-nodes"));
  // 16-bit floats have 11 bits of mantissa, 32-bit ones 24.
  EXPECT_GT(rms(light, "fragment, half-float-native-nodes"), 10.0 * rms(light, "fragment, float32-native-nodes"));
  EXPECT_LT(rms(light, "fragment, float32-native-nodes"), 1e-3);
  // By vertices the error of a smooth beam falls to a quarter; a cut-off's to a half.
  EXPECT_GT(rms(light, "vertex, ground cut 0 times"), 2.0 * rms(light, "vertex, ground cut 1 times"));
  const Ladder& shadows = of_shadows->shadows;
  ASSERT_EQ(shadows.levels.size(), kRayShadows + 1);
  EXPECT_GT(rms(shadows, "off"), 2.0 * rms(shadows, "hard"));
  EXPECT_GE(rms(shadows, "hard"), rms(shadows, "soft"));
  EXPECT_GE(rms(shadows, "soft"), rms(shadows, "fine"));
  // Only the light's own rounding is left: what is hidden is hidden wholly, and the rest is what it is without shadows.
  EXPECT_LT(rms(shadows, "rays"), 1e-3);
  EXPECT_LT(rms(shadows, "rays"), 1e-3 * rms(shadows, "off"));
  const Ladder& lens = ladders->lens;
  ASSERT_EQ(lens.levels.size(), kShadowNames.size());
  EXPECT_GT(rms(lens, "off"), 2.0 * rms(lens, "rays"));
  EXPECT_GT(rms(lens, "rays"), rms(lens, "lens"));
  for (const Ladder* ladder : {&ladders->light, &ladders->shadows, &ladders->lens})
    for (const Level& one : ladder->levels) {
      EXPECT_GT(one.time.median, 0.0) << one.name;
      EXPECT_GT(one.memory_bytes.value_or(0), 1'000'000u) << one.name;
    }
}

TEST(PictureLadders, MeasureOnlyWhatIsWanted) {
  Plan plan;
  plan.quick = true;
  plan.width_px = 160, plan.height_px = 90;
  plan.scene_file = (generated_dir() / "scenes/country_road.glb").string();
  plan.lamp_file = (generated_dir() / "lamps/low_rht.ies").string();
  plan.wanted = [](const std::string& ladder) { return ladder == "shadows"; };
  plan.progress = [](const std::string&, double) {};
  const Result<PictureLadders> ladders = picture_ladders(plan);
  ASSERT_TRUE(ladders.ok()) << ladders.error().text();
  EXPECT_EQ(ladders->shadows.levels.size(), kRayShadows + 1);
  for (const Ladder* ladder : {&ladders->light, &ladders->lens, &ladders->fog, &ladders->exposure})
    EXPECT_TRUE(ladder->levels.empty()) << ladder->name;
}

TEST(EffectLadders, EveryLevelIsOffByWhatItLeavesOutAndARoadThatCallsForNothingLosesNothing) {
  Plan plan;
  plan.quick = true;
  plan.width_px = 320, plan.height_px = 180;
  plan.progress = [](const std::string&, double) {};
  const Result<EffectLadders> found = effect_ladders(plan);
  ASSERT_TRUE(found.ok()) << found.error().text();
  std::vector<std::string> names;
  for (const Ladder& ladder : found->ladders) {
    names.push_back(ladder.name);
    ASSERT_EQ(ladder.levels.size(), ladder.name == "ground" ? kWetNames.size() : 2u) << ladder.name;
    const double off = ladder.levels.front().error.rms.value_or(-1.0);
    // A pupil is some pixels of 57,600, each off by tens of steps of 255.
    if (ladder.name == "nothing") {
      EXPECT_EQ(off, 0.0);
    } else {
      EXPECT_GT(off, ladder.name == "eyeshine" ? 0.05 : 0.3) << ladder.name;
    }
    EXPECT_EQ(ladder.levels.back().error.max, 0.0) << ladder.name << ": the reference itself";
    for (std::size_t k = 0; k < ladder.levels.size(); ++k) {
      EXPECT_GT(ladder.levels[k].time.median, 0.0) << ladder.name;
      if (k > 0) {
        EXPECT_LE(*ladder.levels[k].error.rms, *ladder.levels[k - 1].error.rms) << ladder.name;
      }
    }
  }
  EXPECT_EQ(names, (std::vector<std::string>{"precipitation", "ground", "glare", "snow-cover", "spray", "windscreen",
                                             "eyeshine", "nothing"}));
}
#endif

}  // namespace
}  // namespace phare::cost
