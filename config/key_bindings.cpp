#include "config/key_bindings.h"

#include <algorithm>
#include <array>

namespace phare {

namespace {

using enum KeyAction;
using enum KeyActor;

// Terminals send arrows in two ways (ECMA-48 cursor keys, and the "application" form of the VT100); F1 and F2 as the
// VT220 and as the VT100 do (xterm, "ctlseqs"), but what they show is in the window, so a terminal has no use for them.
constexpr KeyBinding kBindings[] = {
    {kAccelerate, kCar, key::kUp, "Up", {"\x1b[A", "\x1bOA"}, "accelerate"},
    {kBrake, kCar, key::kDown, "Down", {"\x1b[B", "\x1bOB"}, "brake"},
    {kSteerLeft, kCar, key::kLeft, "Left", {"\x1b[D", "\x1bOD"}, "steer left; the wheel comes back by itself"},
    {kSteerRight, kCar, key::kRight, "Right", {"\x1b[C", "\x1bOC"}, "steer right"},
    {kBrakeHard, kCar, ' ', "Space", {" "}, "brake as hard as the car can"},
    {kReverse, kCar, 'r', "R", {"r"}, "reverse gear, and back to drive"},
    {kParkingBrake, kCar, 'k', "K", {"k"}, "parking brake on or off"},
    {kHighBeam, kCar, 'h', "H", {"h"}, "high beam on or off"},
    {kFlash, kCar, 'f', "F", {"f"}, "flash, while held"},
    {kLightUp, kCar, 'l', "L", {"l"}, "light switch up: off, position, low, high"},
    {kLightDown, kCar, 'L', "Shift+L", {"L"}, "light switch down"},
    {kFogFront, kCar, 'g', "G", {"g"}, "front fog lamps on or off"},
    {kFogRear, kCar, 'b', "B", {"b"}, "rear fog lamp on or off"},
    {kTurnLeft, kCar, ',', ",", {","}, "turn signal left, and off"},
    {kTurnRight, kCar, '.', ".", {"."}, "turn signal right, and off"},
    {kHazard, kCar, 'w', "W", {"w"}, "hazard warning on or off"},
    {kAutomaticHigh, kCar, 'a', "A", {"a"}, "automatic high beam, where the cockpit file has it"},
    {kDesignNext, kCar, 'n', "N", {"n"}, "next design of the lamps"},
    {kDesignPrevious, kCar, 'p', "P", {"p"}, "previous design"},
    {kDemo, kCar, 'd', "D", {"d"}, "the demo driver takes the wheel; any driving key gives it back"},
    {kBeginAgain, kDrive, key::kBackspace, "Backspace", {}, "begin again from the start"},
    {kHelp, kPicture, key::kF1, "F1", {}, "show or hide these keys", "help toggle"},
    {kHelp, kPicture, '?', "?", {}, "the same", "help toggle"},
    {kPanel, kPicture, key::kF9, "F9", {}, "the panel: everything by the mouse", "panel toggle"},
    {kCamera,
     kPicture,
     'c',
     "C",
     {},
     "camera: driver, above, behind, oncoming, wall, mirrors, free, one's own",
     "camera next"},
    {kLayout, kPicture, 'v', "V", {}, "a second camera: in halves, in a corner, none", "layout next"},
    {kEyeForward, kPicture, '8', "8 2", {}, "the free eye forward, back; begins where one sees from"},
    {kEyeBack, kPicture, '2', "2", {}, ""},
    {kEyeLeft, kPicture, '4', "4 6", {}, "the same, left, right"},
    {kEyeRight, kPicture, '6', "6", {}, ""},
    {kEyeUp, kPicture, '9', "9 3", {}, "the same, up, down"},
    {kEyeDown, kPicture, '3', "3", {}, ""},
    {kEyeTurnLeft, kPicture, '7', "7 1", {}, "turns it left, right"},
    {kEyeTurnRight, kPicture, '1', "1", {}, ""},
    {kFalseColour, kPicture, key::kF2, "F2", {}, "lux in false colour, then clipping, then the photo", "view next"},
    {kEffects, kPicture, key::kF3, "F3", {}, "which effects are on, what they take, and why", "effects toggle"},
    {kMethod,
     kPicture,
     key::kF4,
     "F4",
     {},
     "where light is computed: pixels, vertices, as in 1998, float64",
     "method next"},
    {kMirrors, kPicture, key::kF7, "F7", {}, "mirrors over the picture", "mirrors toggle"},
    {kCompare,
     kPicture,
     key::kF8,
     "F8",
     {},
     "this design beside the next one: halves, by turns, difference, ratio",
     "compare next"},
    {kGrid, kPicture, key::kF5, "F5", {}, "grid on the road: 10 m, 20 m, none", "grid_m next"},
    {kPlot, kPicture, 't', "T", {}, "lux at the probes over time", "plot toggle"},
    {kIsolux, kPicture, key::kF6, "F6", {}, "isolux lines on the road", "road_isolux toggle"},
    {kLampChoose, kPicture, 'm', "M", {}, "move lamps: which pair or lamp; at the last, none"},
    {kLampQuantity, kPicture, 'x', "X", {}, "what of it: forward, left, up, spacing, yaw, pitch, roll"},
    {kLampMore, kPicture, key::kPageUp, "PageUp", {}, "the chosen lamps 1 cm or 0.1 deg further"},
    {kLampLess, kPicture, key::kPageDown, "PageDown", {}, "the same, back"},
    {kLampsUp, kPicture, key::kHome, "Home", {}, "all lamps 0.1 deg up"},
    {kLampsDown, kPicture, key::kEnd, "End", {}, "all lamps 0.1 deg down"},
    {kLampUndo, kPicture, 'u', "U", {}, "take back what was moved last"},
    {kLampReset, kPicture, 'U', "Shift+U", {}, "chosen lamps, or all, as in the rig file"},
    {kLeave, kPicture, key::kEscape, "Esc", {}, "hide keys or panel, or leave the drive"},
};

constexpr PadBinding kPadBindings[] = {
    {3, "Y (triangle)", kHighBeam},
    {1, "B (circle)", kFlash},
    {2, "X (square)", kFogFront},
    {4, "left bumper", kTurnLeft},
    {5, "right bumper", kTurnRight},
    {11, "D-pad up", kLightUp},
    {13, "D-pad down", kLightDown},
    {12, "D-pad right", kDesignNext},
    {14, "D-pad left", kDesignPrevious},
    {6, "Back", kReverse},
    {7, "Start", kDemo},
};

}  // namespace

std::span<const KeyBinding> key_bindings() {
  return kBindings;
}

const KeyBinding* binding_of(KeyCode code) {
  const auto* found = std::ranges::find(kBindings, code, &KeyBinding::code);
  return found == std::end(kBindings) ? nullptr : found;
}

const KeyBinding* binding_of(KeyAction action) {
  return std::ranges::find(kBindings, action, &KeyBinding::action);
}

std::optional<KeyCode> bound_code(KeyCode code) {
  if (binding_of(code) != nullptr) return code;
  if (code < 'A' || code > 'Z') return std::nullopt;
  const KeyCode lower = code - 'A' + 'a';
  return binding_of(lower) != nullptr ? std::optional(lower) : std::nullopt;
}

std::span<const PadBinding> pad_bindings() {
  return kPadBindings;
}

bool is_driving(KeyAction action) {
  switch (action) {
    case kAccelerate:
    case kBrake:
    case kSteerLeft:
    case kSteerRight:
    case kBrakeHard:
    case kReverse:
    case kParkingBrake:
      return true;
    default:
      return false;
  }
}

bool repeats(KeyAction action) {
  return action == kLampMore || action == kLampLess || action == kLampsUp || action == kLampsDown ||
         (action >= kEyeForward && action <= kEyeTurnRight);
}

std::optional<KeyCode> take_terminal_key(std::string_view& bytes) {
  for (const KeyBinding& binding : kBindings) {
    for (const std::string_view sent : binding.terminal) {
      if (sent.empty() || !bytes.starts_with(sent)) continue;
      bytes.remove_prefix(sent.size());
      return binding.code;
    }
  }
  // Not bound: one byte, or a whole escape sequence: ESC, [ or O, parameters, then one final byte.
  std::size_t size = 1;
  if (bytes.size() >= 3 && bytes[0] == '\x1b' && (bytes[1] == '[' || bytes[1] == 'O')) {
    size = 2;
    while (size < bytes.size() && (bytes[size] < '@' || bytes[size] > '~')) ++size;
    size = std::min(size + 1, bytes.size());
  }
  const auto first = static_cast<unsigned char>(bytes.empty() ? 0 : bytes.front());
  bytes.remove_prefix(std::min(size, bytes.size()));
  const auto letter = bound_code(first);  // Caps Lock
  return letter && !binding_of(*letter)->terminal[0].empty() ? letter : std::nullopt;
}

std::string key_list_text(std::string_view indent) {
  std::size_t width = 0;
  for (const KeyBinding& binding : kBindings) width = std::max(width, binding.name.size());
  std::string text;
  for (const KeyBinding& binding : kBindings) {
    if (binding.what.empty()) continue;
    text += indent;
    text += binding.name;
    text.append(width + 2 - binding.name.size(), ' ');
    text += binding.what;
    text += '\n';
  }
  return text;
}

std::string key_list_markdown() {
  std::string text = "| key | what it does | in a terminal too |\n| --- | --- | --- |\n";
  for (const KeyBinding& binding : kBindings) {
    if (binding.what.empty()) continue;
    text += "| ";
    text += binding.name;
    text += " | ";
    text += binding.what;
    text += binding.terminal[0].empty() ? " | no |\n" : " | yes |\n";
  }
  text +=
      "\n| gamepad | what it does |\n| --- | --- |\n| left stick, right and left trigger | steer, accelerate, brake "
      "|\n";
  for (const PadBinding& binding : kPadBindings) {
    text += "| ";
    text += binding.name;
    text += " | ";
    text += binding_of(binding.action)->what;
    text += " |\n";
  }
  return text;
}

}  // namespace phare
