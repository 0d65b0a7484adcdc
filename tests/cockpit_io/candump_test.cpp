#include "cockpit_io/candump.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/paths.h"

namespace phare {
namespace {

CandumpEntry entry(const char* line) {
  const auto parsed = parse_candump_line(line);
  EXPECT_TRUE(parsed.ok()) << line << ": " << (parsed.ok() ? "" : parsed.error().reason);
  return parsed.ok() ? *parsed : CandumpEntry{};
}

TEST(Candump, ReadsEveryKindOfFrame) {
  const CandumpEntry classic = entry("(46408.584930) can0 260#08FFFB0000001884");
  EXPECT_EQ(classic.stamp_ns, 46408'584930000);
  EXPECT_EQ(classic.frame.id, 0x260u);
  EXPECT_FALSE(classic.frame.extended);
  EXPECT_EQ(classic.frame.length, 8);
  EXPECT_EQ(classic.frame.data[1], 0xFF);
  EXPECT_EQ(classic.frame.data[7], 0x84);

  EXPECT_EQ(entry("(1700000000.123456789) vcan0 123#").stamp_ns, 1700000000'123456789);
  EXPECT_EQ(entry("(1.5) c 00000123#AB").frame.extended, true);
}

TEST(Candump, ReadsRemoteFdAndErrorFrames) {
  EXPECT_TRUE(entry("(1.0) c 123#R").frame.remote);
  EXPECT_EQ(entry("(1.0) c 123#R4").frame.length, 4);
  const CanFrame fd = entry("(1.0) c 12345678##3112233445566778899").frame;
  EXPECT_TRUE(fd.fd && fd.extended);
  EXPECT_EQ(fd.fd_flags, 3);
  EXPECT_EQ(fd.length, 9);
  EXPECT_EQ(entry("(1.0) c 001##0").frame.length, 0);
  const CanFrame error = entry("(1.0) c 20000040#0000000000000000").frame;
  EXPECT_TRUE(error.error);
  EXPECT_EQ(error.id, 0x40u);
  EXPECT_EQ(entry("(1.0) c 123#1122334455667788_F").frame.length, 8);
  EXPECT_EQ(entry("(1.0) c 123#11.22.33 T").frame.length, 3);
}

TEST(Candump, RefusesBrokenLines) {
  for (const char* line : {"",
                           "x",
                           "(1) c 123#",
                           "(1.) c 123#",
                           "(-1.0) c 123#",
                           "(99999999999999.0) c 123#",
                           "(1.0)",
                           "(1.0) c",
                           "(1.0) 123#11",
                           "(1.0) c 123",
                           "(1.0) c 12#11",
                           "(1.0) c FFF#11",
                           "(1.0) c G23#11",
                           "(1.0) c 123#1",
                           "(1.0) c 123#112233445566778899",
                           "(1.0) c 123#R9",
                           "(1.0) c 123##",
                           "(1.0) c 123#11 X",
                           "(1.0) c 123#11 R R",
                           "(1.0) c FFFFFFFF#11"}) {
    EXPECT_FALSE(parse_candump_line(line).ok()) << line;
  }
}

TEST(Candump, KeepsTheRestOfABrokenLog) {
  const auto log = parse_candump("# comment\n(1.0) c 123#11\n\nbroken\n(0.5) c 123#22\r\n(2.0) c 123#3", "a.log");
  ASSERT_TRUE(log.ok());
  EXPECT_EQ(log->entries.size(), 2u);
  EXPECT_EQ(log->broken_lines, 2u);
  EXPECT_EQ(log->backward_stamps, 1u);
  ASSERT_EQ(log->problems.size(), 2u);
  EXPECT_EQ(log->problems[0].line, 4);
  EXPECT_EQ(log->problems[1].line, 6);
  EXPECT_EQ(log->problems[0].reason.find("ends within"), std::string::npos);
  EXPECT_NE(log->problems[1].reason.find("ends within the line"), std::string::npos) << log->problems[1].reason;
}

TEST(Candump, StampsThatGoBackAreToldOnceWithTheFirst) {
  EXPECT_TRUE(doubts(*parse_candump("(1.0) c 123#11\n(1.0) c 123#22\n", "a.log")).empty());
  const auto once = doubts(*parse_candump("(10.0) c 1A0#11\n\n(5.0) c 1A0#22\n(20.0) c 1A0#33\n", "back.log"));
  ASSERT_EQ(once.size(), 1u);
  EXPECT_EQ(once[0],
            "back.log:3: the stamp goes back by 5.000000 s, the only one that does; frames are taken at once until the "
            "stamps have caught up");
  const auto twice = doubts(*parse_candump("(3.0) c 1A0#\n(2.0) c 1A0#\n(1.0) c 1A0#\n", "back.log"));
  ASSERT_EQ(twice.size(), 1u);
  EXPECT_NE(twice[0].find("back.log:2: the stamp goes back by 1.000000 s, the first of 2 that do"), std::string::npos)
      << twice[0];
}

TEST(Candump, BusesThatCarryTheSameIdsAreToldAndOneIsChosen) {
  const std::string text =
      "(1.0) can0 100#01\n(1.1) can1 100#02\n(1.2) can2 200#03\n(1.05) can0 00000100#04\n(1.3) can1 00000100#05\n";
  CandumpLog log = *parse_candump(text, "any.log");
  EXPECT_EQ(log.interfaces, (std::vector<std::string>{"can0", "can1", "can2"}));
  auto said = doubts(log);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[1],
            "any.log: id 100 and 1 more from several buses (can0 and can1), which are mixed; --interface, or interface "
            "in the cockpit file, chooses one");
  // None is named, or one that is not there.
  EXPECT_EQ(*choose_interface(log, "", false), "");
  EXPECT_EQ(*choose_interface(log, "vcan0", false),
            "any.log: no frame comes from vcan0, but from can0, can1 and can2: all of them are taken");
  EXPECT_EQ(log.entries.size(), 5u);
  const auto absent = choose_interface(log, "vcan0", true);
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().text(), "any.log: no frame comes from vcan0, but from can0, can1 and can2");
  // One that is there: its frames alone, and what is doubtful of them alone.
  EXPECT_EQ(*choose_interface(log, "can1", true),
            "any.log: only the frames of can1 are taken, not those of can0 and can2");
  ASSERT_EQ(log.entries.size(), 2u);
  EXPECT_EQ(log.entries[0].frame.data[0], 2);
  EXPECT_EQ(log.entries[1].line, 5);
  EXPECT_TRUE(doubts(log).empty());
  // Other ids on each bus are no doubt; a log of one bus is played whatever the bus was called.
  EXPECT_TRUE(doubts(*parse_candump("(1.0) can0 100#01\n(1.1) can1 101#02\n", "b.log")).empty());
  CandumpLog one = *parse_candump("(1.0) can0 100#01\n", "b.log");
  EXPECT_EQ(*choose_interface(one, "vcan0", false), "");
  EXPECT_EQ(one.entries.size(), 1u);
}

TEST(Candump, WhatCandumpShowsOnTheScreenIsNamed) {
  for (const char* line : {"  can0  123   [8]  01 02 03 04 05 06 07 08", " (1700000000.123456)  can0  123   [1]  11",
                           "  can0  12345678   [0]", "  can0  RX - -  123  [12]  00 00 00 00 00 00 00 00 00 00 00 00",
                           " (000.000000)  can0  123   [0]  remote request\r"}) {
    const auto read = parse_candump_line(line);
    ASSERT_FALSE(read.ok()) << line;
    EXPECT_EQ(read.error().reason, "is what candump shows on the screen; a log is what candump -l or -L writes")
        << line;
  }
  EXPECT_NE(parse_candump_line("can0 123 [x] 11").error().reason.find("expected a stamp"), std::string::npos);
}

TEST(Candump, ALogWithoutAFrameIsAnError) {
  EXPECT_FALSE(parse_candump("", "a.log").ok());
  const auto broken = parse_candump("\nbroken\n", "a.log");
  ASSERT_FALSE(broken.ok());
  EXPECT_EQ(broken.error().place, "a.log:2");
  EXPECT_FALSE(read_candump("/nonexistent.log").ok());
}

TEST(Candump, CountsEveryFrameOfARealDrive) {
  const auto file = std::filesystem::path(shared_data_dir()) / "drives/comma2k19/rav4_seg40_bus0_00-30s.candump.log";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const auto log = read_candump(file);
  ASSERT_TRUE(log.ok());
  EXPECT_EQ(log->entries.size(), 26904u);  // wc -l
  EXPECT_EQ(log->broken_lines, 0u);
  EXPECT_EQ(log->backward_stamps, 0u);
}

}  // namespace
}  // namespace phare
