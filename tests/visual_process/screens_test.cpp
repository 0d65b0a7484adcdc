// unit: what a person at the window is told, and what the window makes of keys.
#include "visual/process/screens.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "visual/process/notice.h"
#include "visual/process/window.h"
#include "visual/process/window_keyboard.h"

namespace phare {
namespace {

using namespace std::chrono_literals;
using Kind = ScreensSetup::Kind;
using Time = WindowKeyboard::Time;

bool lists(const OverlayPanel& panel, KeyAction action) {
  const std::string name(binding_of(action)->name);
  return std::ranges::any_of(panel.rows, [&](const OverlayPanel::Row& row) {
    return ("  " + row.key + "  ").find("  " + name + "  ") != std::string::npos;
  });
}

bool says(const OverlayPanel& panel, const std::string& words) {
  return std::ranges::any_of(panel.rows, [&](const auto& row) { return row.words.find(words) != std::string::npos; });
}

bool press(Screens& screens, Desk& desk, KeyAction action) {
  const KeyAction presses[] = {action};
  return screens.press(presses, true, desk, [&](const DeskCommand& command) { EXPECT_TRUE(apply(desk, command)); });
}

TEST(Screens, HelpListsEveryKeyOfTheTable) {
  Screens screens({});
  Desk desk;
  EXPECT_TRUE(screens.panel({}, 0.0, desk.help).empty());
  EXPECT_FALSE(press(screens, desk, KeyAction::kHelp));
  const OverlayPanel help = screens.panel({}, 0.0, desk.help);
  std::size_t row = 0;
  for (const KeyBinding& binding : key_bindings()) {
    if (binding.what.empty()) continue;  // told with the key before it
    ASSERT_LT(row, help.rows.size());
    EXPECT_EQ(help.rows[row].key, binding.name);
    EXPECT_EQ(help.rows[row++].words, binding.what);
  }
  EXPECT_EQ(row, help.rows.size());
  // Esc takes the help away first, then it leaves.
  EXPECT_FALSE(press(screens, desk, KeyAction::kLeave));
  EXPECT_TRUE(screens.panel({}, 0.0, desk.help).empty());
  EXPECT_TRUE(press(screens, desk, KeyAction::kLeave));
}

TEST(Notice, StandsForAFewSeconds) {
  Notice notice;
  const Notice::Clock::time_point now = Notice::Clock::now();
  EXPECT_EQ(notice.line(now), "");
  notice.say("the rig has one design", now);
  EXPECT_EQ(notice.line(now + 5s), "the rig has one design");
  EXPECT_EQ(notice.line(now + 7s), "");
}

TEST(Screens, TheBeginningGoesWhenThePersonDrivesByWhateverTheyDrive) {
  Screens live({.kind = Kind::kLive, .shown = "Country road"});
  CockpitState controls;  // of a gamepad: no key of the window is pressed
  live.see(controls);
  EXPECT_FALSE(live.panel(controls, 5.0, false).empty());
  controls.accelerator_01 = 0.3;
  live.see(controls);
  controls.accelerator_01 = 0.0;
  live.see(controls);
  EXPECT_TRUE(live.panel(controls, 6.0, false).empty());
  // A drive that is shown accelerates by itself: its panel goes by time or by a key.
  Screens shown({.kind = Kind::kReplay, .shown = "evening.pcap"});
  controls.accelerator_01 = 0.3;
  shown.see(controls);
  EXPECT_FALSE(shown.panel(controls, 0.1, false).empty());
}

TEST(Screens, WhileThePictureIsMadeReadyNothingElseIsSeen) {
  const OverlayPanel panel = getting_ready_panel(3, 11);
  EXPECT_TRUE(says(panel, "step 3 of 11"));
  EXPECT_EQ(panel.place, OverlayPanel::Place::kAlone);
}

TEST(Window, IsNoLargerThanTheScreen) {
  EXPECT_EQ(fitted(1280, 720, 1920, 1080), std::pair(1280, 720));
  EXPECT_EQ(fitted(1280, 720, 640, 480), std::pair(640, 360));
  EXPECT_EQ(fitted(1280, 720, 1366, 360), std::pair(640, 360));
  EXPECT_EQ(fitted(1280, 720, 0, 0), std::pair(1280, 720)) << "a screen that does not say";
}

TEST(Screens, TheStartSaysHowToDriveUntilAKeyIsPressed) {
  Screens screens({.kind = Kind::kLive, .shown = "rig", .demo = true});
  const OverlayPanel start = screens.panel({}, 100.0, false);
  for (const KeyAction action : {KeyAction::kAccelerate, KeyAction::kBrake, KeyAction::kSteerLeft,
                                 KeyAction::kSteerRight, KeyAction::kHighBeam, KeyAction::kHelp, KeyAction::kDemo})
    EXPECT_TRUE(lists(start, action)) << binding_of(action)->name;
  EXPECT_FALSE(lists(Screens({.kind = Kind::kLive}).panel({}, 0.0, false), KeyAction::kDemo)) << "there is none";
  Desk desk;
  screens.press({}, true, desk, {});  // any key
  EXPECT_TRUE(screens.panel({}, 100.0, false).empty());
}

TEST(Screens, AReplayGoesOnWithoutAKey) {
  const Screens screens({.kind = Kind::kReplay, .shown = "evening.pcap"});
  EXPECT_NE(screens.panel({}, 1.0, false).title.find("evening.pcap"), std::string::npos);
  EXPECT_TRUE(screens.panel({}, 7.0, false).empty());
}

TEST(Screens, TheEndSaysWhatCanBeDoneNext) {
  Screens screens({.kind = Kind::kReplay, .shown = "evening.pcap", .demo = true, .report = "/x/out/index.html"});
  screens.drive_over();
  const OverlayPanel end = screens.panel({}, 75.0, false);
  for (const KeyAction action : {KeyAction::kBeginAgain, KeyAction::kAccelerate, KeyAction::kDemo, KeyAction::kLeave})
    EXPECT_TRUE(lists(end, action)) << binding_of(action)->name;
  EXPECT_TRUE(says(end, "/x/out/index.html"));
  Screens without({.kind = Kind::kReplay});
  without.drive_over();
  EXPECT_TRUE(says(without.panel({}, 75.0, false), "--out"));

  Screens live({.kind = Kind::kLive, .demo = true});
  Desk desk;
  live.press({}, true, desk, {});
  CockpitState controls;
  controls.source = "demo ended";
  EXPECT_TRUE(lists(live.panel(controls, 75.0, false), KeyAction::kAccelerate));
  EXPECT_TRUE(lists(live.panel(controls, 75.0, false), KeyAction::kBeginAgain));
}

TEST(Screens, OnlyWhereSomebodySitsTheWindowStays) {
  EXPECT_FALSE(Screens({}).stays());
  EXPECT_TRUE(Screens({.kind = Kind::kLive}).stays());
  EXPECT_TRUE(Screens({.kind = Kind::kReplay}).stays());
}

TEST(Instruments, ShowWhatTheDriverDoes) {
  CockpitState controls;
  VehicleState car;
  const auto text = [&](std::int64_t ms = 0) {
    std::string all;
    for (const auto& each : instruments(controls, car, "led", SimTime{ms * 1'000'000})) all += each.text + "|";
    return all;
  };
  controls.light_switch = LightSwitch::kLow;
  car.speed_mps = 13.9;
  EXPECT_EQ(text(), "50 km/h|D|low beam|led|");
  controls.light_switch = LightSwitch::kHigh;
  controls.gear = Gear::kReverse;
  car.speed_mps = -2.0;
  EXPECT_EQ(text(), "7 km/h|R|high beam|led|");
  controls = {};
  controls.fog_front = controls.fog_rear = true;
  controls.turn = TurnSignal::kRight;
  controls.parking_brake_01 = 1.0;
  controls.source = "demo";
  EXPECT_EQ(text(),
            "7 km/h|D|lights off|front fog|rear fog|turn right|parking brake|led|demo: Up gives you the wheel|");
  // 90 times a minute: lit and dark a third of a second each.
  const auto colour = [&](std::int64_t ms) {
    return instruments(controls, car, "", SimTime{ms * 1'000'000})[5].colour;
  };
  EXPECT_NE(colour(0), colour(400));
  EXPECT_EQ(colour(0), colour(700));
}

// ---- keys of the window

TEST(WindowKeyboard, TellsWhatIsHeldAndEveryPress) {
  WindowKeyboard keyboard;
  const Time t0 = Time() + 1h;
  EXPECT_FALSE(keyboard.message(t0));
  keyboard.key(1, key::kUp, true, t0);
  keyboard.key(2, 'h', true, t0);
  keyboard.key(2, 'h', false, t0 + 5ms);
  const auto message = keyboard.message(t0 + 5ms);
  ASSERT_TRUE(message);
  EXPECT_EQ(*message, (KeyInput{{key::kUp}, {265, 'h', -'h'}, 3}));
  EXPECT_FALSE(keyboard.message(t0 + 10ms)) << "nothing new";
  EXPECT_EQ(keyboard.message(t0 + 25ms), message) << "again, in case it was lost";
  // What was pressed is told for a second, what is held as long as it is.
  EXPECT_EQ(keyboard.message(t0 + 1500ms), (KeyInput{{key::kUp}, {}, 3}));
  keyboard.key(1, key::kUp, false, t0 + 2000ms);
  EXPECT_EQ(keyboard.message(t0 + 2000ms), (KeyInput{{}, {-265}, 4}));
  EXPECT_FALSE(keyboard.message(t0 + 3100ms)) << "quiet again";
  EXPECT_EQ(keyboard.take_presses(), (std::vector{KeyAction::kAccelerate, KeyAction::kHighBeam}));
  EXPECT_TRUE(keyboard.take_any());
  EXPECT_FALSE(keyboard.take_any());
}

TEST(WindowKeyboard, AWindowWithoutFocusHoldsNothing) {
  WindowKeyboard keyboard;
  const Time t0 = Time() + 1h;
  keyboard.key(1, key::kUp, true, t0);
  keyboard.message(t0);
  keyboard.focus_lost(t0 + 50ms);
  EXPECT_EQ(keyboard.message(t0 + 50ms), (KeyInput{{}, {265, -265}, 2}));
  keyboard.key(1, key::kUp, false, t0 + 60ms);  // let go elsewhere
  EXPECT_EQ(keyboard.message(t0 + 80ms)->events, 2u);
}

TEST(WindowKeyboard, ALetterIsLetGoWhateverShiftDoesMeanwhile) {
  WindowKeyboard keyboard;
  const Time t0 = Time() + 1h;
  keyboard.key('L', 'L', true, t0);   // Shift held
  keyboard.key('L', 'l', false, t0);  // and let go first
  EXPECT_EQ(keyboard.message(t0), (KeyInput{{}, {'L', -'L'}, 2}));
  keyboard.key('H', 'H', true, t0);  // upper case that is not bound: the letter
  EXPECT_EQ(keyboard.message(t0)->held, std::vector<std::uint32_t>{'h'});
}

TEST(WindowKeyboard, WhatThePictureDoesStaysInTheWindow) {
  WindowKeyboard keyboard;
  const Time t0 = Time() + 1h;
  keyboard.key(1, key::kF1, true, t0);
  keyboard.key(1, key::kF1, false, t0);
  keyboard.key(2, 'q', true, t0);  // bound to nothing
  keyboard.character('?', t0);
  EXPECT_FALSE(keyboard.message(t0));
  EXPECT_EQ(keyboard.take_presses(), (std::vector{KeyAction::kHelp, KeyAction::kHelp}));
}

TEST(WindowKeyboard, ManyKeysFitTheMessage) {
  WindowKeyboard keyboard;
  const Time t0 = Time() + 1h;
  for (int round = 0; round < 3; ++round)
    for (const KeyBinding& binding : key_bindings()) {
      keyboard.key(static_cast<int>(binding.code), binding.code, true, t0);
      if (round < 2) keyboard.key(static_cast<int>(binding.code), binding.code, false, t0);
    }
  const auto message = keyboard.message(t0);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->held.size(), kMostKeys);
  EXPECT_EQ(message->event.size(), kMostKeys);
  EXPECT_TRUE(std::ranges::is_sorted(message->held));
}

}  // namespace
}  // namespace phare
