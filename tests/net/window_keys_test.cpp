// unit: the keys of windows survive lost messages, a lost focus, a window that is killed and one that takes its place.
#include "net/window_keys.h"

#include <gtest/gtest.h>

namespace phare {
namespace {

constexpr std::uint32_t kUp = 265;
using Presses = std::vector<std::uint32_t>;

WallTime at_ms(std::int64_t ms) {
  return WallTime{1'000'000'000'000 + ms * 1'000'000};
}

TEST(WindowKeys, APressIsOneHoweverOftenItIsTold) {
  WindowKeys keys;
  for (int i = 0; i < 5; ++i) keys.take(0, 7, {{'h'}, {'h'}, 1}, at_ms(20 * i));
  EXPECT_EQ(keys.take_presses(), Presses{'h'});
  EXPECT_TRUE(keys.held(at_ms(100)).test('h'));
  keys.take(0, 7, {{}, {'h', -'h', 'h', -'h'}, 4}, at_ms(120));
  EXPECT_EQ(keys.take_presses(), Presses{'h'}) << "the second press";
  EXPECT_TRUE(keys.held(at_ms(120)).none());
}

TEST(WindowKeys, ALostMessageLosesNoPressAndLeavesNothingHeld) {
  WindowKeys keys;
  keys.take(0, 7, {{kUp}, {static_cast<int>(kUp)}, 1}, at_ms(0));
  // The messages with the release and with two presses of h are lost; a later one tells them again.
  keys.take(0, 7, {{}, {static_cast<int>(kUp), -static_cast<int>(kUp), 'h', -'h', 'h', -'h'}, 6}, at_ms(80));
  EXPECT_EQ(keys.take_presses(), (Presses{kUp, 'h', 'h'}));
  EXPECT_TRUE(keys.held(at_ms(80)).none());
  // What had to be left out of the message cannot be pressed, but nothing is pressed twice either.
  keys.take(0, 7, {{}, {'l', -'l'}, 40}, at_ms(100));
  EXPECT_EQ(keys.take_presses(), Presses{'l'});
}

TEST(WindowKeys, AWindowThatFellSilentHoldsNothing) {
  WindowKeys keys;
  keys.take(0, 7, {{kUp}, {}, 0}, at_ms(0));
  EXPECT_TRUE(keys.held(at_ms(999)).test(kUp));
  EXPECT_FALSE(keys.held(at_ms(1001)).test(kUp));
}

TEST(WindowKeys, AWindowInItsPlaceCountsAnew) {
  WindowKeys keys;
  keys.take(0, 7, {{}, {'h', -'h'}, 90}, at_ms(0));
  keys.take_presses();
  keys.take(0, 8, {{}, {'n'}, 1}, at_ms(10));
  EXPECT_EQ(keys.take_presses(), Presses{'n'});
}

TEST(WindowKeys, WindowsHoldTogether) {
  WindowKeys keys;
  keys.take(0, 7, {{kUp}, {}, 0}, at_ms(0));
  keys.take(1, 9, {{'f'}, {}, 0}, at_ms(0));
  EXPECT_EQ(keys.held(at_ms(1)).count(), 2u);
}

}  // namespace
}  // namespace phare
