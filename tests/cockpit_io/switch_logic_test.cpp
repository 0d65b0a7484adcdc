// Every row of the state table, every change between stalk positions, debounce, fail-safe, counts and stamps.
#include "cockpit_io/switch_logic.h"

#include <gtest/gtest.h>

#include <vector>

namespace phare {
namespace {

constexpr std::int64_t kMs = 1'000'000;

Moment at_ms(double ms) {
  const auto ns = static_cast<std::int64_t>(ms * 1e6);
  return {SimTime{ns}, WallTime{1'000'000'000'000 + ns}};
}

struct Stalk {
  SwitchParams params{20 * kMs, 3};
  SwitchState state;
  SwitchInput input;
  void step(double ms, bool silent = false) { advance_switches(params, input, silent, at_ms(ms), state); }
};

std::vector<SwitchInput> every_input() {
  std::vector<SwitchInput> all;
  for (const LightSwitch stalk : {LightSwitch::kOff, LightSwitch::kPosition, LightSwitch::kLow, LightSwitch::kHigh}) {
    for (int bits = 0; bits < 16; ++bits) {
      SwitchInput input;
      input.stalk = stalk;
      input.high = (bits & 1) != 0;
      input.flash = (bits & 2) != 0;
      input.fog_front = (bits & 4) != 0;
      input.ignition = (bits & 8) == 0;
      all.push_back(input);
    }
  }
  return all;
}

/// The state table of the header, row by row, written independently of the code.
Lights expected(const SwitchInput& in, bool silent) {
  if (in.ignition && silent) return {LightSwitch::kLow, false, false, 0};
  if (!in.ignition)
    return {in.stalk == LightSwitch::kPosition ? LightSwitch::kPosition : LightSwitch::kOff, false, false, 0};
  switch (in.stalk) {
    case LightSwitch::kOff:
      return {LightSwitch::kOff, in.flash, false, 0};
    case LightSwitch::kPosition:
      return {LightSwitch::kPosition, in.flash, in.fog_front, 0};
    case LightSwitch::kLow:
      return {in.high ? LightSwitch::kHigh : LightSwitch::kLow, in.flash, in.fog_front, 0};
    case LightSwitch::kHigh:
      return {LightSwitch::kHigh, in.flash, in.fog_front, 0};
  }
  return {};
}

TEST(SwitchLogic, EveryTransition) {
  for (const SwitchInput& from : every_input()) {
    for (const SwitchInput& to : every_input()) {
      for (int silent = 0; silent < 4; ++silent) {  // before, after
        Stalk stalk;
        stalk.input = from;
        stalk.step(0, (silent & 1) != 0);
        const Lights before = stalk.state.lights;
        ASSERT_EQ(before, expected(from, (silent & 1) != 0));
        const std::uint64_t changes = stalk.state.light_changes;
        ASSERT_EQ(changes, before == Lights{} ? 0u : 1u);
        stalk.input = to;
        stalk.step(100, (silent & 2) != 0);
        ASSERT_EQ(stalk.state.lights, expected(to, (silent & 2) != 0));
        ASSERT_EQ(stalk.state.light_changes, changes + (stalk.state.lights == before ? 0 : 1));
        if (stalk.state.lights != before) {
          ASSERT_EQ(stalk.state.light_change, at_ms(100));
        }
        ASSERT_EQ(stalk.state.fail_safe, (silent & 2) != 0);
      }
    }
  }
}

TEST(SwitchLogic, DebounceTakesTheFirstEdgeAndIgnoresTheBounce) {
  Stalk stalk;
  stalk.step(0);
  for (int bounce = 0; bounce < 9; ++bounce) {  // 2 ms apart: on, off, on … ends on
    stalk.input.flash = bounce % 2 == 0;
    stalk.step(100 + 2 * bounce);
    EXPECT_TRUE(stalk.state.lights.flash);
  }
  stalk.step(150);
  EXPECT_EQ(stalk.state.light_changes, 1u);
  EXPECT_EQ(stalk.state.light_change, at_ms(100));
}

TEST(SwitchLogic, AShortPressEndsWhenTheContactHasSettled) {
  Stalk stalk;
  stalk.step(0);
  stalk.input.flash = true;
  stalk.step(100);
  stalk.input.flash = false;
  stalk.step(105);
  EXPECT_TRUE(stalk.state.lights.flash);
  stalk.step(119.9);
  EXPECT_TRUE(stalk.state.lights.flash);
  stalk.step(120);
  EXPECT_FALSE(stalk.state.lights.flash);
  EXPECT_EQ(stalk.state.light_changes, 2u);
  EXPECT_EQ(stalk.state.light_change, at_ms(105));  // when the contact moved, not when the logic noticed
}

TEST(SwitchLogic, DesignStepsOncePerPressAndWraps) {
  Stalk stalk;
  double ms = 0;
  const auto press = [&](bool SwitchInput::*button) {
    stalk.input.*button = true;
    stalk.step(ms += 50);
    stalk.step(ms += 50);  // held: no second step
    stalk.input.*button = false;
    stalk.step(ms += 50);
    return stalk.state.lights.design_index;
  };
  EXPECT_EQ(press(&SwitchInput::design_next), 1u);
  EXPECT_EQ(press(&SwitchInput::design_next), 2u);
  EXPECT_EQ(press(&SwitchInput::design_next), 0u);
  EXPECT_EQ(press(&SwitchInput::design_previous), 2u);
  EXPECT_EQ(press(&SwitchInput::design_previous), 1u);
  EXPECT_EQ(stalk.state.light_changes, 5u);
  choose_design(stalk.params, 8, at_ms(1000), stalk.state);
  EXPECT_EQ(stalk.state.lights.design_index, 2u);
  EXPECT_EQ(stalk.state.light_changes, 6u);

  Stalk single;
  single.params.design_count = 1;
  single.input.design_next = true;
  single.step(10);
  EXPECT_EQ(single.state.lights.design_index, 0u);
  EXPECT_EQ(single.state.light_changes, 0u);
}

TEST(SwitchLogic, FailSafeKeepsTheDesignAndGoesBack) {
  Stalk stalk;
  stalk.input.stalk = LightSwitch::kHigh;
  stalk.input.design_next = true;
  stalk.step(0);
  stalk.step(500, true);
  EXPECT_EQ(stalk.state.lights, (Lights{LightSwitch::kLow, false, false, 1}));
  EXPECT_EQ(stalk.state.light_change, at_ms(500));
  stalk.step(600, true);
  EXPECT_EQ(stalk.state.light_changes, 2u);
  stalk.step(700, false);
  EXPECT_EQ(stalk.state.lights, (Lights{LightSwitch::kHigh, false, false, 1}));
  EXPECT_EQ(stalk.state.light_change, at_ms(700));
}

}  // namespace
}  // namespace phare
