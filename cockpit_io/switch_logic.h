// Switch logic: from the stalk as the driver holds it to the lights that are to burn.
// What: debounce, the state table below, fail-safe, and the count and stamps of light changes.
// Source: UN R48 5.12 (main beam, dipped beam and front fog lamps only with position lamps, the flash excepted); high
// only with low on, as cars have it; fail-safe low beam: design §3 and §7. Frame: none. Leaves out: automatic high beam,
// rear fog, turn signals. Tests: tests/cockpit_io/switch_logic_test.cpp walks through every row.
// The same table is in docs/switch-logic.md.
//
//   ignition | source | stalk     high pushed | light switch out | flash out        | front fog out
//   ---------+--------+-----------------------+------------------+------------------+---------------------------
//   on       | alive  | off       any         | off              | as held          | off
//   on       | alive  | position  any         | position         | as held          | as switched
//   on       | alive  | low       no          | low              | as held          | as switched
//   on       | alive  | low       yes         | high             | as held          | as switched
//   off      | alive  | off       any         | off              | off              | off
//   off      | alive  | position  any         | position         | off              | off
//   off      | alive  | low       any         | off              | off              | off
//   on       | silent | any       any         | low (fail-safe)  | off              | off
//   off      | silent | any       any         | as alive         | off              | off
//
// Design next and previous act when they are pressed (not while held), in every row; the index wraps at both ends.
// Debounce: a control takes the first edge at once, so that no time passes between stalk and beam, and then holds for
// debounce_ns whatever bounces; after that it follows where the contact has come to rest.
#pragma once

#include <cstdint>

#include "net/messages.h"
#include "net/sim_time.h"

namespace phare {

/// A point in both times.
struct Moment {
  SimTime sim;
  WallTime wall;

  friend bool operator==(const Moment&, const Moment&) = default;
};

/// The stalk as it is held.
struct SwitchInput {
  LightSwitch stalk = LightSwitch::kOff;  ///< off, position, low; high means low with high pushed
  bool high = false;                      ///< stalk pushed to high, counts only with low
  bool flash = false;
  bool fog_front = false;
  bool design_next = false;
  bool design_previous = false;
  bool ignition = true;

  friend bool operator==(const SwitchInput&, const SwitchInput&) = default;
};

struct SwitchParams {
  std::int64_t debounce_ns = 20'000'000;
  std::uint32_t design_count = 1;
};

/// The lights that are to burn: fields 2 to 5 of CockpitState.
struct Lights {
  LightSwitch light_switch = LightSwitch::kOff;
  bool flash = false;
  bool fog_front = false;
  std::uint32_t design_index = 0;

  friend bool operator==(const Lights&, const Lights&) = default;
};

/// One debounced control.
struct DebouncedControl {
  int value = 0;                    ///< what counts
  int raw = 0;                      ///< what the contact says
  Moment raw_since;                 ///< when the contact last changed
  std::int64_t quiet_until_ns = 0;  ///< SimTime before which value holds; 0: at once
};

struct SwitchState {
  DebouncedControl stalk, high, flash, fog_front, design_next, design_previous, ignition{1, 1, {}, 0};
  Lights lights;
  bool fail_safe = false;
  std::uint64_t light_changes = 0;  ///< counts changes of `lights`
  Moment light_change;              ///< when the contact moved that caused the newest one
};

/// Moves the state on to `now`. `silent`: the source has said nothing for its timeout, `input` is what it said last.
/// `now.sim` must not go back between calls.
void advance_switches(const SwitchParams& params, const SwitchInput& input, bool silent, Moment now,
                      SwitchState& state);

/// A design chosen from elsewhere (RigControl); beyond the last one it wraps.
void choose_design(const SwitchParams& params, std::uint32_t design_index, Moment now, SwitchState& state);

}  // namespace phare
