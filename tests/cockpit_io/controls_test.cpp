// Every kind of control: levels, levers, bits, latches, signs, ranges; checks that refuse; gamepads; several sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "cockpit_io/combined_source.h"
#include "cockpit_io/feedback.h"
#include "cockpit_io/gamepad_source.h"
#include "cockpit_io/signal_map.h"
#include "config/cockpit.h"
#include "tests/cockpit_io/controls_file.h"
#include "tests/paths.h"

namespace phare {
namespace {

using test::can, test::control, test::kDbc;
constexpr std::int64_t kMs = 1'000'000;
constexpr double kDeg = std::numbers::pi / 180.0;

struct Bench {
  explicit Bench(const std::string& text) {
    const auto parsed = parse_cockpit(text, "c.toml");
    EXPECT_TRUE(parsed.ok()) << (parsed.ok() ? "" : parsed.error().text());
    config = *parsed;
    auto bound = SignalMap::bind(config, *parse_dbc(kDbc, "c.dbc"), 0);
    EXPECT_TRUE(bound.ok()) << (bound.ok() ? "" : bound.error().text());
    map = std::move(*bound);
    input = initial_input(config);
    cockpit.emplace(switch_params(config, 2), "test");
  }
  /// A frame 50 ms after the one before.
  SignalMap::Taken send(std::initializer_list<int> bytes, std::uint32_t id = 1) {
    CanFrame frame;
    frame.id = id;
    for (const int byte : bytes) frame.data[frame.length++] = static_cast<std::uint8_t>(byte);
    if (id == 1) frame.length = 8;
    at_ns += 50 * kMs;
    const auto taken = map.take(frame, at_ns, input);
    cockpit->take(input, false, {SimTime{at_ns}, WallTime{at_ns}});
    return taken;
  }
  CockpitState state() const { return cockpit->state(-1, false); }

  CockpitConfig config;
  SignalMap map;
  DriverInput input;
  std::optional<Cockpit> cockpit;
  std::int64_t at_ns = 0;
};

TEST(Controls, ALeverWithALatchOnPush) {
  Bench b(can(control("light_switch", "S1", "levels = { off = 0, low = 2 }\n") +
              control("beam_lever", "S0",
                      "levels = { neutral = [\"rest\", \"faulty\"], push = \"pushed\", pull = \"pulled\", half = 3 }\n"
                      "latch = \"push\"\n")));
  const auto light = [&](int lever, int stalk) {
    b.send({lever, stalk});
    return std::pair(b.state().light_switch, b.state().flash);
  };
  using P = std::pair<LightSwitch, bool>;
  EXPECT_EQ(light(0, 2), P(LightSwitch::kLow, false));
  EXPECT_EQ(light(1, 2), P(LightSwitch::kHigh, false));
  EXPECT_EQ(light(0, 2), P(LightSwitch::kHigh, false)) << "latched";
  EXPECT_EQ(light(7, 2), P(LightSwitch::kHigh, false)) << "a fault of the lever counts as neutral here";
  EXPECT_EQ(light(2, 2), P(LightSwitch::kLow, false)) << "a pull ends it, without a flash";
  EXPECT_EQ(light(0, 2), P(LightSwitch::kLow, false));
  EXPECT_EQ(light(2, 2), P(LightSwitch::kLow, true)) << "and now it flashes";
  EXPECT_EQ(light(0, 2), P(LightSwitch::kLow, false));
  EXPECT_EQ(light(3, 2), P(LightSwitch::kLow, true)) << "half";
  EXPECT_EQ(light(0, 2), P(LightSwitch::kLow, false));
  EXPECT_EQ(light(1, 2), P(LightSwitch::kHigh, false));
  EXPECT_EQ(light(0, 0), P(LightSwitch::kOff, false)) << "low goes off";
  EXPECT_EQ(light(0, 2), P(LightSwitch::kLow, false)) << "and the latch with it";
  EXPECT_EQ(light(0, 0), P(LightSwitch::kOff, false));
  EXPECT_EQ(light(1, 0), P(LightSwitch::kOff, false)) << "a push without low does nothing";
  EXPECT_EQ(light(2, 0), P(LightSwitch::kOff, true)) << "a pull flashes with the lights off";
}

TEST(Controls, ALeverThatTurnsOverByPulling) {
  Bench b(can(control("light_switch", "S1", "levels = { off = 0, low = 2 }\n") +
              control("beam_lever", "S0", "levels = { neutral = 0, pull = 2, push = 1 }\nlatch = \"pull\"\n")));
  const auto light = [&](int lever, int stalk = 2) {
    b.send({lever, stalk});
    return std::pair(b.state().light_switch, b.state().flash);
  };
  using P = std::pair<LightSwitch, bool>;
  EXPECT_EQ(light(0), P(LightSwitch::kLow, false));
  EXPECT_EQ(light(2), P(LightSwitch::kHigh, false));
  EXPECT_EQ(light(0), P(LightSwitch::kHigh, false));
  EXPECT_EQ(light(2), P(LightSwitch::kLow, false));
  EXPECT_EQ(light(0), P(LightSwitch::kLow, false));
  EXPECT_EQ(light(1), P(LightSwitch::kHigh, false));
  EXPECT_EQ(light(0, 0), P(LightSwitch::kOff, false));
  EXPECT_EQ(light(2, 0), P(LightSwitch::kOff, true)) << "without low it flashes";
}

TEST(Controls, ALeverThatStaysWhereItIsPushed) {
  Bench b(can(control("light_switch", "S1", "levels = { off = 0, low = [2, 3] }\n") +
              control("beam_lever", "S0", "levels = { neutral = 0, pull = 2, push = 1 }\n")));
  b.send({1, 3});
  EXPECT_EQ(b.state().light_switch, LightSwitch::kHigh);
  b.send({0, 2});
  EXPECT_EQ(b.state().light_switch, LightSwitch::kLow);
  b.send({2, 2});
  EXPECT_TRUE(b.state().flash);
  EXPECT_EQ(b.send({9, 2}), SignalMap::Taken::kIncomplete) << "no such level";
  EXPECT_TRUE(b.state().flash) << "stays";
}

TEST(Controls, PushButtonsLatchAndBouncesDoNotCount) {
  Bench b(can(control("low", "S0", "latch = true\n") + control("high", "S1", "latch = true\n") +
              control("fog_rear", "S2", "on = [4, 5]\ninvert = false\nlatch = true\n")));
  b.send({1, 0, 0});
  b.send({0, 0, 0});
  EXPECT_EQ(b.state().light_switch, LightSwitch::kLow) << "pressed once";
  b.send({0, 1, 5});
  b.send({0, 0, 0});
  EXPECT_EQ(b.state().light_switch, LightSwitch::kHigh);
  EXPECT_TRUE(b.state().fog_rear);
  b.send({1, 0, 4});
  b.send({0, 0, 1});
  EXPECT_EQ(b.state().light_switch, LightSwitch::kOff) << "pressed again; high goes with it";
  EXPECT_FALSE(b.state().fog_rear);
  b.send({1, 0, 0});
  EXPECT_EQ(b.state().light_switch, LightSwitch::kLow);

  // Three edges within the debounce time are one press.
  CanFrame frame;
  frame.id = 1;
  frame.length = 8;
  b.at_ns += 50 * kMs;
  for (const int contact : {0, 1, 0, 1, 0}) {
    frame.data[0] = static_cast<std::uint8_t>(contact);
    b.map.take(frame, b.at_ns += 2 * kMs, b.input);
  }
  EXPECT_EQ(b.input.switches.stalk, LightSwitch::kLow);
}

TEST(Controls, AnglesPedalsAndWheels) {
  Bench b(can(control("steering", "ANGLE",
                      "sign_signal = \"S0\"\noffset_deg = -1\ndead_zone_deg = 2\nrange_deg = [-90, 90]\n") +
              control("brake", "S1", "range = [200, 100]\ndead_zone = 0.1\n") +
              control("clutch", "S1", "range = [0, 250]\n") +
              control("lamp_aim", "S2", "range = [0, 4]\nlowest_deg = -2\n")));
  b.send({0, 200, 2, 110, 0});
  EXPECT_NEAR(b.state().steering_wheel_rad, 10.0 * kDeg, 1e-12);
  EXPECT_EQ(b.state().brake_01, 0.0);
  EXPECT_NEAR(b.state().clutch_01, 0.8, 1e-12);
  EXPECT_NEAR(b.state().lamp_aim_rad, -1.0 * kDeg, 1e-12);
  b.send({1, 190, 4, 110, 0});
  EXPECT_NEAR(b.state().steering_wheel_rad, -12.0 * kDeg, 1e-12) << "the sign bit, then the offset";
  EXPECT_EQ(b.state().brake_01, 0.0) << "within the dead zone";
  b.send({0, 100, 9, 25, 0});
  EXPECT_EQ(b.state().steering_wheel_rad, 0.0) << "1.5 degrees are within the dead zone";
  EXPECT_EQ(b.state().brake_01, 1.0);
  EXPECT_NEAR(b.state().lamp_aim_rad, -2.0 * kDeg, 1e-12);
  b.send({0, 145, 0, 0xFF, 0xFF});
  EXPECT_NEAR(b.state().steering_wheel_rad, 90.0 * kDeg, 1e-12);
  EXPECT_NEAR(b.state().brake_01, 0.5, 1e-12);
}

TEST(Controls, TurnLeversHazardAndIgnition) {
  Bench b(can(control("turn_left", "S0", "on = 1\n") + control("turn_right", "S0", "on = 2\n") +
              control("hazard", "S1") + control("ignition", "S2", "invert = true\n")));
  b.send({1, 0, 0});
  EXPECT_EQ(b.state().turn, TurnSignal::kLeft);
  b.send({2, 1, 0});
  EXPECT_EQ(b.state().turn, TurnSignal::kRight);
  EXPECT_TRUE(b.state().hazard);
  b.send({2, 1, 1});
  EXPECT_TRUE(b.state().ignition_off);
  EXPECT_EQ(b.state().turn, TurnSignal::kNone);
  EXPECT_TRUE(b.state().hazard) << "hazard works without the ignition";
}

TEST(Controls, MultiplexedSignalsComeInTurns) {
  Bench b(can(control("low", "S0", "on = 0\n") + control("flash", "FLASHER", "", "M") +
              control("fog_front", "FOGGER", "", "M")));
  b.send({0});
  EXPECT_EQ(b.send({1, 1}, 2), SignalMap::Taken::kDecoded);
  EXPECT_TRUE(b.state().flash);
  EXPECT_EQ(b.send({2, 1}, 2), SignalMap::Taken::kDecoded);
  EXPECT_TRUE(b.state().flash && b.state().fog_front);
  EXPECT_EQ(b.send({1}, 2), SignalMap::Taken::kIncomplete) << "too short";
}

TEST(Controls, AutomaticHighBeamFromTheCarsCamera) {
  Bench b(can("[automatic_high_beam]\nabove_kmh = 36\nbelow_kmh = 18\ndelay_s = 0.1\n" +
              control("light_switch", "S1", "levels = { off = 0, low = 2 }\n") + control("automatic_high", "S0") +
              control("vehicle_ahead", "S2")));
  b.cockpit->set_speed(20.0);
  b.send({0, 2, 0});
  for (int i = 0; i < 4; ++i) b.send({0, 2, 0});
  EXPECT_EQ(b.state().light_switch, LightSwitch::kLow) << "its switch is off";
  for (int i = 0; i < 4; ++i) b.send({1, 2, 0});
  EXPECT_TRUE(b.state().high_beam_automatic);
  EXPECT_EQ(b.state().light_switch, LightSwitch::kHigh);
  b.send({1, 2, 1});
  EXPECT_EQ(b.state().light_switch, LightSwitch::kLow) << "at once";
}

TEST(Controls, AWrittenValueIsThatOfTheSignalNearestToIt) {
  Bench b(can(control("flash", "ANGLE", "on = [0.3, 0.7]\n")));  // 3 x 0.1 is not 0.3 in float64
  for (const auto& [raw, on] : {std::pair{3, true}, {4, false}, {7, true}}) {
    b.send({0, 0, 0, raw, 0});
    EXPECT_EQ(b.state().flash, on) << raw;
  }
}

// Not available and errors are no values: of a pedal, of a flag, by the DBC file's names or by the cockpit file.
TEST(Controls, WhatIsNotAvailableChangesNothing) {
  Bench pedal(can(control("brake", "S2", "range = [0, 100]\n") +
                  control("accelerator", "S1", "range = [0, 100]\ninvalid = 200\n")));
  EXPECT_EQ(pedal.send({0, 25, 50}), SignalMap::Taken::kDecoded);
  EXPECT_EQ(pedal.send({0, 200, 255}), SignalMap::Taken::kIncomplete);
  EXPECT_EQ(pedal.input.brake_01, 0.5);
  EXPECT_EQ(pedal.input.accelerator_01, 0.25);
  EXPECT_EQ(pedal.send({0, 201, 254}), SignalMap::Taken::kDecoded);
  EXPECT_EQ(pedal.input.brake_01, 1.0) << "254 is called otherwise";
  EXPECT_EQ(pedal.input.accelerator_01, 1.0);

  // By both at once.
  Bench both(can(control("brake", "COUNT", "range = [0, 10]\ninvalid = 15\n")));
  both.send({0, 0, 0, 0, 0, 5});
  for (const int nothing : {13, 14, 15}) EXPECT_EQ(both.send({0, 0, 0, 0, 0, nothing}), SignalMap::Taken::kIncomplete);
  EXPECT_EQ(both.input.brake_01, 0.5);
  EXPECT_EQ(both.send({0, 0, 0, 0, 0, 12}), SignalMap::Taken::kDecoded);

  Bench lamp(can(control("low", "S2") + control("position", "S1")));
  lamp.send({0, 1, 1});
  EXPECT_EQ(lamp.state().light_switch, LightSwitch::kLow);
  const std::int64_t silent_at = lamp.map.silent_at_ns();
  EXPECT_EQ(lamp.send({0, 1, 255}), SignalMap::Taken::kIncomplete);
  EXPECT_EQ(lamp.state().light_switch, LightSwitch::kLow) << "it stays";
  EXPECT_EQ(lamp.map.silent_at_ns(), silent_at) << "and nobody knows what is wanted";

  Bench said(can(control("flash", "S2", "on = [\"LIGHT_SNA\"]\n")));
  EXPECT_EQ(said.send({0, 0, 255}), SignalMap::Taken::kDecoded);
  EXPECT_TRUE(said.state().flash) << "the cockpit file says what it means";
}

// ---- what is refused

TEST(Checks, AFrameWithAWrongCrcIsNotRead) {
  const std::string check = "[check.A]\ncounter = \"COUNT\"\ncrc = \"CRC\"\ncrc_kind = \"xor8\"\n";
  Bench b(can(control("flash", "S0") + check));
  EXPECT_EQ(b.send({1, 0, 0, 0, 0, 1, 0, 0}), SignalMap::Taken::kDecoded);
  EXPECT_TRUE(b.state().flash);
  const std::int64_t silent_at = b.map.silent_at_ns();
  EXPECT_EQ(b.send({0, 0, 0, 0, 0, 2, 0, 3}), SignalMap::Taken::kBadCrc);
  EXPECT_EQ(b.send({0, 0, 0, 0, 0, 1, 0, 1}), SignalMap::Taken::kBadCounter);
  EXPECT_TRUE(b.state().flash);
  EXPECT_EQ(b.map.silent_at_ns(), silent_at) << "a refused frame is no sign of life";
  EXPECT_EQ(b.send({0, 0, 0, 0, 0, 4, 0, 4}), SignalMap::Taken::kDecoded);
  EXPECT_EQ(b.map.lost(), 2u);
}

// What no frame says again: a push button that latches, and the levelling wheel before its message comes; and a stalk
// that had been silent does not speak because the cockpit is new.
TEST(SignalMap, LatchesAndTheTimeOfSilenceAreRemembered) {
  const auto config = parse_cockpit(can(control("fog_front", "S0", "latch = true\n") +
                                        control("lamp_aim", "S1", "range = [0, 100]\nlowest_deg = -2.0\n")),
                                    "c.toml");
  ASSERT_TRUE(config.ok()) << config.error().text();
  const auto fresh = [&](std::int64_t start_ns) {
    return *SignalMap::bind(*config, *parse_dbc(kDbc, "c.dbc"), start_ns);
  };
  SignalMap map = fresh(0);
  DriverInput input;
  const auto send = [&](SignalMap& to, std::uint8_t button, std::int64_t ms) {
    CanFrame frame;
    frame.id = 1;
    frame.length = 8;
    frame.data[0] = button;
    frame.data[1] = 100;
    return to.take(frame, ms * kMs, input);
  };
  send(map, 1, 100);
  send(map, 0, 200);
  ASSERT_TRUE(input.switches.fog_front);
  Memory left;
  map.remember(left);
  SignalMap next = fresh(10'000 * kMs);
  Memory taken_up(left.bytes());
  next.remember(taken_up);
  EXPECT_EQ(next.silent_at_ns(), map.silent_at_ns());
  send(next, 0, 10'100);
  EXPECT_TRUE(input.switches.fog_front);
  send(next, 1, 10'200);
  EXPECT_FALSE(input.switches.fog_front) << "the next press switches it off";
  SignalMap forgetful = fresh(10'000 * kMs);
  send(forgetful, 0, 10'100);
  EXPECT_FALSE(input.switches.fog_front);
}

TEST(CockpitFile, EveryShippedCarFitsItsDbc) {
  const std::filesystem::path cockpits = cockpits_dir();
  const auto folder = std::filesystem::path(shared_data_dir()) / "dbc/opendbc";
  const bool there = std::filesystem::exists(folder);
  const std::vector<std::pair<const char*, const char*>> cars{
      {"toyota_rav4.toml", "toyota_nodsu_pt_generated.dbc"},
      {"honda_civic.toml", "honda_civic_touring_2016_can_generated.dbc"},
      {"vw_mqb.toml", "vw_mqb.dbc"},
      {"tesla_model3.toml", "tesla_model3_vehicle.dbc"},
      {"psa_aee2010.toml", "psa_aee2010_r3.dbc"},
      {"mazda_2017.toml", "mazda_2017.dbc"}};
  for (const auto& [car, dbc_name] : cars) {
    const auto config = read_cockpit(cockpits / car);
    ASSERT_TRUE(config.ok()) << config.error().text();
    for (const auto& beside : config->also) EXPECT_TRUE(read_cockpit(beside).ok()) << beside;
    if (!there) continue;
    const auto dbc = read_dbc(folder / dbc_name);
    ASSERT_TRUE(dbc.ok());
    const auto map = SignalMap::bind(*config, *dbc, 0);
    EXPECT_TRUE(map.ok()) << (map.ok() ? "" : map.error().text());
    EXPECT_TRUE(Feedback::bind(*config, *dbc).ok());
    // A frame of zeros and one of ones in every mapped message: any answer but a crash.
    SignalMap taking = *map;
    DriverInput input;
    for (const CanId& id : taking.ids()) {
      CanFrame frame = empty_frame(*dbc->find(id.id, id.extended));
      taking.take(frame, 1, input);
      frame.data.fill(0xFF);
      taking.take(frame, 2, input);
    }
  }
  EXPECT_TRUE(read_cockpit(cockpits / "gamepad.toml").ok());
  if (!there) GTEST_SKIP() << "no " << folder;
}

// ---- what is sent back

TEST(Feedback, SendsEveryPeriodAndAtOnceWhenATelltaleChanges) {
  const auto config = parse_cockpit(
      can("[[send]]\nmessage = \"OUT\"\nperiod_s = 0.1\n[send.signals]\nHIGH = \"high_beam\"\nKMH = \"speed_kmh\"\n"
          "[check.OUT]\ncounter = \"COUNT\"\ncrc = \"CRC\"\ncrc_kind = \"sum8\"\n" +
          control("flash", "S0")),
      "c.toml");
  ASSERT_TRUE(config.ok()) << config.error().text();
  auto feedback = Feedback::bind(*config, *parse_dbc(kDbc, "c.dbc"));
  ASSERT_TRUE(feedback.ok()) << feedback.error().text();
  FeedbackValues values;
  values.speed_mps = 10.0;
  auto frames = feedback->due(values, 0);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].id, 3u);
  EXPECT_EQ(frames[0].data[0], 0);
  EXPECT_EQ(frames[0].data[1], 36);
  EXPECT_EQ(frames[0].data[7], 36) << "sum of the bytes, counter 0";
  EXPECT_TRUE(feedback->due(values, 50 * kMs).empty());
  values.speed_mps = 20.0;
  EXPECT_TRUE(feedback->due(values, 60 * kMs).empty()) << "speed waits";
  values.telltales.high_beam = true;
  frames = feedback->due(values, 70 * kMs);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].data[0], 1);
  EXPECT_EQ(frames[0].data[1], 72);
  EXPECT_EQ(frames[0].data[2], 1) << "counter";
  EXPECT_EQ(frames[0].data[7], 74);
  values.speed_mps = -3.0;
  EXPECT_EQ(feedback->due(values, 200 * kMs).at(0).data[1], 0) << "the nearest that fits";
}

// ---- gamepads and several sources

GamepadReading reading(std::vector<float> axes, std::vector<std::uint8_t> buttons,
                       std::vector<std::uint8_t> hats = {0}) {
  return {std::move(axes), std::move(buttons), std::move(hats)};
}

TEST(Gamepad, AxesButtonsAndHatsBecomeControls) {
  const auto config = read_cockpit(std::filesystem::path(cockpits_dir()) / "gamepad.toml");
  ASSERT_TRUE(config.ok()) << config.error().text();
  std::optional<GamepadReading> now = reading({0, 0, -1, 0, 0, -1}, {0, 0, 0, 0, 0, 0});
  GamepadSource source(*config, [&] { return now; });
  Cockpit cockpit(switch_params(*config, 3), "gamepad");
  std::int64_t ms = 0;
  const auto step = [&](std::int64_t more_ms = 50) {
    ms += more_ms;
    source.advance({SimTime{ms * kMs}, WallTime{ms * kMs}}, nullptr, cockpit);
    return cockpit.state(-1, false);
  };
  EXPECT_EQ(step().light_switch, LightSwitch::kLow);
  now = reading({-0.5f, 0, 1, 0, 0, 0}, {0, 1, 0, 0, 0, 0}, {2});
  CockpitState state = step();
  EXPECT_NEAR(state.steering_wheel_rad, 225.0 * kDeg, 1e-6);
  EXPECT_EQ(state.brake_01, 1.0);
  EXPECT_NEAR(state.accelerator_01, (0.5 - 0.03) / 0.97, 1e-6);
  EXPECT_TRUE(state.flash);
  EXPECT_EQ(state.design_index, 1u);
  now = reading({0.02f, 0, -1, 0, 0, -1}, {0, 0, 0, 1, 0, 0});
  state = step();
  EXPECT_EQ(state.steering_wheel_rad, 0.0) << "dead zone";
  EXPECT_EQ(state.light_switch, LightSwitch::kHigh);
  now.reset();  // unplugged
  state = step(100);
  EXPECT_FALSE(state.fail_safe);
  EXPECT_EQ(source.status(), "down");
  state = step(500);
  EXPECT_TRUE(state.fail_safe);
  EXPECT_EQ(state.light_switch, LightSwitch::kLow);
  now = reading({0}, {0});  // another device, with too few axes
  step();
  EXPECT_GT(source.counts().incomplete, 0u);
  EXPECT_EQ(gamepad_value(*now, "axis9"), std::nullopt);
}

/// A source that says what a test wants.
class Scripted : public Source {
 public:
  void advance(Moment now, const VehicleState*, ControlSink& sink) override { sink.take(input, silent, now); }
  DriverInput input;
  bool silent = false;
};

TEST(CombinedSource, TheFirstThatHasAControlAndSpeaksGivesIt) {
  CockpitConfig stalk;
  stalk.source = SourceKind::kCan;
  stalk.controls.resize(1);
  stalk.controls[0].control = Control::kLightSwitch;
  CockpitConfig pedals;
  pedals.source = SourceKind::kGamepad;
  pedals.controls.resize(2);
  pedals.controls[0].control = Control::kSteering;
  pedals.controls[1].control = Control::kBrake;
  CockpitConfig keys;
  keys.source = SourceKind::kKeyboard;
  auto a = std::make_unique<Scripted>();
  auto b = std::make_unique<Scripted>();
  auto c = std::make_unique<Scripted>();
  Scripted &can0 = *a, &pad = *b, &keyboard = *c;
  can0.input.switches.stalk = LightSwitch::kHigh;
  can0.input.steering_wheel_rad = 9.0;  // not mapped there: does not count
  pad.input.steering_wheel_rad = 1.0;
  pad.input.brake_01 = 0.5;
  keyboard.input.switches.stalk = LightSwitch::kPosition;
  keyboard.input.steering_wheel_rad = 2.0;
  keyboard.input.switches.flash = true;
  std::vector<CombinedSource::Part> parts;
  parts.push_back({std::move(a), stalk});
  parts.push_back({std::move(b), pedals});
  parts.push_back({std::move(c), keys});
  CombinedSource source(std::move(parts));
  Cockpit cockpit({0, 1}, "can0");
  std::int64_t ms = 0;
  const auto state = [&] {
    ms += 10;
    source.advance({SimTime{ms * kMs}, WallTime{ms * kMs}}, nullptr, cockpit);
    return cockpit.state(-1, false);
  };
  EXPECT_EQ(state().light_switch, LightSwitch::kHigh);
  EXPECT_EQ(state().steering_wheel_rad, 1.0);
  EXPECT_EQ(state().brake_01, 0.5);
  EXPECT_TRUE(state().flash) << "only the keyboard has it";
  can0.silent = true;
  EXPECT_EQ(state().light_switch, LightSwitch::kPosition) << "the next that has it";
  EXPECT_FALSE(state().fail_safe);
  keyboard.silent = true;
  EXPECT_TRUE(state().fail_safe);
  EXPECT_EQ(state().light_switch, LightSwitch::kLow);
  EXPECT_EQ(state().steering_wheel_rad, 1.0);
  pad.silent = true;
  can0.silent = false;
  EXPECT_EQ(state().light_switch, LightSwitch::kHigh);
  EXPECT_EQ(state().steering_wheel_rad, 1.0) << "the last word of the one that had it";
}

}  // namespace
}  // namespace phare
