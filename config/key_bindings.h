// Every key there is, once: what it is called, what the window and the terminal call it, what it does, and who does it.
// The window and the terminal bind by this table; help, start screen, --help and docs/driving.md are made from it. A
// key means one thing everywhere.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace phare {

/// A key as it travels in KeyInput: letters and signs by their character (upper case: with Shift), the others by GLFW's
/// number (GLFW 3.3, "Keyboard key tokens"), as the window process asserts.
using KeyCode = std::uint32_t;
namespace key {
inline constexpr KeyCode kEscape = 256, kBackspace = 259, kRight = 262, kLeft = 263, kDown = 264, kUp = 265,
                         kPageUp = 266, kPageDown = 267, kHome = 268, kEnd = 269, kF1 = 290, kF2 = 291, kF3 = 292,
                         kF4 = 293, kF5 = 294, kF6 = 295, kF7 = 296, kF8 = 297, kF9 = 298;
}  // namespace key

enum class KeyAction {
  kAccelerate,
  kBrake,
  kSteerLeft,
  kSteerRight,
  kBrakeHard,
  kReverse,
  kParkingBrake,
  kLightUp,
  kLightDown,
  kHighBeam,
  kFlash,
  kFogFront,
  kFogRear,
  kTurnLeft,
  kTurnRight,
  kHazard,
  kAutomaticHigh,
  kDesignNext,
  kDesignPrevious,
  kDemo,
  kBeginAgain,
  kHelp,
  kPanel,
  kCamera,
  kFalseColour,
  kEffects,
  kMethod,
  kMirrors,
  kCompare,
  kGrid,
  kIsolux,
  kLampChoose,
  kLampQuantity,
  kLampMore,
  kLampLess,
  kLampsUp,
  kLampsDown,
  kLampUndo,
  kLampReset,
  kEyeForward,
  kEyeBack,
  kEyeLeft,
  kEyeRight,
  kEyeUp,
  kEyeDown,
  kEyeTurnLeft,
  kEyeTurnRight,
  kLayout,
  kPlot,
  kLeave,
};
inline constexpr std::size_t kKeyActions = 50;

/// Who acts on a key: the car (phare-cockpit), the picture (phare-visual), or the drive as a whole (phare drive).
enum class KeyActor { kCar, kPicture, kDrive };

struct KeyBinding {
  KeyAction action;
  KeyActor actor;
  KeyCode code;
  std::string_view name;                     ///< as it is printed on the key: "Up", "L", "Shift+L"
  std::array<std::string_view, 2> terminal;  ///< what terminals send for it; empty: only the window has this key
  std::string_view what;                     ///< what it does, in a few words; empty: told with the key before it
  std::string_view desk{};                   ///< a setting of the picture that it changes (config/desk.h)
};

/// In the order of the help.
std::span<const KeyBinding> key_bindings();

/// nullptr: the key is not bound.
const KeyBinding* binding_of(KeyCode code);
const KeyBinding* binding_of(KeyAction action);  ///< the first of its keys; never nullptr

/// Steering, pedals, gear: whoever presses one wants to drive.
bool is_driving(KeyAction action);

/// Held, it goes on step by step in the window.
bool repeats(KeyAction action);

/// A letter with Shift or Caps Lock counts as the letter where the upper case is not bound; nullopt: neither is.
std::optional<KeyCode> bound_code(KeyCode code);

/// A button of a gamepad as GLFW 3.3 maps the usual ones ("Gamepad buttons").
struct PadBinding {
  std::size_t button;
  std::string_view name;
  KeyAction action;
};
/// Stick and triggers steer, accelerate and brake besides.
std::span<const PadBinding> pad_bindings();

/// Takes the first key off what a terminal sent; nullopt: it was none that is bound. Never takes nothing from bytes
/// that are not empty.
std::optional<KeyCode> take_terminal_key(std::string_view& bytes);

/// "Up, Down, Left, Right" and what they do: the table as lines of text, the words in one column, `indent` before each.
std::string key_list_text(std::string_view indent);

/// The same as rows of a Markdown table.
std::string key_list_markdown();

}  // namespace phare
