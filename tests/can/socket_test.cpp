// The socket on the kernel's real CAN: filters, stamps, error frames, CAN FD, replay by canplayer, interfaces that go.
#include <filesystem>

#include "cockpit_io/candump.h"
#include "tests/can/can_rig.h"
#include "tests/paths.h"

namespace phare::can_test {
namespace {

std::vector<CanSocket::Received> all_from(CanSocket& socket, std::size_t wanted) {
  std::vector<CanSocket::Received> all;
  const auto limit = Clock::now() + kPatience;
  while (all.size() < wanted && Clock::now() < limit) {
    if (const auto received = socket.receive()) {
      all.push_back(*received);
    } else {
      std::this_thread::sleep_for(1ms);
    }
  }
  std::this_thread::sleep_for(50ms);  // what must not come has had its time
  while (const auto more = socket.receive()) all.push_back(*more);
  return all;
}

TEST(RealCan, FiltersLetOnlyTheMappedIdsThrough) {
  PHARE_NEEDS_CAN();
  const Vcan vcan("phc0");
  CanSocket listener = node(vcan.name, {{0x500, false}, {0x123, true}});
  CanSocket sender = node(vcan.name);
  for (const std::uint32_t id : {0x4FFu, 0x500u, 0x501u, 0x123u}) EXPECT_TRUE(sender.send(frame(id, {1, 2, 3})));
  for (const std::uint32_t id : {0x500u, 0x123u}) EXPECT_TRUE(sender.send(frame(id, {4}, true)));
  const auto heard = all_from(listener, 2);
  ASSERT_EQ(heard.size(), 2u);
  EXPECT_EQ(heard[0].frame, frame(0x500, {1, 2, 3}));
  EXPECT_EQ(heard[1].frame, frame(0x123, {4}, true));
}

TEST(RealCan, StampsAreTheKernels) {
  PHARE_NEEDS_CAN();
  const Vcan vcan("phc1");
  CanSocket listener = node(vcan.name, {{0x500, false}});
  const WallTime before = wall_now();
  ASSERT_EQ(sh("cansend phc1 500#0201"), 0);
  const WallTime after = wall_now();
  std::this_thread::sleep_for(200ms);  // read late on purpose: the stamp must not be the moment of reading
  const auto heard = all_from(listener, 1);
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_GE(heard[0].stamp, before);
  EXPECT_LE(heard[0].stamp, after);
}

TEST(RealCan, ErrorFramesAndCanFdArrive) {
  PHARE_NEEDS_CAN();
  const Vcan vcan("phc2");
  CanSocket listener = node(vcan.name, {{0x500, false}});
  ASSERT_EQ(sh("cansend phc2 20000040#0000000000000000 && cansend phc2 500##1" + std::string(128, 'A')), 0);
  const auto heard = all_from(listener, 2);
  ASSERT_EQ(heard.size(), 2u);
  EXPECT_TRUE(heard[0].frame.error);
  EXPECT_EQ(heard[0].frame.id, 0x40u);
  EXPECT_TRUE(heard[1].frame.fd);
  EXPECT_EQ(heard[1].frame.fd_flags, 1);
  EXPECT_EQ(heard[1].frame.length, 64);
  EXPECT_EQ(heard[1].frame.data[63], 0xAA);
}

TEST(RealCan, EveryFrameOfADriveReplayedByCanplayerIsHeard) {
  PHARE_NEEDS_CAN();
  const auto file = std::filesystem::path(shared_data_dir()) / "drives/comma2k19/rav4_seg40_bus0_00-30s.candump.log";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const auto log = read_candump(file);
  ASSERT_TRUE(log.ok());
  const Vcan vcan("phc3");
  const std::vector<CanId> wanted{{0x25, false}, {0x245, false}, {0xB4, false}};  // steering, gas, speed
  auto socket = CanSocket::open(vcan.name, wanted);
  ASSERT_TRUE(socket.ok());
  std::vector<CanFrame> expected;
  for (const CandumpEntry& entry : log->entries) {
    for (const CanId& id : wanted) {
      if (entry.frame.id == id.id && !entry.frame.extended) expected.push_back(entry.frame);
    }
  }
  std::thread player([&] { EXPECT_EQ(sh("canplayer -t -I '" + file.string() + "' phc3=can0"), 0); });
  const auto heard = all_from(*socket, expected.size());
  player.join();
  ASSERT_EQ(heard.size(), expected.size());
  for (std::size_t i = 0; i < heard.size(); ++i) ASSERT_EQ(heard[i].frame, expected[i]) << i;
  EXPECT_EQ(socket->dropped(), 0u);
  std::printf("canplayer: %zu frames sent, %zu mapped, all heard in order\n", log->entries.size(), heard.size());
}

TEST(RealCan, LinkDownAndUpIsSurvivedAndSaidOnce) {
  PHARE_NEEDS_CAN();
  const Vcan vcan("phc4");
  Rig rig(vcan.name, 0.3);
  CanSocket sender = node(vcan.name);
  ASSERT_TRUE(sender.send(stalk(kHigh)));
  ASSERT_TRUE(rig.until_light(LightSwitch::kHigh));
  ASSERT_EQ(sh("ip link set phc4 down"), 0);
  ASSERT_TRUE(rig.until([&] { return rig.source().status() == "down" && rig.state().fail_safe; })) << rig.log();
  EXPECT_EQ(rig.state().light_switch, LightSwitch::kLow);
  EXPECT_EQ(rig.source().fault(), "phc4: link down");
  ASSERT_EQ(sh("ip link set phc4 up"), 0);
  // The link is seen to be up again before anybody has sent.
  ASSERT_TRUE(rig.until([&] { return rig.source().status() == "silent"; })) << rig.log();
  // The sender's socket tells its own ENETDOWN first.
  ASSERT_TRUE(sender.send(stalk(kHigh)) || sender.send(stalk(kHigh)));
  ASSERT_TRUE(rig.until_light(LightSwitch::kHigh)) << rig.log();
  EXPECT_EQ(rig.said("link down"), 1) << rig.log();
  EXPECT_EQ(rig.said("link up again"), 1) << rig.log();
  EXPECT_EQ(rig.said("silent; low beam on"), 1) << rig.log();
  EXPECT_EQ(rig.counts().reconnects, 1u);
}

TEST(RealCan, AnInterfaceThatIsRemovedAndComesBackIsOpenedAgain) {
  PHARE_NEEDS_CAN();
  const Vcan vcan("phc5");
  Rig rig(vcan.name, 0.3);
  ASSERT_EQ(sh("cansend phc5 500#0301"), 0) << "too short: counted, not read";
  CanSocket sender = node(vcan.name);
  ASSERT_TRUE(sender.send(stalk(kHigh)));
  ASSERT_TRUE(rig.until_light(LightSwitch::kHigh));
  vcan.remove();  // while it is read
  ASSERT_TRUE(rig.until([&] { return rig.state().fail_safe; })) << rig.log();
  EXPECT_NE(rig.source().fault().find("phc5: "), std::string::npos);
  std::this_thread::sleep_for(600ms);  // one try to open it in vain
  EXPECT_TRUE(rig.until([] { return true; }));
  vcan.add();
  ASSERT_TRUE(rig.until([&] { return rig.source().status() != "down"; })) << rig.log();
  CanSocket again = node(vcan.name);
  ASSERT_TRUE(again.send(stalk(kHigh)));
  ASSERT_TRUE(rig.until_light(LightSwitch::kHigh)) << rig.log();
  EXPECT_EQ(rig.said("trying again every"), 1) << rig.log();
  EXPECT_EQ(rig.said("back"), 1) << rig.log();
  EXPECT_EQ(rig.counts().reconnects, 1u);
}

TEST(RealCan, AnInterfaceThatIsNotThereYetIsWaitedFor) {
  PHARE_NEEDS_CAN();
  Rig rig("phnew", 0.3);
  ASSERT_TRUE(rig.until([&] { return rig.state().fail_safe; }));
  const Vcan vcan("phnew");
  ASSERT_TRUE(rig.until([&] { return rig.source().status() == "silent"; })) << rig.log();
  CanSocket sender = node(vcan.name);
  ASSERT_TRUE(sender.send(stalk(kHigh)));
  EXPECT_TRUE(rig.until_light(LightSwitch::kHigh)) << rig.log();
}

TEST(RealCan, WhatTheSocketDropsIsCounted) {
  PHARE_NEEDS_CAN();
  const Vcan vcan("phc7");
  Rig rig(vcan.name);
  CanSocket sender = node(vcan.name);
  // Nobody reads meanwhile. 4 MB hold some thousand frames of the kernel's bookkeeping each.
  constexpr std::uint64_t kFlood = 60'000;
  std::uint64_t sent = 0;
  for (std::uint64_t i = 0; i < kFlood; ++i) sent += sender.send(stalk(kLow)) ? 1 : 0;
  ASSERT_TRUE(sender.send(stalk(kHigh)) || true);
  ASSERT_TRUE(rig.until([&] { return rig.counts().frames_read > 1000; }));
  std::this_thread::sleep_for(300ms);
  // The count of drops travels with the next frame that gets in.
  ASSERT_TRUE(rig.until([&] { return sender.send(stalk(kHigh)) && rig.state().light_switch == LightSwitch::kHigh; }));
  EXPECT_GT(rig.counts().dropped, 0u);
  EXPECT_LE(rig.counts().frames_read + rig.counts().dropped + rig.counts().link_dropped, sent + 20'000);
  EXPECT_TRUE(rig.until([&] {  // the interface is looked at four times a second
    return rig.counts().frames_read + rig.counts().dropped + rig.counts().link_dropped >= sent;
  }));
  std::printf("flood of %llu: %llu read, %llu dropped by the socket, %llu by the interface\n",
              static_cast<unsigned long long>(sent), static_cast<unsigned long long>(rig.counts().frames_read),
              static_cast<unsigned long long>(rig.counts().dropped),
              static_cast<unsigned long long>(rig.counts().link_dropped));
}

}  // namespace
}  // namespace phare::can_test
