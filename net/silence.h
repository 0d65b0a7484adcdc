// What silence of the cockpit means to whoever shows its beam: low beam, whatever it said last.
//
// A cockpit that hangs, is stopped or killed, or whose datagrams do not come, cannot take back a high beam. So past
// channel_of<CockpitState>().stale_after every receiver falls back to what the switch logic does when the stalk itself
// is silent (docs/switch-logic.md): low beam, no flash, no fog lamps, no turn signal; hazard and design stay.
// Real time only: in lockstep no picture is drawn without the controls of its own frame.
#pragma once

#include <chrono>
#include <optional>

#include "net/bus.h"
#include "net/messages.h"

namespace phare {

/// The cockpit has not been heard for so long that what it said last holds no more.
bool is_silent(std::chrono::nanoseconds silence);

/// `controls` as they are to be shown after `silence`: as they stand, or the fail-safe with its reason in source_fault.
CockpitState after_silence(CockpitState controls, std::chrono::nanoseconds silence);

/// The newest controls on this bus as they are to be shown at `now`; low beam before the first.
CockpitState controls_to_show(const Bus& bus, std::chrono::steady_clock::time_point now);

}  // namespace phare
