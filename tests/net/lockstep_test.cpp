// unit: what the frame reports of several channels say together, over loopback.
#include "net/lockstep.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace phare {
namespace {

using namespace std::chrono_literals;

class Lockstep : public testing::Test {
 protected:
  Lockstep() {
    rig_.file = "test.toml";
    rig_.channels.resize(2);
    for (int attempt = 0; attempt < 200 && !cockpit_; ++attempt) {
      rig_.port_base = static_cast<std::uint16_t>(20000 + (getpid() * 7 + attempt) % 1300 * 30);
      auto cockpit = Bus::open(rig_, Role::kCockpit);
      auto left = Bus::open(rig_, Role::kVisual, 0), right = Bus::open(rig_, Role::kVisual, 1);
      if (!cockpit || !left || !right) continue;
      cockpit_.emplace(std::move(*cockpit));
      visual_[0].emplace(std::move(*left));
      visual_[1].emplace(std::move(*right));
    }
  }
  void report(std::uint32_t channel, std::int64_t frame) {
    FrameReport drawn;
    drawn.channel = channel;
    drawn.channels = 2;
    drawn.frame_index = frame;
    visual_[channel]->send(SimTime{}, drawn);
    cockpit_->wait(1s);
    cockpit_->poll();
  }
  /// How many CockpitStates have come to a channel since the last look.
  int heard(std::uint32_t channel) {
    int count = 0;
    const auto see = [&](const Datagram& datagram) {
      if (std::holds_alternative<CockpitState>(datagram.payload)) ++count;
    };
    visual_[channel]->on_datagram = [=](const Datagram& datagram, std::span<const std::byte>) { see(datagram); };
    visual_[channel]->on_repeat = see;
    visual_[channel]->wait(200ms);
    visual_[channel]->poll();
    return count;
  }

  Rig rig_;
  std::optional<Bus> cockpit_, visual_[2];
};

TEST_F(Lockstep, WaitsForEveryChannel) {
  ASSERT_TRUE(cockpit_);
  EXPECT_FALSE(newest_frame_of_all(*cockpit_));
  report(0, -1);
  EXPECT_FALSE(newest_frame_of_all(*cockpit_)) << "the other is not up";
  EXPECT_EQ(report_of_frame(*cockpit_, 3), nullptr);
  report(1, -1);
  EXPECT_EQ(newest_frame_of_all(*cockpit_), -1);
  EXPECT_TRUE(all_channels_at(*cockpit_, -1));
  report(1, 0);
  EXPECT_EQ(newest_frame_of_all(*cockpit_), 0);
  EXPECT_FALSE(all_channels_at(*cockpit_, 0)) << "one is a frame behind";
  ASSERT_NE(report_of_frame(*cockpit_, 0), nullptr);
  EXPECT_EQ(report_of_frame(*cockpit_, 0)->value.channel, 1u);
  report(0, 0);
  EXPECT_TRUE(all_channels_at(*cockpit_, 0));
}

TEST_F(Lockstep, SendsAgainToWhoIsLate) {
  ASSERT_TRUE(cockpit_);
  report(0, 0);
  report(1, 0);
  CockpitState state;
  state.frame_index = 1;
  cockpit_->send(SimTime{}, state);
  EXPECT_EQ(heard(0), 1);
  EXPECT_EQ(heard(1), 1);
  send_again_to_late(*cockpit_, 1, kPayloadIndex<CockpitState>);  // both are at 0: twice
  EXPECT_EQ(heard(0), 2);
  send_again_to_late(*cockpit_, 1, kPayloadIndex<CockpitState>);
  EXPECT_EQ(heard(0), 0) << "each report asks once";
  report(0, 1);
  send_again_to_late(*cockpit_, 1, kPayloadIndex<CockpitState>);
  EXPECT_EQ(heard(0), 0) << "it has it";
}

// Who waits for a picture that takes long is not replaced by a stranger as if it had gone.
TEST_F(Lockstep, WhoWaitsForASlowPictureStaysTheOneThatSpeaks) {
  ASSERT_TRUE(cockpit_);
  StaysHeard stays_heard(kPayloadIndex<CockpitState>);
  CockpitState state;
  state.frame_index = 1;
  stays_heard.step(*cockpit_);
  cockpit_->send(SimTime{}, state);
  const auto until = std::chrono::steady_clock::now() + 2 * taken_over_after(channel_of<CockpitState>());
  while (std::chrono::steady_clock::now() < until) {
    stays_heard.step(*cockpit_);
    std::this_thread::sleep_for(5ms);
  }
  auto stranger = Bus::open_to_send(rig_, Role::kCockpit);
  ASSERT_TRUE(stranger);
  stranger->send(SimTime{}, state);
  visual_[0]->poll();  // only now: it was drawing
  const auto& counters = visual_[0]->counters();
  EXPECT_EQ(counters.refused_because[static_cast<std::size_t>(Refusal::kSecond)], 1u);
  EXPECT_EQ(counters.received[kPayloadIndex<CockpitState>].received, 1u);
  EXPECT_GE(counters.received[kPayloadIndex<CockpitState>].duplicate, 3u);
}

}  // namespace
}  // namespace phare
