#include "config/cockpit_control.h"

#include <algorithm>
#include <numbers>
#include <span>
#include <utility>
#include <variant>

#include "config/control_levels.h"

namespace phare {

namespace {

constexpr double kAnyNumber = 1e12;  // keeps values well inside double without limiting a real signal
constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr double kLowestAim_deg = -2.3;  // 4 %, the end of a common levelling wheel's travel

struct NamedLevel {
  std::string_view name;
  int level;
};
using Levels = std::span<const NamedLevel>;

constexpr NamedLevel kLightLevels[]{{kLightSwitchNames[0], static_cast<int>(LightSwitch::kOff)},
                                    {kLightSwitchNames[1], static_cast<int>(LightSwitch::kPosition)},
                                    {kLightSwitchNames[2], static_cast<int>(LightSwitch::kLow)},
                                    {kLightSwitchNames[3], static_cast<int>(LightSwitch::kHigh)},
                                    {"auto", static_cast<int>(LightSwitch::kLow)}};
constexpr NamedLevel kGearLevels[]{{"drive", static_cast<int>(Gear::kDrive)},
                                   {"neutral", static_cast<int>(Gear::kNeutral)},
                                   {"reverse", static_cast<int>(Gear::kReverse)},
                                   {"park", static_cast<int>(Gear::kPark)}};
constexpr NamedLevel kTurnLevels[]{{"none", static_cast<int>(TurnSignal::kNone)},
                                   {"left", static_cast<int>(TurnSignal::kLeft)},
                                   {"right", static_cast<int>(TurnSignal::kRight)}};
constexpr NamedLevel kLeverLevels[]{{"neutral", 0}, {"push", 1}, {"pull", 2}, {"half", 3}};  // Lever

Levels levels_of(Control control) {
  switch (control) {
    case Control::kLightSwitch:
      return kLightLevels;
    case Control::kGear:
      return kGearLevels;
    case Control::kTurn:
      return kTurnLevels;
    case Control::kBeamLever:
      return kLeverLevels;
    default:
      return {};
  }
}

bool is_pedal(Control control) {
  return control == Control::kAccelerator || control == Control::kBrake || control == Control::kClutch ||
         control == Control::kParkingBrake;
}

std::vector<NamedValue> named_values(TomlTable& table, std::string_view key) {
  std::vector<NamedValue> values;
  for (const auto& value : table.values_or_empty(key)) {
    if (const auto* number = std::get_if<double>(&value)) {
      values.push_back({*number, {}, table.place(key)});
    } else {
      values.push_back({0.0, std::get<std::string>(value), table.place(key)});
      if (values.back().name.empty()) table.fail(key, "an empty name");
    }
  }
  return values;
}

void read_levels(TomlTable table, Levels names, ControlMapping& mapping) {
  TomlTable levels = table.table("levels");
  int different = 0;
  for (const auto& [name, level] : names) {
    if (!levels.has(name)) continue;
    ++different;
    for (NamedValue& value : named_values(levels, name)) {
      const bool twice = std::any_of(mapping.levels.begin(), mapping.levels.end(), [&](const SignalLevel& l) {
        return l.when.name == value.name && l.when.value == value.value;
      });
      if (twice) levels.fail(name, "another level has this value too");
      mapping.levels.push_back({std::move(value), level});
    }
  }
  if (different < 2 && table.has("levels")) table.fail("levels", "expected at least two levels");
}

/// The signal of a gamepad: axis = 0, button = 3, or hat = "0.up".
std::string gamepad_signal(TomlTable& table) {
  const int given =
      static_cast<int>(table.has("axis")) + static_cast<int>(table.has("button")) + static_cast<int>(table.has("hat"));
  if (given != 1) table.fail({}, "expected one of axis, button and hat");
  if (table.has("axis")) return "axis" + std::to_string(table.integer("axis", 0, 63));
  if (table.has("button")) return "button" + std::to_string(table.integer("button", 0, 255));
  if (!table.has("hat")) return "axis0";
  const std::string hat = table.text("hat");
  constexpr std::string_view kWays[]{".up", ".down", ".left", ".right"};
  const bool good = hat.size() > 1 && hat.front() >= '0' && hat.front() <= '9' &&
                    std::find(std::begin(kWays), std::end(kWays), std::string_view(hat).substr(1)) != std::end(kWays);
  if (!good) table.fail("hat", "expected a hat and its way, such as \"0.up\"");
  return "hat" + hat;
}

void read_range(TomlTable& table, ControlMapping& mapping, std::string_view what) {
  constexpr double kUnit[]{0.0, 1.0};
  const auto range = table.numbers_or("range", kUnit);
  mapping.lowest = range[0];
  mapping.highest = range[1];
  mapping.dead_zone = table.number_or("dead_zone", 0.0, 0.0, 0.9);
  if (range[0] == range[1]) table.fail("range", "expected [" + std::string(what) + "], two different values");
}

}  // namespace

ControlMapping read_control(Control control, TomlTable table, double timeout_s, bool gamepad) {
  ControlMapping mapping;
  mapping.control = control;
  mapping.place = table.place();
  if (gamepad) {
    mapping.signal = gamepad_signal(table);
  } else {
    mapping.message = table.text("message");
    mapping.signal = table.text("signal");
    mapping.bits = table.text_or("bits", "");
    if (table.has("invalid")) mapping.invalid = named_values(table, "invalid");
    mapping.timeout_s = table.number_or("timeout_s", timeout_s, 0.001, kMostTimeout_s);
  }
  mapping.message_place = table.place("message");
  mapping.signal_place = table.place("signal");
  mapping.fine_place = table.place("fine_signal");
  mapping.sign_place = table.place("sign_signal");
  mapping.bits_place = table.place("bits");
  if (const Levels levels = levels_of(control); !levels.empty()) {
    read_levels(table, levels, mapping);
    mapping.debounce_s = table.has("debounce_s") ? std::optional(table.number("debounce_s", 0.0, 1.0)) : std::nullopt;
    if (control == Control::kBeamLever)
      mapping.latch = static_cast<LatchKind>(table.choice_or("latch", 0, kLatchNames));
    return mapping;
  }
  if (control == Control::kSteering) {
    constexpr double kFull_deg[]{-720.0, 720.0};
    if (!gamepad) mapping.fine_signal = table.text_or("fine_signal", "");
    if (!gamepad) mapping.sign_signal = table.text_or("sign_signal", "");
    mapping.scale = table.number_or("scale", gamepad ? -450.0 : 1.0, -kAnyNumber, kAnyNumber);
    if (mapping.scale == 0.0) table.fail("scale", "must not be 0, or the wheel stands still whatever the signal says");
    mapping.offset_deg = table.number_or("offset_deg", 0.0, -3600.0, 3600.0);
    mapping.dead_zone = table.number_or("dead_zone_deg", 0.0, 0.0, 90.0);
    const auto range = table.numbers_or("range_deg", kFull_deg);
    mapping.lowest = range[0];
    mapping.highest = range[1];
    // The wire takes three turns to a side.
    if (!(range[0] < range[1]) || range[0] < -1080.0 || range[1] > 1080.0)
      table.fail("range_deg", "expected [lowest, highest] within -1080 and 1080");
    else if (range[0] > 0.0 || range[1] < 0.0)
      table.fail("range_deg", "must have 0 in it, or the wheel is never straight");
  } else if (is_pedal(control)) {
    if (!gamepad) mapping.fine_signal = table.text_or("fine_signal", "");
    read_range(table, mapping, "value when released, value when pressed");
  } else if (control == Control::kLampAim) {
    read_range(table, mapping, "value at the highest aim, value at the lowest");
    mapping.lowest_aim_rad = table.number_or("lowest_deg", kLowestAim_deg, -10.0, 10.0) * kDegree_rad;
  } else {
    if (table.has("on")) mapping.on = named_values(table, "on");
    mapping.invert = table.flag_or("invert", false);
    mapping.latch = table.flag_or("latch", false) ? LatchKind::kPush : LatchKind::kNone;
    mapping.debounce_s = table.has("debounce_s") ? std::optional(table.number("debounce_s", 0.0, 1.0)) : std::nullopt;
  }
  return mapping;
}

void check_conflicts(TomlTable& controls, const CockpitConfig& config) {
  const auto name = [](Control control) { return kControlNames[static_cast<std::size_t>(control)]; };
  const auto exclude = [&](Control first, Control second, bool really = true) {
    const ControlMapping* a = config.find(first);
    const ControlMapping* b = config.find(second);
    if (a == nullptr || b == nullptr || !really) return;
    controls.fail(name(second), "two signals for one control: " + b->signal + " here, and " + a->signal + " of " +
                                    std::string(name(first)));
  };
  exclude(Control::kLightSwitch, Control::kPosition);
  exclude(Control::kLightSwitch, Control::kLow);
  const ControlMapping* levels = config.find(Control::kLightSwitch);
  const bool knows_high =
      levels != nullptr && std::any_of(levels->levels.begin(), levels->levels.end(), [](const SignalLevel& l) {
        return l.level == static_cast<int>(LightSwitch::kHigh);
      });
  exclude(Control::kLightSwitch, Control::kHigh, knows_high);
  exclude(Control::kLightSwitch, Control::kBeamLever, knows_high);
  exclude(Control::kHigh, Control::kBeamLever);
  exclude(Control::kTurn, Control::kTurnLeft);
  exclude(Control::kTurn, Control::kTurnRight);
}

}  // namespace phare
