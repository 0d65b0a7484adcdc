// Which setting of the desk forces which effect. By it the user switches an effect off and back, or chooses its level:
// in the rig file, on the command line, by `phare control set`, in the panel. Checked by
// tests/visual_process/effect_doors_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "config/desk.h"
#include "visual/effects.h"

namespace phare {

struct EffectDoor {
  Effect effect;
  std::string_view setting;  ///< of desk_settings()
  /// The level that it sets; null: it is the fact itself, and on or off there is on or off here.
  std::optional<std::size_t> Desk::*level;
};

/// In the order of Effect.
const std::array<EffectDoor, kEffectCount>& effect_doors();

/// What the user has set.
EffectChoices choices_of(const Desk& desk);

}  // namespace phare
