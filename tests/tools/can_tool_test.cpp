// unit: what phare can says of a DBC file, a log, a cockpit file and a checksum.
#include "tools/can_tool.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <sstream>

#include "cockpit_io/crc.h"
#include "tests/paths.h"

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
CandumpLog noise(std::uint32_t id, Seal seal) {
  std::mt19937 random(5);
  std::string text;
  for (int i = 0; i < 64; ++i) {
    std::array<std::uint8_t, 8> data{};
    for (auto& byte : data) byte = static_cast<std::uint8_t>(random());
    data[1] = static_cast<std::uint8_t>((data[1] & 0xF0) | (i & 15));
    seal(data, i & 15);
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

}  // namespace
}  // namespace phare
