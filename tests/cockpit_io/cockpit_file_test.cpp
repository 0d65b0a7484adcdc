// The cockpit file, its mapping onto a DBC, and what is said when they do not fit.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "cockpit_io/signal_map.h"
#include "config/cockpit.h"
#include "tests/paths.h"

namespace phare {
namespace {

const std::filesystem::path kCockpits = cockpits_dir();

std::string error_of(const std::string& text) {
  const auto config = parse_cockpit(text, "c.toml");
  return config.ok() ? "" : config.error().text();
}

std::string bind_error(const std::string& control) {
  const auto config = parse_cockpit("[source]\nkind = \"can\"\ninterface = \"can0\"\n" + control, "c.toml");
  if (!config.ok()) return config.error().text();
  const auto map = SignalMap::bind(*config, *read_dbc(kCockpits / "phare_stalk.dbc"), 0);
  return map.ok() ? "" : map.error().text();
}

TEST(CockpitFile, UnknownKeyNamesTheNearest) {
  EXPECT_EQ(error_of("[source]\nkind = \"keyboard\"\ntimeout = 1\n"),
            "c.toml:3: no key \"timeout\"; did you mean \"timeout_s\"? (in source)");
  EXPECT_NE(error_of("[source]\nkind = \"log\"\n[control.flsh]\n").find("did you mean \"flash\"?"), std::string::npos);
  EXPECT_NE(error_of("[source]\nkind = \"canbus\"\n"), "");
  EXPECT_NE(error_of("[source]\nkind = \"can\"\n"), "") << "no interface";
  EXPECT_NE(error_of("[source]\nkind = \"keyboard\"\ntimeout_s = -1\n"), "");
  EXPECT_NE(error_of(""), "");
}

TEST(CockpitFile, TwoSignalsForOneControlAreAnError) {
  const std::string levels =
      "[source]\nkind = \"log\"\n[control.light_switch]\nmessage = \"M\"\nsignal = \"S\"\nlevels = { off = 0, low = 2, "
      "high = 3 }\n";
  const auto flag = [](const std::string& name) { return "[control." + name + "]\nmessage = \"M\"\nsignal = \"T\"\n"; };
  EXPECT_EQ(error_of(levels), "");
  EXPECT_EQ(error_of(levels + flag("low")),
            "c.toml:7: \"control.low\": two signals for one control: T here, and S of light_switch");
  EXPECT_NE(error_of(levels + flag("high")).find("two signals for one control"), std::string::npos);
  EXPECT_NE(error_of(levels + flag("flash") + flag("flash")), "");
  EXPECT_NE(error_of("[source]\nkind = \"log\"\n[control.light_switch]\nmessage = \"M\"\nsignal = \"S\"\n"
                     "levels = { off = 0, low = 0 }\n")
                .find("another level"),
            std::string::npos);
}

TEST(CockpitFile, UnknownSignalAndMessageNameTheNearest) {
  EXPECT_EQ(bind_error("[control.flash]\nmessage = \"BEAM_STALK\"\nsignal = \"FLASHH\"\n"),
            "c.toml:6: no signal \"FLASHH\"; did you mean \"FLASH\"? (in message BEAM_STALK of phare_stalk.dbc)");
  EXPECT_EQ(bind_error("[control.flash]\nmessage = \"BEAM_STOLK\"\nsignal = \"FLASH\"\n"),
            "c.toml:5: no message \"BEAM_STOLK\" in phare_stalk.dbc; did you mean \"BEAM_STALK\"?");
  EXPECT_EQ(bind_error("[control.flash]\nmessage = \"BEAM_STALK\"\nsignal = \"FLASH\"\n"), "");
}

TEST(CockpitFile, ADroppedSignalIsExplained) {
  const auto config =
      parse_cockpit("[source]\nkind = \"log\"\n[control.flash]\nmessage = \"M\"\nsignal = \"WIDE\"\n", "c.toml");
  ASSERT_TRUE(config.ok());
  const auto dbc = parse_dbc("BO_ 1 M: 1 X\n SG_ WIDE : 4|8@1+ (1,0) [0|0] \"\" X\n", "m.dbc");
  const auto map = SignalMap::bind(*config, *dbc, 0);
  ASSERT_FALSE(map.ok());
  EXPECT_NE(map.error().reason.find("m.dbc:2: does not fit its message"), std::string::npos) << map.error().reason;
}

TEST(CockpitFile, ShippedFilesAreGood) {
  for (const char* name : {"keyboard.toml", "phare_stalk.toml", "toyota_rav4.toml"}) {
    const auto config = read_cockpit(kCockpits / name);
    ASSERT_TRUE(config.ok()) << config.error().text();
  }
  const auto config = read_cockpit(kCockpits / "phare_stalk.toml");
  const auto dbc = read_dbc(config->dbc_file);
  ASSERT_TRUE(dbc.ok()) << dbc.error().text();
  EXPECT_TRUE(dbc->problems.empty());
  const auto map = SignalMap::bind(*config, *dbc, 0);
  ASSERT_TRUE(map.ok()) << map.error().text();
  EXPECT_EQ(map->ids().size(), 3u);
  const auto toyota_dbc = std::filesystem::path(shared_data_dir()) / "dbc/opendbc/toyota_nodsu_pt_generated.dbc";
  if (!std::filesystem::exists(toyota_dbc)) GTEST_SKIP() << "no " << toyota_dbc;
  const auto toyota = SignalMap::bind(*read_cockpit(kCockpits / "toyota_rav4.toml"), *read_dbc(toyota_dbc), 0);
  EXPECT_TRUE(toyota.ok()) << toyota.error().text();
}

TEST(SignalMap, ReadsOurOwnStalk) {
  const auto config = read_cockpit(kCockpits / "phare_stalk.toml");
  const Dbc dbc = *read_dbc(config->dbc_file);
  SignalMap map = *SignalMap::bind(*config, dbc, 0);
  DriverInput input;

  const DbcMessage& stalk = *dbc.find("BEAM_STALK");
  CanFrame frame = empty_frame(stalk);
  ASSERT_TRUE(encode(stalk, *stalk.find("BEAM_SWITCH"), 3, frame));
  ASSERT_TRUE(encode(stalk, *stalk.find("FLASH"), 1, frame));
  ASSERT_TRUE(encode(stalk, *stalk.find("DESIGN_DOWN"), 1, frame));
  ASSERT_TRUE(encode(stalk, *stalk.find("IGNITION"), 1, frame));
  EXPECT_EQ(frame.data[0], 0x87);  // as in the comment of phare_stalk.toml, with design down
  EXPECT_EQ(map.take(frame, 10, input), SignalMap::Taken::kDecoded);
  EXPECT_EQ(input.switches.stalk, LightSwitch::kHigh);
  EXPECT_TRUE(input.switches.flash && input.switches.design_previous && input.switches.ignition);
  EXPECT_FALSE(input.switches.fog_front || input.switches.design_next);

  const DbcMessage& steering = *dbc.find("STEERING");
  frame = empty_frame(steering);
  ASSERT_TRUE(encode(steering, steering.signals[0], -90.0, frame));
  EXPECT_EQ(map.take(frame, 20, input), SignalMap::Taken::kDecoded);
  EXPECT_NEAR(input.steering_wheel_rad, -1.5707963, 1e-6);
  ASSERT_TRUE(encode(steering, steering.signals[0], 700.0, frame));
  map.take(frame, 20, input);
  EXPECT_NEAR(input.steering_wheel_rad, 9.4247780, 1e-6) << "limited to range_deg";

  const DbcMessage& pedals = *dbc.find("PEDALS");
  frame = empty_frame(pedals);
  ASSERT_TRUE(encode(pedals, *pedals.find("BRAKE"), 25.0, frame));
  ASSERT_TRUE(encode(pedals, *pedals.find("GEAR"), 2.0, frame));
  EXPECT_EQ(map.take(frame, 30, input), SignalMap::Taken::kDecoded);
  EXPECT_DOUBLE_EQ(input.brake_01, 0.25);
  EXPECT_EQ(input.gear, Gear::kReverse);
  EXPECT_EQ(map.silent_at_ns(), 10 + 200'000'000);

  frame.length = 3;
  EXPECT_EQ(map.take(frame, 40, input), SignalMap::Taken::kIncomplete);
  frame.id = 1;
  EXPECT_EQ(map.take(frame, 40, input), SignalMap::Taken::kNotMapped);
}

// Half detents too, and what the DBC file has no bit for; a turn lever that says something new takes no beam away.
TEST(SignalMap, ReadsTheLeverOfATeslaInAllItsPositions) {
  const auto file = std::filesystem::path(shared_data_dir()) / "dbc/opendbc/tesla_model3_vehicle.dbc";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const auto config = read_cockpit(kCockpits / "tesla_model3.toml");
  ASSERT_TRUE(config) << config.error().text();
  const Dbc dbc = *read_dbc(file);
  SignalMap map = *SignalMap::bind(*config, dbc, 0);
  auto checker = MessageChecker::bind(config->checks.front(), dbc, *dbc.find("SCCM_leftStalk"));
  ASSERT_TRUE(checker) << checker.error().text();
  DriverInput input;
  std::int64_t at_ns = 1'000'000;
  const auto stalk = [&](int beam, int turn) {
    CanFrame frame;
    frame.id = 585;
    frame.length = 4;
    frame.data[1] = static_cast<std::uint8_t>(beam << 4);
    frame.data[2] = static_cast<std::uint8_t>(turn);
    checker->sign(frame);
    at_ns += 10'000'000;
    return map.take(frame, at_ns, input);
  };
  constexpr int kPush = 2;
  for (int turn = 0; turn <= 8; ++turn) {
    EXPECT_EQ(stalk(kPush, turn), SignalMap::Taken::kDecoded) << turn;
    const TurnSignal meant = turn == 0 ? TurnSignal::kNone : turn <= 4 ? TurnSignal::kRight : TurnSignal::kLeft;
    EXPECT_EQ(input.switches.turn, meant) << turn;
    EXPECT_EQ(input.switches.lever, Lever::kPush) << turn;
  }
  EXPECT_EQ(stalk(0, 13), SignalMap::Taken::kIncomplete) << "told, and";
  EXPECT_EQ(input.switches.turn, TurnSignal::kLeft) << "it stays";
  EXPECT_EQ(input.switches.lever, Lever::kNeutral) << "the beam lever is read all the same";
}

// Frames of the left stalk that owners have published from their cars, in the order of their counters: each fits the
// data id of its counter, and the same with one bit turned fits none.
TEST(SignalMap, TheChecksumOfATeslasStalkIsTheCars) {
  const auto file = std::filesystem::path(shared_data_dir()) / "dbc/opendbc/tesla_model3_vehicle.dbc";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const auto config = read_cockpit(kCockpits / "tesla_model3.toml");
  const Dbc dbc = *read_dbc(file);
  constexpr std::array<std::array<std::uint8_t, 4>, 8> kOfCars{{{0xD3, 0x03, 0x00, 0x00},
                                                                {0xD3, 0x04, 0x00, 0x00},
                                                                {0x5E, 0x07, 0x00, 0x00},
                                                                {0x5E, 0x09, 0x00, 0x00},
                                                                {0xE2, 0x0A, 0x00, 0x00},
                                                                {0x28, 0x0B, 0x00, 0x00},
                                                                {0x3A, 0x0C, 0x00, 0x00},
                                                                {0x63, 0x0D, 0x08, 0x00}}};
  SignalMap map = *SignalMap::bind(*config, dbc, 0);
  DriverInput input;
  std::int64_t at_ns = 0;
  for (const auto& bytes : kOfCars) {
    CanFrame frame;
    frame.id = 585;
    frame.length = 4;
    std::ranges::copy(bytes, frame.data.begin());
    SignalMap another = map;
    EXPECT_EQ(map.take(frame, at_ns += 50'000'000, input), SignalMap::Taken::kDecoded) << int{bytes[1]};
    frame.data[2] ^= 0x02;
    EXPECT_EQ(another.take(frame, at_ns, input), SignalMap::Taken::kBadCrc);
  }
  EXPECT_EQ(input.switches.turn, TurnSignal::kLeft) << "the last of them, held down";
}

TEST(SignalMap, AnUnknownLevelIsASignOfLifeUnlessTheBeamHangsOnIt) {
  const auto config = parse_cockpit(
      "[source]\nkind = \"log\"\ntimeout_s = 0.5\n[control.turn]\nmessage = \"M\"\nsignal = \"TURN\"\n"
      "levels = { none = 0, left = 1, right = 2 }\n[control.light_switch]\nmessage = \"M\"\nsignal = \"BEAM\"\n"
      "levels = { off = 0, low = 1, high = 2 }\n",
      "c.toml");
  ASSERT_TRUE(config) << config.error().text();
  const auto dbc = parse_dbc(
      "BO_ 1 M: 1 X\n SG_ TURN : 0|4@1+ (1,0) [0|0] \"\" X\n SG_ BEAM : 4|4@1+ (1,0) [0|0] \"\" X\n", "m.dbc");
  SignalMap map = *SignalMap::bind(*config, *dbc, 0);
  DriverInput input;
  CanFrame frame;
  frame.id = 1;
  frame.length = 1;
  const auto send = [&](std::uint8_t byte, std::int64_t ms) {
    frame.data[0] = byte;
    return map.take(frame, ms * 1'000'000, input);
  };
  EXPECT_EQ(send(0x21, 100), SignalMap::Taken::kDecoded);
  EXPECT_EQ(map.silent_at_ns(), 600'000'000);
  EXPECT_EQ(send(0x2F, 200), SignalMap::Taken::kIncomplete);
  EXPECT_EQ(map.silent_at_ns(), 700'000'000) << "the turn lever alone";
  EXPECT_EQ(input.switches.turn, TurnSignal::kLeft);
  EXPECT_EQ(send(0xF0, 300), SignalMap::Taken::kIncomplete);
  EXPECT_EQ(map.silent_at_ns(), 700'000'000) << "the beam switch: nobody knows what it wants";
  EXPECT_EQ(input.switches.stalk, LightSwitch::kHigh);
  EXPECT_EQ(input.switches.turn, TurnSignal::kNone);
}

TEST(CockpitFile, BitsThatTheCarHasElsewhereAreChecked) {
  const auto bound = [](const std::string& bits) {
    const auto config = parse_cockpit(
        "[source]\nkind = \"log\"\n[control.flash]\nmessage = \"M\"\nsignal = \"S\"\n"
        "bits = \"" +
            bits + "\"\n",
        "c.toml");
    EXPECT_TRUE(config) << config.error().text();
    return SignalMap::bind(*config, *parse_dbc("BO_ 1 M: 2 X\n SG_ S : 0|1@1+ (1,0) [0|0] \"\" X\n", "m.dbc"), 0);
  };
  EXPECT_TRUE(bound("12|4@1+"));
  EXPECT_TRUE(bound("7|8@0-"));
  for (const char* wrong : {"12|5@1+", "16|1@1+", "0|0@1+", "0|65@1+", "4|4", "4|4@2+", "4|4@1", "4|4@1+ 3", "x"}) {
    const auto map = bound(wrong);
    ASSERT_FALSE(map) << wrong;
    EXPECT_NE(map.error().text().find("c.toml:"), std::string::npos) << map.error().text();
  }
}

TEST(CockpitFile, BitsOfOneControlLeaveAnotherOfTheSameSignalAlone) {
  const auto config = parse_cockpit(
      "[source]\nkind = \"log\"\n"
      "[control.flash]\nmessage = \"M\"\nsignal = \"S\"\n"
      "[control.fog_front]\nmessage = \"M\"\nsignal = \"S\"\nbits = \"8|1@1+\"\n",
      "c.toml");
  ASSERT_TRUE(config) << config.error().text();
  auto map = SignalMap::bind(*config, *parse_dbc("BO_ 1 M: 2 X\n SG_ S : 0|1@1+ (1,0) [0|0] \"\" X\n", "m.dbc"), 0);
  ASSERT_TRUE(map) << map.error().text();
  const auto read = [&](std::uint8_t first, std::uint8_t second) {
    CanFrame frame{.id = 1, .length = 2};
    frame.data[0] = first, frame.data[1] = second;
    DriverInput input;
    EXPECT_EQ(map->take(frame, 1'000'000'000, input), SignalMap::Taken::kDecoded);
    return std::pair(input.switches.flash, input.switches.fog_front);
  };
  EXPECT_EQ(read(1, 0), std::pair(true, false));
  EXPECT_EQ(read(0, 1), std::pair(false, true));
}

}  // namespace
}  // namespace phare
