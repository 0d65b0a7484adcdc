// What a visual process does with each command (net/control_desk.h), and the words it answers with.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "config/desk.h"
#include "config/rig.h"
#include "net/control_desk.h"
#include "visual/process/lamps.h"

namespace phare {

/// Dims, turns, moves and aims lamps, sets the desk; refuses, with the reason, what this rig does not have. A design is
/// the cockpit's to choose: the answer is pending until it shines. Quit is left to who runs the process. All three
/// have to live as long as the verbs.
/// Of several pictures the first (`channel` 0) moves lamps by Mount, Undo and Reset and saves them; the others follow
/// its LampState. `no_reference` and `seen_from`: as DeskContext.
Verbs visual_verbs(Lamps& lamps, const Rig& rig, Desk& desk, std::uint32_t channel = 0,
                   const std::string& no_reference = {}, std::function<std::optional<FreeEye>()> seen_from = {});

/// What is lit, which design, every lamp of it (place, turn, dimmed sources), and what is set on the desk; a line each.
std::string text_of(const Lamps& lamps, const Desk& desk);

}  // namespace phare
