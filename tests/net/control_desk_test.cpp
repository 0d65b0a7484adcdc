// unit: commands are done once and in order, whoever sends them, however often and with whatever lost on the way.
#include "net/control_desk.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <random>

namespace phare {
namespace {

RigControl numbered(std::uint64_t id, std::uint64_t first_open) {
  RigControl control{RigControl::Design{static_cast<std::uint32_t>(id)}};
  control.request_id = id;
  control.first_open = first_open;
  return control;
}

/// Does what it is told by writing it down.
struct Clerk {
  ControlDesk desk;
  std::vector<std::uint32_t> done;
  std::optional<ControlReply> take(std::uint64_t start_id, const RigControl& control) {
    return desk.take(start_id, control, [this](const RigControl& c) {
      done.push_back(std::get<RigControl::Design>(c.command).index);
      return accepted("done");
    });
  }
};

TEST(ControlDesk, ARequestThatComesAgainIsAnsweredAgainAndDoneOnce) {
  Clerk clerk;
  for (int again = 0; again < 3; ++again) {
    const auto answer = clerk.take(7, numbered(1, 1));
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->to_start_id, 7u);
    EXPECT_EQ(answer->request_id, 1u);
    EXPECT_EQ(answer->now, "done");
  }
  EXPECT_EQ(clerk.done, (std::vector<std::uint32_t>{1}));
}

TEST(ControlDesk, WhatOvertakesALostOneWaitsForIt) {
  Clerk clerk;
  EXPECT_FALSE(clerk.take(7, numbered(2, 1)));  // the first was lost: nobody has heard of this sender before
  EXPECT_FALSE(clerk.take(7, numbered(3, 1)));
  EXPECT_TRUE(clerk.take(7, numbered(1, 1)));
  EXPECT_TRUE(clerk.take(7, numbered(2, 1)));
  EXPECT_TRUE(clerk.take(7, numbered(3, 1)));
  EXPECT_EQ(clerk.done, (std::vector<std::uint32_t>{1, 2, 3}));
}

TEST(ControlDesk, AReceiverThatIsNewBeginsWhereTheSenderStands) {
  Clerk clerk;
  EXPECT_FALSE(clerk.take(7, numbered(52, 50)));
  EXPECT_TRUE(clerk.take(7, numbered(50, 50)));
  EXPECT_FALSE(clerk.take(7, numbered(49, 49)));  // answered before, elsewhere
  EXPECT_EQ(clerk.done, (std::vector<std::uint32_t>{50}));
}

TEST(ControlDesk, SendersDoNotDisturbEachOther) {
  Clerk clerk;
  for (std::uint64_t id = 1; id <= 5; ++id) {
    EXPECT_TRUE(clerk.take(1, numbered(id, id)));
    EXPECT_TRUE(clerk.take(100 + id, numbered(1, 1)));  // one command each, as `phare control` is run by hand
  }
  EXPECT_EQ(clerk.done.size(), 10u);
}

TEST(ControlDesk, AnAnswerThatWasPendingIsAskedForAgain) {
  ControlDesk desk;
  int asked = 0;
  const auto act = [&](const RigControl&) { return ++asked < 3 ? pending("not yet") : accepted("there"); };
  EXPECT_EQ(desk.take(1, numbered(1, 1), act)->verdict, Verdict::kPending);
  EXPECT_EQ(desk.take(1, numbered(1, 1), act)->verdict, Verdict::kPending);
  EXPECT_EQ(desk.take(1, numbered(1, 1), act)->verdict, Verdict::kAccepted);
  EXPECT_EQ(desk.take(1, numbered(1, 1), act)->now, "there");
  EXPECT_EQ(asked, 3);
}

TEST(ControlDesk, WithoutANumberThereIsNoAnswer) {
  Clerk clerk;
  EXPECT_FALSE(clerk.take(1, RigControl{RigControl::Design{4}}));
  EXPECT_EQ(clerk.done, (std::vector<std::uint32_t>{4}));
}

TEST(ControlDesk, DoesAllOnceInOrderUnderLossRepetitionAndReordering) {
  std::mt19937_64 random(11);
  Clerk clerk;
  constexpr std::uint64_t kCount = 500;
  std::uint64_t open = 1;  // oldest without an answer
  for (int round = 0; open <= kCount; ++round) {
    ASSERT_LT(round, 100'000);
    std::vector<std::uint64_t> ids;
    for (std::uint64_t id = open; id <= std::min(kCount, open + ControlDesk::kWindow - 1); ++id)
      for (std::uint64_t copies = random() % 3; copies > 0; --copies) ids.push_back(id);
    if (random() % 2 == 0) std::shuffle(ids.begin(), ids.end(), random);
    const std::uint64_t first_open = open;
    for (const std::uint64_t id : ids) {
      const auto answer = clerk.take(9, numbered(id, first_open));
      if (answer && random() % 4 != 0 && answer->request_id == open) ++open;
    }
  }
  ASSERT_EQ(clerk.done.size(), kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) EXPECT_EQ(clerk.done[i], i + 1);
}

// ---- on the bus

Rig free_rig() {
  static std::uint16_t base = static_cast<std::uint16_t>(21000 + (getpid() % 1000) * 30);
  Rig rig;
  rig.channels.resize(1);
  for (int attempt = 0; attempt < 200; ++attempt) {
    base = static_cast<std::uint16_t>(base + 30 > 60000 ? 21000 : base + 30);
    bool free = true;
    for (std::uint16_t offset = 0; offset < 30 && free; ++offset)
      free = UdpSocket::open("127.0.0.1", static_cast<std::uint16_t>(base + offset)).ok();
    if (free) break;
  }
  rig.port_base = base;
  return rig;
}

TEST(Bus, AnAnswerGoesToWhoAskedAndToNobodyElse) {
  const Rig rig = free_rig();
  auto cockpit = Bus::open(rig, Role::kCockpit), drive = Bus::open(rig, Role::kControl);
  auto one = Bus::open_to_send(rig, Role::kControl), other = Bus::open_to_send(rig, Role::kControl);
  ASSERT_TRUE(cockpit && drive && one && other);
  ControlDesk desk;
  cockpit->on_datagram = [&](const Datagram& datagram, std::span<const std::byte>) {
    desk.serve(*cockpit, datagram, [](const RigControl&) { return accepted("yes"); });
  };
  one->send(SimTime{}, numbered(1, 1));
  cockpit->poll();
  EXPECT_EQ(one->poll(), 1u);
  EXPECT_EQ(other->poll(), 0u);
  EXPECT_EQ(drive->poll(), 0u);
  ASSERT_NE(one->newest<ControlReply>(), nullptr);
  EXPECT_EQ(one->newest<ControlReply>()->value, (ControlReply{one->start_id(), 1, Verdict::kAccepted, "", "yes"}));
}

/// `… | phare control -` goes on while `phare control` is run beside it, again and again.
TEST(Bus, ManySendersOfCommandsSpeakAtTheSameTime) {
  const Rig rig = free_rig();
  auto cockpit = Bus::open(rig, Role::kCockpit);
  auto stream = Bus::open_to_send(rig, Role::kControl);
  ASSERT_TRUE(cockpit && stream);
  std::size_t heard = 0;
  cockpit->on_datagram = [&](const Datagram&, std::span<const std::byte>) { ++heard; };
  constexpr std::size_t kTimes = 100;  // more starts than are known at a time
  for (std::uint64_t id = 1; id <= kTimes; ++id) {
    stream->send(SimTime{}, numbered(id, id));
    auto once = Bus::open_to_send(rig, Role::kControl);
    ASSERT_TRUE(once);
    once->send(SimTime{}, numbered(1, 1));
    cockpit->poll();
  }
  EXPECT_EQ(heard, 2 * kTimes);
  EXPECT_EQ(cockpit->counters().received[kPayloadIndex<RigControl>], (InboxCounters{2 * kTimes, 0, 0, 0, 0}));
}

TEST(ManyStarts, CountsEachSequenceAndForgetsTheStartHeardLongestAgo) {
  ManyStarts starts;
  EXPECT_EQ(starts.arrived(1, 1), Arrival::kNewest);
  EXPECT_EQ(starts.arrived(2, 1), Arrival::kNewest);
  EXPECT_EQ(starts.arrived(1, 3), Arrival::kNewest);
  EXPECT_EQ(starts.arrived(1, 3), Arrival::kNewestAgain);
  EXPECT_EQ(starts.arrived(2, 1), Arrival::kNewestAgain);
  EXPECT_EQ(starts.counters(), (InboxCounters{3, 1, 0, 2, 0}));
  for (std::uint64_t id = 10; id < 10 + ManyStarts::kMost - 1; ++id) starts.arrived(id, 1);
  EXPECT_EQ(starts.arrived(2, 1), Arrival::kNewestAgain);  // heard later than 1: still known
  EXPECT_EQ(starts.arrived(1, 3), Arrival::kNewest);       // forgotten
}

Datagram command_of(std::uint64_t start_id, std::int64_t sent_s) {
  Datagram d{Sender::kControl, 0, start_id, 1, SimTime{}, WallTime{sent_s * 1'000'000'000}, RigControl{}};
  return d;
}

TEST(Replays, OfSendersThatSpeakAtTheSameTime) {
  Replays replays(Replays::kClocksApart);
  std::int64_t now_s = 1000;
  const auto is_replay = [&](std::uint64_t start_id, std::int64_t sent_s) {
    now_s = std::max(now_s, sent_s);
    return replays.is_replay(command_of(start_id, sent_s), WallTime{now_s * 1'000'000'000});
  };
  EXPECT_FALSE(is_replay(1, 1000));
  EXPECT_FALSE(is_replay(2, 1005));
  EXPECT_FALSE(is_replay(1, 1006));  // the first goes on
  EXPECT_FALSE(is_replay(3, 998));   // a clock that is some seconds behind
  EXPECT_TRUE(is_replay(4, 900));    // of an earlier evening
  EXPECT_TRUE(is_replay(1, 990));    // of this evening, and of one who is known
  for (std::uint64_t id = 100; id < 100 + ManyStarts::kMost; ++id) EXPECT_FALSE(is_replay(id, 1007));
  EXPECT_TRUE(is_replay(2, 1005));   // forgotten, and so is not taken for new
  EXPECT_FALSE(is_replay(2, 1008));  // it speaks itself
}

}  // namespace
}  // namespace phare
