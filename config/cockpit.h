// The cockpit file: where the driver's controls come from, and which CAN signals they are. Reader of
// config/cockpits/*.toml. How to write one: docs/cockpit-file.md.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/result.h"

namespace phare {

enum class SourceKind { kCan, kLog, kKeyboard, kDrive, kDriver };
inline constexpr std::array<std::string_view, 5> kSourceKindNames{"can", "log", "keyboard", "drive", "driver"};

enum class Control {
  kLightSwitch,  ///< levels off, position, low, high
  kPosition,     ///< flags, for a car that has a bit for each lamp instead of levels
  kLow,
  kHigh,  ///< also beside a light_switch whose levels end at low: the stalk pushed to high
  kFlash,
  kFogFront,
  kDesignNext,
  kDesignPrevious,
  kIgnition,
  kSteering,     ///< degrees of the steering wheel, left positive
  kAccelerator,  ///< 0 … 1
  kBrake,        ///< 0 … 1
  kGear,         ///< levels drive, neutral, reverse, park
};
inline constexpr std::array<std::string_view, 13> kControlNames{
    "light_switch",    "position", "low",      "high",        "flash", "fog_front", "design_next",
    "design_previous", "ignition", "steering", "accelerator", "brake", "gear"};

/// One control and the signal it comes from. Values are physical, after the DBC's factor and offset.
struct ControlMapping {
  Control control = Control::kLightSwitch;
  std::string message, signal;
  std::string fine_signal;                         ///< of the same message, added to the signal; empty: none
  double timeout_s = 0.0;                          ///< silence of the message after which the source counts as silent
  std::vector<std::pair<double, int>> levels;      ///< signal value -> LightSwitch or Gear; light_switch and gear
  std::optional<double> on;                        ///< flags: the value that means pressed; else anything but 0
  double scale = 1.0, offset_deg = 0.0;            ///< steering: signal * scale + offset, then degrees
  double lowest = 0.0, highest = 1.0;              ///< range: steering in degrees; pedals: signal values of 0 and 1
  std::string place, signal_place, message_place;  ///< "file:line" for messages
};

struct CockpitConfig {
  std::filesystem::path file;
  SourceKind source = SourceKind::kKeyboard;
  std::string interface;             ///< can
  std::filesystem::path dbc_file;    ///< can, log; may be empty: then --dbc must give it
  std::filesystem::path input_file;  ///< log, drive, driver: their file; may be empty: then a flag must give it
  double timeout_s = 0.5;            ///< silence that means fail-safe, unless a control says otherwise
  double debounce_s = 0.02;
  std::vector<ControlMapping> controls;
};

/// Reads and checks a cockpit file. Files it names are resolved but not opened, and signals not looked up: the DBC file
/// may come from the command line.
Result<CockpitConfig> read_cockpit(const std::filesystem::path& file);

/// The same from text; `name` stands for the file.
Result<CockpitConfig> parse_cockpit(std::string_view text, const std::string& name);

}  // namespace phare
