#include "config/cockpit.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "config/rig.h"
#include "config/toml_table.h"
#include "net/messages.h"

namespace phare {

namespace {

constexpr double kAnyNumber = 1e12;  // keeps values well inside double without limiting a real signal
constexpr double kMostTimeout_s = 3600.0;

using Levels = std::span<const std::pair<std::string_view, int>>;

constexpr std::pair<std::string_view, int> kLightLevels[]{{"off", static_cast<int>(LightSwitch::kOff)},
                                                          {"position", static_cast<int>(LightSwitch::kPosition)},
                                                          {"low", static_cast<int>(LightSwitch::kLow)},
                                                          {"high", static_cast<int>(LightSwitch::kHigh)}};
constexpr std::pair<std::string_view, int> kGearLevels[]{{"drive", static_cast<int>(Gear::kDrive)},
                                                         {"neutral", static_cast<int>(Gear::kNeutral)},
                                                         {"reverse", static_cast<int>(Gear::kReverse)},
                                                         {"park", static_cast<int>(Gear::kPark)}};

bool has_levels(Control control) {
  return control == Control::kLightSwitch || control == Control::kGear;
}
bool is_pedal(Control control) {
  return control == Control::kAccelerator || control == Control::kBrake;
}

void read_levels(TomlTable table, Levels names, ControlMapping& mapping) {
  TomlTable levels = table.table("levels");
  for (const auto& [name, level] : names) {
    if (!levels.has(name)) continue;
    const double value = levels.number(name, -kAnyNumber, kAnyNumber);
    const bool twice =
        std::any_of(mapping.levels.begin(), mapping.levels.end(), [&](const auto& l) { return l.first == value; });
    if (twice) levels.fail(name, "another level has this value too");
    mapping.levels.emplace_back(value, level);
  }
  if (mapping.levels.size() < 2 && table.has("levels")) table.fail("levels", "expected at least two levels");
}

ControlMapping read_control(Control control, TomlTable table, double timeout_s) {
  ControlMapping mapping;
  mapping.control = control;
  mapping.place = table.place();
  mapping.message = table.text("message");
  mapping.message_place = table.place("message");
  mapping.signal = table.text("signal");
  mapping.signal_place = table.place("signal");
  mapping.timeout_s = table.number_or("timeout_s", timeout_s, 0.001, kMostTimeout_s);
  if (has_levels(control)) {
    read_levels(table, control == Control::kGear ? Levels(kGearLevels) : Levels(kLightLevels), mapping);
  } else if (control == Control::kSteering) {
    constexpr double kFull_deg[]{-720.0, 720.0};
    mapping.fine_signal = table.text_or("fine_signal", "");
    mapping.scale = table.number_or("scale", 1.0, -kAnyNumber, kAnyNumber);
    mapping.offset_deg = table.number_or("offset_deg", 0.0, -3600.0, 3600.0);
    const auto range = table.numbers_or("range_deg", kFull_deg);
    mapping.lowest = range[0];
    mapping.highest = range[1];
    if (!(range[0] < range[1])) table.fail("range_deg", "expected [lowest, highest]");
  } else if (is_pedal(control)) {
    constexpr double kUnit[]{0.0, 1.0};
    mapping.fine_signal = table.text_or("fine_signal", "");
    const auto range = table.numbers_or("range", kUnit);
    mapping.lowest = range[0];
    mapping.highest = range[1];
    if (range[0] == range[1])
      table.fail("range", "expected [value when released, value when pressed], two different ones");
  } else if (table.has("on")) {
    mapping.on = table.number("on", -kAnyNumber, kAnyNumber);
  }
  return mapping;
}

/// Two signals that claim the same control.
void check_conflicts(TomlTable& controls, const CockpitConfig& config) {
  const auto find = [&](Control wanted) {
    const auto found = std::find_if(config.controls.begin(), config.controls.end(),
                                    [&](const ControlMapping& m) { return m.control == wanted; });
    return found == config.controls.end() ? nullptr : &*found;
  };
  const ControlMapping* levels = find(Control::kLightSwitch);
  if (levels == nullptr) return;
  const auto two = [&](const ControlMapping& other) {
    controls.fail(kControlNames[static_cast<std::size_t>(other.control)],
                  "two signals for one control: " + other.signal + " here, and " + levels->signal + " of light_switch");
  };
  for (const Control flag : {Control::kPosition, Control::kLow}) {
    if (const ControlMapping* other = find(flag)) two(*other);
  }
  const bool knows_high = std::any_of(levels->levels.begin(), levels->levels.end(),
                                      [](const auto& l) { return l.second == static_cast<int>(LightSwitch::kHigh); });
  if (const ControlMapping* other = find(Control::kHigh); other != nullptr && knows_high) two(*other);
}

std::filesystem::path named_file(TomlTable& table, std::string_view key) {
  const std::string named = table.text_or(key, "");
  return named.empty() ? std::filesystem::path{} : resolve_path(named, table.file());
}

Result<CockpitConfig> read(TomlTable root) {
  CockpitConfig config;
  config.file = root.file();
  TomlTable source = root.table("source");
  config.source = static_cast<SourceKind>(source.choice("kind", kSourceKindNames));
  const bool is_can = config.source == SourceKind::kCan;
  if (is_can) config.interface = source.text("interface");
  if (is_can && config.interface.size() > 15) source.fail("interface", "an interface's name has at most 15 letters");
  if (is_can || config.source == SourceKind::kLog) config.dbc_file = named_file(source, "dbc");
  if (!is_can && config.source != SourceKind::kKeyboard) config.input_file = named_file(source, "file");
  config.timeout_s = source.number_or("timeout_s", config.timeout_s, 0.001, kMostTimeout_s);
  config.debounce_s = source.number_or("debounce_s", config.debounce_s, 0.0, 1.0);

  if (auto controls = root.table_if("control")) {
    for (std::size_t i = 0; i < kControlNames.size(); ++i) {
      if (auto table = controls->table_if(kControlNames[i])) {
        config.controls.push_back(read_control(static_cast<Control>(i), *table, config.timeout_s));
      }
    }
    check_conflicts(*controls, config);
  } else if (is_can) {
    root.fail("source", "a CAN source needs at least one [control.…] table");
  }
  if (const Status status = root.finish(); !status) return status.error();
  return config;
}

}  // namespace

Result<CockpitConfig> read_cockpit(const std::filesystem::path& file) {
  Result<TomlTable> root = TomlTable::read(file);
  if (!root) return root.error();
  return read(*root);
}

Result<CockpitConfig> parse_cockpit(std::string_view text, const std::string& name) {
  Result<TomlTable> root = TomlTable::parse(text, name);
  if (!root) return root.error();
  return read(*root);
}

}  // namespace phare
