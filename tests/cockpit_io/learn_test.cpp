// --learn: what changes by itself is left out, what is moved is named.
#include "cockpit_io/learn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "cockpit_io/candump.h"
#include "config/cockpit.h"
#include "tests/paths.h"

namespace phare {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

bool any_has(const std::vector<std::string>& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

/// Ten seconds of phare_stalk frames, 50 a second: the counter runs, at 7 s the flash is pulled.
std::vector<std::string> shown(Learner& learner) {
  std::vector<std::string> all;
  for (int i = 0; i < 500; ++i) {
    CanFrame frame;
    frame.id = 0x500;
    frame.length = 8;
    frame.data[0] = static_cast<std::uint8_t>(i >= 350 && i < 360 ? 6 : 2);
    frame.data[7] = static_cast<std::uint8_t>(i & 0xF);
    const auto lines = learner.take(frame, i * kSecond / 50);
    all.insert(all.end(), lines.begin(), lines.end());
  }
  return all;
}

TEST(Learn, NamesTheSignalThatMovedAndNotTheCounter) {
  Learner learner(*read_dbc(cockpits_dir() + "/phare_stalk.dbc"), 5 * kSecond);
  const auto lines = shown(learner);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find("7.000 s  BEAM_STALK.FLASH  0 -> 1"), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find("7.200 s  BEAM_STALK.FLASH  1 -> 0"), std::string::npos) << lines[1];
  const auto summary = learner.summary();
  EXPECT_TRUE(any_has(summary, "500 frames of 1 ids; 1 signals changed by themselves")) << summary[0];
  EXPECT_TRUE(any_has(summary, "signal = \"FLASH\""));
}

// The lever of docs/add-a-car.md: neutral, pulled, pushed.
TEST(Learn, DraftsALeverWithThreeLevels) {
  const auto dbc = parse_dbc(
      "BO_ 585 STALK: 2 X\n SG_ LEVER : 12|2@1+ (1,0) [0|3] \"\" X\n"
      "VAL_ 585 LEVER 0 \"IDLE\" 1 \"PULL\" 2 \"PUSH\";\n",
      "lever.dbc");
  Learner learner(*dbc, kSecond);
  for (int i = 0; i < 400; ++i) {
    CanFrame frame;
    frame.id = 585;
    frame.length = 2;
    const int lever = i > 200 && i < 210 ? 1 : i > 300 && i < 310 ? 2 : 0;
    frame.data[1] = static_cast<std::uint8_t>(lever << 4);
    learner.take(frame, i * kSecond / 50);
  }
  const auto summary = learner.summary();
  EXPECT_TRUE(any_has(summary,
                      "[control.NAME]\nmessage = \"STALK\"\nsignal = \"LEVER\"\n"
                      "levels = { neutral = \"IDLE\", pull = \"PULL\", push = \"PUSH\" }"))
      << summary.back();
}

TEST(Learn, WithoutADbcNamesBits) {
  Learner learner({}, 5 * kSecond);
  const auto lines = shown(learner);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find("500 byte 0 bit 2  0 -> 1"), std::string::npos) << lines[0];
}

// The way of docs/add-a-car.md with a stalk that no DBC file knows: a draft of one from the bits that moved, with which
// learning again gives a draft of the cockpit file, which reads once the names are put in.
TEST(Learn, DraftsTheDbcFileAndThenTheCockpitFile) {
  const auto learnt = [](Dbc dbc) {
    Learner learner(std::move(dbc), kSecond);
    for (int i = 0; i < 400; ++i) {
      CanFrame frame;
      frame.id = 0x3A1;
      frame.length = 8;
      frame.data[0] = static_cast<std::uint8_t>(i * 7);  // a checksum, and a counter
      const int lever = i > 200 && i < 210 ? 1 : i > 250 && i < 260 ? 2 : 0, light = i > 300 ? 3 : i > 280 ? 1 : 0;
      frame.data[1] = static_cast<std::uint8_t>((i & 15) | lever << 4);
      frame.data[2] = static_cast<std::uint8_t>(light);
      learner.take(frame, i * kSecond / 50);
    }
    std::string all;
    for (const std::string& line : learner.summary()) all += line + "\n";
    return all;
  };
  const std::string bits = learnt({});
  const std::size_t begin = bits.find("BO_ 929 ID_3A1: 8 CAR\n");
  ASSERT_NE(begin, std::string::npos) << bits;
  const auto dbc = parse_dbc(bits.substr(begin), "lumen.dbc");
  ASSERT_TRUE(dbc) << dbc.error().text();
  EXPECT_TRUE(dbc->problems.empty());
  ASSERT_EQ(dbc->messages.at(0).signals.size(), 2u) << bits;
  EXPECT_EQ(dbc->messages[0].signals[0].start_bit, 12u);
  EXPECT_EQ(dbc->messages[0].signals[0].length_bits, 2u);
  EXPECT_EQ(dbc->messages[0].signals[1].start_bit, 16u);

  std::string cockpit = learnt(*dbc);
  cockpit.erase(0, cockpit.find("# A draft of the cockpit file"));
  const auto put = [&](const std::string& from, const std::string& to) {
    const std::size_t at = cockpit.find(from);
    ASSERT_NE(at, std::string::npos) << from << " in\n" << cockpit;
    cockpit.replace(at, from.size(), to);
  };
  put("[control.NAME]", "[control.beam_lever]");
  put("[control.NAME]", "[control.light_switch]");
  put("push = 1, pull = 2 }", "push = 2, pull = 1 }");
  put("neutral = 0, push = 1, pull = 3 }", "off = 0, position = 1, low = 3 }");
  const auto config = parse_cockpit(cockpit, "lumen.toml");
  ASSERT_TRUE(config) << config.error().text() << "\n" << cockpit;
  EXPECT_EQ(config->dbc_file.filename(), "lumen.dbc");
  EXPECT_EQ(config->controls.size(), 2u);
  ASSERT_EQ(config->also.size(), 1u);
  EXPECT_TRUE(read_cockpit(config->also.front())) << "the shipped keyboard, wherever one's own file lies";
  EXPECT_NE(cockpit.find("timeout_s = 0.2   # its longest pause was 0.02 s"), std::string::npos) << cockpit;
}

TEST(Learn, FindsTheTurnButtonOfARealDrive) {
  const std::filesystem::path shared = shared_data_dir();
  if (!std::filesystem::exists(shared / "drives/comma2k19")) GTEST_SKIP() << "no " << shared;
  const auto log = read_candump(shared / "drives/comma2k19/rav4_seg40_bus0_00-30s.candump.log");
  Learner learner(*read_dbc(shared / "dbc/opendbc/toyota_nodsu_pt_generated.dbc"), 2 * kSecond);
  std::vector<std::string> all;
  for (const CandumpEntry& entry : log->entries) {
    const auto lines = learner.take(entry.frame, entry.stamp_ns - log->entries.front().stamp_ns);
    all.insert(all.end(), lines.begin(), lines.end());
  }
  EXPECT_TRUE(any_has(all, "BLINKERS_STATE.BLINKER_BUTTON_PRESSED  0 (not pressed) -> 1 (button pressed)"));
  EXPECT_FALSE(any_has(all, "LIGHT_STALK.")) << "the light stalk stays off throughout";
}

}  // namespace
}  // namespace phare
