#include "net/inbox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

namespace phare {
namespace {

constexpr std::uint64_t kStart = 0xabc;

InboxCounters counted(const std::vector<std::uint64_t>& sequences) {
  SequenceTracker tracker;
  for (const std::uint64_t sequence : sequences) tracker.arrived(kStart, sequence);
  return tracker.counters();
}

TEST(Sequences, InOrder) {
  EXPECT_EQ(counted({1, 2, 3, 4}), (InboxCounters{4, 0, 0, 0, 0}));
}

TEST(Sequences, GapsAreLost) {
  EXPECT_EQ(counted({1, 2, 5, 9}), (InboxCounters{4, 5, 0, 0, 0}));
}

TEST(Sequences, AStragglerIsLateAndNoLongerLost) {
  EXPECT_EQ(counted({1, 3, 2, 4}), (InboxCounters{3, 0, 1, 0, 0}));
}

TEST(Sequences, RepeatsAreDuplicates) {
  EXPECT_EQ(counted({1, 2, 2, 1, 3, 2}), (InboxCounters{3, 0, 0, 3, 0}));
}

TEST(Sequences, ALateOneTwiceIsADuplicate) {
  EXPECT_EQ(counted({1, 3, 2, 2}), (InboxCounters{2, 0, 1, 1, 0}));
}

TEST(Sequences, WhoListensLaterHasLostNothing) {
  EXPECT_EQ(counted({1000, 1001}), (InboxCounters{2, 0, 0, 0, 0}));
  EXPECT_EQ(counted({1000, 1001, 999}), (InboxCounters{2, 0, 1, 0, 0}));
}

TEST(Sequences, AGapWiderThanTheWindow) {
  EXPECT_EQ(counted({1, 2, 100'000, 99'999, 2}), (InboxCounters{3, 99'996, 2, 0, 0}));
}

TEST(Sequences, TellsTheRepeatOfTheNewest) {
  SequenceTracker tracker;
  EXPECT_EQ(tracker.arrived(kStart, 1), Arrival::kNewest);
  EXPECT_EQ(tracker.arrived(kStart, 2), Arrival::kNewest);
  EXPECT_EQ(tracker.arrived(kStart, 2), Arrival::kNewestAgain);
  EXPECT_EQ(tracker.arrived(kStart, 1), Arrival::kDuplicate);
}

TEST(Sequences, ARestartedSenderIsTakenAndItsOldStragglersAreLate) {
  SequenceTracker tracker;
  for (std::uint64_t sequence = 1; sequence <= 100; ++sequence) tracker.arrived(1, sequence);
  EXPECT_EQ(tracker.arrived(2, 1), Arrival::kNewest);
  EXPECT_EQ(tracker.arrived(1, 100), Arrival::kLate);
  EXPECT_EQ(tracker.arrived(2, 2), Arrival::kNewest);
  EXPECT_EQ(tracker.counters(), (InboxCounters{102, 0, 1, 0, 1}));
  EXPECT_EQ(tracker.arrived(3, 4), Arrival::kNewest);  // its first three got lost
  EXPECT_EQ(tracker.arrived(3, 1), Arrival::kLate);    // no, one comes late
  EXPECT_EQ(tracker.arrived(2, 2), Arrival::kLate);
  EXPECT_EQ(tracker.arrived(1, 99), Arrival::kLate);
  EXPECT_EQ(tracker.counters(), (InboxCounters{103, 2, 4, 0, 2}));
}

TEST(Sequences, AStartThatComesBackGoesOnWithItsNumbers) {
  SequenceTracker tracker;
  for (std::uint64_t sequence = 1; sequence <= 100; ++sequence) tracker.arrived(1, sequence);
  EXPECT_EQ(tracker.arrived(2, 1), Arrival::kNewest);
  EXPECT_EQ(tracker.arrived(1, 180), Arrival::kNewest);
  EXPECT_EQ(tracker.arrived(1, 181), Arrival::kNewest);
  EXPECT_EQ(tracker.arrived(2, 1), Arrival::kLate);
  EXPECT_EQ(tracker.counters(), (InboxCounters{103, 0, 1, 0, 2}));
}

constexpr Endpoint kHere{0x7f000001, 47000}, kElsewhere{0x7f000001, 50000};

LiveSender::Time heard_at_ms(int ms) {
  return LiveSender::Time{} + std::chrono::hours(1) + std::chrono::milliseconds(ms);
}

TEST(LiveSender, AStrangerWaitsUntilTheFirstIsSilent) {
  LiveSender live(std::chrono::milliseconds(200));
  EXPECT_TRUE(live.admits(1, kHere, heard_at_ms(0)));
  EXPECT_FALSE(live.admits(2, kElsewhere, heard_at_ms(100)));
  EXPECT_TRUE(live.admits(1, kHere, heard_at_ms(150)));
  EXPECT_FALSE(live.admits(2, kElsewhere, heard_at_ms(349)));  // what is refused does not count as heard
  EXPECT_TRUE(live.admits(2, kElsewhere, heard_at_ms(350)));
}

TEST(LiveSender, NobodyIsMuteForGood) {
  LiveSender live(std::chrono::milliseconds(200));
  EXPECT_TRUE(live.admits(1, kHere, heard_at_ms(0)));
  EXPECT_TRUE(live.admits(2, kElsewhere, heard_at_ms(300)));  // one stray datagram while the first hung
  EXPECT_FALSE(live.admits(1, kHere, heard_at_ms(310)));
  EXPECT_TRUE(live.admits(1, kHere, heard_at_ms(500)));
  EXPECT_TRUE(live.admits(1, kHere, heard_at_ms(510)));
}

TEST(LiveSender, WhoHoldsThePortOfTheFirstIsTheFirstStartedAgain) {
  LiveSender live(std::chrono::milliseconds(200));
  EXPECT_TRUE(live.admits(1, kHere, heard_at_ms(0)));
  EXPECT_TRUE(live.admits(2, kHere, heard_at_ms(1)));
  EXPECT_FALSE(live.admits(1, kHere, heard_at_ms(2)));  // a straggler of the start before
  EXPECT_TRUE(live.admits(2, kHere, heard_at_ms(3)));
}

TEST(LiveSender, TimeThatGoesBackDoesNotMakeAnyoneSilent) {
  LiveSender live(std::chrono::milliseconds(200));
  EXPECT_TRUE(live.admits(1, kHere, heard_at_ms(1000)));
  EXPECT_FALSE(live.admits(2, kElsewhere, heard_at_ms(0)));
  EXPECT_TRUE(live.admits(1, kHere, heard_at_ms(10)));
  EXPECT_TRUE(live.admits(2, kElsewhere, heard_at_ms(1200)));
}

TEST(Sequences, CountsAddUpUnderLossReorderingAndDuplication) {
  std::mt19937_64 random(42);
  for (int round = 0; round < 20; ++round) {
    // Each of 1…5000 gets a place near its own; some never come, some come twice.
    constexpr std::uint64_t kCount = 5000;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> arrivals;
    std::set<std::uint64_t> came;
    for (std::uint64_t sequence = 1; sequence <= kCount; ++sequence) {
      const bool edge = sequence == 1 || sequence == kCount;
      if (!edge && random() % 10 == 0) continue;
      came.insert(sequence);
      const std::uint64_t delay = edge || random() % 5 != 0 ? 0 : random() % 200;
      arrivals.emplace_back(sequence + delay, sequence);
      if (random() % 20 == 0) arrivals.emplace_back(sequence + delay + random() % 100, sequence);
    }
    std::stable_sort(arrivals.begin(), arrivals.end(), [](auto& a, auto& b) { return a.first < b.first; });

    SequenceTracker tracker;
    std::set<std::uint64_t> seen;
    InboxCounters expected;
    std::uint64_t newest = 0;
    for (const auto& [place, sequence] : arrivals) {
      tracker.arrived(kStart, sequence);
      if (!seen.insert(sequence).second) {
        ++expected.duplicate;
      } else if (sequence > newest) {
        newest = sequence;
        ++expected.received;
      } else {
        ++expected.late;
      }
    }
    expected.lost = kCount - came.size();
    ASSERT_EQ(tracker.counters(), expected) << "round " << round;
    ASSERT_EQ(expected.received + expected.late + expected.lost, newest);
  }
}

TEST(Inbox, KeepsTheNewestAndGivesItOnce) {
  Inbox<RigControl> inbox;
  Datagram d;
  d.start_id = 7;
  const auto deliver = [&](std::uint64_t sequence, std::uint32_t design, bool repeat_is_news) {
    d.sequence = sequence;
    inbox.deliver(d, RigControl{RigControl::Design{design}}, ArrivalTime{}, Endpoint{}, repeat_is_news);
  };
  EXPECT_EQ(inbox.newest(), nullptr);
  EXPECT_EQ(inbox.take(), nullptr);
  deliver(2, 20, false);
  deliver(1, 10, false);  // late
  ASSERT_NE(inbox.newest(), nullptr);
  EXPECT_EQ(inbox.newest()->value.command, decltype(RigControl::command)(RigControl::Design{20}));
  EXPECT_NE(inbox.take(), nullptr);
  EXPECT_EQ(inbox.take(), nullptr);
  deliver(2, 20, false);
  EXPECT_EQ(inbox.take(), nullptr);
  deliver(2, 20, true);
  EXPECT_NE(inbox.take(), nullptr);
}

}  // namespace
}  // namespace phare
