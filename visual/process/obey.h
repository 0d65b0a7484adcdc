// What a visual process does with a command (net/control_desk.h), and the words it answers with.
#pragma once

#include <string>

#include "config/rig.h"
#include "net/messages.h"
#include "visual/process/lamps.h"

namespace phare {

/// Dims, turns, moves and aims lamps; refuses, with the reason, what this rig does not have. A design is the cockpit's
/// to choose: the answer is pending until it shines. Quit is accepted and left to the caller.
ControlReply obey(Lamps& lamps, const Rig& rig, const RigControl& control);

/// What is lit, which design, and every lamp of it: place, turn, dimmed sources; a line each.
std::string text_of(const Lamps& lamps);

}  // namespace phare
