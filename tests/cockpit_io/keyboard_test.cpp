// unit: the table of keys; keys of terminal and window, a gamepad and the demo driver on one wheel; a person with keys
// holds a lane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <set>

#include "cockpit_io/keyboard_source.h"
#include "tests/paths.h"

namespace phare {
namespace {

Moment key_at_ms(std::int64_t ms) {
  return {SimTime{ms * 1'000'000}, WallTime{1'000'000'000 + ms * 1'000'000}};
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// ---- the table

TEST(KeyTable, NoKeyTwiceAndEveryActionReachable) {
  std::set<KeyCode> codes;
  std::set<std::string_view> names, sent;
  std::set<KeyAction> actions;
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_TRUE(codes.insert(binding.code).second) << binding.name;
    EXPECT_TRUE(names.insert(binding.name).second) << binding.name;
    // What has no words is told with the key before it: "8 2", then "2".
    EXPECT_TRUE(!binding.what.empty() || (&binding)[-1].name.ends_with(" " + std::string(binding.name)))
        << binding.name;
    EXPECT_LT(binding.code, 512u) << "what a message of the bus may name";
    actions.insert(binding.action);
    for (const std::string_view bytes : binding.terminal) {
      const bool twice = !bytes.empty() && !sent.insert(bytes).second;
      EXPECT_FALSE(twice) << binding.name;
    }
  }
  EXPECT_EQ(actions.size(), kKeyActions);
  // What one key sends does not begin with what another sends, or the table's order would decide.
  for (const std::string_view a : sent)
    for (const std::string_view b : sent) EXPECT_FALSE(a != b && b.starts_with(a)) << b;
  std::set<std::size_t> buttons;
  for (const PadBinding& binding : pad_bindings()) EXPECT_TRUE(buttons.insert(binding.button).second) << binding.name;
}

TEST(KeyTable, ATerminalsBytesGiveTheKeyAndNothingElseDoes) {
  for (const KeyBinding& binding : key_bindings()) {
    for (const std::string_view bytes : binding.terminal) {
      if (bytes.empty()) continue;
      const std::string more = std::string(bytes) + "xyz";
      std::string_view rest = more;
      EXPECT_EQ(take_terminal_key(rest), binding.code) << binding.name;
      EXPECT_EQ(rest, "xyz") << binding.name;
    }
  }
  for (const std::string_view other : {"\x1b[1;5C", "\x1b[200~", "\x1b", "\x1b[", "z", "\x1bOP", "?", "c"}) {
    std::string_view rest = other;
    const std::string place(other);
    EXPECT_FALSE(take_terminal_key(rest)) << place.substr(place.starts_with('\x1b') ? 1 : 0);
    EXPECT_LT(rest.size(), other.size());
  }
  std::string_view caps = "H";
  EXPECT_EQ(take_terminal_key(caps), KeyCode{'h'});
}

TEST(KeyTable, TheDriversPageListsIt) {
  const std::string page = text_of(source_dir() + "/docs/driving.md");
  EXPECT_NE(page.find(key_list_markdown()), std::string::npos) << "docs/driving.md has to hold this table as it is:\n"
                                                               << key_list_markdown();
}

// ---- keys

TEST(Keyboard, KeysMoveTheControls) {
  KeyboardDriver driver;
  Cockpit cockpit({20'000'000, 2}, "keyboard");
  driver.advance(key_at_ms(0), cockpit);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kLow);
  driver.press("l", key_at_ms(100), cockpit);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kHigh);
  driver.press("LLl", key_at_ms(200), cockpit);
  driver.advance(key_at_ms(250), cockpit);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kLow);
  driver.press("gnf", key_at_ms(300), cockpit);
  EXPECT_TRUE(cockpit.state(-1, false).fog_front);
  EXPECT_TRUE(cockpit.state(-1, false).flash);
  EXPECT_EQ(cockpit.state(-1, false).design_index, 1u);
  driver.advance(key_at_ms(2000), cockpit);
  EXPECT_FALSE(cockpit.state(-1, false).flash);
  driver.press("b,wrh", key_at_ms(2005), cockpit);
  EXPECT_TRUE(cockpit.state(-1, false).fog_rear && cockpit.state(-1, false).hazard);
  EXPECT_EQ(cockpit.state(-1, false).turn, TurnSignal::kLeft);
  EXPECT_EQ(cockpit.state(-1, false).gear, Gear::kReverse);
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kHigh);
  driver.press(".wr", key_at_ms(2008), cockpit);
  driver.advance(key_at_ms(2009), cockpit);
  EXPECT_EQ(cockpit.state(-1, false).gear, Gear::kDrive);
  driver.press("\x1b[A\x1b[D\x1b[1;5C\x1b[200~\x1bx", key_at_ms(2010), cockpit);
  driver.advance(key_at_ms(2020), cockpit);
  EXPECT_GT(cockpit.state(-1, false).accelerator_01, 0.0);
  EXPECT_GT(cockpit.state(-1, false).steering_wheel_rad, 0.0);
  driver.advance(key_at_ms(9000), cockpit);
  EXPECT_EQ(cockpit.state(-1, false).accelerator_01, 0.0);
  EXPECT_EQ(cockpit.state(-1, false).steering_wheel_rad, 0.0);
}

/// What one key does, from the press until long after it: every 10 ms of simulated time.
std::vector<CockpitState> after_a_press(const std::function<void(KeyboardSource&, Moment)>& at_each,
                                        bool demo = false) {
  KeyboardCompany company;
  if (demo) {
    company.demo.emplace();
    company.demo->script = *read_driver_script(source_dir() + "/config/drives/country_road_script.toml");
    company.demo->lane = {{0, 0, 0, 0, 0, 0}, {1000, 1000, 0, 0, 0, 0}};
  }
  KeyboardSource source(std::move(company));
  SwitchParams params;
  params.design_count = 2;
  params.automatic_high = true;
  Cockpit cockpit(params, "keyboard");
  VehicleState car;
  car.speed_mps = 15.0;
  std::vector<CockpitState> all;
  for (std::int64_t ms = 0; ms <= 2000; ms += 10) {
    at_each(source, key_at_ms(ms));
    source.advance(key_at_ms(ms), &car, cockpit);
    all.push_back(cockpit.state(-1, false));
    if (!source.driver().empty()) all.back().source = source.driver();
  }
  return all;
}

TEST(Keyboard, EveryKeyOfTheCarIsTheSameInWindowAndTerminal) {
  const std::vector<CockpitState> untouched = after_a_press([](KeyboardSource&, Moment) {}, true);
  for (const KeyBinding& binding : key_bindings()) {
    if (binding.actor != KeyActor::kCar) continue;
    const auto code = static_cast<std::int32_t>(binding.code);
    const std::int64_t held_ms = KeyboardDriver::terminal_hold_ns(binding.action) / 1'000'000;
    const auto window = after_a_press(
        [&](KeyboardSource& source, Moment now) {
          const std::int64_t ms = now.sim.ns / 1'000'000;
          if (ms < 300) return;
          KeyInput keys;
          if (ms < 300 + held_ms) keys.held = {binding.code};
          keys.event = {code};
          keys.events = 1;
          // Messages of now: the clock on the wall of the test stands still.
          source.take_keys(0, 7, keys, now.wall);
        },
        true);
    for (const std::string_view bytes : binding.terminal) {
      if (bytes.empty()) continue;
      const auto terminal = after_a_press(
          [&](KeyboardSource& source, Moment now) {
            if (now.sim.ns == 300'000'000) source.take_terminal(bytes);
          },
          true);
      EXPECT_EQ(window, terminal) << binding.name;
      EXPECT_NE(terminal, untouched) << binding.name << " does nothing";
    }
  }
}

TEST(Keyboard, AHeldKeyIsHeldUntilItIsLetGoOrTheWindowIsGone) {
  for (const bool killed : {false, true}) {
    const auto states = after_a_press([&](KeyboardSource& source, Moment now) {
      const std::int64_t ms = now.sim.ns / 1'000'000;
      if (ms % 20 != 0 || ms > 1700) return;
      KeyInput keys{{key::kUp}, {}, 1};
      if (ms >= 900) keys.held.clear();                                 // let go
      if (ms < 900 || !killed) source.take_keys(0, 7, keys, now.wall);  // or never heard of again
    });
    EXPECT_NEAR(states[80].accelerator_01, 0.6, 1e-9) << "at 800 ms";
    EXPECT_EQ(states[110].accelerator_01 > 0.0, killed) << "at 1.1 s";
    EXPECT_EQ(states[200].accelerator_01, 0.0) << "at 2 s: silent for more than one";
  }
}

// ---- steering

/// A person with two keys on a lane, straight for three seconds, then a bend: looks where the car will be in 0.8 s,
/// sees it 0.25 s late, decides four times a second and taps, longer the more the car is off. It starts 0.3 m off and
/// askew. The car is a bicycle without slip. Returns the farthest it was off the lane's middle.
double worst_offset_m(double speed_mps, double bend_1pm) {
  constexpr double kWheelbase_m = 2.63, kRatio = 15.5, kDt_s = 0.01, kAhead_s = 0.8;
  constexpr std::size_t kDelay_steps = 25;
  KeyboardDriver driver;
  Cockpit cockpit({20'000'000, 1}, "keyboard");
  driver.set_speed(speed_mps);
  const double bend_at_m = 3.0 * speed_mps, ahead_m = speed_mps * kAhead_s;
  double along_m = 0.0, left_m = 0.3, heading_rad = 0.5 * std::numbers::pi / 180.0, yaw_rate_radps = 0.0;
  double worst_m = 0.0;
  std::vector<double> seen_m;
  std::int64_t until_ms = 0;
  KeyAction action = KeyAction::kSteerLeft;
  for (std::int64_t ms = 0; ms < 30'000; ms += 10) {
    const double bend_seen_m = std::clamp(along_m + ahead_m - bend_at_m, 0.0, ahead_m);
    seen_m.push_back(left_m + heading_rad * ahead_m + 0.5 * yaw_rate_radps * kAhead_s * ahead_m -
                     0.5 * bend_1pm * bend_seen_m * bend_seen_m);
    const double off_m = seen_m[seen_m.size() > kDelay_steps ? seen_m.size() - 1 - kDelay_steps : 0];
    if (ms % 250 == 0 && std::abs(off_m) > 0.15) {
      action = off_m > 0.0 ? KeyAction::kSteerRight : KeyAction::kSteerLeft;
      until_ms = ms + std::min<std::int64_t>(250, 80 + static_cast<std::int64_t>(160.0 * std::abs(off_m)));
    }
    std::array<bool, kKeyActions> held{};
    held[static_cast<std::size_t>(action)] = ms < until_ms;
    driver.hold(held);
    driver.advance(key_at_ms(ms), cockpit);
    yaw_rate_radps = speed_mps * std::tan(driver.input().steering_wheel_rad / kRatio) / kWheelbase_m;
    heading_rad += (yaw_rate_radps - (along_m > bend_at_m ? bend_1pm * speed_mps : 0.0)) * kDt_s;
    left_m += speed_mps * std::sin(heading_rad) * kDt_s;
    along_m += speed_mps * kDt_s;
    worst_m = std::max(worst_m, std::abs(left_m));
  }
  return worst_m;
}

TEST(Keyboard, APersonWithKeysHoldsALane) {
  constexpr double kRoom_m = 0.85;  // a car of 1.8 m in a lane of 3.5 m
  struct Stretch {
    double speed_kmh, radius_m;  // 0: straight
  };
  for (const Stretch& s : {Stretch{30, 0}, {50, 0}, {80, 0}, {100, 0}, {130, 0}, {30, 60}, {60, 180}, {70, 200}}) {
    const double worst = worst_offset_m(s.speed_kmh / 3.6, s.radius_m > 0.0 ? 1.0 / s.radius_m : 0.0);
    std::printf("%3.0f km/h, radius %3.0f m: %.2f m off at most\n", s.speed_kmh, s.radius_m, worst);
    EXPECT_LT(worst, kRoom_m) << s.speed_kmh << " km/h, radius " << s.radius_m << " m";
  }
}

TEST(Keyboard, TheWheelTurnsAsFarAsTheSpeedBears) {
  for (const double speed_mps : {2.0, 10.0, 25.0, 50.0}) {
    KeyboardDriver driver;
    Cockpit cockpit({20'000'000, 1}, "keyboard");
    driver.set_speed(speed_mps);
    std::array<bool, kKeyActions> held{};
    held[static_cast<std::size_t>(KeyAction::kSteerLeft)] = true;
    driver.hold(held);
    for (std::int64_t ms = 0; ms <= 610; ms += 10) driver.advance(key_at_ms(ms), cockpit);
    const double wheel_rad = cockpit.state(-1, false).steering_wheel_rad;
    EXPECT_DOUBLE_EQ(wheel_rad, most_wheel_rad(speed_mps)) << "reached in 0.6 s";
    const double lateral_mps2 = speed_mps * speed_mps * std::tan(wheel_rad / 15.5) / 2.65;
    EXPECT_LE(lateral_mps2, 5.0 + 1e-9);
    driver.hold({});
    for (std::int64_t ms = 620; ms <= 980; ms += 10) driver.advance(key_at_ms(ms), cockpit);
    EXPECT_EQ(cockpit.state(-1, false).steering_wheel_rad, 0.0) << "straight again in 0.35 s";
  }
}

// ---- the gamepad beside the keys

TEST(Keyboard, AGamepadThatIsMovedDrivesAndAKeyTakesTheWheelBack) {
  PadReading pad;
  pad.left_m1_1 = 0.1;  // a stick that does not come to rest in its middle
  bool there = false;
  KeyboardCompany company;
  company.pad = [&] { return there ? std::optional(pad) : std::nullopt; };
  KeyboardSource source(std::move(company));
  Cockpit cockpit({20'000'000, 1}, "keyboard");
  VehicleState car;
  std::int64_t ms = 0;
  const auto state = [&](std::int64_t for_ms) {
    for (const std::int64_t until = ms + for_ms; ms < until; ms += 10) source.advance(key_at_ms(ms), &car, cockpit);
    return cockpit.state(-1, false);
  };
  EXPECT_EQ(state(100).steering_wheel_rad, 0.0);
  there = true;
  EXPECT_EQ(state(100).steering_wheel_rad, 0.0) << "plugged in, and not touched";
  pad.left_m1_1 = 1.0;
  pad.accelerator_01 = 0.7;
  EXPECT_NEAR(state(500).steering_wheel_rad, most_wheel_rad(0.0), 1e-9);
  EXPECT_DOUBLE_EQ(state(10).accelerator_01, 0.7);
  pad.pressed[static_cast<std::size_t>(KeyAction::kHighBeam)] = true;
  EXPECT_EQ(state(100).light_switch, LightSwitch::kHigh) << "one press, however long it is held";
  source.take_terminal("\x1b[B");
  EXPECT_NEAR(state(300).brake_01, 0.4, 1e-9) << "a key";
  EXPECT_EQ(state(10).accelerator_01, 0.0);
  there = false;
  EXPECT_EQ(state(1000).steering_wheel_rad, 0.0) << "unplugged: nothing of it stays";
}

// ---- the demo driver

TEST(Keyboard, TheDemoDriverTakesTheWheelAtItsKeyAndGivesItBack) {
  KeyboardCompany company;
  company.demo.emplace();
  company.demo->script = *read_driver_script(source_dir() + "/config/drives/country_road_script.toml");
  company.demo->script.events.clear();
  company.demo->script.end_s_m = 60.0;
  company.demo->lane = {{0, 0, 0, 0, 0, 0}, {100, 100, 0, 0, 0, 0}};
  KeyboardSource source(std::move(company));
  Cockpit cockpit({20'000'000, 1}, "keyboard");
  VehicleState car;
  car.y_m = 1.0;  // a metre left of the lane
  std::int64_t ms = 0;
  const auto step = [&] { source.advance(key_at_ms(ms += 10), &car, cockpit); };
  step();
  source.take_terminal("d");
  step(), step();
  EXPECT_EQ(source.driver(), "demo");
  EXPECT_GT(cockpit.state(-1, false).accelerator_01, 0.0);
  EXPECT_LT(cockpit.state(-1, false).steering_wheel_rad, 0.0) << "back to the lane";
  // The lights may be the person's while he drives.
  source.take_terminal("h");
  step(), step();
  EXPECT_EQ(source.driver(), "demo");
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kHigh);
  // At the end of his road he brakes, whatever the person does with the lights.
  car.x_m = 70.0;
  step(), step();
  EXPECT_EQ(source.driver(), "demo ended");
  EXPECT_GT(cockpit.state(-1, false).brake_01, 0.0);
  EXPECT_EQ(cockpit.state(-1, false).accelerator_01, 0.0);
  // A driving key takes the wheel back, and the lights stay as they are.
  source.take_terminal("\x1b[A");
  step(), step();
  EXPECT_EQ(source.driver(), "");
  EXPECT_EQ(cockpit.state(-1, false).light_switch, LightSwitch::kHigh);
  for (int i = 0; i < 30; ++i) step();
  EXPECT_GT(cockpit.state(-1, false).accelerator_01, 0.0);
  // Far off the road, or against it, he does not find the way, and says so.
  car.y_m = 40.0;
  source.take_terminal("d");
  step(), step();
  EXPECT_EQ(source.driver(), "");
  EXPECT_NE(source.fault().find("the road is too far away"), std::string::npos);
  car.y_m = 0.0;
  car.yaw_rad = std::numbers::pi;
  source.take_terminal("d");
  step(), step();
  EXPECT_EQ(source.driver(), "");
}

}  // namespace
}  // namespace phare
