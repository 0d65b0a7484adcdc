// unit: a relay passes on what it is given and back, and loses, doubles and reorders as much as it is told to.
#include "tools/relay.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "net/bus.h"

namespace phare {
namespace {

using namespace std::chrono_literals;

/// Sends `count` numbered datagrams through a relay; what arrives, in order.
std::vector<int> through(const RelayFaults& faults, int count, RelayCounts* counts) {
  auto behind = UdpSocket::open("127.0.0.1", 0), sender = UdpSocket::open("127.0.0.1", 0);
  auto relay = Relay::open("127.0.0.9", "127.0.0.1", behind->port(), 1, faults);
  EXPECT_TRUE(relay) << (relay ? "" : relay.error().text());
  std::vector<int> arrived;
  const Endpoint to{*ipv4_address("127.0.0.9"), behind->port()};
  const auto take = [&] {
    relay->step(1ms);
    while (const auto bytes = behind->receive())
      arrived.push_back(std::atoi(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()).c_str()));
  };
  for (int i = 0; i < count; ++i) {
    const std::string text = std::to_string(i);
    sender->send_to(to, std::as_bytes(std::span(text)));
    take();
  }
  for (int i = 0; i < 100; ++i) take();
  *counts = relay->counts();
  return arrived;
}

TEST(Relay, PassesEverythingOnWithoutFaults) {
  RelayCounts counts;
  const auto arrived = through({}, 200, &counts);
  EXPECT_EQ(arrived.size(), 200u);
  EXPECT_TRUE(std::ranges::is_sorted(arrived));
  EXPECT_EQ(counts.passed_on, 200u);
}

TEST(Relay, LosesDoublesAndReordersAsOftenAsItIsTold) {
  RelayCounts counts;
  const auto arrived =
      through({.loss_01 = 0.2, .duplicate_01 = 0.1, .reorder_01 = 0.3, .jitter = 3ms, .seed = 3}, 1000, &counts);
  // Shares of 1000 draws: four standard deviations, 4 sqrt(p (1 - p) 1000), rounded up.
  EXPECT_NEAR(static_cast<double>(counts.lost), 200.0, 51.0);
  EXPECT_NEAR(static_cast<double>(counts.duplicated), 80.0, 35.0);  // of the 800 that were not lost
  EXPECT_GT(counts.held_back, 100u);
  EXPECT_EQ(counts.passed_on, counts.received - counts.lost + counts.duplicated);
  EXPECT_FALSE(std::ranges::is_sorted(arrived));
  const std::set<int> different(arrived.begin(), arrived.end());
  EXPECT_EQ(different.size(), 1000 - counts.lost);
  RelayCounts again;
  through({.loss_01 = 0.2, .duplicate_01 = 0.1, .reorder_01 = 0.3, .jitter = 3ms, .seed = 3}, 1000, &again);
  EXPECT_EQ(again.lost, counts.lost) << "by its seed";
}

// A command through a relay that loses a third of all: asked again until it is answered, and applied once.
TEST(Relay, AnswersComeBackTheWayTheyCame) {
  Rig rig;
  rig.file = "test.toml";
  rig.channels.resize(1);
  rig.port_base = static_cast<std::uint16_t>(25000 + getpid() % 900 * 30);
  rig.places.dynamics = {"127.0.0.8", "127.0.0.9"};
  auto dynamics = Bus::open(rig, Role::kDynamics);
  auto relay = Relay::open("127.0.0.9", "127.0.0.8", rig.port_base, 26, {.loss_01 = 0.3, .jitter = 2ms, .seed = 4});
  ASSERT_TRUE(dynamics && relay);
  auto asks = Bus::open_to_send(rig, Role::kControl);
  ASSERT_TRUE(asks);
  dynamics->on_datagram = [&](const Datagram&, std::span<const std::byte>) {
    dynamics->answer(SimTime{}, ControlReply{1, 1, Verdict::kAccepted, {}, {}});
  };
  dynamics->on_repeat = [&](const Datagram&) {
    dynamics->answer(SimTime{}, ControlReply{1, 1, Verdict::kAccepted, {}, {}});
  };
  RigControl tell{RigControl::Tell{}};
  tell.request_id = tell.first_open = 1;
  bool answered = false;
  asks->on_datagram = [&](const Datagram&, std::span<const std::byte>) { answered = true; };
  asks->send(SimTime{}, tell);
  for (int round = 0; round < 200 && !answered; ++round) {
    for (int step = 0; step < 5; ++step) {
      relay->step(1ms);
      dynamics->poll();
      asks->poll();
    }
    if (!answered) asks->send_again(kPayloadIndex<RigControl>);
  }
  EXPECT_TRUE(answered);
}

TEST(Relay, SaysWhatItCannotServe) {
  EXPECT_FALSE(Relay::open("127.0.0.9", "car", 25000, 1, {}));
  EXPECT_FALSE(Relay::open("127.0.0.9", "127.0.0.9", 25000, 1, {})) << "to itself";
  const auto taken = UdpSocket::open("127.0.0.9", 0);
  ASSERT_TRUE(taken);
  EXPECT_FALSE(Relay::open("127.0.0.9", "127.0.0.8", taken->port(), 1, {}));
}

}  // namespace
}  // namespace phare
