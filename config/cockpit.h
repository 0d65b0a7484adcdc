// The cockpit file: where the driver's controls come from, which CAN signals they are, what is checked and what is sent
// back. Reader of config/cockpits/*.toml. How to write one: docs/cockpit-file.md and docs/add-a-car.md.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"
#include "config/control_levels.h"

namespace phare {

enum class SourceKind { kCan, kLog, kKeyboard, kDrive, kDriver, kGamepad };
inline constexpr std::array<std::string_view, 6> kSourceKindNames{"can",   "log",    "keyboard",
                                                                  "drive", "driver", "gamepad"};

enum class Control {
  kLightSwitch,  ///< levels off, position, low, high; auto counts as low: Phare drives at night
  kPosition,     ///< flags, for a car that has a bit for each lamp instead of levels
  kLow,
  kHigh,       ///< also beside a light_switch whose levels end at low: the stalk pushed to high
  kBeamLever,  ///< levels neutral, push, pull, half; latch none, push or pull
  kFlash,
  kFogFront,
  kFogRear,
  kTurn,  ///< levels none, left, right
  kTurnLeft,
  kTurnRight,
  kHazard,
  kDesignNext,
  kDesignPrevious,
  kLampAim,        ///< the levelling wheel: range from highest to lowest, lowest_deg of aim
  kAutomaticHigh,  ///< the switch of the automatic high beam
  kVehicleAhead,   ///< what its camera says
  kIgnition,
  kSteering,      ///< degrees of the steering wheel, left positive
  kAccelerator,   ///< 0 … 1
  kBrake,         ///< 0 … 1
  kClutch,        ///< 0 … 1
  kGear,          ///< levels drive, neutral, reverse, park
  kParkingBrake,  ///< 0 … 1
};
inline constexpr std::array<std::string_view, 24> kControlNames{
    "light_switch", "position",        "low",      "high",           "beam_lever",    "flash",
    "fog_front",    "fog_rear",        "turn",     "turn_left",      "turn_right",    "hazard",
    "design_next",  "design_previous", "lamp_aim", "automatic_high", "vehicle_ahead", "ignition",
    "steering",     "accelerator",     "brake",    "clutch",         "gear",          "parking_brake"};

/// A signal's value as the cockpit file writes it: physical, or a name of the DBC's VAL_ table.
struct NamedValue {
  double value = 0.0;
  std::string name;     ///< not empty: to be looked up
  std::string place{};  ///< "file:line" for messages
};

struct SignalLevel {
  NamedValue when;
  int level = 0;  ///< of LightSwitch, Gear, TurnSignal or Lever
};

enum class LatchKind { kNone, kPush, kPull };
inline constexpr std::array<std::string_view, 3> kLatchNames{"none", "push", "pull"};

/// One control and the signal it comes from. Values are physical, after the DBC's factor and offset; of a gamepad an
/// axis is -1 … 1 and a button 0 or 1.
struct ControlMapping {
  Control control = Control::kLightSwitch;
  std::string message, signal;  ///< CAN; of a gamepad `signal` is axisN, buttonN or hatN.up, .down, .left, .right
  std::string fine_signal;      ///< of the same message, added to the signal; empty: none
  std::string sign_signal;      ///< of the same message: anything but 0 makes the value negative
  std::string bits;             ///< where the car differs from the DBC file: "start|length@order sign"; or empty
  double timeout_s = 0.0;       ///< silence of the message after which the source counts as silent
  std::optional<double> debounce_s;
  std::vector<SignalLevel> levels;       ///< light_switch, beam_lever, turn, gear
  LatchKind latch = LatchKind::kNone;    ///< beam_lever; of a flag anything but none: each press switches it over
  std::vector<NamedValue> invalid;       ///< values of the signal that mean nothing: not available, an error
  std::vector<NamedValue> on;            ///< flags: the values that mean pressed; empty: anything but 0
  bool invert = false;                   ///< flags: pressed is released
  double scale = 1.0, offset_deg = 0.0;  ///< steering: signal * scale + offset, then degrees
  double lowest = 0.0, highest = 1.0;    ///< range: steering in degrees; pedals: signal values of 0 and 1
  double dead_zone = 0.0;       ///< steering: degrees on each side; pedals and the aim wheel: share of the range
  double lowest_aim_rad = 0.0;  ///< lamp_aim
  std::string place, signal_place, fine_place, sign_place, message_place, bits_place;  ///< "file:line" for messages
};

/// How a check is computed; docs/cockpit-file.md says each in a line.
enum class CrcKind {
  kNone,
  kE2eProfile1,
  kE2eProfile2,
  kCrc8,
  kCrc8SaeJ1850,
  kCrc8H2f,
  kCrc16CcittFalse,
  kCrc16Arc,
  kCrc32,
  kCrc32P4,
  kXor8,
  kSum8,
  kToyota,
  kHonda,
  kPolynomial,
};
inline constexpr std::array<std::string_view, 15> kCrcNames{
    "none",  "e2e-p1",   "e2e-p2", "crc8", "crc8-sae-j1850", "crc8-h2f", "crc16-ccitt-false", "crc16-arc",
    "crc32", "crc32-p4", "xor8",   "sum8", "toyota",         "honda",    "polynomial"};

/// A cyclic redundancy check by its parameters, as G. Cook's catalogue lists them.
struct CrcPolynomial {
  int width = 8;  ///< bits, 3 to 32
  std::uint32_t poly = 0, init = 0, xor_out = 0;
  bool reflect = false;                ///< input and output
  int first_byte = 0, last_byte = 63;  ///< of the frame, both included, without those the check lies in
  bool data_id_first = false;          ///< before the bytes instead of behind them
};

enum class DataIdMode { kBoth, kAlternating, kLow };
inline constexpr std::array<std::string_view, 3> kDataIdModeNames{"both", "alternating", "low"};

/// What a car checks of a message: an alive counter, a CRC. Also filled in where Phare sends the message.
struct MessageCheck {
  std::string message, counter, crc;           ///< signals; empty: none
  std::int64_t counter_step = 1;               ///< from frame to frame
  std::int64_t counter_most_lost = 5;          ///< frames that may be missing between two; beyond, one frame is refused
  std::optional<std::int64_t> counter_values;  ///< it counts 0 … so many less one; else as many as fit its bits
  CrcKind crc_kind = CrcKind::kNone;
  CrcPolynomial polynomial;  ///< of kPolynomial
  std::vector<std::int64_t>
      data_ids;  ///< e2e-p1: one; e2e-p2: sixteen; other CRCs: a byte, or none; polynomial: by the counter
  DataIdMode data_id_mode = DataIdMode::kBoth;
  std::string place, message_place, counter_place, crc_place;
};

/// What Phare can say on the bus.
enum class SendValue {
  kHighBeam,
  kLowBeam,
  kPosition,
  kFogFront,
  kFogRear,
  kTurnLeft,
  kTurnRight,
  kHazard,
  kAutomaticHigh,
  kFailSafe,
  kLightSwitch,
  kDesign,
  kSpeedKmh,
  kSpeedMps,
  kSteeringDeg,
  kOne,
};
inline constexpr std::array<std::string_view, 16> kSendValueNames{
    "high_beam",      "low_beam",  "position",     "fog_front", "fog_rear",  "turn_left", "turn_right",   "hazard",
    "automatic_high", "fail_safe", "light_switch", "design",    "speed_kmh", "speed_mps", "steering_deg", "one"};

struct SendSignal {
  std::string signal;
  SendValue value = SendValue::kHighBeam;
  std::string place;
};

/// A message sent back onto the bus, every period and at once when one of its telltales changes.
struct SendMessage {
  std::string message;
  double period_s = 0.1;
  std::vector<SendSignal> signals;
  std::string place;
};

struct CockpitConfig {
  std::filesystem::path file;
  SourceKind source = SourceKind::kKeyboard;
  std::string interface;             ///< can; log: of one of several buses, the one that is played; may be empty
  bool interface_is_asked = false;   ///< log: a flag gives it, so the log must have it; not of the file
  std::string device;                ///< gamepad: part of its name; empty: the first there is
  std::filesystem::path dbc_file;    ///< can, log; may be empty: then --dbc must give it
  std::filesystem::path input_file;  ///< log, drive, driver: their file; may be empty: then a flag must give it
  std::filesystem::path demo_file;   ///< keyboard: script of the demo driver; not of the file, a flag gives it
  bool demo_at_once = false;         ///< keyboard: the demo driver begins; not of the file
  bool any_gamepad = false;          ///< keyboard: a gamepad that is plugged in drives as well; not of the file
  double log_speed = 1.0;            ///< log: so many times as fast as it was recorded
  double timeout_s = 0.5;            ///< silence that means fail-safe, unless a control says otherwise
  double debounce_s = 0.02;
  int default_light = 0;        ///< LightSwitch where no control gives it
  bool automatic_high = false;  ///< the car has automatic high beam
  double automatic_above_mps = 40.0 / 3.6, automatic_below_mps = 25.0 / 3.6, automatic_delay_s = 1.5;
  std::vector<ControlMapping> controls;
  std::vector<MessageCheck> checks;
  std::vector<SendMessage> sends;
  std::vector<std::filesystem::path> also;  ///< cockpit files of further sources, in falling priority
  bool keep_design = false;                 ///< of the rig, not of this file: recorded changes of design are left out

  const ControlMapping* find(Control control) const;
};

/// Reads and checks a cockpit file. Files it names are resolved but not opened, and signals not looked up: the DBC file
/// may come from the command line.
Result<CockpitConfig> read_cockpit(const std::filesystem::path& file);

/// The same from text; `name` stands for the file.
Result<CockpitConfig> parse_cockpit(std::string_view text, const std::string& name);

}  // namespace phare
