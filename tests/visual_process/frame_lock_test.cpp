// unit: the first of several pictures begins each frame for all, over loopback; who is silent holds nobody up.
#include "visual/process/frame_lock.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <thread>

namespace phare {
namespace {

using namespace std::chrono_literals;

class FrameLocks : public testing::Test {
 protected:
  FrameLocks() {
    Rig rig;
    rig.file = "test.toml";
    rig.channels.resize(3);
    for (int attempt = 0; attempt < 200 && !bus_[2]; ++attempt) {
      rig.port_base = static_cast<std::uint16_t>(21000 + (getpid() * 7 + attempt) % 1300 * 30);
      for (std::uint32_t i = 0; i < 3; ++i) {
        auto bus = Bus::open(rig, Role::kVisual, i);
        if (!bus) break;
        bus_[i].emplace(std::move(*bus));
      }
    }
  }
  void hear(std::uint32_t channel) {
    bus_[channel]->wait(1s);
    bus_[channel]->poll();
  }
  void draws(std::uint32_t channel, FrameLock& lock) {
    FrameReport report;
    report.channel = channel, report.channels = 3, report.start = lock.number();
    bus_[channel]->send(SimTime{5}, report);
    hear(0);
  }
  std::array<std::optional<Bus>, 3> bus_;
  FrameLock first_{0, 3, false}, second_{1, 3, false}, third_{2, 3, false};
  FrameLock::Clock::time_point now_ = FrameLock::Clock::now();
};

TEST_F(FrameLocks, TheNextFrameBeginsWhenAllHaveDrawnThisOne) {
  ASSERT_TRUE(bus_[2]);
  ASSERT_TRUE(first_.may_begin(*bus_[0], now_));
  FrameStart start;
  start.controls.light_switch = LightSwitch::kHigh, start.pose.x_m = 7.0;
  // A picture that has never spoken is not waited for.
  first_.begin(*bus_[0], SimTime{5}, start, now_);
  for (std::uint32_t i : {1u, 2u}) {
    FrameLock& lock = i == 1 ? second_ : third_;
    hear(i);
    ASSERT_TRUE(lock.follows(*bus_[i], false, FrameLock::Clock::now()));
    const auto begun = lock.next(*bus_[i]);
    ASSERT_TRUE(begun);
    EXPECT_EQ(begun->time.ns, 5);
    EXPECT_EQ(begun->start.pose.x_m, 7.0);
    EXPECT_EQ(begun->start.controls.light_switch, LightSwitch::kHigh);
    EXPECT_FALSE(lock.next(*bus_[i])) << "once";
  }
  draws(1, second_), draws(2, third_);
  EXPECT_TRUE(first_.may_begin(*bus_[0], now_));
  first_.begin(*bus_[0], SimTime{6}, start, now_);
  EXPECT_FALSE(first_.may_begin(*bus_[0], now_)) << "both have spoken, and have not drawn this one";
  for (std::uint32_t i : {1u, 2u}) hear(i);
  ASSERT_TRUE(second_.next(*bus_[1]));
  ASSERT_TRUE(third_.next(*bus_[2]));
  draws(1, second_);
  EXPECT_FALSE(first_.may_begin(*bus_[0], now_));
  draws(2, third_);
  EXPECT_TRUE(first_.may_begin(*bus_[0], now_));
  EXPECT_EQ(first_.json(), (nlohmann::json{{"together", 2}, {"apart", 0}}));
  EXPECT_EQ(third_.json(), (nlohmann::json{{"together", 2}, {"alone", 0}}));
}

TEST_F(FrameLocks, WhatIsLostIsAskedForAgain) {
  ASSERT_TRUE(bus_[2]);
  first_.begin(*bus_[0], SimTime{5}, {}, now_);
  hear(1), hear(2);
  ASSERT_TRUE(second_.next(*bus_[1]));
  ASSERT_TRUE(third_.next(*bus_[2]));
  draws(1, second_), draws(2, third_);
  ASSERT_TRUE(first_.may_begin(*bus_[0], now_));
  first_.begin(*bus_[0], SimTime{6}, {}, now_);
  hear(1), hear(2);
  ASSERT_TRUE(second_.next(*bus_[1]));
  draws(1, second_);
  // The third has not heard of it (its datagram is taken here and thrown away): told again, it draws, and whose answer
  // was lost answers again.
  EXPECT_FALSE(first_.may_begin(*bus_[0], now_ + FrameLock::kAgain));
  hear(1), hear(2);
  EXPECT_FALSE(second_.next(*bus_[1])) << "answers, and does not draw it twice";
  hear(0);
  EXPECT_EQ(bus_[0]->counters().received[kPayloadIndex<FrameReport>].duplicate, 1u);
  ASSERT_TRUE(third_.next(*bus_[2]));
  draws(2, third_);
  EXPECT_TRUE(first_.may_begin(*bus_[0], now_));
}

TEST_F(FrameLocks, WhoIsSilentHoldsNobodyUp) {
  ASSERT_TRUE(bus_[2]);
  first_.begin(*bus_[0], SimTime{5}, {}, now_);
  EXPECT_TRUE(first_.may_begin(*bus_[0], now_)) << "nobody has ever spoken";
  first_.begin(*bus_[0], SimTime{6}, {}, now_);
  hear(1);
  while (second_.next(*bus_[1])) {
  }
  draws(1, second_);
  first_.begin(*bus_[0], SimTime{7}, {}, now_);
  EXPECT_FALSE(first_.may_begin(*bus_[0], now_ + FrameLock::kWait - 1ms));
  EXPECT_TRUE(first_.may_begin(*bus_[0], now_ + FrameLock::kWait)) << "slow";
  first_.begin(*bus_[0], SimTime{8}, {}, now_);
  EXPECT_TRUE(first_.may_begin(*bus_[0], now_)) << "silent since it was given up";
  EXPECT_EQ(first_.json()["apart"], 3);
  hear(1);
  const auto heard = bus_[1]->newest<FrameStart>()->heard;
  EXPECT_TRUE(second_.follows(*bus_[1], false, heard + FrameLock::kAlone - 1ms));
  EXPECT_FALSE(second_.follows(*bus_[1], false, heard + FrameLock::kAlone)) << "draws by its own clock";
  EXPECT_TRUE(second_.follows(*bus_[1], true, heard + FrameLock::kBeam - 1ms));
  EXPECT_FALSE(second_.follows(*bus_[1], true, heard + FrameLock::kBeam)) << "another beam is wanted";
  second_.drew_alone();
  EXPECT_EQ(second_.json()["alone"], 1);
}

TEST_F(FrameLocks, OneChannelAndLockstepNeedNone) {
  ASSERT_TRUE(bus_[2]);
  for (FrameLock lock : {FrameLock(0, 1, false), FrameLock(0, 3, true), FrameLock(2, 3, true)}) {
    EXPECT_FALSE(lock.leads());
    EXPECT_FALSE(lock.follows(*bus_[0], false, now_));
    EXPECT_TRUE(lock.may_begin(*bus_[0], now_));
    lock.begin(*bus_[0], SimTime{5}, {}, now_);
    EXPECT_TRUE(lock.json().is_null());
  }
  EXPECT_EQ(bus_[0]->counters().sent[kPayloadIndex<FrameStart>], 0u);
}

}  // namespace
}  // namespace phare
