// Switch logic: from the stalk as the driver holds it to the lights that are to burn.
// What: debounce, the state tables below, automatic high beam, fail-safe, telltales, the count and stamps of light
// changes. Source: UN R48: 5.12 (main beam, dipped beam and front fog lamps only with position lamps, the flash
// excepted), 6.1.7 (main beam by hand or automatic, by hand always), 6.1.8 and 6.11.8 (telltales), 6.5.9 (90 ± 30
// flashes a minute), 6.6.7 (hazard also with the ignition off), 6.11.7 (rear fog); high only with low on, as cars have
// it; fail-safe low beam: design §3 and §7. Frame: none. Leaves out: the delay and bulb-failure rate of real flashers.
// Tests: tests/cockpit_io/switch_logic_test.cpp walks through every row and every transition.
// The same tables are in docs/switch-logic.md.
//
//   ignition | source | stalk     high pushed | light switch out      | flash out | front fog out
//   ---------+--------+-----------------------+-----------------------+-----------+--------------
//   on       | alive  | off       any         | off                   | as held   | off
//   on       | alive  | position  any         | position              | as held   | as switched
//   on       | alive  | low       no          | low, automatic's high | as held   | as switched
//   on       | alive  | low       yes         | high                  | as held   | as switched
//   on       | silent | any       any         | low (fail-safe)       | off       | off
//   off      | any    | position  any         | position              | off       | off
//   off      | any    | else      any         | off                   | off       | off
//
//   rear fog: off -> lit    when its switch is moved to on while position lamps burn, and low, high or front fog burns
//                           then or later
//             lit -> off    when its switch is moved to off, or position lamps go out; a switch left on has then to be
//                           moved to off and on again. Lit, it needs no more than the position lamps.
//   automatic high beam (armed with: option on, switch on, low on, alive, ignition on):
//             armed -> high when nobody has been ahead for its delay and the car is fast enough
//             high -> armed at once when somebody is ahead or the car is slow
//             any -> asleep when the driver pulls the flash while the automatic's high burns
//             asleep -> armed  when the switch of the automatic is moved to on, or the stalk comes to low anew
//   beam lever (push and pull, where the car has one; counts as "high pushed" and as the flash):
//             stays:  pushed is high, pulled is flash, as long as it is held there
//             latch on push: each push with low on turns high over; a pull turns a latched high off, and else flashes
//             latch on pull: each pull with low on turns high over; without low it flashes; a push turns high on
//             pulled half: flash. A latched high ends when low or the ignition goes off.
//   turn: as the lever is held with the ignition on and the source alive. Hazard: as switched, always.
//
// Design next and previous act when they are pressed (not while held), in every row; the index wraps at both ends.
// Debounce: a control takes the first edge at once, so that no time passes between stalk and beam, and then holds for
// debounce_ns whatever bounces; after that it follows where the contact has come to rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "net/messages.h"
#include "net/sim_time.h"

namespace phare {

/// A point in both times.
struct Moment {
  SimTime sim;
  WallTime wall;

  friend bool operator==(const Moment&, const Moment&) = default;
};

/// A lever that is pushed away from the driver and pulled to him.
enum class Lever { kNeutral, kPush, kPull, kHalf };
enum class LeverLatch { kStays, kPush, kPull };

/// The stalk as it is held.
struct SwitchInput {
  LightSwitch stalk = LightSwitch::kOff;  ///< off, position, low; high means low with high pushed
  bool high = false;                      ///< stalk pushed to high, counts only with low
  bool flash = false;
  bool fog_front = false;
  bool design_next = false;
  bool design_previous = false;
  bool ignition = true;
  bool fog_rear = false;
  TurnSignal turn = TurnSignal::kNone;
  bool hazard = false;
  Lever lever = Lever::kNeutral;
  bool automatic = true;  ///< switch of the automatic high beam; counts only where the option is on
  bool ahead = false;     ///< somebody to be dazzled: a camera's oncoming or preceding vehicle

  friend bool operator==(const SwitchInput&, const SwitchInput&) = default;
};

/// The contacts, each debounced.
enum class Contact {
  kStalk,
  kHigh,
  kFlash,
  kFogFront,
  kDesignNext,
  kDesignPrevious,
  kIgnition,
  kFogRear,
  kTurn,
  kHazard,
  kAutomatic,
  kLever,
};
inline constexpr std::size_t kContacts = 12;

struct SwitchParams {
  std::int64_t debounce_ns = 20'000'000;
  std::uint32_t design_count = 1;
  std::array<std::optional<std::int64_t>, kContacts> own_debounce_ns{};  ///< by Contact, where it differs
  LeverLatch lever_latch = LeverLatch::kStays;
  bool automatic_high = false;                      ///< the car has automatic high beam
  double automatic_above_mps = 40.0 / 3.6;          ///< high from this speed on; chosen, as cars have it
  double automatic_below_mps = 25.0 / 3.6;          ///< low below it
  std::int64_t automatic_delay_ns = 1'500'000'000;  ///< nobody ahead for so long
};

/// The lights that are to burn: fields 2 to 5 of CockpitState.
struct Lights {
  LightSwitch light_switch = LightSwitch::kOff;
  bool flash = false;
  bool fog_front = false;
  std::uint32_t design_index = 0;

  friend bool operator==(const Lights&, const Lights&) = default;
};

/// What the road ahead does not see: the other lamps and the state of the automatic.
struct Signals {
  bool fog_rear = false;
  TurnSignal turn = TurnSignal::kNone;
  bool hazard = false;
  bool automatic_armed = false;

  friend bool operator==(const Signals&, const Signals&) = default;
};

/// The lamps of the instrument panel.
struct Telltales {
  bool high_beam = false;  ///< also while the flash is held
  bool low_beam = false;
  bool position = false;
  bool fog_front = false;
  bool fog_rear = false;
  bool turn_left = false;  ///< flashing: whether it is lit now
  bool turn_right = false;
  bool hazard = false;  ///< flashing
  bool automatic_high = false;
  bool fail_safe = false;

  friend bool operator==(const Telltales&, const Telltales&) = default;
};

/// One debounced control.
struct DebouncedControl {
  int value = 0;                    ///< what counts
  int raw = 0;                      ///< what the contact says
  Moment raw_since;                 ///< when the contact last changed
  std::int64_t quiet_until_ns = 0;  ///< SimTime before which value holds; 0: at once
};

struct SwitchState {
  std::array<DebouncedControl, kContacts> contacts = at_rest();
  Lights lights;
  Signals signals;
  bool fail_safe = false;
  std::uint64_t light_changes = 0;  ///< counts changes of `lights`
  Moment light_change;              ///< when the contact moved that caused the newest one

  bool lever_high = false;       ///< high latched by the lever
  bool lever_flash = false;      ///< the lever flashes
  bool fog_rear_wanted = false;  ///< its switch was moved to on while position lamps burned
  bool automatic_asleep = false;
  bool automatic_high = false;      ///< the automatic has high beam on
  std::int64_t clear_since_ns = 0;  ///< SimTime since when nobody is ahead
  bool ahead = false;
  SimTime flashing_since;  ///< of turn or hazard

  static constexpr std::array<DebouncedControl, kContacts> at_rest() {
    std::array<DebouncedControl, kContacts> contacts{};
    for (const Contact on : {Contact::kIgnition, Contact::kAutomatic}) {
      contacts[static_cast<std::size_t>(on)].value = contacts[static_cast<std::size_t>(on)].raw = 1;
    }
    return contacts;
  }
};

/// Moves the state on to `now`. `silent`: the source has said nothing for its timeout, `input` is what it said last.
/// `now.sim` must not go back between calls. `speed_mps`: for the automatic high beam.
void advance_switches(const SwitchParams& params, const SwitchInput& input, bool silent, Moment now, SwitchState& state,
                      double speed_mps = 0.0);

/// A design chosen from elsewhere (RigControl); beyond the last one nothing changes: its sender has been told.
void choose_design(const SwitchParams& params, std::uint32_t design_index, Moment now, SwitchState& state);

Telltales telltales(const SwitchState& state, SimTime now);

}  // namespace phare
