#include "net/clock.h"

#include <gtest/gtest.h>

#include <csignal>
#include <ctime>

namespace phare {
namespace {

__extension__ using Wide = __int128;

static_assert(frame_time(0, 60).ns == 0);
static_assert(frame_time(1, 60).ns == 16'666'666);
static_assert(frame_time(2, 60).ns == 33'333'333);
static_assert(frame_time(3, 60).ns == 50'000'000);
static_assert(frame_time(60, 60).ns == 1'000'000'000);

TEST(FrameTime, IsTheFloorOfTheExactQuotient) {
  for (const std::int64_t rate_hz : {24, 25, 30, 50, 60, 72, 90, 120, 144, 1000}) {
    for (std::int64_t k = 0; k < 100'000; k += 7) {
      const auto exact = static_cast<std::int64_t>(static_cast<Wide>(k) * 1'000'000'000 / rate_hz);
      ASSERT_EQ(frame_time(k, rate_hz).ns, exact) << k << " at " << rate_hz << " Hz";
    }
  }
}

TEST(FrameTime, DoesNotOverflowInAThousandYears) {
  const std::int64_t seconds = 9'000'000'000;
  EXPECT_EQ(frame_time(seconds * 60, 60).ns, seconds * 1'000'000'000);
}

TEST(WallClock, IsRealtime) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const std::int64_t ns = static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
  EXPECT_GE(wall_now().ns, ns);
  EXPECT_LT(wall_now().ns - ns, 10'000'000'000);
}

TEST(Pacer, LatenessDoesNotAddUp) {
  const auto start = std::chrono::steady_clock::now();
  Pacer pacer(std::chrono::milliseconds(2));
  std::int64_t periods = 0;
  while (periods < 50) periods += 1 + pacer.wait();
  const auto took = std::chrono::steady_clock::now() - start;
  EXPECT_GE(took, std::chrono::milliseconds(2 * 50));
  // A machine under load may be late, but then periods are skipped: the last deadline is where it belongs.
  EXPECT_LE(took, std::chrono::milliseconds(2 * (periods + 1)) + std::chrono::seconds(1));
}

TEST(Pacer, SkipsWhatWasMissed) {
  Pacer pacer(std::chrono::milliseconds(1));
  timespec nap{0, 10'500'000};
  nanosleep(&nap, nullptr);
  EXPECT_GE(pacer.wait(), 9);
  EXPECT_GE(pacer.late(), std::chrono::milliseconds(9));
  EXPECT_LE(pacer.left(), std::chrono::milliseconds(1));
}

TEST(StopSignals, SetTheFlag) {
  const StopFlag stop = install_stop_signals();
  ASSERT_FALSE(stop.requested());
  std::raise(SIGTERM);
  EXPECT_TRUE(stop.requested());
}

}  // namespace
}  // namespace phare
