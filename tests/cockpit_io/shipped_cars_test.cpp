// reference: every shipped cockpit file against the DBC file of its car: each movement of each control is put on the
// bus as the car would, with its counter and checksum, and read back. Needs the DBC files; skips without.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

#include "cockpit_io/cockpit.h"
#include "cockpit_io/signal_map.h"
#include "config/cockpit.h"
#include "tests/paths.h"

namespace phare {
namespace {

struct ShippedCar {
  const char* cockpit;
  const char* dbc;
};
constexpr ShippedCar kShippedCars[]{{"toyota_rav4.toml", "toyota_nodsu_pt_generated.dbc"},
                                    {"honda_civic.toml", "honda_civic_touring_2016_can_generated.dbc"},
                                    {"vw_mqb.toml", "vw_mqb.dbc"},
                                    {"tesla_model3.toml", "tesla_model3_vehicle.dbc"},
                                    {"psa_aee2010.toml", "psa_aee2010_r3.dbc"},
                                    {"mazda_2017.toml", "mazda_2017.dbc"}};

std::filesystem::path shipped_dbc(const ShippedCar& car) {
  return std::filesystem::path(shared_data_dir()) / "dbc/opendbc" / car.dbc;
}

/// A car that sends: every message keeps what its signals were set to, and counts on.
class SendingCar {
 public:
  explicit SendingCar(const ShippedCar& car)
      : config_(*read_cockpit(std::filesystem::path(cockpits_dir()) / car.cockpit)),
        map_(*SignalMap::bind(config_, *read_dbc(shipped_dbc(car)), 0)) {
    input = initial_input(config_);
    for (const MessageCheck& check : config_.checks) {
      auto checker = MessageChecker::bind(check, map_.dbc(), *map_.dbc().find(check.message));
      EXPECT_TRUE(checker) << checker.error().text();
      checkers_.emplace(check.message, std::move(*checker));
    }
  }

  /// Sets a signal of the control's message and sends the message.
  SignalMap::Taken send(const ControlMapping& control, const std::string& name, double value) {
    const DbcMessage& message = *map_.dbc().find(control.message);
    const auto [frame, fresh] = frames_.try_emplace(control.message, empty_frame(message));
    const DbcSignal set = name == control.signal ? signal(control) : *message.find(name);
    EXPECT_TRUE(encode(message, set, value, frame->second)) << name << " = " << value;
    const auto checker = checkers_.find(control.message);
    if (checker != checkers_.end()) checker->second.sign(frame->second);
    return map_.take(frame->second, at_ns_ += 100'000'000, input);
  }
  SignalMap::Taken send(const ControlMapping& control, double value) { return send(control, control.signal, value); }

  DbcSignal signal(const ControlMapping& control) const {
    const DbcMessage& message = *map_.dbc().find(control.message);
    return *laid_out(control, message, *message.find(control.signal));
  }
  /// A value of the cockpit file as a number.
  double number(const ControlMapping& control, const NamedValue& value) const {
    if (value.name.empty()) return value.value;
    const DbcSignal of = signal(control);
    for (const auto& [raw, name] : of.value_names)
      if (name == value.name) return static_cast<double>(raw) * of.factor + of.offset;
    ADD_FAILURE() << "no value " << value.name;
    return 0.0;
  }
  const CockpitConfig& config() const { return config_; }

  DriverInput input;

 private:
  CockpitConfig config_;
  SignalMap map_;
  std::map<std::string, MessageChecker> checkers_;
  std::map<std::string, CanFrame> frames_;
  std::int64_t at_ns_ = 0;
};

/// Where a control with levels stands.
int stands_at(const ControlMapping& control, const DriverInput& input) {
  switch (control.control) {
    case Control::kLightSwitch:
      return static_cast<int>(input.switches.stalk);
    case Control::kBeamLever:
      return static_cast<int>(input.switches.lever);
    case Control::kTurn:
      return static_cast<int>(input.switches.turn);
    default:
      return static_cast<int>(input.gear);
  }
}

/// Whether a flag is up.
bool is_up(const ControlMapping& control, const DriverInput& input) {
  const SwitchInput& s = input.switches;
  switch (control.control) {
    case Control::kPosition:
      return s.stalk >= LightSwitch::kPosition;
    case Control::kLow:
      return s.stalk >= LightSwitch::kLow;
    case Control::kHigh:
      return s.high;
    case Control::kFlash:
      return s.flash;
    case Control::kFogFront:
      return s.fog_front;
    case Control::kFogRear:
      return s.fog_rear;
    case Control::kTurnLeft:
      return s.turn == TurnSignal::kLeft;
    case Control::kTurnRight:
      return s.turn == TurnSignal::kRight;
    case Control::kHazard:
      return s.hazard;
    case Control::kAutomaticHigh:
      return s.automatic;
    case Control::kVehicleAhead:
      return s.ahead;
    default:
      return s.ignition;
  }
}

double pedal_of(const ControlMapping& control, const DriverInput& input) {
  switch (control.control) {
    case Control::kAccelerator:
      return input.accelerator_01;
    case Control::kBrake:
      return input.brake_01;
    case Control::kClutch:
      return input.clutch_01;
    default:
      return input.parking_brake_01;
  }
}

class ShippedCars : public testing::TestWithParam<ShippedCar> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(shipped_dbc(GetParam()))) GTEST_SKIP() << "no " << shipped_dbc(GetParam());
  }
};

TEST_P(ShippedCars, EveryLevelIsReadAsWhatItMeans) {
  SendingCar car(GetParam());
  for (const ControlMapping& control : car.config().controls) {
    for (const SignalLevel& level : control.levels) {
      car.send(control, car.number(control, level.when));
      EXPECT_EQ(stands_at(control, car.input), level.level)
          << control.place << " " << level.when.name << level.when.value;
    }
    // What the DBC file has a name for, the cockpit file has a meaning for.
    if (control.levels.empty()) continue;
    std::set<double> known;
    for (const SignalLevel& level : control.levels) known.insert(car.number(control, level.when));
    const DbcSignal signal = car.signal(control);
    for (const auto& [raw, name] : signal.value_names) {
      if (!control.bits.empty()) break;  // the car's are others than the file's
      EXPECT_TRUE(known.contains(static_cast<double>(raw) * signal.factor + signal.offset))
          << control.place << ": " << signal.name << " may be " << raw << " \"" << name << "\"";
    }
  }
}

TEST_P(ShippedCars, EveryFlagGoesUpAndDown) {
  SendingCar car(GetParam());
  for (const ControlMapping& control : car.config().controls) {
    const bool flag = control.control <= Control::kIgnition && control.levels.empty() &&
                      control.control != Control::kLampAim && control.latch == LatchKind::kNone;
    if (!flag) continue;
    std::vector<double> pressed{1.0};
    if (!control.on.empty()) pressed.clear();
    for (const NamedValue& on : control.on) pressed.push_back(car.number(control, on));
    for (const double value : pressed) {
      for (const double now : {value, 0.0, value, 0.0}) {
        EXPECT_EQ(car.send(control, now), SignalMap::Taken::kDecoded) << control.place;
        EXPECT_EQ(is_up(control, car.input), (now != 0.0) != control.invert) << control.place << " = " << now;
      }
    }
  }
}

// To half a step of the signal.
TEST_P(ShippedCars, WheelAndPedalsReachTheirEnds) {
  SendingCar car(GetParam());
  for (const ControlMapping& control : car.config().controls) {
    if (control.control == Control::kSteering) {
      for (const double wheel_deg : {-90.0, 0.0, 90.0}) {
        const double value = (wheel_deg - control.offset_deg) / control.scale;
        if (!control.sign_signal.empty()) car.send(control, control.sign_signal, value < 0.0 ? 1.0 : 0.0);
        car.send(control, control.sign_signal.empty() ? value : std::abs(value));
        EXPECT_NEAR(car.input.steering_wheel_rad * 180.0 / std::numbers::pi, wheel_deg,
                    0.5 * std::abs(car.signal(control).factor * control.scale) + 1e-9)
            << control.place;
      }
    }
    const bool pedal = control.control >= Control::kAccelerator && control.control != Control::kGear;
    if (!pedal) continue;
    for (const double pressed_01 : {0.0, 1.0, 0.0}) {
      car.send(control, pressed_01 == 0.0 ? control.lowest : control.highest);
      const double step_01 = 0.5 * std::abs(car.signal(control).factor / (control.highest - control.lowest));
      EXPECT_NEAR(pedal_of(control, car.input), pressed_01, step_01) << control.place;
    }
  }
}

// The movements of a night drive, through the switch logic: off, position, low, high and back, where the car has them.
TEST_P(ShippedCars, EachBeamIsTheOneTheStalkAsksFor) {
  SendingCar car(GetParam());
  const CockpitConfig& config = car.config();
  const ControlMapping* low = config.find(Control::kLow);
  if (low == nullptr) GTEST_SKIP() << "the lights of this car are not on its bus";
  Cockpit cockpit(switch_params(config, 1), "test");
  std::int64_t now_ns = 0;
  const auto beam = [&] {
    now_ns += 100'000'000;  // past the debounce
    cockpit.take(car.input, false, {SimTime{now_ns}, WallTime{now_ns}});
    return cockpit.state(-1, false).light_switch;
  };
  const auto set = [&](const ControlMapping* control, bool on) {
    if (control == nullptr) return;
    const double pressed = control->on.empty() ? 1.0 : car.number(*control, control->on.front());
    car.send(*control, on ? pressed : 0.0);
  };
  if (const ControlMapping* ignition = config.find(Control::kIgnition)) set(ignition, true);
  const ControlMapping* position = config.find(Control::kPosition);
  set(low, false);
  EXPECT_EQ(beam(), LightSwitch::kOff);
  set(position, true);
  EXPECT_EQ(beam(), position != nullptr ? LightSwitch::kPosition : LightSwitch::kOff);
  set(low, true);
  EXPECT_EQ(beam(), LightSwitch::kLow);
  const ControlMapping* high = config.find(Control::kHigh);
  const ControlMapping* lever = config.find(Control::kBeamLever);
  const auto move_lever = [&](Lever to) {
    for (const SignalLevel& level : lever->levels) {
      if (level.level != static_cast<int>(to)) continue;
      car.send(*lever, car.number(*lever, level.when));
      return;
    }
  };
  for (int times = 0; times < 3; ++times) {
    if (high != nullptr) set(high, true);
    if (lever != nullptr) move_lever(Lever::kPush);
    EXPECT_EQ(beam(), LightSwitch::kHigh) << times;
    if (lever != nullptr) move_lever(Lever::kNeutral);
    EXPECT_EQ(beam(), LightSwitch::kHigh) << times;
    if (high != nullptr) set(high, false);
    if (lever != nullptr) move_lever(Lever::kPush);
    EXPECT_EQ(beam(), LightSwitch::kLow) << times;
    if (lever != nullptr) move_lever(Lever::kNeutral);
    EXPECT_EQ(beam(), LightSwitch::kLow) << times;
  }
  set(low, false);
  set(position, false);
  EXPECT_EQ(beam(), LightSwitch::kOff);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedCars, testing::ValuesIn(kShippedCars), [](const auto& of) {
  return std::string(of.param.cockpit).substr(0, std::string(of.param.cockpit).find('.'));
});

}  // namespace
}  // namespace phare
