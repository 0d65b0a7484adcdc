// unit: sealed datagrams pass between holders of the key and no one else; what was recorded earlier cannot be played
// again.
#include "net/seal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <random>

#include "net/bus.h"
#include "tests/net/sample.h"

namespace phare {
namespace {

BusKey key_of(std::uint8_t first) {
  BusKey key{};
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = static_cast<std::uint8_t>(first + i);
  return key;
}

Rig sealed_rig(std::uint8_t key, const std::string& address = "127.0.0.1") {
  Rig rig;
  rig.file = "test.toml";
  rig.channels.resize(1);
  rig.bind_address = address;
  rig.port_base = static_cast<std::uint16_t>(21000 + getpid() % 900 * 30);
  if (key != 0) rig.bus_key = key_of(key);
  return rig;
}

TEST(Seal, OpensWithTheSameKeyAndUnchangedBytesOnly) {
  const Seal seal(key_of(1)), other(key_of(2)), none(std::nullopt);
  std::string bytes = "a datagram";
  seal.close(bytes);
  ASSERT_EQ(bytes.size(), 10 + Seal::kTagBytes);
  ASSERT_TRUE(seal.open(test::view(bytes)));
  EXPECT_EQ(seal.open(test::view(bytes))->size(), 10u);
  EXPECT_FALSE(other.open(test::view(bytes)));
  EXPECT_EQ(none.open(test::view(bytes))->size(), bytes.size());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string changed = bytes;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_FALSE(seal.open(test::view(changed))) << bit;
  }
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(seal.open(test::view(bytes.substr(0, size)))) << size;
}

TEST(Seal, BusesOffLoopbackSpeakWithTheKeyOnly) {
  const Rig rig = sealed_rig(1, "0.0.0.0");
  EXPECT_FALSE(Bus::open(sealed_rig(0, "0.0.0.0"), Role::kCockpit));
  auto cockpit = Bus::open(rig, Role::kCockpit);
  auto dynamics = Bus::open(rig, Role::kDynamics);
  ASSERT_TRUE(cockpit && dynamics) << (cockpit ? "" : cockpit.error().text());
  CockpitState state;
  state.brake_01 = 0.25;
  cockpit->send({}, state);
  ASSERT_TRUE(dynamics->wait(std::chrono::seconds(5)));
  dynamics->poll();
  ASSERT_NE(dynamics->newest<CockpitState>(), nullptr);
  EXPECT_EQ(dynamics->newest<CockpitState>()->value.brake_01, 0.25);
  EXPECT_EQ(dynamics->counters().refused, 0u);

  // Valid datagrams without the key, and with another. Those without have no tag where the socket's filter looks for
  // one.
  auto stranger = UdpSocket::open("127.0.0.1", 0);
  ASSERT_TRUE(stranger);
  std::mt19937_64 random(7);
  const auto port = static_cast<std::uint16_t>(rig.port_base + port_offset(Role::kDynamics));
  std::string plain = encode(test::sample(kPayloadIndex<CockpitState>, random)), wrong = plain;
  Seal(key_of(9)).close(wrong);
  stranger->send_to(port, test::view(plain));
  stranger->send_to(port, test::view(wrong));
  dynamics->wait(std::chrono::seconds(5));
  dynamics->poll();
  EXPECT_EQ(dynamics->counters().refused, 2u);
  EXPECT_EQ(dynamics->counters().refused_because[static_cast<std::size_t>(Refusal::kKey)] +
                dynamics->counters().refused_in_kernel,
            2u);
  EXPECT_EQ(dynamics->newest<CockpitState>()->value.brake_01, 0.25);
}

TEST(Seal, WhatWasRecordedEarlierCannotBePlayedAgain) {
  const Rig rig = sealed_rig(1);
  auto dynamics = Bus::open(rig, Role::kDynamics);
  auto stranger = UdpSocket::open("127.0.0.1", 0);
  ASSERT_TRUE(dynamics && stranger);
  const auto port = static_cast<std::uint16_t>(rig.port_base + port_offset(Role::kDynamics));
  const auto send = [&](std::uint64_t start_id, std::uint64_t sequence, std::int64_t sent_ns) {
    Datagram datagram{Sender::kCockpit, 0, start_id, sequence, SimTime{}, WallTime{sent_ns}, CockpitState{}};
    std::string bytes = encode(datagram);
    Seal(rig.bus_key).close(bytes);
    stranger->send_to(port, test::view(bytes));
    dynamics->wait(std::chrono::seconds(5));
    return dynamics->poll();
  };
  const std::int64_t now_ns = wall_now().ns - 5000;  // all within what one machine's clock may be late
  EXPECT_EQ(send(10, 1, now_ns + 1000), 1u);
  EXPECT_EQ(send(10, 2, now_ns + 2000), 1u);
  EXPECT_EQ(send(20, 1, now_ns + 3000), 1u);  // the cockpit was started again
  EXPECT_EQ(send(10, 3, now_ns + 2500), 0u);  // of the earlier start, never heard before
  EXPECT_EQ(send(20, 1, now_ns + 3000), 0u);  // again
  EXPECT_EQ(send(20, 2, now_ns + 4000), 1u);
  EXPECT_EQ(dynamics->counters().refused_because[static_cast<std::size_t>(Refusal::kReplay)], 1u);
  EXPECT_EQ(dynamics->counters().received[kPayloadIndex<CockpitState>].duplicate, 1u);

  // A receiver that was started again knows nobody, and takes nothing old for all that.
  { Bus gone = std::move(*dynamics); }
  dynamics = Bus::open(rig, Role::kDynamics);
  ASSERT_TRUE(dynamics);
  const std::int64_t old_ns = wall_now().ns - std::chrono::nanoseconds(Replays::kOneClock).count() - 1;
  EXPECT_EQ(send(20, 3, old_ns), 0u);
  EXPECT_EQ(dynamics->counters().refused_because[static_cast<std::size_t>(Refusal::kReplay)], 1u);
  EXPECT_EQ(send(20, 3, wall_now().ns), 1u);
}

}  // namespace
}  // namespace phare
