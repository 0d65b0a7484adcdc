// unit: what questions and answers tell of another machine's clock, and that what it stamps is read in our time.
#include "net/peer_clock.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <random>
#include <thread>

#include "net/bus.h"
#include "net/places.h"
#include "net/stats.h"

namespace phare {
namespace {

using namespace std::chrono_literals;

/// Another clock, `ahead` of ours and faster by `drift_ppm`, behind a network of a delay of its own each way.
struct Network {
  std::mt19937_64 random{7};
  double ahead_ns = 0.0, drift_ppm = 0.0, delay_ms = 1.0, jitter_ms = 5.0;

  double way_ns() { return 1e6 * (delay_ms + std::uniform_real_distribution<double>(0.0, jitter_ms)(random)); }
  double ahead_at(double now_s) const { return ahead_ns + drift_ppm * 1e3 * now_s; }

  void exchange(PeerClock& clock, double now_s, double busy_ns = 2e5) {
    const double asked = 1e9 * now_s, heard_there = asked + way_ns(), answered_there = heard_there + busy_ns,
                 heard = answered_there + way_ns();
    const auto wall = [](double ns) { return WallTime{1'700'000'000'000'000'000 + std::llround(ns)}; };
    clock.add({wall(asked), wall(heard_there + ahead_at(now_s)), wall(answered_there + ahead_at(now_s)), wall(heard)},
              PeerClock::Time(std::chrono::nanoseconds(std::llround(heard))));
  }
};

PeerClock::Time at_s(double seconds) {
  return PeerClock::Time(std::chrono::nanoseconds(std::llround(1e9 * seconds)));
}

TEST(PeerClock, KnowsAnOffsetWithinWhatItSays) {
  for (const double ahead_ms : {0.0, 100.0, -100.0, 86'400'000.0}) {
    Network network{.ahead_ns = 1e6 * ahead_ms};
    PeerClock clock;
    EXPECT_FALSE(clock.at(at_s(0.0)));
    for (int i = 0; i < 100; ++i) {
      network.exchange(clock, i);
      const auto estimate = clock.at(at_s(i + 0.02));
      ASSERT_TRUE(estimate);
      EXPECT_LE(std::abs(static_cast<double>(estimate->ahead_ns) - network.ahead_ns), estimate->within_ns) << i;
    }
    // Ways of 1 to 6 ms, 16 exchanges: the tightest has seldom more than both half a jitter above the least.
    EXPECT_LT(clock.at(at_s(99.02))->within_ns, 12e6);
    EXPECT_EQ(clock.steps(), 0u);
    EXPECT_EQ(clock.exchanges(), 100u);
  }
}

TEST(PeerClock, TellsADriftAndFollowsIt) {
  Network network{.ahead_ns = 1e8, .drift_ppm = 80.0};
  PeerClock clock;
  for (int i = 0; i < 15; ++i) network.exchange(clock, i);
  EXPECT_TRUE(std::isinf(clock.at(at_s(15.0))->drift_within_ppm)) << "too early to tell";
  for (int i = 15; i < 1200; ++i) network.exchange(clock, i);
  const auto estimate = clock.at(at_s(1200.0));
  EXPECT_LE(std::abs(estimate->drift_ppm - 80.0), estimate->drift_within_ppm);
  EXPECT_LT(estimate->drift_within_ppm, 40.0) << "two ends of at most 6 ms each, ten minutes apart: 20 ppm, and room";
  EXPECT_LE(std::abs(static_cast<double>(estimate->ahead_ns) - network.ahead_at(1200.0)), estimate->within_ns);
  EXPECT_EQ(clock.steps(), 0u);
}

TEST(PeerClock, BeginsAnewWhenAClockWasSet) {
  Network network{};
  PeerClock clock;
  for (int i = 0; i < 40; ++i) network.exchange(clock, i);
  network.ahead_ns = -3e9;
  network.exchange(clock, 40);
  EXPECT_EQ(clock.steps(), 1u);
  EXPECT_NEAR(static_cast<double>(clock.at(at_s(40.0))->ahead_ns), -3e9, 6e6);
}

TEST(PeerClock, LeavesOutWhatNoClockCanHaveSaid) {
  PeerClock clock;
  clock.add({WallTime{1000}, WallTime{5000}, WallTime{4000}, WallTime{9000}}, at_s(0));  // answered before it heard
  clock.add({WallTime{1000}, WallTime{1000}, WallTime{9000}, WallTime{2000}}, at_s(0));  // thought longer than it took
  EXPECT_EQ(clock.exchanges(), 0u);
  EXPECT_FALSE(clock.at(at_s(0)));
}

// ---- on the bus: every process at an address of its own, as on as many machines

Rig rig_of_places() {
  Rig rig;
  rig.file = "test.toml";
  rig.channels.resize(2);
  rig.port_base = static_cast<std::uint16_t>(25000 + getpid() % 900 * 30);
  rig.places = {{"", "127.0.0.2"}, {"", "127.0.0.3"}, {"", "127.0.0.4"}, {"", "127.0.0.5"}};
  rig.channels[0].place.send_to = "127.0.0.6";
  rig.channels[1].place.send_to = "127.0.0.7";
  return rig;
}

TEST(Places, EveryRoleIsReachedWhereItIs) {
  const Rig rig = rig_of_places();
  auto cockpit = Bus::open(rig, Role::kCockpit), dynamics = Bus::open(rig, Role::kDynamics),
       recorder = Bus::open(rig, Role::kRecorder), left = Bus::open(rig, Role::kVisual, 0),
       right = Bus::open(rig, Role::kVisual, 1), asks = Bus::open_to_send(rig, Role::kControl);
  ASSERT_TRUE(cockpit && dynamics && recorder && left && right && asks);
  cockpit->send(SimTime{}, CockpitState{});
  for (auto* receiver : {&dynamics, &recorder, &left, &right}) EXPECT_EQ((*receiver)->poll(), 1u);
  // An answer goes back to the address that asked.
  RigControl tell{RigControl::Tell{}};
  tell.request_id = tell.first_open = 1;
  asks->send(SimTime{}, tell);
  dynamics->on_datagram = [&](const Datagram& datagram, std::span<const std::byte>) {
    if (std::holds_alternative<RigControl>(datagram.payload))
      dynamics->answer(SimTime{}, ControlReply{1, 1, Verdict::kAccepted, {}, {}});
  };
  dynamics->poll();
  EXPECT_EQ(asks->poll(), 1u);
}

TEST(Places, ToBindAndToSendToMayDiffer) {
  Rig rig = rig_of_places();
  rig.places.dynamics = {"127.0.0.1", "127.0.0.3"};
  EXPECT_EQ(address_to_bind(rig, Role::kDynamics), "127.0.0.1");
  EXPECT_EQ(address_to_bind(rig, Role::kCockpit), "127.0.0.2") << "without bind, where it is reached";
  EXPECT_EQ(text_of(endpoint_of(rig, Role::kDynamics)), "127.0.0.3:" + std::to_string(rig.port_base + 1));
  EXPECT_EQ(text_of(endpoint_of(rig, Role::kVisual, 1)), "127.0.0.7:" + std::to_string(rig.port_base + 11));
  EXPECT_TRUE(has_places(rig));
  EXPECT_FALSE(has_places(Rig{}));
}

TEST(Places, BeyondThisMachineNobodySpeaksWithoutAKey) {
  Rig rig = rig_of_places();
  rig.places.dynamics.send_to = "10.0.0.1";
  const auto without = Bus::open(rig, Role::kCockpit);
  ASSERT_FALSE(without);
  EXPECT_NE(without.error().text().find("10.0.0.1 lies off loopback: a key_file is required"), std::string::npos);
  rig.places.dynamics.send_to = "car";
  EXPECT_FALSE(Bus::open(rig, Role::kCockpit));
}

// Two clocks in one process cannot differ, so the estimate must hold zero within what it says.
TEST(Places, ClocksAreComparedAndTheComparisonIsTold) {
  const Rig rig = rig_of_places();
  auto cockpit = Bus::open(rig, Role::kCockpit), dynamics = Bus::open(rig, Role::kDynamics),
       visual = Bus::open(rig, Role::kVisual, 0);
  ASSERT_TRUE(cockpit && dynamics && visual);
  for (int i = 0; i < 400 && visual->clocks()->peers()[1].clock.exchanges() < 9; ++i) {
    for (auto* bus : {&cockpit, &dynamics, &visual}) (*bus)->poll();
    std::this_thread::sleep_for(2ms);
  }
  const nlohmann::json json = stats_json("visual", *visual);
  for (const char* name : {"cockpit", "dynamics"}) {
    const nlohmann::json& clock = json["bus"]["clocks"][name];
    ASSERT_TRUE(clock.contains("ahead_ms")) << clock;
    EXPECT_LE(std::abs(clock["ahead_ms"].get<double>()), clock["within_ms"].get<double>());
    EXPECT_EQ(clock["set"], 0);
  }
  EXPECT_EQ(json["bus"]["clocks"]["visual-1"]["answered"], 0) << "is not there";
  EXPECT_EQ(json["bus"]["refused"], 0);
}

TEST(Places, NoClockIsComparedOnOneMachine) {
  Rig rig = rig_of_places();
  rig.places = {};
  for (ChannelConfig& channel : rig.channels) channel.place = {};
  auto cockpit = Bus::open(rig, Role::kCockpit), dynamics = Bus::open(rig, Role::kDynamics);
  ASSERT_TRUE(cockpit && dynamics);
  cockpit->poll();
  dynamics->poll();
  EXPECT_EQ(dynamics->counters().received[kPayloadIndex<ClockProbe>].received, 0u);
  EXPECT_FALSE(stats_json("cockpit", *cockpit)["bus"].contains("clocks"));
}

// ---- whose question it was

TEST(PeerClocks, TakeAnAnswerOnceAndToAQuestionOfOursOnly) {
  const Rig rig = rig_of_places();
  PeerClocks clocks(rig, Role::kVisual, 0);
  EXPECT_EQ(clocks.due(at_s(1)).size(), 3u) << "cockpit, dynamics, the other picture";
  EXPECT_TRUE(clocks.due(at_s(1.001)).empty());
  const ClockProbe question = clocks.question(WallTime{1'000'000'000});
  const ClockProbe answer{question.asked, WallTime{3'000'000'000}};
  const auto answered = [&](const ClockProbe& probe, Sender sender) {
    clocks.answered(probe, sender, 0, WallTime{3'000'100'000}, WallTime{1'001'000'000}, at_s(1));
  };
  answered({WallTime{999'999'999}, WallTime{9'000'000'000}}, Sender::kCockpit);
  EXPECT_EQ(clocks.ahead_ns(Sender::kCockpit, 0, at_s(1)), 0) << "not asked";
  answered(answer, Sender::kCockpit);
  answered(answer, Sender::kCockpit);
  EXPECT_EQ(clocks.peers()[0].clock.exchanges(), 1u) << "played again";
  // The way there took (3.0 - 1.0) s - 2 s = 0 or more: 2 s ahead, less half of the 0.9 ms under way.
  EXPECT_NEAR(static_cast<double>(clocks.ahead_ns(Sender::kCockpit, 0, at_s(1))), 2e9 - 0.45e6, 1.0);
  EXPECT_EQ(clocks.ahead_ns(Sender::kDynamics, 0, at_s(1)), 0);
}

TEST(PeerClocks, StampsOfTheCockpitAreReadInOurTime) {
  CockpitState state;
  state.light_change_wall = WallTime{5'000'000'000};
  Datagram datagram{Sender::kCockpit, 0, 1, 1, SimTime{}, WallTime{6'000'000'000}, state};
  to_our_clock(datagram, 100'000'000);
  EXPECT_EQ(datagram.sent.ns, 5'900'000'000);
  EXPECT_EQ(std::get<CockpitState>(datagram.payload).light_change_wall.ns, 4'900'000'000);
  EXPECT_EQ(std::get<CockpitState>(datagram.payload).source_stamp.ns, 0) << "none stays none";
  // Controls that the first picture hands on are stamped by its clock.
  Datagram start{Sender::kVisual, 0, 1, 1, SimTime{}, WallTime{6'000'000'000}, FrameStart{1, state, {}, false}};
  to_our_clock(start, 100'000'000);
  EXPECT_EQ(std::get<FrameStart>(start.payload).controls.light_change_wall.ns, 4'900'000'000);
}

}  // namespace
}  // namespace phare
