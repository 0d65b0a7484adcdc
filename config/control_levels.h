// The levels of a cockpit's controls, by the numbers that net/phare.proto gives them.
#pragma once

#include <array>
#include <string_view>

namespace phare {

enum class LightSwitch { kOff = 0, kPosition = 1, kLow = 2, kHigh = 3 };
inline constexpr std::array<std::string_view, 4> kLightSwitchNames{"off", "position", "low", "high"};

enum class TurnSignal { kNone = 0, kLeft = 1, kRight = 2 };
enum class Gear { kDrive = 0, kNeutral = 1, kReverse = 2, kPark = 3 };

}  // namespace phare
