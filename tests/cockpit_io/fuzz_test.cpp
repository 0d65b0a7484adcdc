// Random bytes and damaged files to every reader: any answer will do, a crash will not. Seeds are fixed.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "cockpit_io/candump.h"
#include "cockpit_io/dbc.h"
#include "cockpit_io/driver_source.h"
#include "cockpit_io/keyboard_source.h"
#include "cockpit_io/signal_map.h"
#include "config/cockpit.h"
#include "tests/paths.h"

namespace phare {
namespace {

std::string contents(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Bytes flipped, cut, doubled and moved; or nothing but noise.
std::string damaged(const std::string& good, std::mt19937_64& random) {
  std::string text = good;
  if (random() % 8 == 0) {
    text.assign(random() % 400, ' ');
    for (char& c : text) c = static_cast<char>(random());
    return text;
  }
  for (auto edits = random() % 12 + 1; edits > 0 && !text.empty(); --edits) {
    const std::size_t at = random() % text.size();
    switch (random() % 5) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text.erase(at, random() % 20);
        break;
      case 2:
        text.insert(at, text.substr(random() % text.size(), random() % 40));
        break;
      case 3:
        text.insert(at, std::to_string(random()));
        break;
      default:
        text[at] = "0123456789-+.|@()[]\":;#\n mM"[random() % 27];
        break;
    }
  }
  return text;
}

CanFrame random_frame(std::mt19937_64& random) {
  CanFrame frame;
  frame.id = static_cast<std::uint32_t>(random() % 3 + 1280);
  frame.length = static_cast<std::uint8_t>(random() % 65);
  frame.remote = random() % 9 == 0;
  frame.error = random() % 9 == 0;
  for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random());
  return frame;
}

TEST(Fuzz, Dbc) {
  const std::string good = contents(std::string(cockpits_dir()) + "/phare_stalk.dbc");
  std::mt19937_64 random(1);
  std::size_t read = 0;
  for (int round = 0; round < 4000; ++round) {
    const auto dbc = parse_dbc(damaged(good, random), "f.dbc");
    if (!dbc.ok()) continue;
    ++read;
    const CanFrame frame = random_frame(random);
    for (const DbcMessage& message : dbc->messages) {
      for (const DbcSignal& signal : message.signals) {
        CanFrame made = empty_frame(message);
        const auto value = decode(message, signal, frame);
        encode(message, signal, value.value_or(1.0), made);
        raw_value(signal, frame.bytes());
      }
    }
  }
  EXPECT_GT(read, 1000u);
}

TEST(Fuzz, Candump) {
  const std::string good =
      "(46408.584930) can0 260#08FFFB0000001884\n(1700000000.123456) vcan0 12345678##3112233\n(1.0) c 123#R4\n"
      "(2.5) c 20000040#0000000000000000 R\n";
  std::mt19937_64 random(2);
  for (int round = 0; round < 20000; ++round) {
    const auto log = parse_candump(damaged(good, random), "f.log");
    if (!log.ok()) continue;
    for (const CandumpEntry& entry : log->entries) EXPECT_LE(entry.frame.length, CanFrame::kMaxLength);
  }
}

TEST(Fuzz, CockpitFile) {
  const std::string good = contents(std::string(cockpits_dir()) + "/phare_stalk.toml");
  const Dbc dbc = *read_dbc(std::string(cockpits_dir()) + "/phare_stalk.dbc");
  std::mt19937_64 random(3);
  for (int round = 0; round < 1500; ++round) {
    const auto config = parse_cockpit(damaged(good, random), "f.toml");
    if (!config.ok()) {
      EXPECT_FALSE(config.error().reason.empty());
      continue;
    }
    auto map = SignalMap::bind(*config, dbc, 0);
    DriverInput input;
    if (map.ok()) map->take(random_frame(random), round, input);
  }
}

TEST(Fuzz, MultiplexedDbc) {
  const std::string good =
      "BO_ 1280 M: 8 X\n SG_ W M : 0|4@1+ (1,0) [0|0] \"\" X\n SG_ I m3M : 4|4@1- (1,0) [0|0] \"\" X\n"
      " SG_ D m1 : 15|8@0+ (0.5,1) [0|0] \"\" X\n SG_ F m2 : 16|32@1- (1,0) [0|0] \"\" X\n"
      "SG_MUL_VAL_ 1280 I W 3-5;\nSG_MUL_VAL_ 1280 D I 1-1, 9-9;\nSIG_VALTYPE_ 1280 F : 1;\n"
      "VAL_TABLE_ T 0 \"a\" 1 \"b\";\nVAL_ 1280 W T;\nCM_ SG_ 1280 W \"x\ny\";\nBA_ \"VFrameFormat\" BO_ 1280 14;\n"
      "BA_ \"SystemSignalLongSymbol\" SG_ 1280 W \"WHICH\";\n";
  std::mt19937_64 random(7);
  for (int round = 0; round < 8000; ++round) {
    const auto dbc = parse_dbc(damaged(good, random), "f.dbc");
    if (!dbc.ok()) continue;
    CanFrame frame = random_frame(random);
    for (const DbcMessage& message : dbc->messages) {
      for (const DbcSignal& signal : message.signals) {
        ASSERT_EQ(signal.multiplexor.empty(), signal.multiplex_values.empty());
        ASSERT_TRUE(signal.multiplexor.empty() || message.find(signal.multiplexor) != nullptr);
        encode(message, signal, 1.0, frame);
        decode(message, signal, frame);
      }
    }
  }
}

TEST(Fuzz, EveryShippedCockpitFile) {
  std::mt19937_64 random(8);
  std::size_t read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(cockpits_dir())) {
    if (entry.path().extension() != ".toml") continue;
    const std::string good = contents(entry.path());
    for (int round = 0; round < 150; ++round) {
      const auto config = parse_cockpit(damaged(good, random), "f.toml");
      if (!config.ok()) {
        EXPECT_FALSE(config.error().reason.empty());
      } else {
        ++read;
      }
    }
  }
  EXPECT_GT(read, 50u);
}

TEST(Fuzz, FramesThroughTheMapAndTheSwitches) {
  const auto config = read_cockpit(std::string(cockpits_dir()) + "/phare_stalk.toml");
  SignalMap map = *SignalMap::bind(*config, *read_dbc(config->dbc_file), 0);
  Cockpit cockpit({20'000'000, 2}, "fuzz");
  DriverInput input;
  std::mt19937_64 random(4);
  for (int i = 0; i < 100'000; ++i) {
    const std::int64_t ns = static_cast<std::int64_t>(random() % 100) * 1'000'000'000;  // back and forth
    map.take(random_frame(random), ns, input);
    cockpit.take(input, random() % 50 == 0, {SimTime{ns}, WallTime{ns}});
    const CockpitState state = cockpit.state(-1, false);
    ASSERT_TRUE(state.accelerator_01 >= 0.0 && state.accelerator_01 <= 1.0);
    ASSERT_TRUE(state.brake_01 >= 0.0 && state.brake_01 <= 1.0);
    ASSERT_LT(state.design_index, 2u);
    ASSERT_TRUE(state.clutch_01 >= 0.0 && state.clutch_01 <= 1.0);
    ASSERT_LE(std::abs(state.lamp_aim_rad), 0.2);
  }
}

TEST(Fuzz, DriverScript) {
  const std::string good = contents(std::string(cockpits_dir()) + "/../drives/country_road_script.toml");
  std::mt19937_64 random(5);
  for (int round = 0; round < 1000; ++round) {
    const auto script = parse_driver_script(damaged(good, random), "f.toml");
    if (script.ok()) speed_profile({{0, 0, 0, 0, 0, 0}, {100, 100, 0, 0, 0, 0.1}, {200, 200, 0, 0, 0, 0}}, *script);
  }
}

TEST(Fuzz, Keys) {
  std::mt19937_64 random(6);
  KeyboardDriver driver;
  Cockpit cockpit({20'000'000, 2}, "keyboard");
  for (int i = 0; i < 20000; ++i) {
    std::string bytes(random() % 12, ' ');
    for (char& c : bytes) c = random() % 3 == 0 ? "\x1b[ABCDO;1lLfgnp "[random() % 16] : static_cast<char>(random());
    const Moment now{SimTime{std::int64_t{i} * 3'000'000}, {}};
    driver.press(bytes, now, cockpit);
    driver.advance(now, cockpit);
  }
}

}  // namespace
}  // namespace phare
