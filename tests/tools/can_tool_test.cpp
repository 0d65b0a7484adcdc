// unit: what phare can says of a DBC file, a log, a cockpit file and a checksum.
#include "tools/can_tool.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <random>
#include <sstream>
#include <vector>

#include "cockpit_io/crc.h"
#include "cockpit_io/message_check.h"
#include "config/cockpit.h"
#include "tests/paths.h"
#include "tools/crc_search.h"

namespace phare {
namespace {

constexpr const char* kDbcOfTwo =
    "BO_ 256 STALK: 3 X\n SG_ BEAM : 0|2@1+ (1,0) [0|3] \"\" X\n SG_ SPEED : 8|8@1- (0.5,-10) [-74|53.5] \"km/h\" X\n"
    "BO_ 257 OTHER: 1 X\n SG_ FLAG : 0|1@1+ (1,0) [0|1] \"\" X\nVAL_ 256 BEAM 2 \"LOW\" 3 \"HIGH\";\n";

Dbc two() {
  return *parse_dbc(kDbcOfTwo, "two.dbc");
}

CandumpLog log_of(const std::string& text) {
  return *parse_candump(text, "drive.log");
}

TEST(CanTool, ListsEveryMessageAndSignal) {
  std::ostringstream out;
  list_dbc(two(), out);
  EXPECT_EQ(out.str(),
            "100 STALK, 3 bytes\n    BEAM  0|2@1+  0 to 3  2 \"LOW\"  3 \"HIGH\"\n"
            "    SPEED  8|8@1-  * 0.5 + -10  -74 to 53.5 km/h\n101 OTHER, 1 bytes\n    FLAG  0|1@1+  0 to 1\n"
            "2 messages, 3 signals, 0 lines that cannot be used\n");
}

TEST(CanTool, NamesTwentyBrokenLinesAndCountsTheRest) {
  std::string text = kDbcOfTwo, log;
  for (int i = 0; i < 27; ++i) text += "BO_ x BROKEN: 1 X\n", log += "no frame\n";
  std::ostringstream out, of_log;
  tell_problems(*parse_dbc(text, "two.dbc"), out);
  tell_problems(log_of("(1.0) can0 100#02\n" + log), of_log);
  for (const std::string& said : {out.str(), of_log.str()}) {
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 21) << said;
    EXPECT_NE(said.find(": and 7 more"), std::string::npos) << said;
  }
  EXPECT_TRUE(of_log.str().starts_with("drive.log:2: ")) << of_log.str();
}

TEST(CanTool, DecodesALog) {
  const CandumpLog log = log_of("(1.5) can0 100#021400\n(1.6) can0 101#01\n(1.7) can0 7FF#00\n(1.8) can0 100#03\n");
  std::ostringstream out, csv;
  ASSERT_TRUE(decode_log(two(), log, {}, out));
  EXPECT_EQ(out.str(),
            "1.500000 STALK  BEAM 2 \"LOW\"  SPEED 0 km/h\n1.600000 OTHER  FLAG 1\n1.800000 STALK  BEAM 3 \"HIGH\"\n");
  ASSERT_TRUE(decode_log(two(), log, {{"STALK.BEAM"}, true}, csv));
  EXPECT_EQ(csv.str(), "t_s,message,signal,value,unit,name\n1.500000,STALK,BEAM,2,,LOW\n1.800000,STALK,BEAM,3,,HIGH\n");
  const Status unknown = decode_log(two(), log, {{"BEAN", "SPEAD"}, false}, out);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().reason.find("BEAM"), std::string::npos) << unknown.error().text();
  EXPECT_NE(unknown.error().reason.find("SPEED"), std::string::npos) << "all unknown names in one run";
}

TEST(CanTool, ValuesLoseNoDigit) {
  const Dbc dbc = *parse_dbc(
      "BO_ 256 WIDE: 8 X\n SG_ U64 : 0|64@1+ (1,0) [0|0] \"\" X\n SG_ S64 : 0|64@1- (1,0) [0|0] \"\" X\n"
      " SG_ D : 0|64@1- (1,0) [0|0] \"\" X\nBO_ 257 TENTHS: 8 X\n SG_ T : 0|8@1+ (0.1,0) [0|0] \"\" X\n"
      " SG_ N : 0|8@1- (0.01,-2.5) [0|0] \"\" X\n SG_ RAD : 8|16@1+ (0.017453292519943295,0) [0|0] \"\" X\n"
      " SG_ F : 32|32@1- (1,0) [0|0] \"\" X\n SG_ K : 0|8@1+ (1000,1E20) [0|0] \"\" X\n"
      "SIG_VALTYPE_ 256 D : 2;\nSIG_VALTYPE_ 257 F : 1;\n",
      "wide.dbc");
  const auto values = [&](const std::string& frames) {
    std::ostringstream csv;
    EXPECT_TRUE(decode_log(dbc, log_of(frames), {{}, true}, csv));
    std::map<std::string, std::string> of;
    std::istringstream lines(csv.str());
    for (std::string line, t, message, signal, value; std::getline(lines, line);) {
      std::istringstream fields(line);
      for (std::string* field : {&t, &message, &signal, &value}) std::getline(fields, *field, ',');
      of[signal] = value;
    }
    return of;
  };
  auto all = values("(1.0) c 100#FFFFFFFFFFFFFFFF\n");
  EXPECT_EQ(all["U64"], "18446744073709551615");
  EXPECT_EQ(all["S64"], "-1");
  EXPECT_EQ(all.count("D"), 0u) << "not a number";
  all = values("(1.0) c 100#8000000000000001\n(1.1) c 101#0301000000000000\n");
  EXPECT_EQ(all["S64"], "72057594037928064");
  EXPECT_EQ(all["T"], "0.3") << "not 0.30000000000000004";
  EXPECT_EQ(all["N"], "-2.47");
  EXPECT_EQ(all["RAD"], "0.017453292519943295");
  EXPECT_EQ(all["K"], "100000000000000003000");
  EXPECT_EQ(all["F"], "0");
  all = values("(1.0) c 100#182D4454FB210940\n(1.1) c 101#FF00FF00CDCCCC3D\n");
  EXPECT_EQ(all["D"], "3.141592653589793");
  EXPECT_EQ(all["F"], "0.10000000149011612");
  EXPECT_EQ(all["N"], "-2.51");
  EXPECT_EQ(std::stod(all["RAD"]), 0xFF00 * 0.017453292519943295) << all["RAD"];
  std::ostringstream list;
  list_dbc(dbc, list);
  EXPECT_NE(list.str().find("D  0|64@1- double\n"), std::string::npos) << list.str();
  EXPECT_NE(list.str().find("F  32|32@1- float\n"), std::string::npos);
  EXPECT_NE(list.str().find("S64  0|64@1-\n"), std::string::npos);
  EXPECT_NE(list.str().find("  * 0.017453292519943295 + 0\n"), std::string::npos);
}

TEST(CanTool, OfSeveralBusesEachFrameSaysItsOwn) {
  const CandumpLog log = log_of("(1.5) can0 101#00\n(1.6) can1 101#01\n");
  std::ostringstream out, csv, told;
  ASSERT_TRUE(decode_log(two(), log, {}, out));
  EXPECT_EQ(out.str(), "1.500000 can0 OTHER  FLAG 0\n1.600000 can1 OTHER  FLAG 1\n");
  ASSERT_TRUE(decode_log(two(), log, {{}, true}, csv));
  EXPECT_EQ(
      csv.str(),
      "t_s,message,signal,value,unit,name,interface\n1.500000,OTHER,FLAG,0,,,can0\n1.600000,OTHER,FLAG,1,,,can1\n");
  tell_problems(log, told);
  EXPECT_EQ(told.str(),
            "drive.log: id 101 from several buses (can0 and can1), which are mixed; --interface, or interface in the "
            "cockpit file, chooses one\n");
}

TEST(CanTool, TellsWhichControlMovesWhen) {
  const auto config = parse_cockpit(
      "[source]\nkind = \"log\"\ntimeout_s = 0.5\n[control.light_switch]\nmessage = \"STALK\"\nsignal = \"BEAM\"\n"
      "levels = { off = 0, low = \"LOW\", high = \"HIGH\" }\n[control.hazard]\n"
      "message = \"OTHER\"\nsignal = \"FLAG\"\n",
      "c.toml");
  ASSERT_TRUE(config) << config.error().text();
  std::ostringstream out;
  ASSERT_TRUE(check_cockpit(*config, two(),
                            log_of("(1.0) can0 100#0200\n(1.0) can0 101#00\n(1.2) can0 100#0300\n(1.4) can0 101#00\n"
                                   "(1.9) can0 100#0200\n"),
                            out));
  EXPECT_EQ(out.str(),
            "     0.000 s  light_switch    off -> low\n     0.200 s  light_switch    low -> high\n"
            "     0.700 s  silent: STALK; the fail-safe would give low beam\n"
            "     0.900 s  light_switch    high -> low\nhazard (OTHER.FLAG) never moves\n"
            "5 frames, 5 used, 0 too short or with a value that means nothing, 0 refused by their checksum, 0 by their "
            "counter, silent 1 times\n");
}

/// Messages of 8 bytes with noise in them, a counter in the lower half of byte 1, and what `seal` does.
template <class Seal>
CandumpLog noise(std::uint32_t id, Seal seal, int values = 16) {
  std::mt19937 random(5);
  std::string text;
  for (int i = 0; i < 64; ++i) {
    std::array<std::uint8_t, 8> data{};
    for (auto& byte : data) byte = static_cast<std::uint8_t>(random());
    data[1] = static_cast<std::uint8_t>((data[1] & 0xF0) | (i % values));
    seal(data, i % values);
    char line[64];
    int at = std::snprintf(line, sizeof line, "(%d.0) can0 %03X#", i + 1, id);
    for (const auto byte : data)
      at += std::snprintf(line + at, sizeof line - static_cast<std::size_t>(at), "%02X", byte);
    text += std::string(line) + "\n";
  }
  return log_of(text);
}

TEST(CanTool, FindsTheChecksumThatALogCarries) {
  const auto of = [](const CrcParams& params, const std::array<std::uint8_t, 8>& data, int id) {
    Crc crc(params);
    for (std::size_t i = 1; i < 8; ++i) crc.add(data[i]);
    if (id >= 0) crc.add(static_cast<std::uint8_t>(id));
    return static_cast<std::uint8_t>(crc.value());
  };
  const auto only = [](const CandumpLog& log) {
    const auto found = find_crcs(log);
    return found.size() == 1 ? found[0].where + "; " + found[0].scheme : std::to_string(found.size()) + " found";
  };
  EXPECT_EQ(only(noise(0x100, [&](auto& data, int) { data[0] = of(kCrc8SaeJ1850, data, -1); })),
            "byte 0; crc_kind = \"crc8-sae-j1850\"");
  EXPECT_EQ(only(noise(0x100, [&](auto& data, int) { data[0] = of(kCrc8H2f, data, 0x5A); })),
            "byte 0; crc_kind = \"crc8-h2f\", data_id = 90");
  EXPECT_EQ(only(noise(0x249, [&](auto& data, int counter) { data[0] = of(kCrc8H2f, data, 157 + 6 * counter); })),
            "byte 0, counter in the lower half of byte 1; crc_kind = \"e2e-p2\", data_ids = [157, 163, 169, 175, 181, "
            "187, 193, 199, 205, 211, 217, 223, 229, 235, 241, 247]");
  EXPECT_EQ(only(noise(0x100, [](auto&, int) {})), "0 found");
}

/// The frames of a log that the one check found does not take, once its lines stand in a DBC and a cockpit file.
std::string refused_by(const CandumpLog& log, const std::string& wanted) {
  const auto found = find_crcs(log);
  std::string said;
  for (const CrcFound& one : found) said += one.where + "; " + one.scheme + "\n";
  if (found.size() != 1 || said != wanted + "\n") return "found: " + said;
  std::string dbc_text = "BO_ 256 M: 8 X\n", cockpit = "[source]\nkind = \"log\"\n[check.M]\n";
  for (const std::string& line : found[0].signals) dbc_text += " " + line + "\n";
  for (const std::string& line : found[0].table) cockpit += line + "\n";
  const auto dbc = parse_dbc(dbc_text, "m.dbc");
  const auto config = parse_cockpit(cockpit, "m.toml");
  if (!dbc || !dbc->problems.empty()) return "DBC: " + dbc_text;
  if (!config) return config.error().text() + "\n" + cockpit;
  auto checker = MessageChecker::bind(config->checks[0], *dbc, dbc->messages[0]);
  if (!checker) return checker.error().text();
  int refused = 0;
  for (const CandumpEntry& entry : log.entries)
    refused += checker->take(entry.frame) == MessageChecker::Verdict::kGood ? 0 : 1;
  return refused == 0 ? "" : std::to_string(refused) + " refused\n" + cockpit;
}

std::uint32_t crc_of(const CrcParams& params, std::vector<int> before, const std::array<std::uint8_t, 8>& data,
                     std::size_t from, std::size_t to, std::vector<int> behind = {}) {
  Crc crc(params);
  for (const int byte : before) crc.add(static_cast<std::uint8_t>(byte));
  for (std::size_t i = from; i < to; ++i) crc.add(data[i]);
  for (const int byte : behind) crc.add(static_cast<std::uint8_t>(byte));
  return crc.value();
}

TEST(CanTool, WhatItPrintsOfAnAutosarCheckLoadsAndTakesTheFrames) {
  const auto profile_1 = [](auto id_bytes, int values) {
    return noise(
        0x100,
        [=](auto& data, int counter) {
          data[0] = static_cast<std::uint8_t>(crc_of(kCrc8E2eProfile1, id_bytes(counter), data, 1, 8));
        },
        values);
  };
  const std::string counter = "byte 0, counter in the lower half of byte 1; ";
  const auto both = [](int) { return std::vector<int>{0x34, 0x12}; };
  // Of the ids that both bytes of 0x1234 stand for, the one below 256.
  const auto id = [&] {
    for (int low = 0; low < 256; ++low)
      if (crc_of(kCrc8E2eProfile1, {low, 0}, {}, 0, 0) == crc_of(kCrc8E2eProfile1, {0x34, 0x12}, {}, 0, 0)) return low;
    return -1;
  }();
  EXPECT_EQ(refused_by(profile_1(both, 15), counter + "crc_kind = \"e2e-p1\", data_id = " + std::to_string(id)), "");
  EXPECT_EQ(refused_by(profile_1(both, 16),
                       counter + "crc_kind = \"e2e-p1\", data_id = " + std::to_string(id) + ", counter_values = 16"),
            "");
  const auto open = find_crcs(profile_1(both, 15));
  ASSERT_EQ(open.size(), 1u);
  EXPECT_NE(open[0].note.find("cannot be told"), std::string::npos);
  const auto alternating = [](int count) { return std::vector<int>{count % 2 == 0 ? 0x34 : 0x12}; };
  EXPECT_EQ(refused_by(profile_1(alternating, 15),
                       counter + "crc_kind = \"e2e-p1\", data_id = 4660, data_id_mode = \"alternating\""),
            "");
  EXPECT_EQ(refused_by(noise(0x100,
                             [](auto& data, int count) {
                               data[0] = static_cast<std::uint8_t>(crc_of(kCrc8H2f, {}, data, 1, 8, {157 + 6 * count}));
                             }),
                       counter + "crc_kind = \"e2e-p2\", data_ids = [157, 163, 169, 175, 181, 187, 193, 199, 205, 211, "
                                 "217, 223, 229, 235, 241, 247]"),
            "");
  // Nothing counts: by its parameters.
  EXPECT_EQ(refused_by(noise(0x100,
                             [](auto& data, int) {
                               data[1] ^= static_cast<std::uint8_t>(data[2] & 15);
                               data[0] = static_cast<std::uint8_t>(crc_of(kCrc8E2eProfile1, {7}, data, 1, 8));
                             }),
                       "byte 0; crc_kind = \"polynomial\", width = 8, poly = 29, init = " +
                           std::to_string(crc_of(kCrc8E2eProfile1, {7}, {}, 0, 0))),
            "");
}

TEST(CanTool, WhatItPrintsOfANamedCheckLoadsAndTakesTheFrames) {
  const auto at_end = [](const CrcParams& params, bool motorola, std::vector<int> id) {
    return noise(0x100, [=](auto& data, int) {
      const std::size_t count = static_cast<std::size_t>(params.width) / 8;
      const std::uint32_t crc = crc_of(params, {}, data, 0, 8 - count, id);
      for (std::size_t i = 0; i < count; ++i)
        data[motorola ? 7 - i : 8 - count + i] = static_cast<std::uint8_t>(crc >> (8 * i));
    });
  };
  EXPECT_EQ(refused_by(at_end(kCrc8SaeJ1850, false, {77}), "byte 7; crc_kind = \"crc8-sae-j1850\", data_id = 77"), "");
  EXPECT_EQ(refused_by(at_end(kCrc8, false, {}), "byte 7; crc_kind = \"crc8\""), "");
  const struct {
    CrcParams params;
    const char* where;
    const char* name;
  } kLong[]{{kCrc16CcittFalse, "bytes 6 and 7", "crc16-ccitt-false"},
            {kCrc16Arc, "bytes 6 and 7", "crc16-arc"},
            {kCrc32, "bytes 4 to 7", "crc32"},
            {kCrc32P4, "bytes 4 to 7", "crc32-p4"}};
  for (const auto& kind : kLong) {
    for (const bool motorola : {false, true}) {
      const std::string said = std::string(kind.where) + (motorola ? ", the highest first" : ", the lowest first") +
                               "; crc_kind = \"" + kind.name + "\"";
      EXPECT_EQ(refused_by(at_end(kind.params, motorola, {}), said), "");
      EXPECT_EQ(refused_by(at_end(kind.params, motorola, {200}), said + ", data_id = 200"), "");
    }
  }
  EXPECT_EQ(refused_by(noise(0x123,
                             [](auto& data, int) {
                               int sum = 1 + 2 + 3;
                               for (const int byte : data) sum += (byte >> 4) + (byte & 15);
                               sum -= data[7] & 15;
                               data[7] = static_cast<std::uint8_t>((data[7] & 0xF0) | ((8 - sum) & 15));
                             }),
                       "the last nibble; crc_kind = \"honda\""),
            "");
}

TEST(CanTool, TheByteOfAnExclusiveOrCannotBeTold) {
  const CandumpLog log = noise(0x100, [](auto& data, int) {
    data[4] = 0;
    data[0] = data[1] ^ data[2] ^ data[3] ^ data[5] ^ data[6] ^ data[7];
  });
  EXPECT_EQ(refused_by(log, "byte 7; crc_kind = \"xor8\""), "");
  const auto found = find_crcs(log);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].note.find("which of them is the check cannot be told"), std::string::npos);
}

}  // namespace
}  // namespace phare
