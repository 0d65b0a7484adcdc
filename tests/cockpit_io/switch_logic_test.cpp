// Every row and every transition of the state tables, debounce, fail-safe, telltales, counts and stamps.
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

// ---- rear fog, the second table: off, wanted (its switch moved while position lamps burn), lit

/// Moves on and answers whether rear fog is lit.
bool rear_fog(Stalk& stalk, double ms, LightSwitch light, bool contact, bool front = false, bool silent = false,
              bool ignition = true) {
  stalk.input.stalk = light;
  stalk.input.fog_rear = contact;
  stalk.input.fog_front = front;
  stalk.input.ignition = ignition;
  stalk.step(ms, silent);
  return stalk.state.signals.fog_rear;
}

TEST(RearFog, EveryTransition) {
  using L = LightSwitch;
  {  // off -> lit: the switch while low burns, high burns, or front fog beside position lamps
    for (const L light : {L::kLow, L::kHigh}) {
      Stalk s;
      EXPECT_FALSE(rear_fog(s, 0, light, false));
      EXPECT_TRUE(rear_fog(s, 100, light, true));
    }
    Stalk s;
    EXPECT_FALSE(rear_fog(s, 0, L::kPosition, false, true));
    EXPECT_TRUE(rear_fog(s, 100, L::kPosition, true, true));
  }
  {  // off -> wanted -> lit: moved with position lamps alone, low comes later
    Stalk s;
    EXPECT_FALSE(rear_fog(s, 0, L::kPosition, false));
    EXPECT_FALSE(rear_fog(s, 100, L::kPosition, true));
    EXPECT_TRUE(rear_fog(s, 200, L::kLow, true));
    EXPECT_TRUE(rear_fog(s, 300, L::kPosition, true)) << "lit, it needs no more than the position lamps";
    EXPECT_FALSE(rear_fog(s, 400, L::kOff, true)) << "lit -> off: position lamps out";
    EXPECT_FALSE(rear_fog(s, 500, L::kLow, true)) << "left on, it stays off";
    EXPECT_FALSE(rear_fog(s, 600, L::kLow, false));
    EXPECT_TRUE(rear_fog(s, 700, L::kLow, true)) << "moved anew";
    EXPECT_FALSE(rear_fog(s, 800, L::kLow, false)) << "lit -> off: its switch";
  }
  {  // off -> off: moved while nothing burns
    Stalk s;
    EXPECT_FALSE(rear_fog(s, 0, L::kOff, true));
    EXPECT_FALSE(rear_fog(s, 100, L::kLow, true));
  }
  {  // wanted -> off: the switch back, before low comes
    Stalk s;
    EXPECT_FALSE(rear_fog(s, 0, L::kPosition, true));
    EXPECT_FALSE(rear_fog(s, 100, L::kPosition, false));
    EXPECT_FALSE(rear_fog(s, 200, L::kLow, false));
  }
  for (const bool by_silence : {true, false}) {  // lit -> off: silence, ignition
    Stalk s;
    EXPECT_TRUE(rear_fog(s, 0, L::kLow, true));
    EXPECT_FALSE(rear_fog(s, 100, L::kLow, true, false, by_silence, by_silence));
    EXPECT_FALSE(rear_fog(s, 200, L::kLow, true)) << "not by itself when all is back";
  }
}

// ---- automatic high beam, the third table: off, armed, high, asleep

struct Automatic : Stalk {
  Automatic() {
    params.automatic_high = true;
    params.automatic_delay_ns = 500 * kMs;
    input.stalk = LightSwitch::kLow;
  }
  enum State { kOff, kArmed, kHigh };
  State at(double ms, double speed_mps = 20.0, bool silent = false) {
    advance_switches(params, input, silent, at_ms(ms), state, speed_mps);
    EXPECT_EQ(state.automatic_high, state.lights.light_switch == LightSwitch::kHigh);
    return state.automatic_high ? kHigh : state.signals.automatic_armed ? kArmed : kOff;
  }
};

TEST(AutomaticHigh, EveryTransition) {
  using A = Automatic;
  {  // armed -> high when nobody is ahead for the delay and the car is fast; high -> armed at once
    A a;
    EXPECT_EQ(a.at(0), A::kArmed);
    EXPECT_EQ(a.at(499), A::kArmed);
    EXPECT_EQ(a.at(500), A::kHigh);
    EXPECT_EQ(a.state.light_changes, 2u);
    EXPECT_EQ(a.state.light_change, at_ms(500));
    a.input.ahead = true;
    EXPECT_EQ(a.at(510), A::kArmed);
    a.input.ahead = false;
    EXPECT_EQ(a.at(600), A::kArmed);
    EXPECT_EQ(a.at(1099), A::kArmed);
    EXPECT_EQ(a.at(1100), A::kHigh);
    EXPECT_EQ(a.at(1200, 8.0), A::kHigh) << "between the two speeds it stays";
    EXPECT_EQ(a.at(1300, 6.0), A::kArmed) << "slow";
    EXPECT_EQ(a.at(1400, 8.0), A::kArmed) << "and stays off between the two speeds";
    EXPECT_EQ(a.at(1500, 12.0), A::kHigh);
  }
  // armed and high -> off: option, switch, low, ignition, silence
  for (const int cause : {0, 1, 2, 3, 4}) {
    for (const double before_ms : {100.0, 600.0}) {
      A a;
      a.at(0);
      EXPECT_EQ(a.at(before_ms), before_ms < 500 ? A::kArmed : A::kHigh);
      if (cause == 0) a.params.automatic_high = false;
      if (cause == 1) a.input.automatic = false;
      if (cause == 2) a.input.stalk = LightSwitch::kPosition;
      if (cause == 3) a.input.ignition = false;
      EXPECT_EQ(a.at(700, 20.0, cause == 4), A::kOff) << cause;
    }
  }
  {  // high -> asleep by the flash; asleep -> armed by the switch, and by coming to low anew
    for (const bool by_switch : {true, false}) {
      A a;
      a.at(0);
      EXPECT_EQ(a.at(600), A::kHigh);
      a.input.flash = true;
      advance_switches(a.params, a.input, false, at_ms(700), a.state, 20.0);
      EXPECT_FALSE(a.state.automatic_high);
      a.input.flash = false;
      EXPECT_EQ(a.at(800), A::kOff);
      EXPECT_EQ(a.at(5000), A::kOff) << "asleep";
      (by_switch ? a.input.automatic : a.input.ignition) = !by_switch;
      if (!by_switch) a.input.stalk = LightSwitch::kPosition;
      a.at(5100);
      a.input.automatic = true;
      a.input.stalk = LightSwitch::kLow;
      EXPECT_EQ(a.at(5200), A::kHigh) << by_switch;
    }
  }
  {  // armed -> armed by the flash: it is only a flash then
    A a;
    a.at(0);
    a.input.flash = true;
    EXPECT_EQ(a.at(100), A::kArmed);
    a.input.flash = false;
    EXPECT_EQ(a.at(600), A::kHigh);
  }
  {  // high by hand beside it: the automatic does not take it away
    A a;
    a.input.high = true;
    a.input.ahead = true;
    advance_switches(a.params, a.input, false, at_ms(0), a.state, 20.0);
    EXPECT_EQ(a.state.lights.light_switch, LightSwitch::kHigh);
  }
}

// ---- the beam lever: every contact from every state, for each kind of latch

TEST(BeamLever, EveryTransition) {
  for (const LeverLatch latch : {LeverLatch::kStays, LeverLatch::kPush, LeverLatch::kPull}) {
    for (const bool low : {true, false}) {
      for (const bool was_high : {true, false}) {
        for (const Lever to : {Lever::kNeutral, Lever::kPush, Lever::kPull, Lever::kHalf}) {
          if (was_high && (!low || latch == LeverLatch::kStays)) continue;  // no such state
          Stalk s;
          s.params.lever_latch = latch;
          s.input.stalk = low ? LightSwitch::kLow : LightSwitch::kOff;
          s.step(0);
          if (was_high) {
            s.input.lever = Lever::kPush;
            s.step(100);
            s.input.lever = Lever::kNeutral;
            s.step(200);
            ASSERT_EQ(s.state.lights.light_switch, LightSwitch::kHigh);
          }
          s.input.lever = to;
          s.step(300);
          // The table of the header, row by row.
          bool high = was_high, flash = to == Lever::kHalf;
          if (latch == LeverLatch::kStays) {
            high = to == Lever::kPush;
            flash = flash || to == Lever::kPull;
          } else if (latch == LeverLatch::kPush) {
            if (to == Lever::kPush) high = !was_high;
            if (to == Lever::kPull) high = false, flash = !was_high;
          } else {
            if (to == Lever::kPush) high = true;
            if (to == Lever::kPull) high = !was_high, flash = !low;
          }
          high = high && low;
          EXPECT_EQ(s.state.lights.light_switch, high  ? LightSwitch::kHigh
                                                 : low ? LightSwitch::kLow
                                                       : LightSwitch::kOff)
              << static_cast<int>(latch) << low << was_high << static_cast<int>(to);
          EXPECT_EQ(s.state.lights.flash, flash) << static_cast<int>(latch) << low << was_high << static_cast<int>(to);
          const Lights held = s.state.lights;
          s.step(400);
          EXPECT_EQ(s.state.lights, held) << "held, nothing more happens";
          s.input.lever = Lever::kNeutral;
          s.step(500);
          EXPECT_FALSE(s.state.lights.flash);
          EXPECT_EQ(s.state.lights.light_switch == LightSwitch::kHigh, high && latch != LeverLatch::kStays);
          // A latched high ends with low and with the ignition, and does not come back with them.
          s.input.ignition = false;
          s.step(600);
          s.input.ignition = true;
          s.step(700);
          EXPECT_EQ(s.state.lights.light_switch, low ? LightSwitch::kLow : LightSwitch::kOff);
        }
      }
    }
  }
}

// ---- turn, hazard, telltales

TEST(Signals, TurnNeedsTheIgnitionAndHazardDoesNot) {
  for (const TurnSignal turn : {TurnSignal::kNone, TurnSignal::kLeft, TurnSignal::kRight}) {
    for (int bits = 0; bits < 8; ++bits) {
      const bool hazard = (bits & 1) != 0, ignition = (bits & 2) != 0, silent = (bits & 4) != 0;
      Stalk s;
      s.input.turn = turn;
      s.input.hazard = hazard;
      s.input.ignition = ignition;
      s.step(0, silent);
      EXPECT_EQ(s.state.signals.turn, ignition && !silent ? turn : TurnSignal::kNone);
      EXPECT_EQ(s.state.signals.hazard, hazard);
      EXPECT_EQ(s.state.light_changes, ignition && silent ? 1u : 0u) << "they are no light changes of the road";
    }
  }
}

TEST(Telltales, ShowWhatBurns) {
  Stalk s;
  s.input.stalk = LightSwitch::kPosition;
  s.step(0);
  Telltales t = telltales(s.state, SimTime{0});
  EXPECT_TRUE(t.position && !t.low_beam && !t.high_beam);
  s.input.flash = true;
  s.step(100);
  EXPECT_TRUE(telltales(s.state, SimTime{0}).high_beam) << "also for the flash";
  s.input = {};
  s.input.stalk = LightSwitch::kHigh;
  s.input.fog_front = s.input.fog_rear = true;
  s.step(200);
  t = telltales(s.state, SimTime{0});
  EXPECT_TRUE(t.position && t.low_beam && t.high_beam && t.fog_front && t.fog_rear);
  s.step(300, true);
  t = telltales(s.state, SimTime{0});
  EXPECT_TRUE(t.fail_safe && t.low_beam && !t.high_beam && !t.fog_front && !t.fog_rear);
}

TEST(Telltales, FlashBetween60And120TimesAMinute) {
  for (const bool hazard : {true, false}) {
    Stalk s;
    s.step(0);
    s.input.hazard = hazard;
    s.input.turn = hazard ? TurnSignal::kNone : TurnSignal::kLeft;
    s.step(1234);
    int rises = 0;
    bool before = false;
    for (int ms = 1234; ms < 61234; ms += 5) {
      const Telltales t = telltales(s.state, at_ms(ms).sim);
      EXPECT_EQ(t.turn_right, hazard && t.turn_left);
      EXPECT_EQ(t.hazard, t.turn_right);
      if (t.turn_left && !before) ++rises;
      if (ms == 1234) {
        EXPECT_TRUE(t.turn_left) << "lit at once";
      }
      before = t.turn_left;
    }
    EXPECT_EQ(rises, 90);
  }
}

TEST(SwitchLogic, AControlMayHaveItsOwnDebounce) {
  Stalk s;
  s.params.own_debounce_ns[static_cast<std::size_t>(Contact::kFlash)] = 200 * kMs;
  s.step(0);
  s.input.flash = s.input.fog_front = true;
  s.input.stalk = LightSwitch::kLow;
  s.step(100);
  s.input.flash = s.input.fog_front = false;
  s.step(150);
  EXPECT_TRUE(s.state.lights.flash);
  EXPECT_FALSE(s.state.lights.fog_front);
  s.step(300);
  EXPECT_FALSE(s.state.lights.flash);
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
  choose_design(stalk.params, 8, at_ms(990), stalk.state);  // there is none, and none is taken in its place
  EXPECT_EQ(stalk.state.lights.design_index, 1u);
  EXPECT_EQ(stalk.state.light_changes, 5u);
  choose_design(stalk.params, 2, at_ms(1000), stalk.state);
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
