// The DBC reader: bits computed by hand, grammar that real files break, the eight real files.
#include "cockpit_io/dbc.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <random>

#include "tests/paths.h"

namespace phare {
namespace {

Dbc parsed(const std::string& text) {
  Result<Dbc> dbc = parse_dbc(text, "test.dbc");
  EXPECT_TRUE(dbc.ok()) << (dbc.ok() ? "" : dbc.error().text());
  return dbc.ok() ? std::move(*dbc) : Dbc{};
}

CanFrame frame_of(const DbcMessage& message, std::initializer_list<int> bytes) {
  CanFrame frame = empty_frame(message);
  std::size_t i = 0;
  for (const int byte : bytes) frame.data[i++] = static_cast<std::uint8_t>(byte);
  return frame;
}

double value(const Dbc& dbc, const char* signal, const CanFrame& frame) {
  const DbcMessage& message = dbc.messages.front();
  const DbcSignal* found = message.find(signal);
  EXPECT_NE(found, nullptr) << signal;
  return found == nullptr ? NAN : decode(message, *found, frame).value_or(NAN);
}

TEST(Dbc, DecodesIntelBits) {
  const Dbc dbc = parsed(
      "BO_ 1 M: 8 X\n"
      " SG_ BYTE : 8|8@1+ (1,0) [0|0] \"\" X\n"
      " SG_ WORD : 0|16@1+ (0.5,-10) [0|0] \"km/h\" X\n"
      " SG_ TWELVE : 4|12@1- (1,0) [0|0] \"\" X\n"
      " SG_ ALL : 0|64@1+ (1,0) [0|0] \"\" X\n");
  const CanFrame frame = frame_of(dbc.messages.front(), {0x34, 0xF2, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(value(dbc, "BYTE", frame), 0xF2);
  EXPECT_EQ(value(dbc, "WORD", frame), 0xF234 * 0.5 - 10);
  EXPECT_EQ(value(dbc, "TWELVE", frame), 0xF23 - 0x1000);  // bits 4 … 15 of 0xF234, sign bit set
  EXPECT_EQ(value(dbc, "ALL", frame), 0xF234);
  EXPECT_EQ(dbc.messages.front().find("WORD")->unit, "km/h");
}

TEST(Dbc, AQuoteBehindABackslashIsOfTheText) {
  const Dbc dbc = parsed(
      "BO_ 1 M: 8 X\n SG_ A : 0|8@1+ (1,0) [0|0] \"\" X\n"
      "CM_ SG_ 1 A \"says \\\"high\\\";\nC:\\dir\";\n"
      "VAL_ 1 A 1 \"one \\\"q\\\"\" 255 \"all; of it\" ;\n");  // read so by cantools 45.1.0
  EXPECT_TRUE(dbc.problems.empty()) << dbc.problems.front().reason;
  const DbcSignal& a = *dbc.messages.front().find("A");
  EXPECT_EQ(a.value_names, (std::map<std::int64_t, std::string>{{1, "one \"q\""}, {255, "all; of it"}}));
  EXPECT_EQ(a.comment, "says \"high\";\nC:\\dir");
}

TEST(Dbc, WhatIsNamedTwiceIsTold) {
  const Dbc dbc = parsed(
      "BO_ 1 M: 8 X\n SG_ A : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ B : 8|8@1+ (1,0) [0|0] \"\" X\nBO_ 2 M: 8 X\n"
      "VAL_ 1 A 1 \"one\" 2 \"two\" 1 \"uno\" ;\nVAL_ 1 B 0 \"off\" ;\nVAL_ 1 B 1 \"on\" ;\n");
  EXPECT_EQ(dbc.messages.front().find("A")->value_names.at(1), "uno");
  ASSERT_EQ(dbc.problems.size(), 3u);
  EXPECT_EQ(dbc.problems[0].line, 5);
  EXPECT_EQ(dbc.problems[0].reason, "names the value 1 twice, \"one\" and \"uno\"; the second is used");
  EXPECT_EQ(dbc.problems[1].line, 7);
  EXPECT_EQ(dbc.problems[1].reason, "has value names already; those of this line are used");
  EXPECT_EQ(dbc.problems[2].line, 4);
  EXPECT_EQ(dbc.problems[2].reason,
            "the message of line 1 has this name too; by the name that one is found, by its id this one");
}

TEST(Dbc, DecodesMotorolaBits) {
  // Start bit is the most significant: 7|16 is the first two bytes, big-endian.
  const Dbc dbc = parsed(
      "BO_ 1 M: 8 X\n"
      " SG_ WORD : 7|16@0+ (1,0) [0|0] \"\" X\n"
      " SG_ ANGLE : 3|12@0- (1.5,0) [0|0] \"deg\" X\n"
      " SG_ NIBBLE : 39|4@0- (0.1,0) [0|0] \"deg\" X\n"
      " SG_ BIT : 30|1@0+ (1,0) [0|1] \"\" X\n");
  const CanFrame frame = frame_of(dbc.messages.front(), {0x1F, 0xFE, 0, 0x40, 0xC0, 0, 0, 0});
  EXPECT_EQ(value(dbc, "WORD", frame), 0x1FFE);
  EXPECT_EQ(value(dbc, "ANGLE", frame), -2 * 1.5);  // 0xFFE in 12 bits
  EXPECT_EQ(value(dbc, "NIBBLE", frame), -4 * 0.1);
  EXPECT_EQ(value(dbc, "BIT", frame), 1);
}

TEST(Dbc, DecodesFloats) {
  const Dbc dbc = parsed(
      "BO_ 1 M: 8 X\n SG_ F : 32|32@1- (1,0) [0|0] \"\" X\n SG_ G : 0|32@1- (1,0) [0|0] \"\" X\n"
      "SIG_VALTYPE_ 1 F : 1;\nSIG_VALTYPE_ 1 G : 2;\n");
  EXPECT_EQ(value(dbc, "F", frame_of(dbc.messages.front(), {0, 0, 0, 0, 0, 0, 0xC0, 0x3F})), 1.5);
  EXPECT_TRUE(std::isnan(value(dbc, "F", frame_of(dbc.messages.front(), {0, 0, 0, 0, 0, 0, 0x80, 0x7F}))))
      << "infinite";
  ASSERT_EQ(dbc.problems.size(), 1u);  // a double needs 64 bits
  EXPECT_EQ(dbc.problems[0].line, 5);
}

TEST(Dbc, MultiplexedSignalsAreThereOnlyWhenTheirValueIs) {
  const Dbc dbc = parsed(
      "BO_ 1 M: 2 X\n SG_ WHICH M : 0|4@1+ (1,0) [0|0] \"\" X\n SG_ A m1 : 8|8@1+ (1,0) [0|0] \"\" X\n"
      " SG_ B m2 : 8|8@1+ (1,0) [0|0] \"\" X\n");
  const CanFrame frame = frame_of(dbc.messages.front(), {0x02, 77});
  EXPECT_TRUE(std::isnan(value(dbc, "A", frame)));
  EXPECT_EQ(value(dbc, "B", frame), 77);
  EXPECT_TRUE(dbc.problems.empty());

  CanFrame made = empty_frame(dbc.messages.front());
  ASSERT_TRUE(encode(dbc.messages.front(), *dbc.messages.front().find("A"), 5, made));
  EXPECT_EQ(made.data[0], 1);
  EXPECT_EQ(made.data[1], 5);
}

// Two levels and ranges, written out by hand: WHICH 3 … 5 holds INNER, whose value 1 or 9 holds DEEP.
TEST(Dbc, ExtendedMultiplexingIsFollowedThroughItsLevels) {
  const Dbc dbc = parsed(
      "BO_ 1 M: 3 X\n SG_ WHICH M : 0|4@1+ (1,0) [0|0] \"\" X\n SG_ INNER m3M : 4|4@1+ (1,0) [0|0] \"\" X\n"
      " SG_ DEEP m1 : 8|8@1+ (1,0) [0|0] \"\" X\n SG_ OTHER m0 : 4|12@1+ (1,0) [0|0] \"\" X\n"
      "SG_MUL_VAL_ 1 INNER WHICH 3-5;\nSG_MUL_VAL_ 1 DEEP INNER 1-1,\n 9-9;\n");
  EXPECT_TRUE(dbc.problems.empty());
  const DbcMessage& message = dbc.messages.front();
  EXPECT_EQ(value(dbc, "DEEP", frame_of(message, {0x13, 7, 0})), 7);
  EXPECT_EQ(value(dbc, "DEEP", frame_of(message, {0x95, 8, 0})), 8);
  EXPECT_TRUE(std::isnan(value(dbc, "DEEP", frame_of(message, {0x25, 8, 0})))) << "INNER is 2";
  EXPECT_TRUE(std::isnan(value(dbc, "DEEP", frame_of(message, {0x16, 8, 0})))) << "WHICH is 6";
  EXPECT_EQ(value(dbc, "INNER", frame_of(message, {0x24, 8, 0})), 2);
  EXPECT_EQ(value(dbc, "OTHER", frame_of(message, {0x20, 8, 0})), 0x082);

  CanFrame made = frame_of(message, {0xF4, 0, 0});  // WHICH has a fitting value already and keeps it
  ASSERT_TRUE(encode(message, *message.find("DEEP"), 200, made));
  EXPECT_EQ(made.data[0], 0x14);
  EXPECT_EQ(made.data[1], 200);
}

// Two switches in one message, each with signals of its own: SG_MUL_VAL_ says whose is whose.
TEST(Dbc, TwoIndependentMultiplexorsOfOneMessage) {
  const Dbc dbc = parsed(
      "BO_ 1 A: 4 X\n SG_ LEFT M : 0|4@1+ (1,0) [0|0] \"\" X\n SG_ RIGHT M : 4|4@1+ (1,0) [0|0] \"\" X\n"
      " SG_ L1 m1 : 8|8@1+ (1,0) [0|0] \"\" X\n SG_ R1 m1 : 16|8@1+ (1,0) [0|0] \"\" X\n"
      " SG_ R2 m2 : 16|8@1+ (1,0) [0|0] \"\" X\n SG_ WHOSE m2 : 24|8@1+ (1,0) [0|0] \"\" X\n"
      "SG_MUL_VAL_ 1 L1 LEFT 1-1;\nSG_MUL_VAL_ 1 R1 RIGHT 1-1;\nSG_MUL_VAL_ 1 R2 RIGHT 2-3;\n");
  const DbcMessage& message = dbc.messages.front();
  EXPECT_EQ(value(dbc, "L1", frame_of(message, {0x21, 7, 9, 0})), 7);
  EXPECT_EQ(value(dbc, "R2", frame_of(message, {0x21, 7, 9, 0})), 9);
  EXPECT_TRUE(std::isnan(value(dbc, "R1", frame_of(message, {0x21, 7, 9, 0})))) << "RIGHT is 2";
  EXPECT_EQ(value(dbc, "R1", frame_of(message, {0x12, 7, 9, 0})), 9);
  EXPECT_TRUE(std::isnan(value(dbc, "L1", frame_of(message, {0x12, 7, 9, 0})))) << "LEFT is 2";
  EXPECT_EQ(value(dbc, "LEFT", frame_of(message, {0x12, 7, 9, 0})), 2);
  EXPECT_EQ(value(dbc, "RIGHT", frame_of(message, {0x12, 7, 9, 0})), 1);
  EXPECT_EQ(message.find("WHOSE"), nullptr);
  ASSERT_EQ(dbc.problems.size(), 1u);
  EXPECT_EQ(dbc.problems[0].signal, "WHOSE");
  EXPECT_NE(dbc.problems[0].reason.find("LEFT and RIGHT"), std::string::npos) << dbc.problems[0].reason;
}

TEST(Dbc, MultiplexingThatCannotBeIsReported) {
  const Dbc dbc = parsed(
      "BO_ 1 A: 2 X\n SG_ LOST m1 : 8|8@1+ (1,0) [0|0] \"\" X\n"                                      // 2: no M
      "BO_ 2 B: 2 X\n SG_ W M : 0|4@1+ (1,0) [0|0] \"\" X\n SG_ P m1M : 8|4@1+ (1,0) [0|0] \"\" X\n"  // 5: circle
      " SG_ Q m1M : 12|4@1+ (1,0) [0|0] \"\" X\n SG_ V M : 4|4@1+ (1,0) [0|0] \"\" X\n"  // 6: circle, 7: second M
      "SG_MUL_VAL_ 2 P Q 1-1;\nSG_MUL_VAL_ 2 Q P 1-1;\nSG_MUL_VAL_ 2 Q W 5-1;\nSG_MUL_VAL_ 2 Q NONE 1-1;\n");
  EXPECT_EQ(dbc.signal_count(), 2u);
  std::vector<int> lines;
  for (const DbcProblem& problem : dbc.problems) lines.push_back(problem.line);
  EXPECT_EQ(lines, (std::vector<int>{10, 11, 2, 5, 6}));
}

// The values that the README of cantools prints for the frames of its motohawk.dbc; the encoded frame by cantools 45.1.
TEST(Dbc, AgreesWithThePrintedExampleOfCantools) {
  const Dbc dbc = parsed(
      "BO_ 496 ExampleMessage: 8 PCM1\n SG_ Temperature : 0|12@0- (0.01,250) [229.52|270.47] \"degK\"  PCM1,FOO\n"
      " SG_ AverageRadius : 6|6@0+ (0.1,0) [0|5] \"m\"  Vector__XXX\n SG_ Enable : 7|1@0+ (1,0) [0|0] \"-\"  X\n"
      "VAL_ 496 Enable 0 \"Disabled\" 1 \"Enabled\" ;\n");
  const DbcMessage& message = dbc.messages.front();
  const CanFrame printed = frame_of(message, {0x80, 0x4A, 0x0F, 0, 0, 0, 0, 0});
  EXPECT_EQ(value(dbc, "Enable", printed), 1);
  EXPECT_EQ(value(dbc, "AverageRadius", printed), 0);
  EXPECT_NEAR(value(dbc, "Temperature", printed), 255.92, 1e-9);
  EXPECT_EQ(message.find("Enable")->value_names.at(1), "Enabled");
  CanFrame made = empty_frame(message);
  ASSERT_TRUE(encode(message, *message.find("Temperature"), 250.1, made));
  ASSERT_TRUE(encode(message, *message.find("AverageRadius"), 3.2, made));
  ASSERT_TRUE(encode(message, *message.find("Enable"), 1, made));
  EXPECT_EQ(made, frame_of(message, {0xC0, 0x01, 0x40, 0, 0, 0, 0, 0}));
}

TEST(Dbc, LongSymbolsAreTheNames) {
  const Dbc dbc = parsed(
      "BO_ 1 SHORT_0000: 2 X\n SG_ W_0000 M : 0|4@1+ (1,0) [0|0] \"\" X\n SG_ A m1 : 8|8@1+ (1,0) [0|0] \"\" X\n"
      "BA_ \"SystemMessageLongSymbol\" BO_ 1 \"SHORT_IN_TRUTH_LONG\";\n"
      "BA_ \"SystemSignalLongSymbol\" SG_ 1 W_0000 \"WHICH_IN_TRUTH_LONG\";\nVAL_ 1 W_0000 1 \"one\" ;\n");
  ASSERT_NE(dbc.find("SHORT_IN_TRUTH_LONG"), nullptr);
  EXPECT_EQ(dbc.messages.front().find("WHICH_IN_TRUTH_LONG")->value_names.at(1), "one");
  EXPECT_EQ(value(dbc, "A", frame_of(dbc.messages.front(), {1, 9})), 9);
}

TEST(Dbc, LongFramesHaveTheLengthsOfCanFd) {
  const Dbc dbc = parsed(
      "BO_ 1 TEN: 10 X\n SG_ LAST : 72|8@1+ (1,0) [0|0] \"\" X\nBO_ 2 FULL: 64 X\n SG_ END : 511|1@1+ (1,0) [0|0] \"\" "
      "X\n"
      "BO_ 3 SHORT: 8 X\n SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\nBO_ 4 CLASSIC: 8 X\n SG_ S : 0|8@1+ (1,0) [0|0] \"\" X\n"
      "BA_ \"VFrameFormat\" BO_ 3 14;\nBA_ \"VFrameFormat\" BO_ 4 0;\nBA_ \"GenMsgCycleTime\" BO_ 4 100;\n");
  EXPECT_TRUE(dbc.problems.empty());
  EXPECT_EQ(empty_frame(dbc.messages[0]).length, 12);
  EXPECT_TRUE(empty_frame(dbc.messages[0]).fd && empty_frame(dbc.messages[2]).fd);
  EXPECT_FALSE(empty_frame(dbc.messages[3]).fd);
  CanFrame full = empty_frame(dbc.messages[1]);
  EXPECT_EQ(full.length, 64);
  ASSERT_TRUE(encode(dbc.messages[1], dbc.messages[1].signals.front(), 1, full));
  EXPECT_EQ(full.data[63], 0x80);
  EXPECT_EQ(fd_length(33), 48u);
  EXPECT_EQ(fd_length(7), 7u);
}

TEST(Dbc, ReadsIdsValueNamesAndText) {
  const Dbc dbc = parsed(
      "VERSION \"\"\r\nNS_ :\r\n\tCM_\r\n\tVAL_\r\n\r\nBS_:\r\nBU_: A B\r\n"
      "BO_ 2566849537 LONG: 8 A\r\n SG_ S : 0|2@1+ (1,0) [0|3] \"\" B,A\r\n"
      "CM_ SG_ 2566849537 S \"a text\r\nBO_ over lines\r\n; with marks\";\r\n"
      "VAL_TABLE_ OnOff 0 \"no\" 1\r\n \"yes\" ;\r\nCM_ BO_ 2566849537 \"the message\";\r\n"
      "VAL_ 2566849537 S 0 \"off\" 3 \"on; really\" ;\r\nBA_ \"X\" 1;\r\nVAL_ 5 NOTHERE 0 \"x\";\r\n"
      "BO_ 2 SHORT: 1 A\r\n SG_ T : 0|1@1+ (1,0) [0|1] \"\" B\r\nVAL_ 2 T OnOff ;\r\n");
  EXPECT_TRUE(dbc.problems.empty()) << dbc.problems.front().line << " " << dbc.problems.front().reason;
  const DbcMessage* message = dbc.find(2566849537u & 0x1FFFFFFFu, true);
  ASSERT_NE(message, nullptr);
  EXPECT_EQ(dbc.find(message->id, false), nullptr);
  ASSERT_NE(message->find("S"), nullptr);
  EXPECT_EQ(message->find("S")->value_names.at(3), "on; really");
  EXPECT_EQ(message->find("S")->comment, "a text\r\nBO_ over lines\r\n; with marks");
  EXPECT_EQ(message->comment, "the message");
  EXPECT_EQ(dbc.find("SHORT")->find("T")->value_names.at(1), "yes");
}

TEST(Dbc, BrokenLinesAreReportedWithTheirNumberAndTheRestIsKept) {
  const Dbc dbc = parsed(
      "BO_ 1 GOOD: 2 X\n"
      " SG_ OK : 0|8@1+ (1,0) [0|0] \"\" X\n"
      " SG_ NOLENGTH : 8@1+ (1,0) [0|0] \"\" X\n"                  // 3
      " SG_ BIG : 8|9@1+ (1,0) [0|0] \"\" X\n"                     // 4: a bit too far
      " SG_ BIGM : 8|2@0+ (1,0) [0|0] \"\" X\n"                    // 5: Motorola runs into byte 2
      " SG_ HUGE : 4294967295|4294967295@1+ (1,0) [0|0] \"\" X\n"  // 6
      " SG_ ZERO : 0|0@1+ (1,0) [0|0] \"\" X\n"                    // 7
      " SG_ NOFACTOR : 0|8@1+ (0,0) [0|0] \"\" X\n"                // 8
      " SG_ OK : 0|8@1+ (1,0) [0|0] \"\" X\n"                      // 9: twice
      "BO_ 1 AGAIN: 2 X\n"                                         // 10
      " SG_ LEFTOUT : 0|8@1+ (1,0) [0|0] \"\" X\n"
      "BO_ 2048 WIDE: 2 X\n"  // 12: 12 bits, taken as 29-bit id
      "BO_ nonsense\n"        // 13
      "WHAT_ is this\n"       // 14
      "CM_ \"never ends\n"    // 15
      "BO_ 3 LAST: 1 X\n SG_ L : 0|8@1+ (1,0) [0|0] \"\" X\n");
  std::vector<int> lines;
  for (const DbcProblem& problem : dbc.problems) lines.push_back(problem.line);
  EXPECT_EQ(lines, (std::vector<int>{3, 4, 5, 6, 7, 8, 9, 10, 12, 13, 14, 15}));
  EXPECT_EQ(dbc.messages.size(), 3u);
  ASSERT_NE(dbc.find("LAST"), nullptr);
  EXPECT_NE(dbc.find("LAST")->find("L"), nullptr);
  EXPECT_EQ(dbc.problems[1].signal, "BIG");
  EXPECT_NE(dbc.problems[1].reason.find("does not fit"), std::string::npos);
}

TEST(Dbc, AFileWithoutMessagesIsAnError) {
  EXPECT_FALSE(parse_dbc("", "empty.dbc").ok());
  EXPECT_FALSE(read_dbc("/nonexistent.dbc").ok());
  EXPECT_FALSE(read_dbc("/tmp").ok());
  const auto broken = parse_dbc("\nBO_ x\n", "x.dbc");
  ASSERT_FALSE(broken.ok());
  EXPECT_EQ(broken.error().place, "x.dbc:2");
}

TEST(Dbc, EncodesWhatItDecodes) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 2000; ++round) {
    DbcSignal signal;
    signal.motorola = (random() & 1) != 0;
    signal.length_bits = static_cast<std::uint32_t>(random() % 52 + 1);
    signal.start_bit = static_cast<std::uint32_t>(random() % 64);
    signal.type = (random() & 1) != 0 ? DbcSignal::Type::kSigned : DbcSignal::Type::kUnsigned;
    DbcMessage message;
    message.length_bytes = 8;
    CanFrame frame = empty_frame(message);
    for (std::size_t i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(random());
    const auto physical = decode(message, signal, frame);
    if (!physical) continue;  // did not fit
    CanFrame again = empty_frame(message);
    ASSERT_TRUE(encode(message, signal, *physical, again));
    EXPECT_EQ(decode(message, signal, again), physical);
    EXPECT_FALSE(encode(message, signal, 1e18, again));
    EXPECT_FALSE(encode(message, signal, NAN, again));
  }
}

TEST(Dbc, ShortAndRemoteFramesDecodeToNothing) {
  const Dbc dbc = parsed("BO_ 1 M: 8 X\n SG_ S : 7|16@0+ (1,0) [0|0] \"\" X\n");
  CanFrame frame = empty_frame(dbc.messages.front());
  const DbcSignal& signal = dbc.messages.front().signals.front();
  frame.length = 1;
  EXPECT_FALSE(decode(dbc.messages.front(), signal, frame));
  frame.length = 2;
  EXPECT_TRUE(decode(dbc.messages.front(), signal, frame));
  frame.remote = true;
  EXPECT_FALSE(decode(dbc.messages.front(), signal, frame));
}

TEST(Dbc, RealFilesLoad) {
  struct Expected {
    const char* file;
    std::size_t messages, signals, problems;  // counted with grep and by hand
  };
  constexpr std::array<Expected, 8> files{{{"fca_giorgio.dbc", 37, 155, 1},
                                           {"honda_civic_touring_2016_can_generated.dbc", 38, 288, 2},
                                           {"mazda_2017.dbc", 102, 514, 11},
                                           {"nissan_x_trail_2017_generated.dbc", 20, 141, 0},
                                           {"psa_aee2010_r3.dbc", 107, 430, 2},
                                           {"tesla_model3_vehicle.dbc", 11, 209, 0},
                                           {"toyota_nodsu_pt_generated.dbc", 60, 380, 0},
                                           {"vw_mqb.dbc", 113, 1348, 0}}};
  const std::filesystem::path folder = std::filesystem::path(shared_data_dir()) / "dbc/opendbc";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  for (const Expected& expected : files) {
    Result<Dbc> dbc = read_dbc(folder / expected.file);
    ASSERT_TRUE(dbc.ok()) << dbc.error().text();
    std::printf("%s: %zu messages, %zu signals, %zu lines reported\n", expected.file, dbc->messages.size(),
                dbc->signal_count(), dbc->problems.size());
    for (const DbcProblem& problem : dbc->problems) {
      std::printf("  line %d: %s %s: %s\n", problem.line, problem.message.c_str(), problem.signal.c_str(),
                  problem.reason.c_str());
      EXPECT_GT(problem.line, 0);
    }
    EXPECT_EQ(dbc->messages.size(), expected.messages) << expected.file;
    EXPECT_EQ(dbc->signal_count(), expected.signals) << expected.file;
    EXPECT_EQ(dbc->problems.size(), expected.problems) << expected.file;
  }
}

}  // namespace
}  // namespace phare
