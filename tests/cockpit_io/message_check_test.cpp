// Alive counters and checksums: the catalogue's check values, AUTOSAR's profiles against the package autosar-e2e
// (PyPI), a real car's checksums, frames that are refused.
#include "cockpit_io/message_check.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <sstream>

#include "cockpit_io/candump.h"
#include "cockpit_io/crc.h"
#include "tests/cockpit_io/oracle.h"
#include "tests/paths.h"

namespace phare {
namespace {

TEST(Crc, GivesTheCheckValuesOfTheCatalogue) {
  // G. Cook, "Catalogue of parametrised CRC algorithms": the check of "123456789".
  const std::string digits = "123456789";
  const auto check = [&](const CrcParams& params) {
    Crc crc(params);
    for (const char c : digits) crc.add(static_cast<std::uint8_t>(c));
    return crc.value();
  };
  EXPECT_EQ(check(kCrc8), 0xF4u);
  EXPECT_EQ(check(kCrc8SaeJ1850), 0x4Bu);
  EXPECT_EQ(check(kCrc8H2f), 0xDFu);
  EXPECT_EQ(check(kCrc16CcittFalse), 0x29B1u);
  EXPECT_EQ(check(kCrc16Arc), 0xBB3Du);
  EXPECT_EQ(check(kCrc32), 0xCBF43926u);
  EXPECT_EQ(check(kCrc32P4), 0x1697D06Au);
}

TEST(Crc, OfAnyWidthAndInitGivesTheCheckValuesOfTheCatalogue) {
  const std::string digits = "123456789";
  const auto check = [&](const CrcParams& params) {
    Crc crc(params);
    for (const char c : digits) crc.add(static_cast<std::uint8_t>(c));
    return crc.value();
  };
  EXPECT_EQ(check({4, 0x3, 0x0, true, 0x0}), 0x7u);            // CRC-4/G-704
  EXPECT_EQ(check({5, 0x05, 0x1F, true, 0x1F}), 0x19u);        // CRC-5/USB
  EXPECT_EQ(check({8, 0x31, 0x00, true, 0x00}), 0xA1u);        // CRC-8/MAXIM-DOW
  EXPECT_EQ(check({15, 0x4599, 0x0, false, 0x0}), 0x059Eu);    // CRC-15/CAN
  EXPECT_EQ(check({16, 0x1021, 0xB2AA, true, 0x0}), 0x63D0u);  // CRC-16/RIELLO: an init that is not symmetric
}

const char* const kDbc =
    "BO_ 1 P1: 8 X\n SG_ CRC : 0|8@1+ (1,0) [0|0] \"\" X\n SG_ COUNT : 8|4@1+ (1,0) [0|0] \"\" X\n"
    " SG_ WIDE : 16|16@1+ (1,0) [0|0] \"\" X\n SG_ LONG : 32|32@1+ (1,0) [0|0] \"\" X\n";

MessageCheck check_of(CrcKind kind, std::vector<std::int64_t> ids = {}, const char* crc = "CRC") {
  MessageCheck check;
  check.message = "P1";
  check.counter = "COUNT";
  check.crc = crc;
  check.crc_kind = kind;
  check.data_ids = std::move(ids);
  if (kind == CrcKind::kE2eProfile1) check.counter_values = 15;
  return check;
}

MessageChecker checker_of(const MessageCheck& check) {
  const Dbc dbc = *parse_dbc(kDbc, "p.dbc");
  auto checker = MessageChecker::bind(check, dbc, dbc.messages.front());
  EXPECT_TRUE(checker.ok()) << (checker.ok() ? "" : checker.error().text());
  return *checker;
}

CanFrame frame_of(std::initializer_list<int> bytes) {
  CanFrame frame;
  frame.id = 1;
  for (const int byte : bytes) frame.data[frame.length++] = static_cast<std::uint8_t>(byte);
  return frame;
}

TEST(MessageCheck, WhatIsSignedIsGoodAndEveryFlippedBitIsNot) {
  const std::vector<std::int64_t> sixteen{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  for (const MessageCheck& check :
       {check_of(CrcKind::kE2eProfile1, {0x1234}), check_of(CrcKind::kE2eProfile2, sixteen), check_of(CrcKind::kCrc8),
        check_of(CrcKind::kCrc8SaeJ1850), check_of(CrcKind::kCrc8H2f, {0x5A}), check_of(CrcKind::kXor8),
        check_of(CrcKind::kSum8), check_of(CrcKind::kToyota), check_of(CrcKind::kCrc16CcittFalse, {}, "WIDE"),
        check_of(CrcKind::kCrc16Arc, {}, "WIDE"), check_of(CrcKind::kCrc32, {}, "LONG"),
        check_of(CrcKind::kCrc32P4, {}, "LONG")}) {
    MessageChecker sender = checker_of(check);
    MessageChecker receiver = checker_of(check);
    for (int round = 0; round < 40; ++round) {
      CanFrame frame = frame_of({0, 0, round, 7, 9, 11, 200, 3});
      sender.sign(frame);
      ASSERT_EQ(receiver.take(frame), MessageChecker::Verdict::kGood)
          << kCrcNames[static_cast<std::size_t>(check.crc_kind)] << " " << round;
      for (int bit = 0; bit < 64; ++bit) {
        CanFrame flipped = frame;
        flipped.data[static_cast<std::size_t>(bit / 8)] ^= static_cast<std::uint8_t>(1 << bit % 8);
        MessageChecker fresh = checker_of(check);
        ASSERT_EQ(fresh.take(flipped), MessageChecker::Verdict::kBadCrc)
            << kCrcNames[static_cast<std::size_t>(check.crc_kind)] << " bit " << bit;
      }
    }
    EXPECT_EQ(receiver.lost(), 0u);
  }
}

TEST(MessageCheck, CountersThatStandStillOrJumpAreRefused) {
  MessageCheck check;
  check.message = "P1";
  check.counter = "COUNT";
  check.counter_most_lost = 3;
  MessageChecker checker = checker_of(check);
  const auto take = [&](int counter) { return checker.take(frame_of({0, counter, 0, 0, 0, 0, 0, 0})); };
  using V = MessageChecker::Verdict;
  EXPECT_EQ(take(14), V::kGood);
  EXPECT_EQ(take(15), V::kGood);
  EXPECT_EQ(take(0), V::kGood);
  EXPECT_EQ(take(0), V::kBadCounter) << "stands still";
  EXPECT_EQ(take(4), V::kGood) << "three are missing";
  EXPECT_EQ(checker.lost(), 3u);
  EXPECT_EQ(take(9), V::kBadCounter) << "four are missing";
  EXPECT_EQ(take(10), V::kGood) << "counts from there";
  EXPECT_EQ(take(9), V::kBadCounter) << "backwards";

  check.counter_values = 15;  // 0 … 14, as profile 1 counts
  checker = checker_of(check);
  EXPECT_EQ(take(14), V::kGood);
  EXPECT_EQ(take(0), V::kGood);
  EXPECT_EQ(take(15), V::kBadCounter) << "no such value";
}

TEST(MessageCheck, SignalsThatCannotBeItAreErrors) {
  const Dbc dbc = *parse_dbc(kDbc, "p.dbc");
  const auto reason = [&](MessageCheck check) {
    const auto bound = MessageChecker::bind(check, dbc, dbc.messages.front());
    return bound.ok() ? std::string() : bound.error().reason;
  };
  EXPECT_NE(reason(check_of(CrcKind::kCrc8, {}, "CRK")).find("did you mean \"CRC\"?"), std::string::npos);
  EXPECT_NE(reason(check_of(CrcKind::kCrc8, {}, "WIDE")).find("16 bits, crc8 gives 8"), std::string::npos);
  MessageCheck check = check_of(CrcKind::kCrc8);
  check.counter = "LONG";
  EXPECT_NE(reason(check).find("no counter"), std::string::npos);
  check.counter = "COUNT";
  check.counter_values = 17;
  EXPECT_NE(reason(check).find("too few"), std::string::npos);
}

// Printed by the package autosar-e2e 1.0.0 (PyPI): e2e_p01_protect(bytearray(8), 0x123) and
// e2e_p02_protect(bytearray(8), bytes(range(1, 17))).
TEST(MessageCheck, Profile1And2ProtectAsPrinted) {
  MessageChecker first = checker_of(check_of(CrcKind::kE2eProfile1, {0x123}));
  EXPECT_EQ(first.take(frame_of({0x91, 1, 0, 0, 0, 0, 0, 0})), MessageChecker::Verdict::kGood);
  MessageChecker second =
      checker_of(check_of(CrcKind::kE2eProfile2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}));
  EXPECT_EQ(second.take(frame_of({0x1B, 1, 0, 0, 0, 0, 0, 0})), MessageChecker::Verdict::kGood);
}

TEST(MessageCheck, Profile1And2AgreeWithAnotherImplementation) {
  const auto [why, status] = make_oracle_venv();
  if (status == 77) GTEST_SKIP() << "no package to compare with: " << why;
  ASSERT_EQ(status, 0) << why;
  const auto [text, exit] =
      output_of(std::string(build_root("oracle")) + "/bin/python " + tests_dir("cockpit_io") + "/e2e_oracle.py");
  ASSERT_EQ(exit, 0);
  std::istringstream lines(text);
  std::string kind, mode, hex;
  std::int64_t id = 0;
  std::size_t compared = 0;
  while (lines >> kind >> mode >> id >> hex) {
    MessageCheck check = check_of(CrcKind::kE2eProfile1, {id});
    if (mode == "alternating") check.data_id_mode = DataIdMode::kAlternating;
    if (mode == "low") check.data_id_mode = DataIdMode::kLow;
    if (kind == "p2") {
      std::vector<std::int64_t> ids;
      for (std::int64_t i = 0; i < 16; ++i) ids.push_back((id + i * 37) & 0xFF);
      check = check_of(CrcKind::kE2eProfile2, ids);
    }
    CanFrame frame;
    frame.id = 1;
    for (const std::uint8_t byte : bytes_of(hex)) frame.data[frame.length++] = byte;
    MessageChecker checker = checker_of(check);
    ASSERT_EQ(checker.take(frame), MessageChecker::Verdict::kGood) << kind << " " << mode << " " << id << " " << hex;
    ++compared;
  }
  std::printf("%zu frames protected by the package autosar-e2e are good\n", compared);
  EXPECT_GE(compared, 400u);
}

TEST(MessageCheck, ARealCarsChecksumsAreGood) {
  const std::filesystem::path shared = shared_data_dir();
  if (!std::filesystem::exists(shared / "drives/comma2k19")) GTEST_SKIP() << "no " << shared;
  const auto log = read_candump(shared / "drives/comma2k19/rav4_seg40_bus0_00-30s.candump.log");
  const auto dbc = read_dbc(shared / "dbc/opendbc/toyota_nodsu_pt_generated.dbc");
  for (const char* name : {"SPEED", "GAS_PEDAL"}) {
    const DbcMessage& message = *dbc->find(name);
    MessageCheck check;
    check.message = name;
    check.crc = "CHECKSUM";
    check.crc_kind = CrcKind::kToyota;
    MessageChecker checker = *MessageChecker::bind(check, *dbc, message);
    std::size_t good = 0, all = 0;
    for (const CandumpEntry& entry : log->entries) {
      if (entry.frame.id != message.id) continue;
      ++all;
      good += checker.take(entry.frame) == MessageChecker::Verdict::kGood ? 1 : 0;
    }
    EXPECT_GT(all, 900u) << name;
    EXPECT_EQ(good, all) << name;
  }
}

// A scheme that nobody has given a name: what is signed is good, another byte or counter is not.
TEST(MessageCheck, APolynomialByItsParameters) {
  MessageCheck check = check_of(CrcKind::kPolynomial, {10, 20, 30});
  check.polynomial = {
      .width = 8, .poly = 0x2F, .init = 0x55, .xor_out = 0x0F, .reflect = true, .first_byte = 1, .last_byte = 4};
  MessageChecker sender = checker_of(check), receiver = checker_of(check);
  for (int round = 0; round < 20; ++round) {
    CanFrame frame = frame_of({0, 0, round, 7, 9, 11, 200, 3});
    sender.sign(frame);
    ASSERT_EQ(receiver.take(frame), MessageChecker::Verdict::kGood) << round;
    CanFrame outside = frame, inside = frame;
    outside.data[5] ^= 1u;  // the check does not cover it
    inside.data[4] ^= 1u;
    MessageChecker fresh = checker_of(check);
    EXPECT_EQ(fresh.take(outside), MessageChecker::Verdict::kGood);
    EXPECT_EQ(fresh.take(inside), MessageChecker::Verdict::kBadCrc);
  }
}

}  // namespace
}  // namespace phare
